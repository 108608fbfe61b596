"""Runs put aside and gone on with; runs repeated with one link changed."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from understudy.behaviors import SkillSet, installed_skills
from understudy.errors import ContextError, NetworkError, RecordingError
from understudy.execution import State, compile_network, load_context
from understudy.network import LinkType, load_task, relinked, task_path
from understudy.recording import read_recording
from understudy.sessions import Past, past_at, perform, take_up, what_if
from understudy.sim import load_world, world_path

from .conftest import Demonstrated

Show = Callable[[str], Demonstrated]
SEED = 3


@pytest.fixture(scope="module")
def whole(demonstrated: Show, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The recording of an undisturbed run."""
    shown, file = demonstrated("transport"), tmp_path_factory.mktemp("whole") / "run.mcap"
    perform("task", shown.network, shown.world, installed_skills(), seed=SEED, recording=file)
    return file


@pytest.mark.parametrize("pause_s", [0.0, 12.3, 30.0])
def test_a_paused_run_ends_as_the_undisturbed_one_bit_for_bit(
    demonstrated: Show, whole: Path, tmp_path: Path, pause_s: float
) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    file = tmp_path / "run.mcap"
    paused = perform("task", shown.network, shown.world, skills, seed=SEED, recording=file, pause_at_s=pause_s)
    assert (paused.report.done, paused.report.ending) == (False, "paused")
    assert paused.paused is not None
    paused.paused.save(tmp_path / "run.json")

    saved = load_context(tmp_path / "run.json")
    context = saved.restored(compile_network(shown.network, skills))
    past = Past.of(read_recording(tmp_path / saved.recording), context)
    again = tmp_path / "again.mcap"
    resumed = perform("task", shown.network, shown.world, skills, seed=SEED, recording=again, past=past)
    assert resumed.report.done
    assert again.read_bytes() == whole.read_bytes()


def test_a_run_that_was_cut_goes_on_from_its_recording_alone(demonstrated: Show, whole: Path, tmp_path: Path) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    past = past_at(read_recording(cut), shown.network, skills)
    assert past.context.tick > 0
    again = tmp_path / "again.mcap"
    perform("task", shown.network, shown.world, skills, seed=SEED, recording=again, past=past)
    assert again.read_bytes() == whole.read_bytes()


def test_more_time_for_a_run_that_had_too_little(demonstrated: Show, whole: Path, tmp_path: Path) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    late, again = tmp_path / "late.mcap", tmp_path / "again.mcap"
    perform("task", shown.network, shown.world, skills, seed=SEED, recording=late, limit_s=20)
    past = past_at(read_recording(late), shown.network, skills)
    perform("task", shown.network, shown.world, skills, seed=SEED, recording=again, past=past)
    assert again.read_bytes() == whole.read_bytes()


def test_a_past_that_does_not_fit_is_refused(demonstrated: Show, whole: Path) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    recording = read_recording(whole)
    with pytest.raises(RecordingError, match=r"the task was done at .* nothing to go on with"):
        past_at(recording, shown.network, skills)
    with pytest.raises(RecordingError, match="is the recording of a demonstration"):
        past_at(read_recording(shown.recording), shown.network, skills)
    link = shown.network.links[0]
    other = relinked(shown.network, link.source, link.target, None)
    with pytest.raises(
        RecordingError, match=f"another task: the {link.type} link {link.source} -> {link.target} is gone"
    ):
        past_at(recording, other, skills)
    past = past_at(recording, shown.network, skills, 5.0)
    with pytest.raises(RecordingError, match=r"at 0\.0 s the simulated room does not answer as it did"):
        perform("task", shown.network, shown.world, skills, seed=SEED + 1, past=past)


