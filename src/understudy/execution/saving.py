"""A running task put aside: its context as a document, by the paths of its components, and back (semantics §3)."""

import json
from collections.abc import Mapping
from pathlib import Path
from random import Random
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError

from understudy.documents import Part, expect_kind, first_fault, read_data, write_new
from understudy.errors import ContextError, NetworkError
from understudy.execution.context import Context
from understudy.execution.program import Program
from understudy.execution.step import NOTHING
from understudy.execution.trace import State
from understudy.network import Task, differences

__all__ = ["ComponentState", "SavedContext", "load_context"]


class Told(Part):
    """The state that the trace has told last, with its reasons."""

    state: State
    why: dict[str, Any] = {}


class ComponentState(Part):
    """What a context holds of one component; what is usual is left out.

    Attributes:
        effects, achieved, active: the port ``Effects``, the latch, the port ``Active``.
        goes_on: its primitive asserts ``Continue``.
        inhibited_by: the path of the rival that executes.
        skipped, timed_out, active_s: of its timeout: passed over; ran out of time; active for so long.
        called, rung, due_s: of a duty: called now; its condition is true; when it is called next.
        case: of a network in its place that has been begun, the name of its case.
        idle: it has been begun, and no case fits.
        begun_s: of its cases that have been begun, when.
        rounds: how many are complete.
        memory: what its primitive remembers.
        told: by the trace.
    """

    effects: bool = False
    achieved: bool = False
    active: bool = False
    goes_on: bool = False
    inhibited_by: str = ""
    skipped: bool = False
    timed_out: bool = False
    active_s: float | None = None
    called: bool = False
    rung: bool = False
    due_s: float | None = None
    case: str | None = None
    idle: bool = False
    begun_s: dict[str, float] = {}
    rounds: int | None = None
    memory: dict[str, Any] | None = None
    told: Told | None = None


class SavedContext(Part):
    """A context document.

    Attributes:
        understudy: kind and version of the document.
        task: what was executed, written out.
        recording: the file beside this one that holds what the robot sensed and did until then; empty if there is none.
        seed: of all chance in that run; None if nobody knows.
        tick: how many ticks were made.
        time_s: of the last one; None before the first.
        begun_s: when the task was begun.
        executing: the paths of those that executed, in the order in which they took their locks.
        inhibited: the paths of those that are inhibited, in the order in which that came to be.
        taken: where there are alternatives, the paths of those on the way so far, one after the other.
        components: everything else by path; a component of which nothing is to be said is left out.
        wander: what ``Wander`` remembers.
        avoiding: ``Avoid`` overrode the wheels.
        completed: completion was told.
        chance: the state of all chance, as :meth:`random.Random.getstate` gives it.
    """

    understudy: Literal["context/1"] = "context/1"
    task: Task
    recording: Annotated[str, Field(pattern=r"^[^/\\]*$")] = ""
    seed: int | None = None
    tick: Annotated[int, Field(ge=0)]
    time_s: float | None = None
    begun_s: float | None = None
    executing: tuple[str, ...] = ()
    inhibited: tuple[str, ...] = ()
    taken: tuple[str, ...] = ()
    components: dict[str, ComponentState] = {}
    wander: dict[str, Any] = {}
    avoiding: bool = False
    completed: bool = False
    chance: tuple[int, tuple[int, ...], float | None]

    @classmethod
    def of(
        cls, context: Context, program: Program, task: str, *, recording: str = "", seed: int | None = None
    ) -> "SavedContext":
        """The document of a context.

        Args:
            context: after a tick.
            program: that it belongs to.
            task: the task's name.
            recording: the file's name, if there is one.
            seed: of all chance in this run.
        """
        states = {node.id: _state(context, program, node.row) for node in program.nodes}
        version, numbers, gauss = context.random.getstate()
        return cls(
            task=Task.of(task, program.network),
            recording=recording,
            seed=seed,
            tick=context.tick,
            time_s=context.time_s,
            begun_s=context.begun.get(0),
            executing=tuple(program.nodes[row].id for row in context.executing),
            inhibited=tuple(program.nodes[row].id for row in context.inhibited),
            taken=tuple(program.nodes[row].id for _, way in sorted(context.taken.items()) for row in way),
            components={path: state for path, state in states.items() if state != ComponentState()},
            wander=context.wander,
            avoiding=context.avoiding,
            completed=context.completed,
            chance=(version, numbers, gauss),
        )

    def restored(self, program: Program, *, source: str = "") -> Context:
        """The context, for a program of the same definition.

        Args:
            program: that is to go on.
            source: the document's name, for messages.

        Raises:
            ContextError: the program is of another definition, or the document does not fit it; with the difference.
        """
        try:
            saved = self.task.network()
        except NetworkError as error:
            raise ContextError(error.problem, source=source, path=f"task.{error.path}") from None
        told = differences(saved, program.network)
        if told:
            more = f", and {len(told) - 1} more" if len(told) > 1 else ""
            raise ContextError(
                f"it was saved in another task than the one that is to go on: {told[0]}{more}; go on with the task as"
                " it was, or start anew",
                source=source,
            )
        for path in (*self.components, *self.executing, *self.inhibited, *self.taken):
            if path not in program.rows:
                raise ContextError(f"no component of the task is called {path!r}", source=source, path="components")
        _check_way(self.taken, program, source)
        return self._onto(program, source)

    def carried_over(self, program: Program) -> Context:
        """The context for a program of another definition: what both have goes on; what is new has no past.

        Args:
            program: that is to go on, of a task that was edited in the middle of its run.
        """
        rows = program.rows
        kept = self.model_copy(
            update={
                "components": {path: state for path, state in self.components.items() if path in rows},
                "executing": tuple(path for path in self.executing if path in rows),
                "inhibited": tuple(
                    path for path in self.inhibited if path in rows and self.components[path].inhibited_by in rows
                ),
                "taken": tuple(path for path in self.taken if path in rows),
                "completed": False,
            }
        )
        return kept._onto(program, "")

    def _onto(self, program: Program, source: str) -> Context:
        rows = program.rows
        context = Context.start(program)
        context.tick, context.time_s = self.tick, self.time_s
        if self.begun_s is not None:
            context.begun[0] = self.begun_s
        context.executing = tuple(rows[path] for path in self.executing)
        context.wander, context.avoiding, context.completed = self.wander, self.avoiding, self.completed
        context.random = _chance(self.chance, source)
        for path, state in self.components.items():
            _restore(context, program, rows[path], state, source)
        for path in self.taken:
            scope = program.scopes[program.nodes[rows[path]].scope]
            if scope.ways is not None and rows[path] in scope.ways.ids:
                context.taken[scope.number] = (*context.taken.get(scope.number, ()), rows[path])
        for path in self.inhibited:
            by = self.components.get(path, ComponentState()).inhibited_by
            if by not in rows:
                raise ContextError(f"{path!r} is inhibited by {by!r}, which is not there", source=source)
            context.inhibited[rows[path]] = rows[by]
        context.active = frozenset(rows[path] for path, state in self.components.items() if state.active)
        context.keep_on = frozenset(rows[path] for path, state in self.components.items() if state.goes_on)
        return context

    def save(self, path: Path) -> None:
        """Writes the document; nothing is overwritten.

        Raises:
            ContextError: the file exists, or cannot be written.
        """
        data = {"understudy": self.understudy, **self.model_dump(by_alias=True, exclude_defaults=True)}
        try:
            text = json.dumps(data, indent=1)
        except TypeError as error:
            raise ContextError(
                f"a skill remembers something that is no plain data: {error}", source=str(path)
            ) from None
        write_new(path, text + "\n", ContextError)


