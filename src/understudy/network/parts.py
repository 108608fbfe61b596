"""The parts of a task document, as pydantic models: what stands in the file, before it becomes a network."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from understudy.documents import Part, TextOrNumber
from understudy.network.definition import LinkType

__all__ = [
    "BehaviorPart",
    "CasePart",
    "ComponentPart",
    "ConditionPart",
    "InhibitionPart",
    "LinkEvidencePart",
    "LinkPart",
    "NetworkPart",
    "OccurrencePart",
    "PathPart",
    "RepeatPart",
    "SwitchPart",
    "Text",
    "TimeoutPart",
    "TriggerPart",
]

Text = Annotated[str, Field(min_length=1, max_length=200)]
Seconds = Annotated[float, Field(allow_inf_nan=False)]
Span = tuple[Seconds, Seconds]


def _exactly_one(part: Any, names: tuple[str, ...]) -> None:
    given = [name for name in names if getattr(part, name) is not None]
    if len(given) != 1:
        aliases = [type(part).model_fields[name].alias or name for name in names]
        raise PydanticCustomError(
            "exactly_one",
            "exactly one of these keys is needed: {keys}; given {given}",
            {
                "keys": ", ".join(aliases),
                "given": " and ".join(type(part).model_fields[name].alias or name for name in given) or "none",
            },
        )


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


class BehaviorPart(Part):
    """A behavior with parameters, in a condition; its name alone if it has none."""

    shorthand: ClassVar[str | None] = "behavior"

    behavior: Text
    parameters: dict[str, TextOrNumber] = {}


class ConditionPart(Part):
    """A condition: exactly one of the keys."""

    holds: BehaviorPart | None = None
    possible: BehaviorPart | None = None
    event: Text | None = None
    achieved: Text | None = None
    timed_out: Text | None = None
    complete: Literal[True] | None = None
    after: Seconds | None = None
    not_: "ConditionPart | None" = Field(default=None, alias="not")
    all: "tuple[ConditionPart, ...] | None" = None
    any: "tuple[ConditionPart, ...] | None" = None

    @model_validator(mode="after")
    def _one(self) -> "ConditionPart":
        _exactly_one(self, tuple(type(self).model_fields))
        return self


class TimeoutPart(Part):
    """What happens to a component that has been active for too long."""

    seconds: Seconds
    then: Literal["skip", "stop", "signal"] = "stop"
    event: str = ""


class TriggerPart(Part):
    """When a duty beside the sequence is asked for."""

    every: Seconds | None = None
    when: ConditionPart | None = None

    @model_validator(mode="after")
    def _one(self) -> "TriggerPart":
        _exactly_one(self, ("every", "when"))
        return self


class RepeatPart(Part):
    """How often a network is executed."""

    times: int | None = None
    until: ConditionPart | None = None


class CasePart(Part):
    """One of the networks that can stand in a component's place."""

    name: Annotated[str, Field(max_length=200)] = ""
    when: ConditionPart | None = None
    network: "NetworkPart | None" = None
    task: Text | None = None

    @model_validator(mode="after")
    def _one(self) -> "CasePart":
        _exactly_one(self, ("network", "task"))
        return self


class SwitchPart(Part):
    """When one case gives way to another."""

    source: Text = Field(alias="from")
    target: Text = Field(alias="to")
    when: ConditionPart


class ComponentPart(Part):
    """One use of a behavior (AB-Description of §3.4), or a network in its place (NAB-Description)."""

    id: Text
    behavior: Text | None = None
    parameters: dict[str, TextOrNumber] = {}
    network: "NetworkPart | None" = None
    task: Text | None = None
    cases: Annotated[tuple[CasePart, ...], Field(min_length=1)] | None = None
    name: Text | None = None
    switches: tuple[SwitchPart, ...] = ()
    repeat: RepeatPart | None = None
    until: ConditionPart | None = None
    timeout: TimeoutPart | None = None
    trigger: TriggerPart | None = None
    seen: tuple[OccurrencePart, ...] = ()

    @model_validator(mode="after")
    def _one(self) -> "ComponentPart":
        _exactly_one(self, ("behavior", "network", "task", "cases"))
        only = (
            ("parameters", "seen") if self.behavior is None else ("name", "switches", "repeat"),
            "behaviors" if self.behavior is None else "networks",
        )
        for key in only[0]:
            if getattr(self, key):
                raise PydanticCustomError("misplaced", "{key!r} is for {kind} only", {"key": key, "kind": only[1]})
        return self


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


class PathPart(Part):
    """One step of the ways through a network: after ``from``, or START, may come ``to``, or END."""

    source: Text = Field(alias="from")
    target: Text = Field(alias="to")
    shown: tuple[Text, ...] = ()


class NetworkPart(Part):
    """Components, links and inhibitions: NETWORK-DESCRIPTION of §3.4; and paths, where there are alternatives."""

    components: Annotated[tuple[ComponentPart, ...], Field(min_length=1)]
    links: tuple[LinkPart, ...] = ()
    inhibitions: tuple[InhibitionPart, ...] = ()
    paths: tuple[PathPart, ...] = ()


for _part in (ConditionPart, TriggerPart, RepeatPart, CasePart, SwitchPart, ComponentPart, NetworkPart):
    _part.model_rebuild()
