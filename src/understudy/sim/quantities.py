"""Numbers that world documents are made of, with their units and limits."""

from typing import Annotated, Any

from pydantic import BeforeValidator, Field, ValidationError, ValidatorFunctionWrapHandler, WrapValidator
from pydantic_core import PydanticCustomError

__all__ = ["Degrees", "Length", "Level", "Metres", "Place", "Rate", "Seconds", "plainly", "two_numbers"]


def plainly(words: str) -> WrapValidator:
    """Refuses one number or text in these words; pydantic's own would speak of strings, integers and inputs."""

    def check(given: Any, handler: ValidatorFunctionWrapHandler) -> Any:
        try:
            return handler(given)
        except ValidationError:
            problem = {"words": words, "given": f"{given!r:.80}"}
            raise PydanticCustomError("limits", "this must be {words}, given {given}", problem) from None

    return WrapValidator(check)


Coordinate = Annotated[float, Field(allow_inf_nan=False), plainly("a finite number of metres")]


def two_numbers(given: Any) -> Any:
    """Refuses anything but a list of two, before its numbers are looked at."""
    if isinstance(given, list | tuple) and len(given) == 2:
        return given
    raise PydanticCustomError("place", "expected two numbers, [x, y], given {given}", {"given": repr(given)})


Place = Annotated[tuple[Coordinate, Coordinate], BeforeValidator(two_numbers)]
"""A point of the floor in metres, from the arena's lower left corner."""

Degrees = Annotated[float, Field(allow_inf_nan=False), plainly("a finite number of degrees")]
"""A heading, counter-clockwise from the x axis."""

Length = Annotated[float, Field(gt=0.0, le=100.0), plainly("a number of metres above 0, at most 100")]
"""The size of a thing, metres."""

Metres = Annotated[float, Field(gt=0.0, allow_inf_nan=False), plainly("a number of metres above 0")]
"""A distance."""

Seconds = Annotated[float, Field(ge=0.0, allow_inf_nan=False), plainly("a number of seconds, 0 or more")]
"""A duration."""

Level = Annotated[float, Field(ge=0.0, allow_inf_nan=False), plainly("a number, 0 or more")]
"""A standard deviation."""

Rate = Annotated[float, Field(ge=0.0, le=1.0), plainly("a number from 0 to 1")]
"""A share of all."""
