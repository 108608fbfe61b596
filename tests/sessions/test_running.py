"""Learned tasks, executed: in the same room, in changed ones, and with things moved in mid-run."""

from collections.abc import Callable
from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.errors import NetworkError
from understudy.execution import Decision, run_network
from understudy.experiments import problems_of
from understudy.geometry import Point
from understudy.network import Component, Network
from understudy.perception import Percepts
from understudy.recording import read_recording
from understudy.robot import Color, Command
from understudy.sessions import Performed, Stage, perform
from understudy.sim import World, rearranged

from .conftest import Demonstrated

Show = Callable[[str], Demonstrated]


class Meddler:
    """Does something to the room once, as soon as a step has been achieved."""

    def __init__(self, after: str, deed: Callable[[Stage], None]) -> None:
        self.after, self.deed = after, deed
        self.done_s: float | None = None
        self._stage: Stage | None = None

    def prepare(self, stage: Stage) -> None:
        self._stage = stage

    def watch(self, percepts: Percepts, decision: Decision) -> None:
        reached = [event.component for event in decision.events if event.kind == "achieved"]
        if self.done_s is None and self.after in reached:
            assert self._stage is not None
            self.deed(self._stage)
            self.done_s = percepts.time_s


def run(shown: Demonstrated, seed: int, meddler: Meddler | None = None) -> Performed:
    return perform(
        "task",
        shown.network,
        shown.world,
        installed_skills(),
        seed=seed,
        watch=meddler.watch if meddler else None,
        prepare=meddler.prepare if meddler else None,
    )


def times_of(performed: Performed, component: str, state: str) -> list[float]:
    """When a component entered a state."""
    return [
        event.time_s
        for event in performed.report.events
        if event.kind == "state" and event.component == component and event.detail["state"] == state
    ]


@pytest.mark.parametrize("name", ["visit_targets", "transport", "slalom", "clutter"])
@pytest.mark.parametrize("seed", [11, 12])
def test_the_task_is_done_in_the_same_room_and_in_a_changed_one(demonstrated: Show, name: str, seed: int) -> None:
    shown = demonstrated(name)
    assert problems_of(run(shown, seed), shown.network) == []
    changed = perform("task", shown.network, rearranged(shown.world, seed), installed_skills(), seed=seed)
    assert problems_of(changed, shown.network) == []


def test_the_steps_are_achieved_in_the_order_shown(demonstrated: Show) -> None:
    shown = demonstrated("visit_targets")
    achieved = [id_ for id_, _ in run(shown, 5).report.achieved]
    assert achieved == [component.id for component in shown.network.components]


def test_the_same_seed_gives_the_same_run_bit_for_bit(demonstrated: Show, tmp_path: Path) -> None:
    shown = demonstrated("transport")
    files = [tmp_path / "one.mcap", tmp_path / "two.mcap"]
    for file in files:
        perform("task", shown.network, shown.world, installed_skills(), seed=3, recording=file)
    assert files[0].read_bytes() == files[1].read_bytes()
    recording = read_recording(files[0])
    assert [e["kind"] for e in recording.events()].count("achieved") == len(shown.network.components)
    assert recording.info.attachments == ("world.yaml", "task.yaml")


def test_the_next_target_is_moved_away(demonstrated: Show) -> None:
    shown = demonstrated("visit_targets")
    meddler = Meddler("track-yellow-1", lambda stage: stage.simulation.move_target(Color.LIGHT_ORANGE, (2.0, 3.0)))
    performed = run(shown, 7, meddler)
    assert meddler.done_s is not None
    assert problems_of(performed, shown.network) == []


def test_the_box_is_taken_from_the_gripper(demonstrated: Show) -> None:
    """The broken permanent precondition sends the robot back to pick the box up again (§3.3.2)."""
    shown = demonstrated("transport")
    meddler = Meddler("track-light-orange-1", lambda stage: stage.simulation.move_box(0, (1.7, 1.6)))
    performed = run(shown, 7, meddler)
    assert meddler.done_s is not None
    again = [time_s for time_s in times_of(performed, "pick-up-orange-1", "executing") if time_s > meddler.done_s]
    assert again
    assert problems_of(performed, shown.network) == []
    assert performed.verdict.boxes[0].distance_to(Point(2.3, 4.8)) < 1.2


