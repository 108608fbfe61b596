"""Two demonstrations, given once for all tests here."""

from functools import cache
from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.learning import Lesson, learn
from understudy.sessions import Taught, teach
from understudy.sim import World, load_world, world_path


class Demonstrated:
    """A bundled world, the demonstration given in it, and what was learned."""

    def __init__(self, name: str, folder: Path) -> None:
        self.world: World = load_world(world_path(name))
        self.recording = folder / f"{name}.mcap"
        self.taught: Taught = teach(self.world, installed_skills(), recording=self.recording)
        self.lesson: Lesson = learn(self.taught.demonstration)
        self.network = self.lesson.network


@pytest.fixture(scope="session")
def demonstrated(tmp_path_factory: pytest.TempPathFactory):  # type: ignore[no-untyped-def]
    """Gives a demonstration in a bundled world, the first time that it is asked for."""
    folder = tmp_path_factory.mktemp("demonstrations")
    return cache(lambda name: Demonstrated(name, folder))
