"""``--robot``, ``sim`` and ``export`` as far as they need no network; and the keyboard beside a robot."""

import json
import os
import pty
import threading
from pathlib import Path

import pytest

from tests.cli.program import understudy
from understudy.cli.keyboard import Keyboard
from understudy.robot import Cue


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("teach",), "in which world, or with which robot? Name WORLD or --robot"),
        (("teach", "transport", "--robot", "pioneer"), "Name either WORLD or --robot"),
        (("run", "delivery", "--robot", "pioneer", "--world", "delivery"), "are for simulated rooms"),
        (("practice", "delivery", "--robot", "pioneer", "--world", "delivery"), "Give either --world or --robot"),
        (("run", "delivery", "--robot", "r2d2"), "no such robot among: pioneer, turtlebot"),
        (("run", "delivery", "--robot", "turtlebot"), "turtlebot cannot do this task"),
        (("sim", "transport"), "offer it with --ros2"),
        (("export", "a.mcap"), "Name a folder with --ros2bag"),
        (("export", "a.mcap", "--ros2bag", "bag"), "a.mcap cannot be read"),
        (("calibrate", "robot.yaml"), "Missing option"),
    ],
)
def test_mistakes_are_one_line_and_exit_with_two(arguments: tuple[str, ...], says: str, tmp_path: Path) -> None:
    done = understudy(*arguments, folder=tmp_path, expect=2)
    assert says in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_the_schema_of_a_robot(tmp_path: Path) -> None:
    schema = json.loads(understudy("schema", "robot", folder=tmp_path).stdout)
    assert "laser" in schema["properties"]


def test_keys_are_words_and_space_is_the_emergency_stop(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[Cue] = []
    heard, stopped = threading.Event(), threading.Event()

    def say(word: Cue) -> None:
        said.append(word)
        if word is Cue.GO:
            heard.set()

    terminal, theirs = pty.openpty()
    with os.fdopen(theirs) as stdin:
        monkeypatch.setattr("sys.stdin", stdin)
        with Keyboard(say, stopped.set):
            os.write(terminal, b"sHtxdqbcg")
            assert heard.wait(30)
            assert not stopped.is_set()
            os.write(terminal, b" ")
            assert stopped.wait(30)
    os.close(terminal)
    assert said == [Cue.START, Cue.HERE, Cue.TAKE, Cue.DROP, Cue.DONE, Cue.BAD, Cue.COME, Cue.GO]
