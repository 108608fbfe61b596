"""Running a network: the compiled program, the context, the tick, the trace."""

from understudy.execution.activation import Activation, Step
from understudy.execution.conditions import Outside
from understudy.execution.context import Context
from understudy.execution.controller import Controller, Decision
from understudy.execution.ports import Ports
from understudy.execution.program import Arc, Node, Program, compile_network
from understudy.execution.run import RunReport, run_network
from understudy.execution.trace import Event, State

__all__ = [
    "Activation",
    "Arc",
    "Context",
    "Controller",
    "Decision",
    "Event",
    "Node",
    "Outside",
    "Ports",
    "Program",
    "RunReport",
    "State",
    "Step",
    "compile_network",
    "run_network",
]
