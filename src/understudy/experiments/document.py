"""The experiment document: what is tried, where, how often, and by what it is measured (§4.5)."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from understudy.documents import Name, Part
from understudy.learning import LearningSettings

__all__ = ["ExperimentDocument", "Learning", "Limits", "Options", "Row", "experiment_schema"]

Metres = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Seconds = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]


class Limits(Part):
    """How a changed room is drawn; what is left out is as in :func:`understudy.sim.rearranged`.

    Attributes:
        spacing: least gap between things of different groups, metres.
        wall_margin: least gap between things and walls, metres.
        robot_clearance: least gap around a robot's start, metres.
    """

    spacing: Metres | None = None
    wall_margin: Metres | None = None
    robot_clearance: Metres | None = None


class Learning(Part):
    """Settings of the learner; what is left out is as in :class:`understudy.learning.LearningSettings`."""

    merge_gap_s: Seconds | None = None
    min_duration_s: Seconds | None = None
    max_distance_m: Metres | None = None
    cue_grace_s: Seconds | None = None
    cue_delay_s: Seconds | None = None
    heed_cues: bool | None = None
    keep_unchanging: bool | None = None
    order: Literal["onset", "closest"] | None = None

    @property
    def settings(self) -> LearningSettings:
        """All settings."""
        return LearningSettings(**self.model_dump(exclude_none=True))


class Options(Part):
    """What a kind of trial takes beside its row; a kind that takes something derives its own from this."""

    @property
    def named_worlds(self) -> tuple[str, ...]:
        """The further worlds that it names; they are found with the experiment."""
        return ()


class Row(Part):
    """One row of the experiment's table: trials of one kind, in one room.

    Attributes:
        name: unique in the experiment.
        kind: what a trial is: ``run``, ``teach`` or another one of :data:`understudy.experiments.KINDS`.
        world: another one than the experiment's.
        task: another one than the experiment's.
        room: ``same`` is the world as it stands; ``changed`` has everything elsewhere, drawn by the trial's seed.
        limits: of the drawing.
        teacher: keys of the world's teacher with other values, over those of the experiment.
        noise: keys of the world's noise with other values, over those of the experiment.
        options: what else the kind takes (in the document: ``with``), over those of the experiment.
        dissertation: its figure, as text: ``9 of 10``.
        goal: the least rate of successes (or what else the kind measures) that would be good.
    """

    name: Name
    kind: Name
    world: Name | None = None
    task: Name | None = None
    room: Literal["same", "changed"] = "same"
    limits: Limits = Limits()
    teacher: dict[str, Any] = {}
    noise: dict[str, Any] = {}
    options: dict[str, Any] = Field(default={}, alias="with")
    dissertation: str = ""
    goal: Annotated[float, Field(ge=0.0, allow_inf_nan=False)] | None = None

    @model_validator(mode="after")
    def _limits_of_a_changed_room(self) -> Self:
        if self.room == "same" and self.limits != Limits():
            raise PydanticCustomError("limits_of_nothing", "`limits` are those of a changed room; add `room: changed`")
        return self


class ExperimentDocument(Part):
    """An experiment document.

    Attributes:
        understudy: kind and version of the document.
        name: what it is called, and files after it.
        title: the same for a reader.
        source: where it is described: ``§4.5.4.1``.
        note: anything a person should know of it.
        world: a bundled one, or a file beside the document.
        task: the same; left out, it is what one demonstration in the world as it stands teaches.
        teacher: keys of the world's teacher with other values.
        noise: keys of the world's noise with other values.
        learning: settings of the learner.
        options: for the kinds of all rows (in the document: ``with``).
        limit_s: simulated seconds allowed to a run; §4.5.4.1 allows 5 minutes.
        trials: how many in each row, if nobody says.
        seed: of the first trial in each row, if nobody says; the next ones count up.
        tables: what the report tells beside the rows, of :data:`understudy.experiments.TABLES`.
        rows: at least one.
    """

    understudy: Literal["experiment/1"]
    name: Name
    title: str = ""
    source: str = ""
    note: str = ""
    world: Name
    task: Name | None = None
    teacher: dict[str, Any] = {}
    noise: dict[str, Any] = {}
    learning: Learning = Learning()
    options: dict[str, Any] = Field(default={}, alias="with")
    limit_s: Annotated[float, Field(gt=0.0, allow_inf_nan=False)] = 300.0
    trials: Annotated[int, Field(ge=1)] = 20
    seed: Annotated[int, Field(ge=0)] = 1
    tables: tuple[Name, ...] = ()
    rows: Annotated[tuple[Row, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _names_are_unique(self) -> Self:
        names = [row.name for row in self.rows]
        if twice := [name for index, name in enumerate(names) if name in names[:index]]:
            problem = {"name": repr(twice[0])}
            raise PydanticCustomError("name_twice", "two rows are called {name}; rename one of them", problem)
        return self


def experiment_schema() -> dict[str, Any]:
    """The JSON Schema of the document."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **ExperimentDocument.model_json_schema()}