def test_what_if_a_link_were_another(demonstrated: Show, whole: Path) -> None:
    """While nothing hangs on a link it makes no difference; a step that waits for nothing any more does not wait."""
    shown, skills = demonstrated("transport"), installed_skills()
    recording = read_recording(whole)
    permanent = next(link for link in shown.network.links if link.type is LinkType.PERMANENT)
    same = what_if(recording, 5.0, permanent.source, permanent.target, LinkType.ORDERING, skills)
    assert same.was is LinkType.PERMANENT
    assert same.first is None
    assert (same.done, same.performed.report.done) == (True, True)
    assert same.performed.report.duration_s == pytest.approx(same.ended_s)

    # The drop waits for nothing: it comes true as soon as the box is let go of, and nobody asks where.
    *_, last = shown.network.components
    links = [link for link in shown.network.links if link.target == last.id]
    parted = what_if(recording, 0.0, links[-1].source, last.id, None, skills)
    assert parted.first is not None
    assert parted.first.states[last.id][0] is State.WAITING
    assert parted.as_record()["first_difference"]["states"][last.id][0] == "waiting"


def test_what_cannot_be_asked(demonstrated: Show, whole: Path) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    first, *_, last = (component.id for component in shown.network.components)
    with pytest.raises(NetworkError, match=f"no link {last} -> {first}; to {first} lead: none"):
        what_if(read_recording(whole), 5.0, last, first, LinkType.ORDERING, skills)
    link = shown.network.links[0]
    with pytest.raises(NetworkError, match=f"is {link.type} as it is; ask for another type"):
        what_if(read_recording(whole), 5.0, link.source, link.target, link.type, skills)
    with pytest.raises(RecordingError, match="ask within that"):
        what_if(read_recording(whole), 500.0, link.source, link.target, None, skills)
    with pytest.raises(RecordingError, match="name a run that understudy run has made"):
        what_if(read_recording(shown.recording), 5.0, first, last, None, skills)


def test_a_context_beside_the_wrong_recording_is_refused(demonstrated: Show, whole: Path, tmp_path: Path) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    files = [tmp_path / "one.mcap", tmp_path / "two.mcap"]
    for seed, file in zip((SEED, SEED + 1), files, strict=True):
        paused = perform("task", shown.network, shown.world, skills, seed=seed, recording=file, pause_at_s=3.0 + seed)
        assert paused.paused is not None
        paused.paused.save(file.with_suffix(".json"))
    data = json.loads(files[0].with_suffix(".json").read_text())
    (tmp_path / "mixed.json").write_text(json.dumps(data | {"recording": "two.mcap"}))
    with pytest.raises(ContextError, match=f"of another run: its seed is {SEED + 1}, and this one's was {SEED}"):
        take_up(tmp_path / "mixed.json", shown.network, skills)
    (tmp_path / "mixed.json").write_text(json.dumps(data | {"recording": "two.mcap", "seed": SEED + 1, "tick": 90}))
    past = take_up(tmp_path / "mixed.json", shown.network, skills)
    again = tmp_path / "again.mcap"
    with pytest.raises(RecordingError, match="is not the recording of this run"):
        perform("task", shown.network, past.world, skills, seed=past.seed, past=past, recording=again)
    assert not again.exists()
    for wrong in ({"recording": "a/b.mcap"}, {"tick": -1}):
        (tmp_path / "wrong.json").write_text(json.dumps(data | wrong))
        with pytest.raises(ContextError, match=next(iter(wrong))):
            take_up(tmp_path / "wrong.json", shown.network, skills)


def test_another_skill_is_noticed(demonstrated: Show, whole: Path) -> None:
    shown, skills = demonstrated("transport"), installed_skills()
    lazy = SkillSet(
        *(
            replace(skill, primitive=skills["Drop"].primitive) if skill.name == "Track" else skill
            for skill in skills.values()
        )
    )
    with pytest.raises(RecordingError, match="the robot would not do what it did"):
        past_at(read_recording(whole), shown.network, lazy, 30.0)


def test_the_landmarks_of_a_past_are_watched_when_it_is_thought_through_again(tmp_path: Path) -> None:
    _, network = load_task(task_path("delivery"))
    world, skills, file = load_world(world_path("delivery")), installed_skills(), tmp_path / "run.mcap"
    perform("delivery", network, world, skills, recording=file, pause_at_s=10.0)
    past = past_at(read_recording(file), network, skills)
    assert "delivery/deliver/localize" in {event.component for event in past.events if event.kind == "achieved"}
