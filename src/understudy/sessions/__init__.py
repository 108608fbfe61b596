"""What a person does in one sitting: a demonstration taught, a task run, in a simulated room, recorded and judged."""

from understudy.sessions.capability import Capability, capabilities, check_capable, unbound
from understudy.sessions.onboard import await_start, perform_with, practise_with, teach_with
from understudy.sessions.passing_on import PassedOn, pass_on, with_robot_teacher
from understudy.sessions.past import Past, past_at, take_up
from understudy.sessions.practising import Practised, practise
from understudy.sessions.recorded import limit_of, seed_of, spec_of, task_of, world_of
from understudy.sessions.running import Performed, perform
from understudy.sessions.stage import Stage, Verdict
from understudy.sessions.teaching import Taught, recorded_demonstration, teach
from understudy.sessions.whatif import Divergence, WhatIf, what_if
from understudy.sessions.workspace import Workspace, file_stem

__all__ = [
    "Capability",
    "Divergence",
    "PassedOn",
    "Past",
    "Performed",
    "Practised",
    "Stage",
    "Taught",
    "Verdict",
    "WhatIf",
    "Workspace",
    "await_start",
    "capabilities",
    "check_capable",
    "file_stem",
    "limit_of",
    "pass_on",
    "past_at",
    "perform",
    "perform_with",
    "practise",
    "practise_with",
    "recorded_demonstration",
    "seed_of",
    "spec_of",
    "take_up",
    "task_of",
    "teach",
    "teach_with",
    "unbound",
    "what_if",
    "with_robot_teacher",
    "world_of",
]
