"""A simulated robot behind the same :class:`~understudy.robot.Robot` protocol as a real one."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from understudy.geometry import Pose
from understudy.robot import Command, Cue, Observation, RobotSpec
from understudy.sim.body import RobotBody
from understudy.sim.camera import Camera
from understudy.sim.noise import NoiseLevels, NoiseStreams
from understudy.sim.scenery import Scenery
from understudy.sim.sensors import GripperSensor, Laser, SonarRing, WheelOdometry

__all__ = ["SimRobot"]


class SimRobot:
    """One robot of a simulation.

    Sensing is lazy: the first ``sense`` in a control period takes the readings, a further one returns them again.

    Args:
        name: as in the world document.
        body: its body.
        model: MuJoCo's model.
        data: MuJoCo's state.
        scenery: what its camera can see.
        noise: how much its senses err.
        streams: where its noise comes from.
        now: tells the simulation's time, seconds.
        step: lets one control period pass for the whole simulation.
    """

    def __init__(
        self,
        name: str,
        body: RobotBody,
        model: Any,
        data: Any,
        *,
        scenery: Scenery,
        noise: NoiseLevels,
        streams: NoiseStreams,
        now: Callable[[], float],
        step: Callable[[], None],
    ) -> None:
        self.name = name
        self._body, self._now, self._step = body, now, step
        self._laser = Laser(model, data, body, noise, streams.laser)
        self._sonars = SonarRing(model, data, body, noise, streams.sonar)
        self._camera = Camera(body, scenery, noise, streams.camera, streams.colors)
        self._odometry = WheelOdometry(body.pose, noise, streams.odometry)
        self._gripper = GripperSensor(model, data, body, noise, streams.gripper)
        self._sensed: Observation | None = None
        self._heard: list[Cue] = []

    @property
    def spec(self) -> RobotSpec:
        """What the robot is made of."""
        return self._body.spec

    def sense(self) -> Observation:
        """The newest readings; cues that arrived since the last call are handed over once."""
        cues = tuple(self._heard)
        self._heard.clear()
        if self._sensed is None:
            pose = self._body.pose
            self._sensed = Observation(
                time_s=self._now(),
                scan=self._laser.scan(pose),
                sonar=self._sonars.ranges(pose),
                image=self._camera.picture(pose),
                odometry=self._odometry.reading,
                gripper=self._gripper.read(pose),
            )
        return replace(self._sensed, cues=cues) if cues else self._sensed

    def act(self, command: Command) -> None:
        """Takes the command for the period that begins; speeds are clipped to the spec."""
        self._body.take(command)

    def wait(self) -> None:
        """Steps the whole simulation by one control period; with several robots, call ``Simulation.step`` instead."""
        self._step()

    def stop(self) -> None:
        """Brakes at once; the gripper keeps what it holds."""
        self._body.halt()

    def hear(self, cue: Cue) -> None:
        """Something is said that this robot hears with its next observation."""
        self._heard.append(cue)

    def period_passed(self) -> None:
        """A control period is over: the wheels have turned, and the old readings are stale."""
        self._odometry.advance(self._body.pose)
        self._sensed = None

    def carried_to(self, pose: Pose) -> None:
        """Somebody put the robot down elsewhere, which its wheels did not notice."""
        self._body.place(pose)
        self._odometry.carried_to(self._body.pose)

    def forget_readings(self) -> None:
        """Something was moved by hand: the next ``sense`` looks again."""
        self._sensed = None
