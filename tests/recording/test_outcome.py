"""How a recorded run ended."""

from pathlib import Path
from typing import Any

import pytest

from tests.recording.support import drive
from understudy.recording import Outcome, Recorder, outcome_of, read_recording
from understudy.robot import PIONEER

BEGIN_S = 100.0
"""A robot's clock need not begin with the run."""


def outcome(path: Path, *events: dict[str, Any], keep: float = 1.0) -> Outcome:
    """Of a run of 2 s with these events, of whose file this part is kept."""
    with Recorder(path, kind="run", name="a", spec=PIONEER) as into:
        for obs in drive(21):
            object.__setattr__(obs, "time_s", BEGIN_S + obs.time_s)
            into.observation(obs)
            for event in events:
                if event["time_s"] == obs.time_s:
                    into.event(event)
    content = path.read_bytes()
    path.write_bytes(content[: int(keep * len(content))])
    return outcome_of(read_recording(path))


def achieved(id_: str, time_s: float) -> dict[str, Any]:
    return {"time_s": time_s, "kind": "achieved", "component": id_, "on_purpose": True}


def test_a_task_that_was_done(tmp_path: Path) -> None:
    found = outcome(
        tmp_path / "a.mcap",
        achieved("a", BEGIN_S),
        achieved("b", BEGIN_S + 1.5),
        {"time_s": BEGIN_S + 1.5, "kind": "complete"},
    )
    assert found == Outcome(done=True, time_s=1.5, reason="", achieved=(("a", BEGIN_S), ("b", BEGIN_S + 1.5)))
    assert str(found) == "done after 1.5 s"


def test_a_task_that_was_stopped(tmp_path: Path) -> None:
    stopped = {"time_s": BEGIN_S + 2, "kind": "stopped", "reason": "the time limit of 2 s"}
    found = outcome(tmp_path / "a.mcap", achieved("a", BEGIN_S), stopped)
    assert found == Outcome(done=False, time_s=2.0, reason="the time limit of 2 s", achieved=(("a", BEGIN_S),))
    assert str(found) == "not done: the time limit of 2 s"


@pytest.mark.parametrize(("keep", "reason"), [(1.0, "it breaks off at 2.0 s"), (0.7, "it breaks off at 1.0 s")])
def test_a_run_without_an_end_was_interrupted_or_its_file_was_cut(tmp_path: Path, keep: float, reason: str) -> None:
    """Even where it was done after that: what is not in the file is not known."""
    later = [] if keep == 1.0 else [{"time_s": BEGIN_S + 2, "kind": "complete"}]
    found = outcome(tmp_path / "a.mcap", *later, keep=keep)
    assert (found.done, found.reason) == (False, reason)
