"""Writing a demonstration of ten minutes, and learning from its recording."""

import tempfile
import time
from pathlib import Path

from understudy.behaviors import installed_skills
from understudy.learning import learn
from understudy.recording import Recorder, read_recording
from understudy.robot import PIONEER, Observation
from understudy.sessions import recorded_demonstration, teach
from understudy.sim import World, load_world, world_path

__all__ = ["main"]

MINUTES = 10
ROUNDS = 20
"""Times around the room; more than ten minutes last."""


def long_world() -> World:
    """Visiting the six targets again and again."""
    world = load_world(world_path("visit_targets"))
    data = world.model_dump(mode="json", by_alias=True)
    walks = [item for item in data["teacher"]["script"] if item.get("walk")]
    data["teacher"]["script"] = [{"say": "START"}, *walks * ROUNDS, {"say": "DONE"}]
    return World.from_data(data)


def main() -> None:
    skills = installed_skills()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "long.mcap"
        teach(long_world(), skills, recording=path, limit_s=60.0 * MINUTES)
        begun = time.perf_counter()
        demonstration = recorded_demonstration(path, skills)
        observed = time.perf_counter()
        lesson = learn(demonstration)
        learned = time.perf_counter()
        print(f"recording of {demonstration.span.duration / 60:.1f} minutes, {path.stat().st_size / 1e6:.0f} MB")
        print(f"  read, perceived and observed in {observed - begun:.1f} s")
        steps, links = len(lesson.network.components), len(lesson.network.links)
        print(f"  {steps} steps and {links} links in {learned - observed:.3f} s")
        recording = read_recording(path)
        observations = list(recording.observations())
        print(f"  written again: {rewritten(Path(folder), observations):,.0f} control steps/s")


def rewritten(folder: Path, observations: list[Observation]) -> float:
    """Control steps a second that the recorder can write."""
    begun = time.perf_counter()
    with Recorder(folder / "again.mcap", kind="demonstration", name="again", spec=PIONEER) as recorder:
        for observation in observations:
            recorder.observation(observation)
    return len(observations) / (time.perf_counter() - begun)


if __name__ == "__main__":
    main()
