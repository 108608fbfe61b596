"""The report as one HTML page that needs nothing beside it: no file, no network."""

import base64
import importlib
from pathlib import Path

from understudy.errors import MissingExtraError
from understudy.experiments.reports.contents import Report

__all__ = ["page"]

_TEMPLATE = Path(__file__).with_name("page.html")


def page(report: Report) -> str:
    """The whole page.

    Raises:
        MissingExtraError: Jinja is not installed.
    """
    try:
        jinja = importlib.import_module("jinja2")
    except ModuleNotFoundError as error:
        raise MissingExtraError(
            f"the report as a page needs {error.name}, which is not installed; pip install 'understudy[campaign]'"
        ) from None
    environment = jinja.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja.StrictUndefined
    )
    environment.filters["inline"] = lambda png: base64.b64encode(png).decode("ascii")
    template = environment.from_string(_TEMPLATE.read_text(encoding="utf-8"))
    rows = dict.fromkeys(picture.row for picture in report.pictures)
    text: str = template.render(
        report=report,
        document=report.experiment.document,
        galleries=[(row, [picture for picture in report.pictures if picture.row == row]) for row in rows],
    )
    return text
