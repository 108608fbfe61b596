"""Pictures on disk: a PNG to look at and an SVG to print, the same bytes for the same picture, nothing overwritten."""

from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from understudy.errors import UnderstudyError
from understudy.figures.sheet import DPI
from understudy.figures.style import drawable

__all__ = ["save"]

# No date, no versions; and the ids inside an SVG, random by default, from a fixed salt.
_METADATA: dict[str, dict[str, None]] = {"png": {"Software": None}, "svg": {"Date": None, "Creator": None}}
_SETTINGS: Any = {"svg.hashsalt": "understudy", "svg.fonttype": "path", "savefig.bbox": None, "savefig.pad_inches": 0.0}


def save(figure: Figure, path: str | Path) -> list[Path]:
    """Write a picture as PNG and as SVG.

    Args:
        figure: from any of this room's ``draw`` functions.
        path: without a suffix; ``pictures/fetch`` becomes ``pictures/fetch.png`` and ``pictures/fetch.svg``.
            Folders that are missing are made.

    Returns:
        Both files.

    Raises:
        UnderstudyError: one of them exists already, or cannot be written.
    """
    path = Path(path)
    files = [path.with_name(f"{path.name}.{kind}") for kind in _METADATA]
    for file in files:
        if file.exists():
            raise _exists(file)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UnderstudyError(f"{path.parent}: this is no folder to write to: {error.strerror}; name another") from None
    for file, (kind, metadata) in zip(files, _METADATA.items(), strict=True):
        try:
            with file.open("xb") as stream, rc_context(_SETTINGS):
                figure.savefig(stream, format=kind, dpi=DPI, metadata=metadata | _title(figure, kind))
        except FileExistsError:
            raise _exists(file) from None
        except OSError as error:
            raise UnderstudyError(f"{file}: the picture cannot be written: {error.strerror}; name another") from None
    return files


def _title(figure: Figure, kind: str) -> dict[str, str]:
    """What a reader of the picture is told aloud, or shown under the pointer; PNG files have no place for it."""
    title = str(figure.get_label())
    return {"Title": drawable(title)} if title and kind == "svg" else {}


def _exists(file: Path) -> UnderstudyError:
    return UnderstudyError(f"{file}: this picture exists already, and nothing is overwritten; name another")
