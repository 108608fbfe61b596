"""The world document: an arena, what stands in it, and the seed of all its randomness."""

import math
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import yaml
from pydantic import AfterValidator, BeforeValidator, Field, ValidationError
from pydantic_core import PydanticCustomError

from understudy.documents import Name as AnyName
from understudy.documents import Part, expect_kind, first_fault, read_data
from understudy.errors import WorldError
from understudy.geometry import Point, Pose
from understudy.robot import ROBOTS, TEACHER_COLOR, Color, RobotSpec
from understudy.sim.habits import Habits
from understudy.sim.layout import check_layout
from understudy.sim.noise import NoiseLevels
from understudy.sim.quantities import Degrees, Length, Metres, Place, plainly, two_numbers
from understudy.sim.script import ScriptItem

__all__ = [
    "Arena",
    "Box",
    "Door",
    "RobotStart",
    "Target",
    "Teacher",
    "Wall",
    "World",
    "load_world",
    "world_names",
    "world_path",
]

Name = Annotated[AnyName, plainly("text of 1 to 80 characters that are not all blank")]

DOOR_RANGE_DEG = 110.0
"""So far a door swings, either way."""

_BUNDLED = Path(__file__).parent / "worlds"


class Arena(Part):
    """A rectangle of floor, walled in; the origin is its lower left corner.

    Attributes:
        size: along x and y, metres.
    """

    size: Annotated[tuple[Length, Length], BeforeValidator(two_numbers)]


class Wall(Part):
    """A wall inside the arena, 4 cm thick, from one point to another."""

    start: Place = Field(alias="from")
    end: Place = Field(alias="to")


class Door(Part):
    """A swinging door without a latch: it is pushed open with the body, either way, and stays where it was pushed.

    Attributes:
        hinge: where it hangs.
        to: where its free edge is when it is closed.
        open_deg: how far it is open at first, counter-clockwise from above.
    """

    hinge: Place
    to: Place
    open_deg: Annotated[
        float,
        Field(ge=-DOOR_RANGE_DEG, le=DOOR_RANGE_DEG),
        plainly(f"a number of degrees from -{DOOR_RANGE_DEG:g} to {DOOR_RANGE_DEG:g}"),
    ] = 0.0

    @property
    def length(self) -> float:
        """From the hinge to the free edge, metres."""
        return Point(*self.hinge).distance_to(Point(*self.to))

    def edge(self, open_deg: float) -> Point:
        """Where the free edge is when the door is open so far."""
        hinge, closed = Point(*self.hinge), Point(*self.to)
        turned = math.atan2(closed.y - hinge.y, closed.x - hinge.x) + math.radians(open_deg)
        return Pose(hinge.x, hinge.y, turned).to_parent(Point(self.length, 0.0))


class Target(Part):
    """A tall colored cylinder that stays where it is when bumped.

    Attributes:
        color: one of the eight trained colors; in a world with a teacher not blue, by which the robot knows people.
        at: its centre.
        radius: metres.
        height: metres; the laser's plane is 0.30 m up.
        group: things of one group keep their places relative to each other when a room is rearranged.
    """

    color: Color
    at: Place
    radius: Length = 0.10
    height: Length = 0.50
    group: Name | None = None


class Box(Part):
    """A small colored box of 0.1 kg and 0.10 m height, light enough to be pushed, carried and taken away.

    Attributes:
        color: as for targets.
        at: its centre.
        heading_deg: which way it is turned.
        size: its width and depth, metres; the gripper opens 0.20 m.
        group: as for targets.
    """

    color: Color
    at: Place
    heading_deg: Degrees = 0.0
    size: Annotated[float, Field(ge=0.03, le=0.14), plainly("a number of metres from 0.03 to 0.14")] = 0.09
    group: Name | None = None


class RobotStart(Part):
    """A robot and where it is switched on.

    Attributes:
        name: how the simulation hands it out.
        kind: which robot.
        at: the point between its drive wheels.
        heading_deg: where it looks.
        marker: color of a tall cylinder on its back, so that another robot can follow it (§4.1, robot teachers).
    """

    name: Name
    kind: Literal["pioneer", "turtlebot"] = "pioneer"
    at: Place
    heading_deg: Degrees = 0.0
    marker: Color | None = None

    @property
    def spec(self) -> RobotSpec:
        """What it is made of."""
        return ROBOTS[self.kind]


