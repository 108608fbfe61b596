"""What came out of a campaign, for a reader."""

from understudy.experiments.reports.contents import Failure, Report, report_of
from understudy.experiments.reports.markdown import markdown
from understudy.experiments.reports.page import page
from understudy.experiments.reports.pictures import Picture
from understudy.experiments.reports.rows import missed_goals, rows_table
from understudy.experiments.reports.writing import write_markdown, write_page

__all__ = [
    "Failure",
    "Picture",
    "Report",
    "markdown",
    "missed_goals",
    "page",
    "report_of",
    "rows_table",
    "write_markdown",
    "write_page",
]
