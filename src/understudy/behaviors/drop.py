"""``Drop``: let go of whatever the gripper holds (§3.5.3.2, A.4)."""

from collections.abc import Mapping
from random import Random

from understudy.behaviors.skill import Action, Actuator, Drive, Instance, Memory, Parameter, Parameters, Skill
from understudy.behaviors.symbols import BOX, TARGET, Way
from understudy.perception import Percepts

__all__ = ["DROP", "AbstractDrop", "PrimitiveDrop"]


class AbstractDrop:
    """Goal: ``HaveObject = FALSE``."""

    name = "Drop"
    parameters: tuple[Parameter, ...] = ()
    actuators = frozenset({Actuator.WHEELS, Actuator.GRIPPER})
    maintaining = False
    ways = (
        Way(goal="gripper_empty", ends="holding(*), near(*)"),  # it backs off and turns
        Way(
            of={"box": BOX, "target": TARGET},
            goal="gripper_empty",
            needs="holding(box), near(target)",
            gives="carried(box, target)",
            ends="holding(*), near(*)",
        ),
    )

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        return percepts.gripper is not None and percepts.gripper.empty

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return percepts.gripper is not None

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        if percepts.gripper is None or not percepts.gripper.empty:
            return {}
        return {Instance(self.name): {}}

    def describe(self, parameters: Parameters) -> str:
        return "drop what the gripper holds"

    def holding(self, parameters: Parameters) -> str:
        return "the gripper is empty"

    def possible(self, parameters: Parameters) -> str:
        return "the gripper is there"


class PrimitiveDrop:
    """Lowers, opens, backs off while turning so as not to grab it again, closes and lifts (A.4)."""

    lower_ticks = 8
    open_ticks = 16
    back_ticks = 40
    end_ticks = 48

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        ticks = memory.get("ticks", 0) + 1
        keep_on = ticks < self.end_ticks
        if ticks <= self.lower_ticks:
            action = Action(drive=Drive(), lift="down", keep_on=keep_on)
        elif ticks <= self.open_ticks:
            action = Action(drive=Drive(), paddles="open", keep_on=keep_on)
        elif ticks <= self.back_ticks:
            # Straight until the paddles' tips are clear of the box, then turning.
            turn = 0.0 if ticks < self.open_ticks + 14 else 0.6
            action = Action(drive=Drive(linear=-0.15, angular=turn), paddles="open", keep_on=keep_on)
        else:
            action = Action(drive=Drive(), paddles="close", lift="up", keep_on=keep_on)
        return action, {"ticks": ticks if keep_on else 0}


DROP = Skill(AbstractDrop(), PrimitiveDrop())
