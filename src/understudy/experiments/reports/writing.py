"""A report in the folder of its campaign, in the place of the one before."""

import os
from pathlib import Path

from understudy.errors import CampaignError, MissingExtraError
from understudy.experiments.campaign import Campaign
from understudy.experiments.reports.contents import report_of
from understudy.experiments.reports.markdown import PICTURES, markdown
from understudy.experiments.reports.page import page

__all__ = ["write_report"]


def write_report(campaign: Campaign) -> list[Path]:
    """Writes ``report.md`` with its pictures, and ``report.html`` if Jinja is installed.

    Raises:
        CampaignError: a file cannot be written.
    """
    report = report_of(campaign)
    folder = campaign.folder
    written = {folder / PICTURES / f"{picture.name}.png": picture.png for picture in report.pictures}
    pages = {folder / "report.md": markdown(report).encode()}
    try:
        pages[folder / "report.html"] = page(report).encode()
    except MissingExtraError as error:
        campaign.notes.append(str(error))
    for path, content in (written | pages).items():
        _replace(path, content)
    for old in set((folder / PICTURES).glob("*.png")) - written.keys():
        old.unlink()
    return list(pages)


def _replace(path: Path, content: bytes) -> None:
    """All of it or nothing: whoever has the page open never meets half of one."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_bytes(content)
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise CampaignError(f"{path} cannot be written: {error.strerror}; the trials are kept") from None
