"""One simulated robot's body: commands become servo targets, and the state of its joints is read."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from understudy.clock import CONTROL_PERIOD_S
from understudy.geometry import Point, Pose, wrap_angle
from understudy.robot import STOP, Command, GripperGeometry, RobotSpec
from understudy.sim.model import RobotIndex

__all__ = ["RobotBody"]

_PADDLE_TRAVEL_S = 0.8
_LIFT_TRAVEL_S = 0.8
_CLOSED, _UP = 0.1, 0.9
"""Paddles this little open, as a share of their opening, count as closed; a gripper this far up counts as lifted."""
_SHY_M = 0.0008
"""The gripper's servos aim this far short of their stops: a joint that rests on a stop costs the solver time."""


def _toward(now: float, goal: float, most: float) -> float:
    return now + min(most, max(-most, goal - now))


class RobotBody:
    """Drives one robot in the simulation. Truth: only the simulator, the teacher and the referee may read it.

    Args:
        index: where the robot is in MuJoCo's arrays.
        spec: what it is made of.
        data: MuJoCo's state.
        start: where it is switched on.
    """

    def __init__(self, index: RobotIndex, spec: RobotSpec, data: Any, start: Pose) -> None:
        self.index = index
        self.spec = spec
        self.command: Command = STOP
        self._qpos = data.qpos
        self._pose = data.qpos[index.pose]
        self._speed = data.qvel[index.speed]
        self._open, self._raised = False, True
        self._servos = np.zeros(3)
        if spec.gripper is not None:
            up = spec.gripper.lift_height - _SHY_M
            self._servos = np.array([0.0, 0.0, 0.0, _SHY_M, up])
            data.qpos[index.left] = data.qpos[index.right] = _SHY_M
            data.qpos[index.lift] = up
        self.place(start)

    def place(self, pose: Pose) -> None:
        """Puts the robot somewhere, standing still."""
        self._pose[:] = pose.x, pose.y, pose.heading
        self._speed[:] = 0.0
        self._servos[:2] = 0.0

    def halt(self) -> None:
        """Brakes with all the force that the wheels have, instead of the gentle ramp."""
        self.command = STOP
        self._servos[:2] = 0.0

    def take(self, command: Command) -> None:
        """Keeps a command for the coming periods."""
        self.command = command
        if command.paddles is not None:
            self._open = command.paddles == "open"
        if command.lift is not None:
            self._raised = command.lift == "up"

    def advance_servos(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Servo targets at the beginning and at the end of the coming period, within the spec's limits."""
        spec, dt = self.spec, CONTROL_PERIOD_S
        begin = self._servos
        driving, turning, _, *hand = begin.tolist()
        gripper = spec.gripper
        linear = min(spec.max_linear, max(-spec.max_linear, self.command.linear))
        angular = min(spec.max_angular, max(-spec.max_angular, self.command.angular))
        end = np.array(
            [
                _toward(driving, linear, spec.max_linear_acceleration * dt),
                _toward(turning, angular, spec.max_angular_acceleration * dt),
                0.0,
                *(self._hand_after(hand[0], hand[1], gripper) if gripper is not None else ()),
            ]
        )
        self._servos = end
        return begin, end

    def _hand_after(self, opened: float, lifted: float, gripper: GripperGeometry) -> tuple[float, float]:
        """Servo targets of paddles and lift at the end of the coming period."""
        dt = CONTROL_PERIOD_S
        travel, height = gripper.opening / 2, gripper.lift_height
        paddles = travel - _SHY_M if self._open else _SHY_M
        lift = height - _SHY_M if self._raised else _SHY_M
        return (
            _toward(opened, paddles, travel / _PADDLE_TRAVEL_S * dt),
            _toward(lifted, lift, height / _LIFT_TRAVEL_S * dt),
        )

    @property
    def pose(self) -> Pose:
        """The true pose in the arena."""
        x, y, heading = self._pose.tolist()
        return Pose(x, y, wrap_angle(heading))

    @property
    def turning_rate(self) -> float:
        """The true turning speed, rad/s."""
        return float(self._speed[2])

    @property
    def speed(self) -> float:
        """The true speed over the floor, m/s."""
        return math.hypot(float(self._speed[0]), float(self._speed[1]))

    @property
    def paddles(self) -> tuple[float, float]:
        """How far the left and the right paddle are from the middle, metres; zero without a gripper."""
        if self.index.left is None or self.index.right is None:
            return 0.0, 0.0
        return float(self._qpos[self.index.left]), float(self._qpos[self.index.right])

    @property
    def lift(self) -> float:
        """How high the gripper is above its lowest place, metres; zero without one."""
        return float(self._qpos[self.index.lift]) if self.index.lift is not None else 0.0

    @property
    def clamped(self) -> bool:
        """Whether the paddles are told to close, and are apart: on a box, or still on their way."""
        gripper = self.spec.gripper
        return gripper is not None and not self._open and sum(self.paddles) >= _CLOSED * gripper.opening

    def grips(self, box: Point) -> bool:
        """Whether a box with its centre at this place of the arena is clamped between the closed paddles."""
        gripper = self.spec.gripper
        if gripper is None or not self.clamped:
            return False
        local = self.pose.to_local(box)
        return gripper.x_back < local.x < gripper.x_front + 0.04 and abs(local.y) < gripper.opening / 2

    def holds(self, box: Point) -> bool:
        """Whether such a box is gripped and lifted."""
        gripper = self.spec.gripper
        return gripper is not None and self.lift > gripper.lift_height / 2 and self.grips(box)

    @property
    def stowed(self) -> bool:
        """Whether the paddles are closed, on nothing, and lifted: so the gripper is carried, and so Drop ends (A.4).

        A robot without a gripper has nothing to put away.
        """
        gripper = self.spec.gripper
        return gripper is None or (
            sum(self.paddles) < _CLOSED * gripper.opening and self.lift > _UP * gripper.lift_height
        )
