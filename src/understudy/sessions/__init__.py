"""What a person does in one sitting: a demonstration taught, a task run, in a simulated room, recorded and judged."""

from understudy.sessions.recorded import task_of, world_of
from understudy.sessions.running import Performed, perform
from understudy.sessions.stage import Stage, Verdict
from understudy.sessions.teaching import Taught, recorded_demonstration, teach
from understudy.sessions.workspace import Workspace, file_stem

__all__ = [
    "Performed",
    "Stage",
    "Taught",
    "Verdict",
    "Workspace",
    "file_stem",
    "perform",
    "recorded_demonstration",
    "task_of",
    "teach",
    "world_of",
]
