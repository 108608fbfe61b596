"""One calm look for all pictures: ink, greys, the eight paints, type sizes, and how wide a text is."""

from functools import cache

from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.textpath import text_to_path

from understudy.robot import RGB, Color

__all__ = [
    "BODY",
    "CAP_HEIGHT",
    "FAINT",
    "FAMILY",
    "FLOOR",
    "HAIR",
    "INK",
    "MUTED",
    "PAPER",
    "SMALL",
    "SOFT",
    "TITLE",
    "blend",
    "contrast",
    "drawable",
    "edge",
    "elide",
    "paint",
    "text_width",
    "wrap",
]

INK = "#20252c"
MUTED = "#5d6673"
"""Small print; 5.8 : 1 on white."""
FAINT = "#a9b1bd"
SOFT = "#d9dee5"
HAIR = "#e9ecf0"
FLOOR = "#f7f7f4"
PAPER = "#ffffff"

TITLE = 12.0
BODY = 9.0
SMALL = 7.5

FAMILY = "DejaVu Sans"
"""Comes with Matplotlib, so that a picture looks the same everywhere."""

CAP_HEIGHT = 0.73
"""Of the family, in parts of the type size."""

_EDGE_CONTRAST = 3.0
"""What the edge of a shape needs against white to be seen (WCAG 2.1, 1.4.11)."""


def paint(color: str) -> str:
    """A trained color's paint as ``#rrggbb``; any other text is returned as it is, for Matplotlib to understand."""
    return _hex(RGB[Color(color)]) if color in tuple(Color) else color


def edge(color: str) -> str:
    """The same hue, as dark as an outline on white has to be."""
    dark = paint(color)
    while contrast(dark, PAPER) < _EDGE_CONTRAST:
        dark = blend(dark, "#000000", 0.1)
    return blend(dark, "#000000", 0.15)


def blend(one: str, other: str, part: float) -> str:
    """``one`` with the given part of ``other`` mixed in, without transparency: lines may then cross themselves."""
    pairs = zip(_rgb(one), _rgb(other), strict=True)
    return _hex(tuple(round((1 - part) * a + part * b) for a, b in pairs))


def contrast(one: str, other: str) -> float:
    """The contrast ratio of two colors, 1 to 21 (WCAG 2.1)."""
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def drawable(text: str) -> str:
    """The text with a box for every letter that the family does not have, instead of a warning for each."""
    return "".join(letter if ord(letter) in _letters() else "□" for letter in text)


@cache
def _letters() -> frozenset[int]:
    return frozenset(get_font(findfont(FontProperties(family=FAMILY))).get_charmap())


@cache
def text_width(text: str, size: float, weight: str = "normal") -> float:
    """How wide a line of text is, in points."""
    font = FontProperties(family=FAMILY, size=size, weight=weight)
    width, _, _ = text_to_path.get_text_width_height_descent(drawable(text), font, False)
    return float(width)


def wrap(text: str, width: float, size: float, weight: str = "normal", lines: int = 3) -> tuple[str, ...]:
    """A text in lines of at most so many points; what does not fit into the last one is elided."""
    done: list[str] = []
    words = text.split()
    while words:
        count = 1
        while count < len(words) and text_width(" ".join(words[: count + 1]), size, weight) <= width:
            count += 1
        if len(done) == lines - 1:
            count = len(words)
        done.append(elide(" ".join(words[:count]), width, size, weight))
        words = words[count:]
    return tuple(done)


def elide(text: str, width: float, size: float, weight: str = "normal") -> str:
    """The text, or as much of it as fits with an ellipsis."""
    text = " ".join(text.split())
    if text_width(text, size, weight) <= width:
        return text
    while text and text_width(text + "…", size, weight) > width:
        text = text[:-1].rstrip()
    return text + "…"


def _rgb(color: str) -> tuple[int, int, int]:
    red, green, blue = to_rgb(color)
    return round(255 * red), round(255 * green), round(255 * blue)


def _hex(rgb: tuple[int, ...]) -> str:
    return "#" + "".join(f"{part:02x}" for part in rgb)


def _luminance(color: str) -> float:
    parts = [part / 255 for part in _rgb(color)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
