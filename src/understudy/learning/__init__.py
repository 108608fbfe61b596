"""Learning a task from one demonstration (§4): observed intervals become a behavior network.

On-line, an :class:`Observer` watches the goals of the skills. Off-line, :func:`learn` leaves out what does not belong
to the task and reads the links from the relations of the intervals (Table 4.1). A plain document of intervals comes in
by :func:`load_intervals`.
"""

from understudy.learning.allen import HALF_A_TICK_S, TABLE_4_1, Relation, relation
from understudy.learning.apprentice import Apprentice, demonstrate, evaluate, observe
from understudy.learning.construction import construct
from understudy.learning.documents import IntervalsDocument, intervals_schema, load_intervals, parse_intervals
from understudy.learning.learner import Lesson, learn
from understudy.learning.observations import Demonstration, History, Instance, Observed
from understudy.learning.observer import Observer
from understudy.learning.remarks import Remarks
from understudy.learning.selection import Dropped, Selection, select
from understudy.learning.settings import DISTANCE, LearningSettings

__all__ = [
    "DISTANCE",
    "HALF_A_TICK_S",
    "TABLE_4_1",
    "Apprentice",
    "Demonstration",
    "Dropped",
    "History",
    "Instance",
    "IntervalsDocument",
    "LearningSettings",
    "Lesson",
    "Observed",
    "Observer",
    "Relation",
    "Remarks",
    "Selection",
    "construct",
    "demonstrate",
    "evaluate",
    "intervals_schema",
    "learn",
    "load_intervals",
    "observe",
    "parse_intervals",
    "relation",
    "select",
]
