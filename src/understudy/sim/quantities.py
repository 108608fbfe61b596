"""Numbers that world documents are made of, with their units and limits."""

from typing import Annotated, Any

from pydantic import BeforeValidator, Field
from pydantic_core import PydanticCustomError

__all__ = ["Degrees", "Length", "Level", "Metres", "Place", "Rate", "Seconds", "two_numbers"]

Coordinate = Annotated[float, Field(allow_inf_nan=False)]


def two_numbers(given: Any) -> Any:
    """Refuses anything but a list of two, before its numbers are looked at."""
    if isinstance(given, list | tuple) and len(given) == 2:
        return given
    raise PydanticCustomError("place", "expected two numbers, [x, y], given {given}", {"given": repr(given)})


Place = Annotated[tuple[Coordinate, Coordinate], BeforeValidator(two_numbers)]
"""A point of the floor in metres, from the arena's lower left corner."""

Degrees = Annotated[float, Field(allow_inf_nan=False)]
"""A heading, counter-clockwise from the x axis."""

Length = Annotated[float, Field(gt=0.0, le=100.0)]
"""The size of a thing, metres."""

Metres = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
"""A distance."""

Seconds = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
"""A duration."""

Level = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
"""A standard deviation."""

Rate = Annotated[float, Field(ge=0.0, le=1.0)]
"""A share of all."""
