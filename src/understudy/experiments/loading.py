"""Experiments found and read: those that come with the program by their names, others by their files."""

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

from pydantic import ValidationError

from understudy.behaviors import installed_skills
from understudy.documents import expect_kind, first_fault, path_text, read_data
from understudy.errors import ExperimentError
from understudy.execution import compile_network
from understudy.experiments.document import ExperimentDocument, Row
from understudy.experiments.experiment import Experiment
from understudy.experiments.kinds import KINDS
from understudy.experiments.tables import TABLES
from understudy.network import Task, load_task, task_names, task_path
from understudy.sim import World, load_world, world_names, world_path

__all__ = ["experiment_names", "find_experiment", "load_experiment"]

_BUNDLED = Path(__file__).parent / "documents"


def experiment_names() -> tuple[str, ...]:
    """Names of the bundled experiments."""
    return tuple(sorted(path.stem for path in _BUNDLED.glob("*.yaml")))


def find_experiment(name: str) -> Experiment:
    """The experiment of a file, or a bundled one by its name.

    Raises:
        ExperimentError: there is neither, or the document is malformed.
        WorldError: a world that it names is malformed.
        NetworkError: a task that it names is malformed.
    """
    if name in experiment_names():
        return replace(load_experiment(_BUNDLED / f"{name}.yaml"), called=name)
    if not Path(name).exists():
        raise ExperimentError(
            f"there is no such file, and no such experiment among: {', '.join(experiment_names())}", source=name
        )
    return load_experiment(name)


def load_experiment(path: str | Path) -> Experiment:
    """Reads an experiment document from a YAML (or JSON) file, and all that it names.

    Raises:
        ExperimentError: the file cannot be read, or is no experiment; the message names the first problem's place.
        WorldError: a world that it names is malformed.
        NetworkError: a task that it names is malformed, or does not fit the skills.
    """
    path = Path(path)
    source = str(path)
    data = read_data(path, ExperimentError)
    expect_kind(data, "experiment/1", source=source, kind=ExperimentError)
    try:
        document = ExperimentDocument.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, source, ExperimentError) from None
    for index, name in enumerate(document.tables):
        _known(name, TABLES, source, ("tables", index))
    worlds, tasks = [document.world], [document.task]
    for index, row in enumerate(document.rows):
        worlds += [*filter(None, [row.world]), *_checked_options(document, row, index, source)]
        tasks.append(row.task)
    experiment = Experiment(
        document=document,
        worlds={name: _world(name, path) for name in dict.fromkeys(worlds)},
        tasks={name: _task(name, path) for name in dict.fromkeys(tasks) if name is not None},
        called=source,
    )
    for row in document.rows:
        experiment.place(row)  # a teacher or a noise that cannot be is refused before anything is done
    return experiment


def _checked_options(document: ExperimentDocument, row: Row, index: int, source: str) -> tuple[str, ...]:
    """The further worlds that a row's kind asks for, if the kind is known and takes the row's options."""
    kind = KINDS[_known(row.kind, KINDS, source, ("rows", index, "kind"))]
    if kind.is_rate and row.goal is not None and row.goal > 1:
        problem = f"the goal of this kind is a rate of successes, a number from 0 to 1, given {row.goal:g}"
        raise ExperimentError(problem, source=source, path=f"rows[{index}].goal")
    try:
        return kind.options.model_validate({**document.options, **row.options}).named_worlds
    except ValidationError as error:
        fault = first_fault(error, source, ExperimentError)
        place = path_text(("rows", index, "with", *filter(None, [fault.path])))
        raise ExperimentError(fault.problem, source=source, path=place) from None


def _known(name: str, known: Collection[str], source: str, place: tuple[str | int, ...]) -> str:
    if name not in known:
        problem = f"{name!r} is unknown here; choose one of: {', '.join(known)}"
        raise ExperimentError(problem, source=source, path=path_text(place))
    return name


def _world(name: str, document: Path) -> World:
    return load_world(world_path(name) if name in world_names() else _beside(name, document, "world", world_names()))


def _task(name: str, document: Path) -> Task:
    bundled = name in task_names()
    path = task_path(name) if bundled else _beside(name, document, "task", task_names())
    task, network = load_task(path)
    compile_network(network, installed_skills(), source=str(path))  # what does not fit is refused with the file's name
    return Task.of(task.name, network, note=task.note)  # with the tasks that stand in it written out


def _beside(name: str, document: Path, what: str, known: tuple[str, ...]) -> Path:
    path = document.parent / name
    if not path.exists():
        raise ExperimentError(
            f"it names the {what} {name!r}, and there is no such file beside it, and no such {what} among:"
            f" {', '.join(known)}",
            source=str(document),
        )
    return path
