"""A report in the folder of its campaign, in the place of the one before."""

import os
from contextlib import suppress
from pathlib import Path

from understudy.errors import CampaignError
from understudy.experiments.reports.contents import Report
from understudy.experiments.reports.markdown import PICTURES, markdown
from understudy.experiments.reports.page import page

__all__ = ["write_markdown", "write_page"]


def write_markdown(report: Report, folder: Path) -> Path:
    """Writes ``report.md``, and its pictures beside it; those of an earlier report are taken away.

    Raises:
        CampaignError: a file cannot be written.
    """
    pictures = {folder / PICTURES / f"{picture.name}.png": picture.png for picture in report.pictures}
    for path, content in pictures.items():
        _replace(path, content)
    for old in set((folder / PICTURES).glob("*.png")) - pictures.keys():
        old.unlink()
    return _replace(folder / "report.md", markdown(report).encode())


def write_page(report: Report, folder: Path) -> Path:
    """Writes ``report.html``, with everything in it.

    Raises:
        CampaignError: it cannot be written.
        MissingExtraError: Jinja is not installed.
    """
    return _replace(folder / "report.html", page(report).encode())


def _replace(path: Path, content: bytes) -> Path:
    """All of it or nothing: whoever has the page open never meets half of one."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_bytes(content)
        return part.replace(path)
    except OSError as error:
        with suppress(OSError):
            part.unlink()
        raise CampaignError(f"{path} cannot be written: {error.strerror}; the trials are kept") from None
