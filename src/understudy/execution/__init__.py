"""Running a network: the compiled program, the context, the tick, the trace."""

from understudy.execution.activation import Activation
from understudy.execution.causes import Cause
from understudy.execution.conditions import Outside
from understudy.execution.context import Context
from understudy.execution.controller import Controller, Decision
from understudy.execution.explanation import Explanation, Missing, explain
from understudy.execution.history import History, StateChange
from understudy.execution.ports import Ports
from understudy.execution.program import Arc, Node, Program, compile_network
from understudy.execution.run import RunReport, go_on, run_network
from understudy.execution.saving import ComponentState, SavedContext, load_context
from understudy.execution.step import Step
from understudy.execution.tally import Tally
from understudy.execution.trace import Event, State

__all__ = [
    "Activation",
    "Arc",
    "Cause",
    "ComponentState",
    "Context",
    "Controller",
    "Decision",
    "Event",
    "Explanation",
    "History",
    "Missing",
    "Node",
    "Outside",
    "Ports",
    "Program",
    "RunReport",
    "SavedContext",
    "State",
    "StateChange",
    "Step",
    "Tally",
    "compile_network",
    "explain",
    "go_on",
    "load_context",
    "run_network",
]
