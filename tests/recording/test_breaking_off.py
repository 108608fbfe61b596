"""Files that break off: killed in mid-recording, or cut at any byte."""

import os
import signal
import subprocess
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mcap.opcode import Opcode

from tests.recording.support import bits, drive, record
from understudy.errors import RecordingError
from understudy.recording import read_recording

_RECORD_UNTIL_KILLED = """
import sys
from pathlib import Path
from tests.recording.support import drive
from understudy.recording import Recorder
from understudy.robot import PIONEER, Command

into = Recorder(Path(sys.argv[1]), kind="run", name="killed", spec=PIONEER, attachments={"world.yaml": b"seed: 4"})
for obs in drive(int(sys.argv[2])):
    into.observation(obs)
    into.command(obs.time_s, Command(linear=0.2))
    into.event({"time_s": obs.time_s, "kind": "tick"})
print("recorded", flush=True)
sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
@pytest.mark.parametrize("steps", [1, 47])
def test_a_killed_recording_is_kept_up_to_the_last_second(tmp_path: Path, steps: int) -> None:
    path = tmp_path / "killed.mcap"
    root = Path(__file__).parents[2]
    with subprocess.Popen(
        [sys.executable, "-c", _RECORD_UNTIL_KILLED, str(path), str(steps)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(root), str(root / "src")])},
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"recorded\n"
        process.kill()
        process.wait()
    assert process.returncode == -signal.SIGKILL
    recording = read_recording(path)
    live = drive(steps)
    kept = list(recording.observations())
    assert [bits(obs) for obs in kept] == [bits(obs) for obs in live[: len(kept)]]
    assert live[-1].time_s - kept[-1].time_s < 1
    assert not recording.info.complete
    assert recording.info.name == "killed"
    assert recording.attachment("world.yaml") == b"seed: 4"
    assert recording.info.topics["/scan"].count == len(kept)
    assert recording.info.duration_s == pytest.approx(kept[-1].time_s)
    # The last step's command and event come after the flush that its observation makes.
    assert len(list(recording.commands())) >= len(kept) - 1
    assert len(list(recording.events())) >= len(kept) - 1


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return record(tmp_path_factory.mktemp("whole") / "a.mcap", drive(45)).read_bytes()


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(part=st.floats(0, 1, exclude_max=True))
def test_a_file_cut_anywhere_gives_a_prefix_or_a_clear_refusal(whole: bytes, tmp_path: Path, part: float) -> None:
    live = [bits(obs) for obs in drive(45)]
    size = int(part * len(whole))
    (tmp_path / "cut.mcap").write_bytes(whole[:size])
    try:
        recording = read_recording(tmp_path / "cut.mcap")
    except RecordingError:
        # Only where the first observation's own chunk is cut, well within the first tenth.
        assert size < len(whole) / 10
        return
    assert not recording.info.complete
    kept = [bits(obs) for obs in recording.observations()]
    assert kept == live[: len(kept)]
    # No more than a chunk, a second, is lost of what the bytes hold.
    assert len(kept) >= 45 * size / len(whole) - 15


@settings(deadline=None, max_examples=120, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(place=st.floats(0, 1, exclude_max=True) | st.floats(0.95, 1, exclude_max=True), mask=st.integers(1, 255))
def test_a_file_with_any_byte_changed_gives_a_prefix_or_a_clear_refusal(
    whole: bytes, tmp_path: Path, place: float, mask: int
) -> None:
    content = bytearray(whole)
    content[int(place * len(whole))] ^= mask
    (tmp_path / "changed.mcap").write_bytes(content)
    live = [bits(obs) for obs in drive(45)]
    kept: list[tuple[object, ...]] = []
    with suppress(RecordingError):
        kept.extend(bits(obs) for obs in read_recording(tmp_path / "changed.mcap").observations())
    assert kept == live[: len(kept)]


def test_a_broken_index_costs_nothing(whole: bytes, tmp_path: Path) -> None:
    content = bytearray(whole)
    # The index repeats the topics: there, this one has become another.
    content[content.rindex(b"/understudy/observation")] ^= 1
    (tmp_path / "a.mcap").write_bytes(content)
    recording = read_recording(tmp_path / "a.mcap")
    assert recording.info.exact
    assert [bits(obs) for obs in recording.observations()] == [bits(obs) for obs in drive(45)]


def test_a_first_step_that_is_not_whole_is_refused(tmp_path: Path) -> None:
    """Its image is larger than a chunk, so the scan is with the system long before the step is complete."""
    image = np.random.default_rng(0).integers(0, 256, (800, 800, 3), np.uint8)
    content = record(tmp_path / "a.mcap", [replace(drive(1)[0], image=image)]).read_bytes()
    # The second chunk begins right after the index of the first, which the image ends.
    (tmp_path / "b.mcap").write_bytes(content[: image.size + 3000])
    with pytest.raises(RecordingError, match=r"b\.mcap breaks off before its first whole step"):
        read_recording(tmp_path / "b.mcap")


def test_no_chunk_is_passed_over_in_silence(whole: bytes, tmp_path: Path) -> None:
    content = bytearray(whole)
    # Right after the attachment begins the first chunk; its kind of record has become one that nobody knows.
    begin = content.index(b"seed: 4") + len(b"seed: 4") + 4
    assert content[begin] == Opcode.CHUNK
    content[begin] = 0x7A
    (tmp_path / "a.mcap").write_bytes(content)
    recording = read_recording(tmp_path / "a.mcap")
    assert [bits(obs) for obs in recording.observations()] == [bits(obs) for obs in drive(45)]
