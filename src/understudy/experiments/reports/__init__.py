"""What came out of a campaign, for a reader."""

from understudy.experiments.reports.rows import missed_goals, rows_table

__all__ = ["missed_goals", "rows_table"]
