"""The skill of docs/skills.md: every block of the page, run as it stands there."""

import re
import sys
from pathlib import Path

import pytest

from understudy.behaviors import SkillSet, installed_skills
from understudy.figures import describe_task
from understudy.learning import learn
from understudy.network import Component, Network
from understudy.sessions import perform, teach
from understudy.sim import World

PAGE = Path(__file__).parents[2] / "docs" / "skills.md"


@pytest.fixture
def blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The page's Python; its first block is the module ``wallside.park``."""
    found = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / "wallside").mkdir()
    (tmp_path / "wallside" / "park.py").write_text(found[0], encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    for name in ("wallside", "wallside.park"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return found


def test_the_page_runs(blocks: list[str]) -> None:
    _, trying, testing = blocks
    spoken: dict[str, object] = {}
    exec(compile(trying, str(PAGE), "exec"), spoken)
    run = spoken["run"]
    assert run.report.done  # type: ignore[attr-defined]
    assert run.verdict.clean  # type: ignore[attr-defined]
    exec(compile(testing, str(PAGE), "exec"), {})


ROOM = {
    "understudy": "world/1",
    "name": "garage",
    "seed": 1,
    "arena": {"size": [4.0, 3.0]},
    "robots": [{"name": "learner", "at": [0.6, 1.5], "heading_deg": 0}],
    "teacher": {
        "at": [1.3, 1.5],
        "script": [
            {"say": "START"},
            {"walk": [3.0, 1.5]},
            {"step_aside": [3.0, 2.5]},
            {"wait": 3.0},
            {"say": "HERE"},
            {"wait": 1.0},
            {"say": "DONE"},
        ],
    },
}


def test_the_skill_can_be_taught(blocks: list[str]) -> None:
    from wallside.park import PARK  # type: ignore[import-not-found]

    skills = SkillSet(*installed_skills().values(), PARK)
    world = World.from_data(ROOM)
    network = learn(teach(world, skills).demonstration).network
    assert "Park" in [part.behavior for part in network.components if isinstance(part, Component)]
    only = Network(
        tuple(part for part in network.components if isinstance(part, Component) and part.behavior == "Park")
    )
    assert "before whatever is ahead" in describe_task("park", only, skills)
    assert perform("park", only, world, skills, seed=5).report.done
