"""Practice in simulated rooms: BAD, COME … GO, sensed, followed and learned (§6)."""

from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.errors import NetworkError, RecordingError, WorldError
from understudy.execution import Event, History, State, explain
from understudy.network import Component, Link, LinkType, Network, Timeout, load_task, task_path
from understudy.practice import reassigned
from understudy.recording import read_recording
from understudy.robot import Cue
from understudy.sessions import Practised, past_at, perform, practise, task_of
from understudy.sim import World, load_world, world_path

SKILLS = installed_skills()


@pytest.fixture(scope="module")
def practised(tmp_path_factory: pytest.TempPathFactory) -> Practised:
    """The bundled practice run."""
    _, network = load_task(task_path("practice"))
    file = tmp_path_factory.mktemp("practice") / "run.mcap"
    return practise("practice", network, load_world(world_path("practice")), SKILLS, recording=file)


def ids(network: Network) -> list[str]:
    return [component.id for component in network.components]


def test_a_wrong_step_is_taken_out_and_a_missing_one_put_in(practised: Practised) -> None:
    bad, come = practised.report.corrections
    assert (bad.word, bad.meant[0].component, bad.meant[0].how) == (Cue.BAD, "track-red-1", "finished")
    assert (come.word, come.meant[0].component, come.meant[0].how) == (Cue.COME, "track-pink-1", "executing")
    assert practised.report.done
    assert ids(practised.report.network) == ["track-green-1", "track-light-orange-1", "track-pink-1"]
    assert {(link.source, link.target) for link in practised.report.network.links} == {
        ("track-green-1", "track-light-orange-1"),
        ("track-light-orange-1", "track-pink-1"),
    }
    assert practised.verdict.clean


def test_the_corrected_task_is_done_by_the_robot_alone(practised: Practised) -> None:
    run = perform("practice", practised.report.network, practised.stage.world, SKILLS, seed=11)
    assert [path for path, _ in run.report.achieved] == ids(practised.report.network)


def test_the_words_and_what_they_meant_are_in_the_recording(practised: Practised) -> None:
    assert practised.recording is not None
    recording = read_recording(practised.recording)
    assert [cue.value for _, cue in recording.cues()] == ["BAD", "COME", "HERE", "GO"]
    corrected = [event for event in recording.events() if event["kind"] == "corrected"]
    assert [(event["component"], event["word"]) for event in corrected] == [
        ("track-red-1", "BAD"),
        ("track-pink-1", "COME"),
    ]


def test_a_practice_run_explains_itself_and_is_not_gone_on_with(practised: Practised) -> None:
    assert practised.recording is not None
    recording = read_recording(practised.recording)
    attached = task_of(recording)
    assert attached is not None
    history = History(attached[1], map(Event.from_record, recording.events()))
    assert explain(history, "track-red-1", 12.0).state is State.UNUSED
    with pytest.raises(RecordingError, match="is a practice run"):
        past_at(recording, attached[1], SKILLS, 3.0)


def test_a_word_that_was_taken_for_another_step(practised: Practised) -> None:
    bad, come = reassigned(practised.report.corrections, 1, "track-green-1")
    assert ids(bad.after) == ["track-red-1", "track-pink-1"]
    assert ids(come.after) == ["track-red-1", "track-light-orange-1", "track-pink-1"]
    assert [one.component for one in bad.meant][:2] == ["track-green-1", "track-red-1"]
    # The other way about: where the step that a later word was about is gone, that word is without effect.
    bad, come = reassigned(practised.report.corrections, 1, "track-pink-1")
    assert (come.before, come.note[:24]) == (come.after, "no step is called 'track")
    with pytest.raises(NetworkError, match="no correction 3; the practice run has 2"):
        reassigned(practised.report.corrections, 3, "track-red-1")
    with pytest.raises(NetworkError, match="no step was called 'x' then"):
        reassigned(practised.report.corrections, 2, "x")


CARRYING = {
    "understudy": "world/1",
    "name": "carrying",
    "seed": 3,
    "arena": {"size": [5.0, 4.0]},
    "targets": [{"color": "pink", "at": [4.4, 3.0]}, {"color": "yellow", "at": [1.2, 3.3]}],
    "boxes": [{"color": "orange", "at": [2.2, 1.0]}],
    "robots": [{"name": "learner", "at": [0.6, 1.0], "heading_deg": 0}],
    "teacher": {
        "at": [2.8, 2.6],
        "script": [
            {"wait_for": {"condition": "robot_holds_box", "timeout": 60}},
            {"wait": 11.0},
            {"say": {"word": "COME", "when_robot_within": 2.2, "of": [4.4, 3.0], "timeout": 10}},
            {"wait": 3.0},
            {"walk": [2.0, 2.4]},
            {"walk": {"to": [1.4, 2.2], "say": {"word": "HERE", "when_robot_within": 1.7, "of": [1.2, 3.3]}}},
            {"wait": 2.0},
            {"say": "GO"},
            {"step_aside": [0.6, 2.4]},
        ],
    },
}
CARRY = Network(
    (
        Component(id="pick-up-orange-1", behavior="PickUp", parameters={"color": "orange"}),
        Component(id="track-pink-1", behavior="Track", parameters={"color": "pink"}),
        Component(id="drop-1", behavior="Drop"),
    ),
    (
        Link(source="pick-up-orange-1", target="track-pink-1", type=LinkType.PERMANENT),
        Link(source="track-pink-1", target="drop-1", type=LinkType.ENABLING),
    ),
)


