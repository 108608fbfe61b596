"""Ctrl-C in the middle of a command: the robot stands still, and nothing is lost."""

import json
import signal
import subprocess
import time
from pathlib import Path

from tests.cli.program import PROGRAM, understudy
from tests.tiny import world
from understudy.network import load_task
from understudy.recording import read_recording


def interrupted(*arguments: str, recording: Path, folder: Path) -> str:
    """What a command says that is stopped by Ctrl-C once it has recorded a while."""
    # The one who runs the tests may have them ignore Ctrl-C, which children inherit.
    process = subprocess.Popen(
        [*PROGRAM, *arguments],
        cwd=folder,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509
    )
    for _ in range(600):
        if recording.exists() and recording.stat().st_size > 300_000:
            break
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    return errors


def test_ctrl_c_keeps_what_was_recorded(tmp_path: Path) -> None:
    script = [{"say": "START"}, *[{"walk": [2.4, 0.9]}, {"walk": [1.3, 0.9]}] * 400, {"say": "DONE"}]
    (tmp_path / "long.yaml").write_text(
        world(name="long", teacher={"at": [1.3, 0.9], "script": script}), encoding="utf-8"
    )
    recording = tmp_path / "understudy-out" / "long.mcap"
    errors = interrupted("teach", "long.yaml", recording=recording, folder=tmp_path)
    assert "stopped by Ctrl-C; the robot stands still" in errors
    found = read_recording(recording)
    assert found.info.complete
    assert len(list(found.observations(images=False))) > 10


def test_a_run_stopped_by_ctrl_c_says_how_to_go_on(tmp_path: Path) -> None:
    recording = tmp_path / "understudy-out" / "hierarchical-run.mcap"
    errors = interrupted("run", "hierarchical", "--world", "hierarchical", recording=recording, folder=tmp_path)
    (told,) = [line for line in errors.splitlines() if line.startswith("Go on with: understudy ")]
    gone_on = understudy(*told.split()[4:], folder=tmp_path)
    assert "Done after" in gone_on.stdout


def test_a_practice_stopped_by_ctrl_c_keeps_what_was_corrected(tmp_path: Path) -> None:
    """BAD at once, and then a search for a target that is not there."""
    script = [{"wait": 0.5}, {"say": "BAD"}]
    (tmp_path / "w.yaml").write_text(world(teacher={"at": [1.3, 2.0], "script": script}), encoding="utf-8")
    steps = [{"id": color, "behavior": "Track", "parameters": {"color": color}} for color in ("red", "pink")]
    task = {"understudy": "task/1", "name": "seek", "components": steps}
    (tmp_path / "seek.json").write_text(json.dumps(task), encoding="utf-8")
    recording = tmp_path / "understudy-out" / "seek-practice.mcap"
    errors = interrupted("practice", "seek.json", "-w", "w.yaml", recording=recording, folder=tmp_path)
    assert "Corrected task so far in understudy-out/seek-practice.yaml" in errors
    _, network = load_task(tmp_path / "understudy-out" / "seek-practice.yaml")
    assert [component.id for component in network.components] == ["pink"]
