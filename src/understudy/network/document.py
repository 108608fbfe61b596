"""The task document: a behavior network in YAML or JSON, the dissertation's NETWORK-DESCRIPTION (§3.4)."""

import json
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml
from pydantic import Field, ValidationError

from understudy.documents import Name, Part, TextOrNumber, expect_kind, first_fault, read_data, write_new
from understudy.errors import NetworkError
from understudy.network.definition import Component, Link, LinkType, Network
from understudy.network.evidence import Interval, LinkEvidence, Occurrence

__all__ = ["Task", "load_task", "parse_task", "save_task", "task_schema", "task_text"]

Text = Annotated[str, Field(min_length=1, max_length=200)]
Seconds = Annotated[float, Field(allow_inf_nan=False)]
Span = tuple[Seconds, Seconds]


class OccurrencePart(Part):
    """Where a component was seen: in which demonstration, when, with which values, marked by which words."""

    demonstration: Text
    interval: Span
    values: dict[str, float] = {}
    cues: tuple[tuple[Seconds, str], ...] = ()
    closest_s: Seconds | None = None


class LinkEvidencePart(Part):
    """What one demonstration says about a link: both intervals, and Allen's relation between them (Table 4.1)."""

    demonstration: Text
    from_interval: Span
    to_interval: Span
    relation: str
    note: str = ""


class ComponentPart(Part):
    """One use of a behavior: AB-Description of §3.4."""

    id: Text
    behavior: Text
    parameters: dict[str, TextOrNumber] = {}
    seen: tuple[OccurrencePart, ...] = ()


class LinkPart(Part):
    """One precondition: an entry of the Topology-Description of §3.4."""

    source: Text = Field(alias="from")
    target: Text = Field(alias="to")
    type: LinkType
    because: tuple[LinkEvidencePart, ...] = ()


class InhibitionPart(Part):
    """While ``from`` executes, ``to`` is inhibited (§3.2.1)."""

    source: Text = Field(alias="from")
    target: Text = Field(alias="to")


class Task(Part):
    """A task document.

    Attributes:
        understudy: kind and version of the document.
        name: what the task is called.
        note: anything a person should know of it.
        components: at least one; their order settles every tie.
        links: between components, without circles.
        inhibitions: between components.
    """

    understudy: Literal["task/1"] = "task/1"
    name: Name
    note: str = ""
    components: Annotated[tuple[ComponentPart, ...], Field(min_length=1)]
    links: tuple[LinkPart, ...] = ()
    inhibitions: tuple[InhibitionPart, ...] = ()

    @classmethod
    def of(cls, name: str, network: Network, *, note: str = "") -> "Task":
        """The document of a network.

        Raises:
            NetworkError: the name, or an id, is none that a document can have: empty, or too long.
        """
        try:
            return cls._of(name, network, note)
        except ValidationError as error:
            raise first_fault(error, f"the task {name!r:.60}", NetworkError) from None

    @classmethod
    def _of(cls, name: str, network: Network, note: str) -> "Task":
        return cls(
            name=name,
            note=note,
            components=tuple(
                ComponentPart(
                    id=component.id,
                    behavior=component.behavior,
                    parameters=dict(component.parameters),
                    seen=tuple(
                        OccurrencePart(
                            demonstration=seen.demonstration,
                            interval=tuple(seen.interval),
                            values=dict(seen.values),
                            cues=seen.cues,
                            closest_s=seen.closest_s,
                        )
                        for seen in component.occurrences
                    ),
                )
                for component in network.components
            ),
            links=tuple(
                LinkPart(
                    source=link.source,
                    target=link.target,
                    type=link.type,
                    because=tuple(
                        LinkEvidencePart(
                            demonstration=evidence.demonstration,
                            from_interval=tuple(evidence.source),
                            to_interval=tuple(evidence.target),
                            relation=evidence.relation,
                            note=evidence.note,
                        )
                        for evidence in link.evidence
                    ),
                )
                for link in network.links
            ),
            inhibitions=tuple(InhibitionPart(source=source, target=target) for source, target in network.inhibitions),
        )

    def network(self, *, source: str = "") -> Network:
        """The network that the document describes.

        Raises:
            NetworkError: two components of one id, a link to nowhere, a circle.
        """
        components = tuple(
            Component(
                id=part.id,
                behavior=part.behavior,
                parameters=part.parameters,
                occurrences=tuple(
                    Occurrence(
                        demonstration=seen.demonstration,
                        interval=Interval(*seen.interval),
                        values=seen.values,
                        cues=seen.cues,
                        closest_s=seen.closest_s,
                    )
                    for seen in part.seen
                ),
            )
            for part in self.components
        )
        links = tuple(
            Link(
                source=part.source,
                target=part.target,
                type=part.type,
                evidence=tuple(
                    LinkEvidence(
                        demonstration=evidence.demonstration,
                        source=Interval(*evidence.from_interval),
                        target=Interval(*evidence.to_interval),
                        relation=evidence.relation,
                        note=evidence.note,
                    )
                    for evidence in part.because
                ),
            )
            for part in self.links
        )
        try:
            return Network(components, links, tuple((part.source, part.target) for part in self.inhibitions))
        except NetworkError as error:
            raise NetworkError(error.problem, source=source, path=error.path) from None


def parse_task(data: Any, *, source: str = "") -> tuple[Task, Network]:
    """A task and its network from plain data.

    Raises:
        NetworkError: it is no task document; the message names the first problem and its place.
    """
    expect_kind(data, "task/1", source=source, kind=NetworkError)
    try:
        task = Task.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, source, NetworkError) from None
    return task, task.network(source=source)


def load_task(path: str | Path) -> tuple[Task, Network]:
    """A task and its network from a file.

    Raises:
        NetworkError: the file cannot be read, or is no task document.
    """
    return parse_task(read_data(path, NetworkError), source=str(path))


def task_text(task: Task) -> str:
    """A task document as YAML."""
    data = {"understudy": task.understudy, **task.model_dump(mode="json", by_alias=True, exclude_defaults=True)}
    text: str = yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=120, default_flow_style=None)
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
