"""What a ROS 2 robot sends: subscriptions, and the observations that are made of their messages.

The rules are those by which its bags are read (:mod:`understudy.recording.sampling`), so that a robot learns live what
it would learn from the recording.
"""

import logging
from dataclasses import dataclass
from typing import Final, cast

from rosbags.typesys.stores import ros2_humble as ros

from understudy.clock import Clock
from understudy.errors import RecordingError, RobotError
from understudy.recording import Grid, Held, RawMessage, decode, stamp_ns
from understudy.robot import Cue, Observation
from understudy.ros2.document import RobotDocument
from understudy.ros2.fitting import Fitting
from understudy.ros2.frozen import Frozen
from understudy.ros2.roles import Role, roles_of
from understudy.ros2.transport import Subscription, Transport

__all__ = ["Inputs", "Listening"]

_log = logging.getLogger(__name__)

_BLIND_S: Final = 2.0
"""Without a picture for this long somebody should know; the robot goes on by laser and memory."""

_LEAP_S: Final = 1.0
"""A clock that leaps so far in one sweep was set."""


_STILL_S: Final = 0.3
"""A sweep that came later than this ago came, but made no observation."""


@dataclass(slots=True)
class Listening:
    """A role that is listened to.

    Attributes:
        role: what it is.
        topic: that was chosen.
        type: of its messages.
        subscription: hands them over.
        count: of the messages so far.
        first_s: when the first came, on our own clock; None before.
        last_s: when the last came.
    """

    role: Role
    topic: str
    type: str
    subscription: Subscription
    count: int = 0
    first_s: float | None = None
    last_s: float | None = None


class Inputs:
    """Everything that a robot sends.

    Args:
        document: which topics it has.
        transport: the network.
        clock: our own, for the age of messages.
    """

    def __init__(self, document: RobotDocument, transport: Transport, clock: Clock) -> None:
        self._transport, self._clock, self._name = transport, clock, document.name
        self._zero_is_free = document.topics.zero_is_free
        self._sim = document.clock == "sim"
        self._fitting = Fitting(document)
        self._held = Held(document.name, document.topics.joints, odometry_known=False)
        self._grid = Grid()
        self._frozen = Frozen()
        self._stamp_ns = 0
        self._blind_told = False
        self.roles = roles_of(document)
        self.listening: dict[str, Listening] = {}
        self.emergency = False

    @property
    def stamp_ns(self) -> int:
        """The stamp of the newest sweep, by the robot's own clock."""
        return self._stamp_ns

    def listen(self) -> None:
        """Subscribes to whatever can be told by now: a topic of several types when one of them is published."""
        for role in self.roles:
            if role.name in self.listening:
                continue
            choice = role.choose(self._transport)
            if choice is not None:
                topic, type_name = choice
                subscription = self._transport.subscribe(topic, type_name, role.qos)
                self.listening[role.name] = Listening(role, topic, type_name, subscription)

    @property
    def missing(self) -> tuple[Role, ...]:
        """The roles that the robot needs and that have not been heard of yet."""
        return tuple(
            role
            for role in self.roles
            if role.needed and (role.name not in self.listening or not self.listening[role.name].count)
        )

    def hear(self, cue: Cue) -> None:
        """A word from elsewhere, such as the keyboard; comes with the next observation."""
        self._held.hear(cue)

    def update(self) -> Observation | None:
        """Takes in all that came; an observation, if a sweep was among it that begins a control period.

        Raises:
            RobotError: a message cannot be used, the clock was set, or two publishers contend for a topic.
        """
        try:
            # The sweeps first: what was sent before them must be among what is then taken of the others.
            sweeps = self._take("scan")
            for name in self.listening:
                if name == "emergency_stop":
                    for raw in self._take(name):
                        self.emergency = cast(ros.std_msgs__msg__Bool, decode(self._name, raw)).data
                elif name != "scan":
                    for raw in self._take(name):
                        self._held.take(name, raw)
            observation = self._observation(sweeps)
        except RecordingError as error:
            raise RobotError(str(error)) from error
        if observation is None:
            return None
        if self._frozen.notices(observation):
            raise RobotError(
                f"{self.listening['scan'].topic} brings the same sweep again and again, while the wheels turn;"
                " start the laser's driver again"
            )
        self._check_publishers()
        self._check_ages(seen=observation.image is not None)
        return self._fitting.observation(observation)

    def _take(self, name: str) -> list[RawMessage]:
        listening = self.listening.get(name)
        data = listening.subscription.take() if listening is not None else []
        if listening is None or not data:
            return []
        now_s = self._clock.now()
        listening.count += len(data)
        listening.first_s = now_s if listening.first_s is None else listening.first_s
        listening.last_s = now_s
        return [RawMessage(listening.topic, listening.type, round(now_s * 1e9), one) for one in data]

    def _observation(self, sweeps: list[RawMessage]) -> Observation | None:
        """Of the newest sweep that begins a control period."""
        chosen: tuple[float, ros.sensor_msgs__msg__LaserScan] | None = None
        for raw in sweeps:
            message = cast(ros.sensor_msgs__msg__LaserScan, decode(self._name, raw))
            stamp = stamp_ns(message.header) or raw.time_ns
            if self.missing:
                continue
            self._check_clock(stamp)
            time_s = self._grid.begin(stamp, where=f"{self._name}: {raw.topic}")
            if time_s is not None:
                chosen = time_s, message
        if chosen is None:
            return None
        return self._held.observation(*chosen, zero_is_free=self._zero_is_free)

    def _check_clock(self, stamp: int) -> None:
        leap_s = (stamp - self._stamp_ns) / 1e9
        # A simulation may run as fast as it likes, but not backwards.
        if self._stamp_ns and (leap_s < -_LEAP_S or (leap_s > _LEAP_S and not self._sim)):
            raise RobotError(
                f"the clock of {self._name} leapt by {leap_s:+.1f} s; let its time settle (chrony, ntp) and start again"
            )
        self._stamp_ns = stamp

    def _check_publishers(self) -> None:
        for listening in self.listening.values():
            if not listening.role.exclusive:
                continue
            publishers = self._transport.publishers(listening.topic)
            if len(publishers) > 1:
                raise RobotError(
                    f"{len(publishers)} programs publish {listening.topic}, and their readings must not be mixed;"
                    " stop all but one, or name another topic in the robot document"
                )

    def _check_ages(self, *, seen: bool) -> None:
        for listening in self.listening.values():
            limit_s = listening.role.fresh_s
            if limit_s is not None and self._silent(listening.role.name, limit_s):
                raise RobotError(self.why_silent(listening.role))
        if seen:
            self._blind_told = False
        elif "image" in self.listening and self._silent("image", _BLIND_S) and not self._blind_told:
            self._blind_told = True
            _log.warning("%s; the robot goes on without seeing colors", self.why_silent(self.listening["image"].role))

    def _silent(self, name: str, limit_s: float) -> bool:
        last_s = self.listening[name].last_s
        return last_s is None or self._clock.now() - last_s > limit_s

    def why_silent(self, role: Role) -> str:
        """Why nothing comes in a role, and what to do about it."""
        fault = role.fault(self._transport)
        if fault:
            return fault
        listening = self.listening.get(role.name)
        if listening is None or listening.last_s is None:
            return f"{role.topic} is published, but nothing has come; is the {role.what} running?"
        age_s = self._clock.now() - listening.last_s
        if role.name == "scan" and age_s < _STILL_S:
            return f"the stamps on {listening.topic} stand still, or were set back; check the clock of the {role.what}"
        return f"nothing came on {listening.topic} for {age_s:.1f} s; check the {role.what} and the connection"