def load_context(path: str | Path) -> SavedContext:
    """A context from a file.

    Raises:
        ContextError: the file cannot be read, or is no context document.
    """
    data = read_data(path, ContextError)
    expect_kind(data, "context/1", source=str(path), kind=ContextError)
    try:
        return SavedContext.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, str(path), ContextError) from None


def _state(context: Context, program: Program, row: int) -> ComponentState:
    node = program.nodes[row]
    chosen = context.chosen.get(row)
    names = {number: program.scopes[number].name for number in node.scopes}
    told = context.told.get(row)
    return ComponentState(
        effects=context.effects[row],
        achieved=context.achieved[row],
        active=row in context.active,
        goes_on=row in context.keep_on,
        inhibited_by=program.nodes[context.inhibited[row]].id if row in context.inhibited else "",
        skipped=row in context.skipped,
        timed_out=row in context.timed_out,
        active_s=context.active_s.get(row),
        called=row in context.called,
        rung=row in context.rung,
        due_s=context.due_s.get(row),
        case=names[chosen] if chosen is not None and chosen != NOTHING else None,
        idle=chosen == NOTHING,
        begun_s={name: context.begun[number] for number, name in names.items() if number in context.begun},
        rounds=context.rounds.get(row),
        memory=context.memories.get(row),
        told=Told(state=told[0], why=told[1]) if told is not None else None,
    )


def _restore(context: Context, program: Program, row: int, state: ComponentState, source: str) -> None:
    context.effects[row], context.achieved[row] = state.effects, state.achieved
    flags = (
        (state.skipped, context.skipped),
        (state.timed_out, context.timed_out),
        (state.called, context.called),
        (state.rung, context.rung),
    )
    for so, rows in flags:
        if so:
            rows.add(row)
    values: tuple[tuple[Any, dict[int, Any]], ...] = (
        (state.active_s, context.active_s),
        (state.due_s, context.due_s),
        (state.rounds, context.rounds),
        (state.memory, context.memories),
        ((state.told.state, state.told.why) if state.told is not None else None, context.told),
    )
    for value, by_row in values:
        if value is not None:
            by_row[row] = value
    scopes: Mapping[str, int] = {program.scopes[number].name: number for number in program.nodes[row].scopes}
    for name in (*state.begun_s, *([state.case] if state.case is not None else [])):
        if name not in scopes:
            path = f"components.{program.nodes[row].id}"
            raise ContextError(
                f"it has no case {name!r}; it has: {', '.join(scopes) or 'none'}", source=source, path=path
            )
    if state.case is not None or state.idle:
        context.chosen[row] = NOTHING if state.case is None else scopes[state.case]
    for name, begun_s in state.begun_s.items():
        context.begun[scopes[name]] = begun_s


def _check_way(taken: tuple[str, ...], program: Program, source: str) -> None:
    """Refuses a way through a network that is none. One that was taken before an edit need not be one any more."""
    ways: dict[int, tuple[int, ...]] = {}
    for row in (program.rows[path] for path in taken):
        scope = program.scopes[program.nodes[row].scope]
        before = ways.get(scope.number, ())
        if scope.ways is None or row not in scope.ways.candidates(before):
            last = program.nodes[before[-1]].id if before else "START"
            raise ContextError(f"no way leads from {last} to {program.nodes[row].id}", source=source, path="taken")
        ways[scope.number] = (*before, row)


def _chance(state: tuple[int, tuple[int, ...], float | None], source: str) -> Random:
    random = Random()
    try:
        random.setstate(state)
    except (TypeError, ValueError) as error:
        raise ContextError(f"this is no state of chance: {error}", source=source, path="chance") from None
    return random
