"""The report as Markdown, for a page among others; its pictures lie in a folder beside it."""

from collections.abc import Iterator

from understudy.experiments.reports.contents import Report

__all__ = ["PICTURES", "markdown"]

HOW_IT_IS_COUNTED = (
    "A success is one by all criteria of §4.5.3; the intervals are exact (Clopper-Pearson). Times and contacts are"
    " those of all trials, the failed ones among them; a collision makes a failure, a graze is a short, soft contact."
)

PICTURES = "pictures"
"""The folder."""


def markdown(report: Report) -> str:
    """The whole page."""
    return "\n".join(_lines(report)) + "\n"


def _lines(report: Report) -> Iterator[str]:
    document = report.experiment.document
    yield f"# {document.title or document.name}" + (f" ({document.source})" if document.source else "")
    yield ""
    yield f"{report.standing}."
    if document.note:
        yield from ("", document.note)
    yield from ("", *report.rows.markdown(), "")
    yield HOW_IT_IS_COUNTED
    for line in report.missed:
        yield from ("", f"Below its goal: {line}.")
    yield from ("", "## Failures", "")
    for failure in report.failures:
        yield f"- {failure.trial}: {'; '.join(failure.problems)}"
        yield f"  - again: `{failure.again}`"
        for name in failure.recordings:
            yield f"  - recorded: [{name}]({name})"
    if not report.failures:
        yield "None."
    for table in report.tables:
        yield from ("", f"## {table.title}", "", *table.markdown())
    rows = list(dict.fromkeys(picture.row for picture in report.pictures))
    for row in rows:
        yield from ("", f"## {row}")
        for picture in report.pictures:
            if picture.row == row:
                yield from ("", f"![{picture.caption}]({PICTURES}/{picture.name}.png)", "", f"{picture.caption}.")
    yield from ("", f"Made by {report.program}.")
