"""Every error that a user of Understudy can meet.

The tree::

    UnderstudyError
    ├── DocumentError        a document (world, task, intervals, context, experiment, robot) is malformed
    │   ├── WorldError
    │   ├── RobotDocumentError
    │   ├── NetworkError
    │   ├── ContextError     a saved run cannot be gone on with
    │   └── ExperimentError
    ├── SkillError           an unknown skill, or a parameter that a skill does not take
    ├── RobotError           the robot's readings cannot be used, or it stopped answering
    ├── RecordingError       a recording cannot be read or written
    ├── LanguageError        a task's language is too large, or too empty, for what was asked
    ├── LearningError        a demonstration holds nothing that can be learned, or that goes with the task
    ├── LibraryError         the library cannot be opened, read or written, or has not what was asked for
    ├── PlanningError        a goal cannot be read, or means nothing to the skills
    │   └── NoPlanError      no plan reaches it
    ├── CampaignError        the trials of an experiment cannot be made, kept or gone on with
    └── MissingExtraError    an optional package is not installed

A message says what was given, what would have been valid, and how to mend it, in one or two lines.
The command line prints it without a traceback and exits with 2.
"""

__all__ = [
    "CampaignError",
    "ContextError",
    "DocumentError",
    "ExperimentError",
    "LanguageError",
    "LearningError",
    "LibraryError",
    "MissingExtraError",
    "NetworkError",
    "NoPlanError",
    "PlanningError",
    "RecordingError",
    "RobotDocumentError",
    "RobotError",
    "SkillError",
    "UnderstudyError",
    "WorldError",
]


class UnderstudyError(Exception):
    """Root of all errors that Understudy raises on purpose."""


class DocumentError(UnderstudyError):
    """A document is malformed.

    Args:
        problem: what is wrong and what would be valid.
        source: the file, or another name of the document.
        path: where in the document, for example ``targets[2].color``.
    """

    def __init__(self, problem: str, *, source: str = "", path: str = "") -> None:
        self.problem = problem
        self.source = source
        self.path = path
        where = ": ".join(part for part in (source, path) if part)
        super().__init__(f"{where}: {problem}" if where else problem)


class WorldError(DocumentError):
    """A world document is malformed."""


class RobotDocumentError(DocumentError):
    """A robot document is malformed."""


class NetworkError(DocumentError):
    """A behavior network is malformed: a cycle, a dangling link, two components with one id."""


class ContextError(DocumentError):
    """A saved run is malformed, or belongs to another task."""


class ExperimentError(DocumentError):
    """An experiment document is malformed, or names what is not there."""


class SkillError(UnderstudyError):
    """An unknown skill, or parameter values that the skill does not take."""


class RobotError(UnderstudyError):
    """The robot's readings cannot be used, or it stopped answering."""


class RecordingError(UnderstudyError):
    """A recording cannot be read or written."""


class LanguageError(UnderstudyError):
    """A task's language is too large, or too empty, for what was asked of it."""


class LearningError(UnderstudyError):
    """A demonstration holds nothing that can be learned, or does not go with the task it is added to."""


class LibraryError(UnderstudyError):
    """The library of tasks cannot be opened, read or written, or has not what was asked for."""


class PlanningError(UnderstudyError):
    """A goal cannot be read, or means nothing to the skills."""


class NoPlanError(PlanningError):
    """No plan reaches a goal.

    Args:
        goal: as it is understood.
        missing: in words, what stands in the way.
    """

    def __init__(self, goal: str, missing: tuple[str, ...]) -> None:
        self.goal = goal
        self.missing = missing
        super().__init__("\n  ".join((f"there is no plan for {goal}:", *missing)))


class CampaignError(UnderstudyError):
    """The trials of an experiment cannot be made, kept or gone on with."""


class MissingExtraError(UnderstudyError):
    """An optional package is not installed; the message names the extra."""
