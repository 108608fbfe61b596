"""The task document: a behavior network in YAML or JSON, the dissertation's NETWORK-DESCRIPTION (§3.4)."""

import json
from pathlib import Path
from typing import Any, Literal

import yaml
from pydantic import ValidationError

from understudy.documents import Name, expect_kind, first_fault, read_data, write_new
from understudy.errors import NetworkError
from understudy.network.definition import Network
from understudy.network.parts import NetworkPart
from understudy.network.reading import network_of
from understudy.network.writing import network_part

__all__ = ["Task", "load_task", "parse_task", "save_task", "task_data", "task_schema", "task_text"]


class Task(NetworkPart):
    """A task document.

    Attributes:
        understudy: kind and version of the document.
        name: what the task is called.
        note: anything a person should know of it.
        components: at least one; their order settles every tie.
        links: between components, without circles.
        inhibitions: between components.
        paths: the ways through it, where there are alternatives.
    """

    understudy: Literal["task/1"] = "task/1"
    name: Name
    note: str = ""

    @classmethod
    def of(cls, name: str, network: Network, *, note: str = "") -> "Task":
        """The document of a network. Tasks that stand in it are written out.

        Raises:
            NetworkError: the name, or an id, is none that a document can have: empty, or too long.
        """
        try:
            part = network_part(network)
            return cls(name=name, note=note, **{key: getattr(part, key) for key in NetworkPart.model_fields})
        except ValidationError as error:
            raise first_fault(error, f"the task {name!r:.60}", NetworkError) from None

    def network(self, *, source: str = "") -> Network:
        """The network that the document describes.

        Args:
            source: the document's file; tasks that stand in it (``task: other.yaml``) are looked for beside it.

        Raises:
            NetworkError: two components of one id, a link to nowhere, a circle, a task that cannot be loaded.
        """
        return _network(self, source, ())


def _network(task: Task, source: str, around: tuple[str, ...]) -> Network:
    def fetch(name: str, path: str) -> tuple[str, Network]:
        file = (Path(source).parent if source else Path()) / name
        opened = (*around, str(Path(source).resolve()) if source else "")
        if str(file.resolve()) in opened:
            raise NetworkError(f"the task {name} stands in itself; take it out", path=path)
        try:
            inner = _parsed(read_data(file, NetworkError), str(file))
            return inner.name, _network(inner, str(file), opened)
        except NetworkError as error:
            raise NetworkError(f"the task that stands here cannot be used: {error}", path=path) from None

    try:
        return network_of(task, fetch)
    except NetworkError as error:
        raise NetworkError(error.problem, source=source, path=error.path) from None


def _parsed(data: Any, source: str) -> Task:
    expect_kind(data, "task/1", source=source, kind=NetworkError)
    try:
        return Task.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, source, NetworkError) from None
    except RecursionError:
        raise NetworkError("this is nested too deeply to be a task", source=source) from None


def parse_task(data: Any, *, source: str = "") -> tuple[Task, Network]:
    """A task and its network from plain data.

    Raises:
        NetworkError: it is no task document; the message names the first problem and its place.
    """
    task = _parsed(data, source)
    return task, task.network(source=source)


def load_task(path: str | Path) -> tuple[Task, Network]:
    """A task and its network from a file.

    Raises:
        NetworkError: the file cannot be read, or is no task document.
    """
    return parse_task(read_data(path, NetworkError), source=str(path))


def task_data(task: Task) -> dict[str, Any]:
    """A task document as plain data, for JSON and YAML; what is as it is by default is left out."""
    written: dict[str, Any] = task.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    data: dict[str, Any] = {"understudy": task.understudy}
    data |= {key: written.pop(key) for key in ("name", "note") if key in written}
    return data | written


def task_text(task: Task) -> str:
    """A task document as YAML."""
    text: str = yaml.safe_dump(task_data(task), sort_keys=False, allow_unicode=True, width=120, default_flow_style=None)
    return text


def save_task(path: str | Path, task: Task) -> None:
    """Writes a task document; JSON if the name ends in ``.json``, YAML otherwise. Nothing is overwritten.

    Raises:
        NetworkError: the file exists, or cannot be written.
    """
    path = Path(path)
    text = task_text(task)
    if path.suffix.lower() == ".json":
        text = json.dumps(yaml.safe_load(text), indent=2, ensure_ascii=False) + "\n"
    write_new(path, text, NetworkError)


def task_schema() -> dict[str, Any]:
    """The JSON Schema of the task document."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **Task.model_json_schema()}
