"""The eight trained colors (A.1). Blue is the teacher's."""

from enum import StrEnum

__all__ = ["RGB", "TEACHER_COLOR", "Color", "Paints"]


class Color(StrEnum):
    """A color that the camera has been trained for; the value is its name in documents."""

    RED = "red"
    ORANGE = "orange"
    LIGHT_ORANGE = "light orange"
    YELLOW = "yellow"
    LIGHT_GREEN = "light green"
    GREEN = "green"
    PINK = "pink"
    BLUE = "blue"


TEACHER_COLOR = Color.BLUE

RGB: dict[Color, tuple[int, int, int]] = {
    Color.RED: (205, 30, 30),
    Color.ORANGE: (235, 105, 15),
    Color.LIGHT_ORANGE: (250, 175, 95),
    Color.YELLOW: (235, 220, 35),
    Color.LIGHT_GREEN: (145, 230, 105),
    Color.GREEN: (15, 125, 50),
    Color.PINK: (240, 115, 185),
    Color.BLUE: (35, 70, 190),
}
"""The paint of each color in plain light, 0 to 255."""

Paints = tuple[tuple[int, int, int], ...]
"""How a camera sees each color, 0 to 255, in the order of :class:`Color`."""
