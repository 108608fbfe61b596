"""Pictures worth looking at: rooms from above, networks, timelines; and tasks in plain words.

Everything is loaded when it is first asked for, because Matplotlib takes its time.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from understudy.figures.arena import draw_arena
    from understudy.figures.dot import to_dot
    from understudy.figures.network import draw_network
    from understudy.figures.network_layout import Layout, Place, layout
    from understudy.figures.numbering import numbers_of
    from understudy.figures.progress import draw_progress
    from understudy.figures.progress_average import draw_progress_average
    from understudy.figures.saving import save
    from understudy.figures.timeline import draw_observations
    from understudy.figures.trajectories import Mark, Trajectory, marks_of_cues, marks_of_run
    from understudy.figures.why import WhyWords
    from understudy.figures.words import describe_task
    from understudy.figures.words_conditions import condition_in_words
    from understudy.figures.words_difference import describe_difference
    from understudy.figures.words_goals import goal_in_words
    from understudy.figures.words_language import compared_in_words, describe_language, membership_in_words
    from understudy.figures.words_lesson import describe_lesson
    from understudy.figures.words_order import describe_deviations
    from understudy.figures.words_regression import describe_misfit, describe_regression, sittings_in_words

__all__ = [
    "Layout",
    "Mark",
    "Place",
    "Trajectory",
    "WhyWords",
    "compared_in_words",
    "condition_in_words",
    "describe_deviations",
    "describe_difference",
    "describe_language",
    "describe_lesson",
    "describe_misfit",
    "describe_regression",
    "describe_task",
    "draw_arena",
    "draw_network",
    "draw_observations",
    "draw_progress",
    "draw_progress_average",
    "goal_in_words",
    "layout",
    "marks_of_cues",
    "marks_of_run",
    "membership_in_words",
    "numbers_of",
    "save",
    "sittings_in_words",
    "to_dot",
]

_HOMES = {
    "arena": ("draw_arena",),
    "dot": ("to_dot",),
    "network": ("draw_network",),
    "network_layout": ("Layout", "Place", "layout"),
    "numbering": ("numbers_of",),
    "progress": ("draw_progress",),
    "progress_average": ("draw_progress_average",),
    "saving": ("save",),
    "timeline": ("draw_observations",),
    "trajectories": ("Mark", "Trajectory", "marks_of_cues", "marks_of_run"),
    "why": ("WhyWords",),
    "words": ("describe_task",),
    "words_conditions": ("condition_in_words",),
    "words_difference": ("describe_difference",),
    "words_order": ("describe_deviations",),
    "words_goals": ("goal_in_words",),
    "words_language": ("compared_in_words", "describe_language", "membership_in_words"),
    "words_lesson": ("describe_lesson",),
    "words_regression": ("describe_misfit", "describe_regression", "sittings_in_words"),
}


def __getattr__(name: str) -> Any:
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{home}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
