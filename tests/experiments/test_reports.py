"""The report: every trial is counted, with the dissertation's figure beside ours; failures can be looked at."""

import re
import struct
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from understudy.errors import CampaignError, MissingExtraError
from understudy.experiments import Alone, Campaign, Experiment, Made, Unit, load_experiment
from understudy.experiments.reports import Report, markdown, missed_goals, report_of, write_markdown, write_page

from .campaigns import write_tiny


class Failing(Alone):
    """All trials of seed 2 fail."""

    def made(self, units: Sequence[Unit]) -> Iterator[Made]:
        for made, unit in zip(super().made(units), units, strict=True):
            if unit.seed != 2:
                yield made
                continue
            trial = unit.trial(
                ending="time limit",
                time_s=30.0,
                problems=("it | did <not>",),
                collisions={"wall": 1},
                grazes={"target": 2},
                achieved=made.trial.achieved,
                path=made.trial.path,
            )
            yield Made(trial=trial, took_s=1.0, recordings=((f"{unit.stem}-run.mcap", b""),))


@pytest.fixture(scope="module")
def experiment(tmp_path_factory: pytest.TempPathFactory) -> Experiment:
    path = write_tiny(tmp_path_factory.mktemp("tiny"), title="A <tiny> one", source="§4.5.4.1", tables=["orders"])
    return load_experiment(path)


@pytest.fixture(scope="module")
def folder(experiment: Experiment, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("campaign")
    with Campaign(experiment, experiment.document.rows, range(1, 4), folder) as campaign:
        campaign.go_on(Failing())
    return folder


@pytest.fixture(scope="module")
def report(experiment: Experiment, folder: Path) -> Report:
    with Campaign(experiment, experiment.document.rows, range(1, 4), folder) as campaign:
        return report_of(campaign)


@pytest.fixture(scope="module")
def pages(report: Report, folder: Path) -> list[str]:
    return [write(report, folder).read_text(encoding="utf-8") for write in (write_markdown, write_page)]


def test_all_trials_are_counted_with_the_dissertation_s_figure_beside_ours(report: Report) -> None:
    assert report.standing.startswith("9 trials, with seeds 1 to 3 in each row; ")
    taught, elsewhere, both = report.rows.rows
    assert taught[:5] == ("taught", "2 of 3", "9% to 99%", "", "50%")
    assert both[:5] == ("both", "2 of 3", "9% to 99%", "9 of 10", "")
    assert elsewhere[6:] == ("30 s", "1 wall", "2 target")
    assert report.missed == ()


def test_failures_are_told_with_recording_and_command(report: Report, folder: Path) -> None:
    assert [failure.trial for failure in report.failures] == [
        f"tiny, {row}, seed 2" for row in ("taught", "elsewhere", "both")
    ]
    called = report.experiment.called
    assert report.failures[1].again == f"understudy experiment {called} --row elsewhere --seed 2 --trials 1"
    assert all((folder / name).exists() for failure in report.failures for name in failure.recordings)
    text = markdown(report)
    assert "- tiny, both, seed 2: it | did <not>" in text
    assert "  - recorded: [recordings/both-seed-2-run.mcap](recordings/both-seed-2-run.mcap)" in text


def test_every_row_has_its_pictures_and_the_task_is_shown_once(report: Report) -> None:
    shown = [(picture.row, picture.name.rpartition("-")[2]) for picture in report.pictures]
    run = ["room", "progress", "average"]
    assert shown == [
        *(("taught", what) for what in ("room", "observations", "task")),
        *(("elsewhere", what) for what in run),
        *(("both", what) for what in ("room", "observations", *run)),
    ]
    for picture in report.pictures:
        assert struct.unpack(">II", picture.png[16:24])[0] == pytest.approx(picture.width * 160 / 96, abs=1)


def test_the_page_needs_nothing_beside_it(report: Report, pages: list[str]) -> None:
    html = pages[1]
    assert "A &lt;tiny&gt; one" in html
    assert "it | did &lt;not&gt;" in html
    sources = re.findall(r'(?:src|href)="([^"]*)"', html)
    inside, links = [one for one in sources if one.startswith("data:")], [one for one in sources if one[:5] != "data:"]
    assert len(inside) == len(report.pictures)
    assert all(link.startswith("recordings/") for link in links)
    assert not re.search(r"https?://|<script|@import|url\(", html)


def test_the_markdown_has_all_pictures_beside_it(pages: list[str], folder: Path) -> None:
    named = re.findall(r"!\[[^]]*\]\(([^)]*)\)", pages[0])
    assert sorted(named) == sorted(f"pictures/{path.name}" for path in (folder / "pictures").iterdir())


def test_a_goal_that_is_missed_is_said(experiment: Experiment, folder: Path) -> None:
    rows = tuple(row.model_copy(update={"goal": 0.9}) for row in experiment.document.rows[:1])
    high = replace(experiment, document=experiment.document.model_copy(update={"rows": rows}))
    with Campaign(high, rows, range(1, 4), folder) as campaign:
        assert missed_goals(high, campaign.trials) == ["taught: 2 of 3, and the goal is 90%"]


def test_without_jinja_there_is_no_page(report: Report, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "jinja2", None)
    with pytest.raises(MissingExtraError, match="the report as a page needs jinja2, which is not installed; pip insta"):
        write_page(report, tmp_path)


def test_pictures_of_an_earlier_report_are_taken_away(report: Report, tmp_path: Path) -> None:
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / "old.png").touch()
    write_markdown(report, tmp_path)
    assert len(list((tmp_path / "pictures").iterdir())) == len(report.pictures)


def test_a_report_that_cannot_be_written(report: Report, tmp_path: Path) -> None:
    (tmp_path / "pictures").write_text("no folder", encoding="utf-8")
    with pytest.raises(CampaignError, match=r"cannot be written: .*; the trials are kept"):
        write_markdown(report, tmp_path)
