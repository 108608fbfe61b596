"""From the actions that behaviors ask for to the one command that the robot gets (semantics §3, step 7)."""

from collections.abc import Sequence

from understudy.behaviors.avoid import Avoid
from understudy.behaviors.skill import Action, Drive, Head
from understudy.behaviors.surroundings import surroundings
from understudy.perception import Percepts
from understudy.robot import Command, RobotSpec

__all__ = ["Motion"]


class Motion:
    """Merges actions, lets ``Avoid`` override, and keeps to the robot's limits. Holds no run-time state."""

    def __init__(self, spec: RobotSpec) -> None:
        self.spec = spec
        self.avoid = Avoid(spec)

    def command(self, actions: Sequence[Action], percepts: Percepts) -> tuple[Command, bool]:
        """The command for this tick.

        Args:
            actions: of the executing behaviors, whose actuators are disjoint; ``Wander``'s or the follower's among
            them.
            percepts: for the obstacles.

        Returns:
            The command, and whether ``Avoid`` overrode the wheels.
        """
        drive, overridden = Drive(), False
        paddles = next((action.paddles for action in actions if action.paddles), None)
        lift = next((action.lift for action in actions if action.lift), None)
        driving = next((action for action in actions if action.drive is not None), None)
        if driving is not None and driving.drive is not None:
            wanted, met = driving.drive, percepts.obstacles
            if driving.pushing is not None:
                met = met[~driving.pushing.holds(met)]
            if isinstance(wanted, Head):
                around = surroundings(percepts, driving.aim)
                if driving.pushing is not None and not driving.pushing.shy:
                    around = around[~driving.pushing.holds(around)]
                wanted = self.avoid.steer(wanted, around, driving.aim, driving.aim_radius)
            # Small boxes are gone around, but they are light: better to push one a little than to be stuck beside it.
            drive, overridden = self.avoid.guard(wanted, met, driving.aim, driving.aim_radius)
        top, spin = self.spec.max_linear, self.spec.max_angular
        command = Command(
            linear=max(-top, min(top, drive.linear)),
            angular=max(-spin, min(spin, drive.angular)),
            paddles=paddles,
            lift=lift,
        )
        return command, overridden