class Teacher(Part):
    """A person in blue who leads a robot and speaks to it (A.3, A.5).

    Attributes:
        at: where the teacher stands at first.
        heading_deg: where the teacher looks at first.
        speed: of a walk, m/s.
        radius: metres; legs close together make a uniform target (A.5).
        height: metres.
        leads: name of the robot that is led; the first one if left out.
        habits: how well the teacher teaches; carefully, if left out.
        script: what the teacher does, in this order.
    """

    at: Place
    heading_deg: Degrees = 0.0
    speed: Annotated[float, Field(gt=0.0, le=2.0), plainly("a number of m/s above 0, at most 2")] = 0.35
    radius: Length = 0.15
    height: Length = 1.7
    leads: Name | None = None
    habits: Habits = Habits()
    script: tuple[ScriptItem, ...] = ()


def _at_least_one(robots: tuple[RobotStart, ...]) -> tuple[RobotStart, ...]:
    if not robots:
        raise PydanticCustomError("no_robot", "a world needs at least one robot, given none")
    return robots


class World(Part):
    """A world document.

    Attributes:
        understudy: kind and version of the document.
        name: what it is called.
        seed: of every random number in a run.
        arena: the walled floor.
        jitter: how far, along x and along y, things and robots move when the room is rearranged, metres; anywhere if
            None.
        walls: further walls.
        doors: swinging doors.
        targets: tall cylinders.
        boxes: small boxes.
        robots: at least one.
        teacher: a scripted person, or nobody.
        noise: how much the senses err.
    """

    understudy: Literal["world/1"]
    name: Name
    seed: Annotated[int, Field(ge=0), plainly("a whole number, 0 or more")] = 0
    arena: Arena
    jitter: Metres | None = None
    walls: tuple[Wall, ...] = ()
    doors: tuple[Door, ...] = ()
    targets: tuple[Target, ...] = ()
    boxes: tuple[Box, ...] = ()
    robots: Annotated[tuple[RobotStart, ...], AfterValidator(_at_least_one), Field(json_schema_extra={"minItems": 1})]
    teacher: Teacher | None = None
    noise: NoiseLevels = NoiseLevels()

    def with_habits(self, **habits: Any) -> Self:
        """The same, with other habits of its teacher.

        Args:
            habits: keys of :class:`Habits`; all others are those of the level given, ``like``.

        Raises:
            WorldError: it has no teacher, or these are no habits.
        """
        if self.teacher is None:
            raise WorldError("this world has no teacher, who could have habits", source=self.name)
        try:
            found = Habits.model_validate(habits)
        except ValidationError as error:
            raise first_fault(error, self.name, WorldError) from None
        return self.model_copy(update={"teacher": self.teacher.model_copy(update={"habits": found})})

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the document."""
        return {"$schema": "https://json-schema.org/draft/2020-12/schema", **cls.model_json_schema()}

    def to_yaml(self) -> str:
        """The document's text; reading it gives an equal world."""
        data = self.model_dump(mode="json", by_alias=True, exclude_defaults=True)
        text: str = yaml.safe_dump({"understudy": self.understudy, **data}, sort_keys=False, allow_unicode=True)
        return text

    @classmethod
    def from_data(cls, data: Any, *, source: str = "") -> Self:
        """Checks plain data and makes a world of it.

        Raises:
            WorldError: for the first problem found, with its path.
        """
        expect_kind(data, "world/1", source=source, kind=WorldError)
        try:
            world = cls.model_validate(data)
        except ValidationError as error:
            raise first_fault(error, source, WorldError) from None
        check_layout(world, source=source)
        _check_colors(world, source)
        return world


def _check_colors(world: World, source: str) -> None:
    """Refuses things of the teacher's color beside a teacher: the robot would follow them instead."""
    if world.teacher is None:
        return
    colors = [(f"targets[{i}].color", target.color) for i, target in enumerate(world.targets)]
    colors += [(f"boxes[{i}].color", box.color) for i, box in enumerate(world.boxes)]
    for path, color in colors:
        if color is TEACHER_COLOR:
            others = ", ".join(other for other in Color if other is not TEACHER_COLOR)
            raise WorldError(
                f"{color} is the teacher's color, by which the robot knows the teacher; choose another one: {others}",
                source=source,
                path=path,
            )


def load_world(path: str | Path) -> World:
    """Reads a world document from a YAML (or JSON) file.

    Raises:
        WorldError: the file cannot be read, is no YAML (with line and column), or is no world (with the path).
    """
    return World.from_data(read_data(path, WorldError), source=str(path))


def world_names() -> tuple[str, ...]:
    """Names of the bundled worlds."""
    return tuple(sorted(path.stem for path in _BUNDLED.glob("*.yaml")))


def world_path(name: str) -> Path:
    """The file of a bundled world.

    Raises:
        WorldError: no bundled world has this name.
    """
    if name not in world_names():
        raise WorldError(f"no bundled world is called {name!r}; there are: {', '.join(world_names())}")
    return _BUNDLED / f"{name}.yaml"