def test_what_is_carried_all_the_while_stays_a_condition() -> None:
    practised = practise("carry", CARRY, World.from_data(CARRYING), SKILLS)
    (come,) = practised.report.corrections
    assert come.note == ""
    assert come.meant[0].component == "track-pink-1"
    assert ids(practised.report.network) == ["pick-up-orange-1", "track-yellow-1", "track-pink-1", "drop-1"]
    types = {(link.source, link.target): link.type for link in practised.report.network.links}
    assert types == {
        ("pick-up-orange-1", "track-yellow-1"): LinkType.PERMANENT,
        ("pick-up-orange-1", "track-pink-1"): LinkType.PERMANENT,
        ("track-yellow-1", "track-pink-1"): LinkType.ORDERING,
        ("track-pink-1", "drop-1"): LinkType.ENABLING,
    }
    assert practised.report.done


def silent(**teacher: object) -> World:
    return World.from_data(CARRYING | {"teacher": {"at": [2.8, 2.6], **teacher}})


def test_words_of_which_nothing_comes() -> None:
    """BAD for the only step, COME and GO with nothing between them that holds: it is said why."""
    only = Network(CARRY.components[:1])
    script = [{"say": "BAD"}, {"wait": 1.0}, {"say": "COME"}, {"wait": 1.0}, {"say": "GO"}]
    practised = practise("short", only, silent(script=script), SKILLS)
    bad, come = practised.report.corrections
    assert practised.report.network == only
    assert "is the only step of the task" in bad.note
    assert "nothing remains to learn" in come.note or "no skill's goal came true" in come.note
    assert practised.report.done


def test_no_word_is_passed_over_in_silence() -> None:
    words = ["GO", "HERE", "DONE", "COME", "BAD", "COME"]
    script = [item for word in words for item in ({"say": word}, {"wait": 0.5})]
    practised = practise("silence", CARRY, silent(script=script), SKILLS, limit_s=5.0)
    assert [(one.word.value, one.note.partition(";")[0]) for one in practised.report.corrections] == [
        ("GO", "nothing is being shown"),
        ("HERE", "nothing is being shown"),
        ("DONE", "it belongs to a demonstration, and this is practice"),
        ("BAD", "it was said while something was being shown"),
        ("COME", "it was said while something was being shown"),
        ("COME", "GO was never said"),
    ]
    assert (practised.report.done, practised.report.ending) == (False, "time limit")
    assert practised.report.network == CARRY


def test_the_last_step_can_still_be_corrected() -> None:
    """When the task is done the robot listens on; that does not count as time of the run."""
    network = Network(
        (Component(id="drop-1", behavior="Drop"), Component(id="a", behavior="Track", parameters={"color": "pink"}))
    )
    script = [{"say": {"word": "BAD", "when_robot_within": 0.9, "of": [4.4, 3.0], "delay": 2.0, "timeout": 60}}]
    practised = practise("last", network, silent(script=script), SKILLS)
    (bad,) = practised.report.corrections
    assert (bad.meant[0].component, bad.meant[0].how) == ("a", "finished")
    assert practised.report.done
    assert practised.report.duration_s < bad.time_s
    assert ids(practised.report.network) == ["drop-1"]


def test_a_timeout_that_stops_the_run_stops_practice() -> None:
    step = Component(id="a", behavior="Track", parameters={"color": "red"}, timeout=Timeout(seconds=1, then="stop"))
    report = practise("late", Network((step,)), silent(script=[{"wait": 1.0}]), SKILLS).report
    assert (report.done, report.ending, report.stopped_by) == (False, "timeout", "a")


def test_a_long_name_is_no_obstacle() -> None:
    network = Network(
        (*CARRY.components, Component(id="b", behavior="Track", parameters={"color": "red"})), CARRY.links
    )
    practised = practise("n" * 80, network, silent(script=[{"wait": 1.0}, {"say": "BAD"}]), SKILLS, limit_s=3.0)
    (bad,) = practised.report.corrections
    assert bad.note == ""


def test_somebody_must_watch(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="nobody watches the practice"):
        practise("carry", CARRY, silent(), SKILLS, recording=tmp_path / "x.mcap")
    assert not list(tmp_path.iterdir())
