"""What is shown between COME and GO: the robot follows its teacher, and learns a piece of the task (§6.2)."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from understudy.behaviors import Skill
from understudy.generalization import Symbol
from understudy.learning import Apprentice, Instance, LearningSettings, Observer, evaluate, learn
from understudy.network import Network
from understudy.perception import Percepts
from understudy.practice.corrections import Correction
from understudy.robot import Command, Cue, RobotSpec

__all__ = ["Showing"]

_AS_IN_A_DEMONSTRATION = {Cue.COME: Cue.START, Cue.GO: Cue.DONE}


class Showing:
    """One COME … GO.

    Args:
        asked: the COME.
        skills: by name.
        spec: the robot.
        settings: of the learner.
        seed: of all chance.
    """

    def __init__(
        self,
        asked: Correction,
        skills: Mapping[str, Skill],
        spec: RobotSpec,
        settings: LearningSettings | None = None,
        *,
        seed: int = 0,
    ) -> None:
        self.asked = asked
        self._skills = skills
        # BAD is a word about the run here, and takes nothing of the lesson back.
        self._settings = replace(settings or LearningSettings(), begin=Cue.COME, end=Cue.GO, take_back_s=0.0)
        self._apprentice = Apprentice(skills, spec, seed=seed)
        self._observer = Observer(self._settings)

    def step(self, percepts: Percepts, cues: Sequence[Cue]) -> tuple[Command, list[dict[str, Any]]]:
        """The command for this tick, and what is to be told of it.

        Args:
            percepts: of this tick.
            cues: heard since the last one; the first of the first tick is COME, and GO is the last.
        """
        self._observer.step(percepts.time_s, evaluate(percepts, self._skills), cues)
        words = [_AS_IN_A_DEMONSTRATION.get(cue, cue) for cue in cues]
        command, news = self._apprentice.step(percepts, words)
        return command, [record for record in news if record["kind"] != "heard"]

    def piece(self, name: str, held: Collection[Symbol]) -> Network:
        """What was learned.

        Args:
            name: of the demonstration, in the evidence.
            held: what had to hold all the while: if it did so from the beginning, it is a condition, and no step.

        Raises:
            LearningError: nothing was.
        """
        demonstration = self._observer.finish(name=name)
        begun_s = demonstration.span.start
        seen = tuple(
            one
            for one in demonstration.observations
            if _symbol(one.instance) not in held or one.interval.start > begun_s
        )
        return learn(replace(demonstration, observations=seen), self._settings).network


def _symbol(instance: Instance) -> Symbol:
    return Symbol(instance.behavior, tuple(sorted((name, str(value)) for name, value in instance.parameters)))
