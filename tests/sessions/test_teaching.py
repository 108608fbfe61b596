"""From a demonstration to the network: what the text describes (§4.5.4.1, §4.5.4.3), live and from the recording."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.errors import LearningError, RecordingError, WorldError
from understudy.learning import LearningSettings, learn
from understudy.network import LinkType, expand_links
from understudy.recording import read_recording
from understudy.sessions import recorded_demonstration, teach
from understudy.sim import World, load_world, world_path
from understudy.sim.teacher import ScriptedTeacher

from .conftest import Demonstrated

Show = Callable[[str], Demonstrated]


def steps(shown: Demonstrated) -> list[tuple[str, str]]:
    return [(c.behavior, str(c.parameters.get("color", ""))) for c in shown.network.components]


def links(shown: Demonstrated, *, full: bool = False) -> dict[tuple[str, str], LinkType]:
    network = expand_links(shown.network) if full else shown.network
    return {(link.source, link.target): link.type for link in network.links}


def test_visiting_targets_is_learned_as_visits_in_an_order(demonstrated: Show) -> None:
    """Figure 4.7: "all the precondition-postcondition dependencies [...] are ordering type constraints"."""
    shown = demonstrated("visit_targets")
    colors = ["green", "yellow", "light orange", "pink", "light green", "red"]
    assert steps(shown) == [("Track", color) for color in colors]
    assert set(links(shown).values()) == {LinkType.ORDERING}
    ids = [component.id for component in shown.network.components]
    assert list(links(shown)) == list(pairwise(ids))
    assert len(links(shown, full=True)) == 15
    assert shown.taught.verdict.clean
    assert not shown.taught.verdict.grazes


def test_every_target_is_passed_on_the_side_on_which_it_was_shown(demonstrated: Show) -> None:
    for component in demonstrated("visit_targets").network.components:
        assert float(component.parameters["angle_deg"]) < 30
        assert 0.4 < float(component.parameters["distance_m"]) < 1.1


def test_transport_is_learned_with_all_three_types_of_links(demonstrated: Show) -> None:
    """§4.5.4.3 and Figure 4.13."""
    shown = demonstrated("transport")
    assert steps(shown) == [
        ("Drop", ""),  # the gripper was empty at first: drop whatever it may hold
        ("Track", "green"),
        ("PickUp", "orange"),
        ("Track", "light orange"),
        ("Track", "yellow"),
        ("Track", "orange"),
        ("Drop", ""),
    ]
    found = links(shown)
    carried = {target for (source, target), type_ in found.items() if type_ is LinkType.PERMANENT}
    assert carried == {"track-light-orange-1", "track-yellow-1", "track-orange-1"}
    assert all(source == "pick-up-orange-1" for (source, _), type_ in found.items() if type_ is LinkType.PERMANENT)
    assert found["track-green-1", "pick-up-orange-1"] is LinkType.ENABLING
    assert LinkType.ORDERING in found.values()
    assert shown.taught.verdict.clean


def test_the_gate_is_passed_between_its_posts(demonstrated: Show) -> None:
    """ "Track the yellow target until it is at 180 degrees, then [the other one] until it is at 0 degrees"."""
    by_id = demonstrated("transport").network.by_id
    assert float(by_id["track-yellow-1"].parameters["angle_deg"]) > 160
    assert float(by_id["track-light-orange-1"].parameters["angle_deg"]) < 20


def test_a_slalom_is_learned_with_enabling_links(demonstrated: Show) -> None:
    """§4.5.4.2 and Figure 4.11: "the robot began to track a new target while still near the previous one"."""
    shown = demonstrated("slalom")
    assert steps(shown) == [("Track", color) for color in ("pink", "yellow", "green", "light orange")]
    ids = [component.id for component in shown.network.components]
    assert links(shown) == dict.fromkeys(pairwise(ids), LinkType.ENABLING)
    angles = [float(component.parameters["angle_deg"]) for component in shown.network.components]
    assert [angle < 30 for angle in angles] == [True, False, True, False]
    assert [angle > 150 for angle in angles] == [False, True, False, True]
    assert shown.taught.verdict.clean
    assert not shown.taught.verdict.grazes


def test_words_keep_the_distractors_out_of_a_task(demonstrated: Show) -> None:
    """§4.5.5.1 and Figure 4.16: the robot is led past an orange and a second yellow target, and nobody says a word."""
    shown = demonstrated("clutter")
    assert steps(shown) == [
        ("Drop", ""),
        ("Track", "light green"),
        ("PickUp", "orange"),
        ("Track", "yellow"),
        ("Track", "light orange"),
        ("Track", "green"),
        ("Drop", ""),
        ("Track", "light green"),
    ]
    found = links(shown)
    carried = {target for (source, target) in found if source == "pick-up-orange-1"}
    assert carried == {"track-yellow-1", "track-light-orange-1", "track-green-1"}
    assert all(found["pick-up-orange-1", target] is LinkType.PERMANENT for target in carried)
    left_out = {(str(one.observed.instance), one.reason) for one in shown.lesson.dropped}
    silent = "no cue while it was true"
    assert left_out == {("Track(color=orange)", silent), ("Track(color=yellow)", silent)}
    assert shown.taught.verdict.clean


def test_without_words_the_distractors_are_learned(demonstrated: Show) -> None:
    shown = demonstrated("clutter")
    everything = learn(shown.taught.demonstration, LearningSettings(heed_cues=False)).network
    ids = [component.id for component in everything.components]
    assert ids[-3:] == ["track-orange-1", "track-yellow-2", "track-light-green-2"]
    assert set(shown.network.by_id) < {*ids}


def test_every_link_has_its_evidence(demonstrated: Show) -> None:
    shown = demonstrated("transport")
    for link in shown.network.links:
        [evidence] = link.evidence
        assert evidence.demonstration == "transport"
        assert evidence.source in [o.interval for o in shown.network.by_id[link.source].occurrences]
        assert evidence.target in [o.interval for o in shown.network.by_id[link.target].occurrences]


@pytest.mark.parametrize("name", ["visit_targets", "transport"])
def test_a_recording_teaches_the_same_as_the_live_demonstration(demonstrated: Show, name: str) -> None:
    shown = demonstrated(name)
    again = learn(recorded_demonstration(shown.recording, installed_skills()))
    assert again.network == shown.network
    assert again.dropped == shown.lesson.dropped


def test_the_recording_holds_what_the_robot_was_told_and_the_world(demonstrated: Show) -> None:
    shown = demonstrated("transport")
    recording = read_recording(shown.recording)
    assert [cue.value for _, cue in recording.cues()] == ["START", "TAKE", "HERE", "HERE", "DROP", "DONE"]
    kinds = [event["kind"] for event in recording.events()]
    assert kinds.count("errand-done") == 2
    assert len(list(recording.commands())) == len(list(recording.observations(images=False)))
    assert recording.attachment("world.yaml") == shown.world.to_yaml().encode()


def test_what_the_robot_said_is_in_the_recording_and_its_teacher_hears_it(
    demonstrated: Show, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = demonstrated("transport")
    events = [event for event in read_recording(shown.recording).events() if event["kind"] == "remark"]
    assert [(event["time_s"], event["what"]) for event in events] == list(shown.taught.remarks)
    assert (events[0]["about"], events[0]["noted"]) == ("noted", ["green"])
    heard: list[str] = []
    monkeypatch.setattr(ScriptedTeacher, "hear", lambda self, remark: heard.append(remark["what"]))
    again = teach(shown.world, installed_skills())
    assert heard == [what for _, what in again.remarks] == [what for _, what in shown.taught.remarks]


def test_the_same_seed_gives_the_same_demonstration_bit_for_bit(demonstrated: Show, tmp_path: Path) -> None:
    shown = demonstrated("visit_targets")
    again = tmp_path / "again.mcap"
    teach(shown.world, installed_skills(), recording=again)
    assert again.read_bytes() == shown.recording.read_bytes()


def test_another_seed_gives_another_demonstration_and_the_same_task(demonstrated: Show) -> None:
    shown = demonstrated("visit_targets")
    other = learn(teach(shown.world, installed_skills(), seed=99).demonstration).network
    assert other != shown.network
    assert [component.id for component in other.components] == [c.id for c in shown.network.components]
    assert [(link.source, link.target, link.type) for link in other.links] == [
        (link.source, link.target, link.type) for link in shown.network.links
    ]


def truncated(recording: Path, share: float, folder: Path) -> Path:
    path = folder / "cut.mcap"
    content = recording.read_bytes()
    path.write_bytes(content[: int(len(content) * share)])
    return path


def test_a_recording_that_breaks_off_is_learned_from_up_to_there(demonstrated: Show, tmp_path: Path) -> None:
    shown = demonstrated("visit_targets")
    lesson = learn(recorded_demonstration(truncated(shown.recording, 0.6, tmp_path), installed_skills()))
    found = [component.id for component in lesson.network.components]
    whole = [component.id for component in shown.network.components]
    assert 2 <= len(found) < len(whole)
    assert found == whole[: len(found)]
    assert any("cut short" in note for note in lesson.notes)


def script(*items: object) -> World:
    world = load_world(world_path("visit_targets"))
    data = world.model_dump(mode="json", by_alias=True)
    data["teacher"]["script"] = list(items)
    return World.from_data(data)


def test_done_without_start() -> None:
    with pytest.raises(LearningError, match=r"START was never said.*Say START"):
        teach(script({"say": "DONE"}), installed_skills())


def test_an_empty_demonstration() -> None:
    taught = teach(script({"say": "START"}, {"wait": 1.0}, {"say": "DONE"}), installed_skills())
    with pytest.raises(LearningError, match="every observation was left out"):
        learn(taught.demonstration)


def test_a_world_without_a_teacher() -> None:
    world = load_world(world_path("visit_targets")).model_copy(update={"teacher": None})
    with pytest.raises(WorldError, match="no teacher with a script"):
        teach(world, installed_skills())


def test_a_recording_is_never_overwritten(demonstrated: Show) -> None:
    shown = demonstrated("visit_targets")
    before = shown.recording.read_bytes()
    with pytest.raises(RecordingError, match="exists already"):
        teach(shown.world, installed_skills(), recording=shown.recording)
    assert shown.recording.read_bytes() == before
