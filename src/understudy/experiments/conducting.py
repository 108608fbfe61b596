"""Making one trial."""

from understudy.errors import MissingExtraError, UnderstudyError
from understudy.experiments.kinds import KINDS
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit

__all__ = ["conduct"]


def conduct(unit: Unit) -> Trial:
    """Makes a trial. An error that a user can meet makes a failed one.

    Raises:
        MissingExtraError: an optional package is not installed; that says nothing of the robot.
    """
    try:
        return KINDS[unit.row.kind].trial(unit)
    except MissingExtraError:
        raise
    except UnderstudyError as error:
        return unit.trial(ending="error", problems=(str(error),))
