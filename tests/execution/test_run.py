"""A whole run's end: done, out of time, or stopped by a component that ran out of its own."""

from collections.abc import Iterator

import numpy as np
import pytest

from understudy.behaviors import SkillSet
from understudy.execution import run_network
from understudy.network import Component, Network, Timeout
from understudy.robot import PIONEER, Command, Observation, RobotSpec, Scan

from .support import stub_skill


class Standing:
    """A robot in an empty room, on which time passes."""

    spec: RobotSpec = PIONEER

    def __init__(self) -> None:
        self.stopped = False
        self._times: Iterator[float] = iter(np.arange(0.0, 60.0, 0.1).round(1).tolist())

    def sense(self) -> Observation:
        return Observation(time_s=next(self._times), scan=Scan(ranges=np.full(181, 8.0, np.float32)))

    def act(self, command: Command) -> None:
        self.stopped = False

    def wait(self) -> None:
        pass

    def stop(self) -> None:
        self.stopped = True


@pytest.mark.parametrize(
    ("timeout", "ending", "at_s"),
    [
        (Timeout(seconds=2.0), "timeout", 2.0),
        (Timeout(seconds=2.0, then="skip"), "complete", 2.0),
        (Timeout(seconds=2.0, then="signal", event="late"), "time limit", 5.0),
    ],
)
def test_a_component_out_of_time_does_what_its_timeout_says(timeout: Timeout, ending: str, at_s: float) -> None:
    robot = Standing()
    network = Network((Component(id="never", behavior="Never", timeout=timeout),))
    report = run_network(robot, network, SkillSet(stub_skill("Never")), limit_s=5.0)
    assert (report.ending, report.duration_s, report.done) == (ending, at_s, ending == "complete")
    assert report.stopped_by == ("never" if ending == "timeout" else "")
    reasons = [event.detail["reason"] for event in report.events if event.kind == "stopped"]
    assert reasons == {"timeout": ["never ran out of time"], "time limit": ["the time limit of 5 s"]}.get(ending, [])
    assert robot.stopped