def test_an_achieved_goal_is_undone(demonstrated: Show) -> None:
    """The robot is carried away from the source before it has the box: enabled by being there, it goes back first."""
    shown = demonstrated("transport")

    def carry_off(stage: Stage) -> None:
        stage.simulation.move_box(0, (3.2, 5.3))
        stage.simulation.move_robot((0.6, 5.2), 0.0)

    meddler = Meddler("track-green-1", carry_off)
    performed = run(shown, 7, meddler)
    assert meddler.done_s is not None
    assert performed.report.done
    assert performed.verdict.clean
    achieved = dict(performed.report.achieved)
    assert achieved["pick-up-orange-1"] > meddler.done_s + 5


def test_a_robot_that_holds_something_drops_it_first(demonstrated: Show) -> None:
    """§4.5.4.3: the initial Drop is there for the case that the robot starts while it holds something."""
    shown = demonstrated("transport")
    only_pick_up = Network((Component(id="p", behavior="PickUp", parameters={"color": "orange"}),))
    stages: list[Stage] = []
    first = perform("p", only_pick_up, shown.world, installed_skills(), seed=2, prepare=stages.append)
    assert first.report.done
    report = run_network(stages[0].robot, shown.network, installed_skills(), seed=2)
    dropped = [
        e for e in report.events if e.kind == "state" and e.component == "drop-1" and e.detail["state"] == "executing"
    ]
    assert dropped
    assert report.done


def test_time_runs_out(demonstrated: Show) -> None:
    shown = demonstrated("visit_targets")
    performed = perform("task", shown.network, shown.world, installed_skills(), limit_s=5.0)
    assert not performed.report.done
    assert performed.report.ending == "time limit"
    assert performed.report.duration_s == pytest.approx(5.0)
    assert performed.report.events[-1].kind == "stopped"
    assert problems_of(performed, shown.network)[0].startswith("time limit; missing track-")


def test_a_task_that_does_not_fit_is_refused_before_anything_is_written(demonstrated: Show, tmp_path: Path) -> None:
    dance = Network((Component(id="d", behavior="Dance"),))
    path = tmp_path / "run.mcap"
    with pytest.raises(NetworkError, match=r"components\[0\] \(d\): there is no skill called 'Dance'"):
        perform("dance", dance, demonstrated("transport").world, installed_skills(), recording=path)
    assert not path.exists()


def test_another_box_in_the_gripper_is_let_go() -> None:
    """The laser passes over small boxes: on its way the robot may catch the wrong one."""
    room = World.from_data(
        {
            "understudy": "world/1",
            "name": "two boxes",
            "seed": 0,
            "arena": {"size": [4.0, 4.0]},
            "boxes": [{"color": "orange", "at": [2.6, 2.0]}, {"color": "pink", "at": [1.9, 2.02]}],
            "robots": [{"name": "learner", "at": [1.0, 2.0]}],
        }
    )
    fetch = Network((Component(id="p", behavior="PickUp", parameters={"color": "orange"}),))
    stages: list[Stage] = []
    performed = perform("fetch", fetch, room, installed_skills(), limit_s=120.0, prepare=stages.append)
    assert performed.report.done
    assert stages[0].referee.held_box() == 0


def test_the_referee_tells_of_hard_collisions() -> None:
    """A robot that is driven into a wall: the verdict that every other test calls clean must not be."""
    room = World.from_data(
        {
            "understudy": "world/1",
            "name": "narrow",
            "seed": 0,
            "arena": {"size": [3.0, 3.0]},
            "robots": [{"name": "learner", "at": [1.5, 1.5]}],
        }
    )
    stage = Stage(room)
    assert stage.verdict().clean
    for _ in range(60):
        stage.robot.act(Command(linear=0.5))
        stage.robot.wait()
        stage.look()
    assert stage.verdict().collisions == {"wall": 1}
    assert not stage.verdict().clean
