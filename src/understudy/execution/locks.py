"""Who of the active behaviors executes: the locks of step 5 (semantics §3)."""

from collections.abc import Callable, Iterator

from understudy.execution.context import Context
from understudy.execution.links import Links
from understudy.execution.program import Program
from understudy.execution.step import Step

__all__ = ["Locks"]


class Locks:
    """Gives the actuators to the active behaviors, one after the other.

    Args:
        program: the compiled network.
        context: its run-time state.
        links: derived from the same context.

    Attributes:
        asked: the rows that were asked for their world precondition in the last tick, since their actuators were free.
    """

    def __init__(self, program: Program, context: Context, links: Links) -> None:
        self.program = program
        self.context = context
        self.links = links
        self.asked: frozenset[int] = frozenset()
        self._actuators = frozenset(actuator for node in program.nodes for actuator in node.actuators)
        self._owners: dict[str, int] = {}
        self._parts: tuple[list[int], ...] = ()
        self._part_of: dict[int, int] = {}

    def give(
        self, active: frozenset[int], precondition: Callable[[int], bool]
    ) -> tuple[tuple[int, ...], dict[str, int]]:
        """Who executes, in the order of the turns, and who holds each actuator.

        Duties come first; then who executed before; then the higher level; then document order. A maintaining behavior
        that is kept going for its successors takes only what all others leave free. Nobody is asked for its
        precondition whose actuators are another's.

        Args:
            active: the rows that are active in this tick.
            precondition: whether the world precondition of a row holds now.
        """
        context, nodes, touched = self.context, self.program.nodes, self.links.touched
        owners: dict[str, int] = {}
        executing: list[int] = []
        asked: list[int] = []
        for row in self._turns(active):
            actuators = nodes[row].actuators
            if actuators:
                if len(owners) == len(self._actuators):
                    break
                if any(actuator in owners for actuator in actuators):
                    continue
            asked.append(row)
            if row not in context.keep_on and not precondition(row):
                continue
            for actuator in actuators:
                owners[actuator] = row
            executing.append(row)
        now_asked = frozenset(asked)
        touched |= now_asked
        touched |= self.asked - now_asked
        if owners != self._owners:
            touched |= active
        self.asked, self._owners = now_asked, owners
        return tuple(executing), owners

    def owner_at(self, row: int, step: Step) -> int | None:
        """Who held an actuator that an active behavior needs, at its turn; None if nobody else did.

        Of several owners the one that took its locks first: others may have taken theirs after the behavior's turn.
        """
        owners = {step.owners.get(actuator) for actuator in self.program.nodes[row].actuators}
        return next((owner for owner in step.executing if owner in owners and owner != row), None)

    def _turns(self, active: frozenset[int]) -> Iterator[int]:
        """The active behaviors in the order in which they take their locks; those without actuators first."""
        context, nodes = self.context, self.program.nodes
        if self.links.turns_stale or active is not context.active:
            parts: tuple[list[int], ...] = ([], [], [], [])
            for row in active:
                node = nodes[row]
                if node.scopes:
                    continue
                yields = node.maintaining and context.achieved[row]
                parts[0 if not node.actuators else 1 if self._on_duty(row) else 3 if yields else 2].append(row)
            self._parts = tuple(sorted(part, key=self._turn) for part in parts)
            self._part_of = {row: number for number, part in enumerate(parts) for row in part}
            self.links.turns_stale = False
        before = [row for row in context.executing if row in active]
        for number, part in enumerate(self._parts):
            yield from sorted((row for row in before if self._part_of[row] == number), key=self._turn)
            for row in part:
                if row not in before:
                    yield row

    def _turn(self, row: int) -> tuple[int, int]:
        return -self.links.full_level(row), row

    def _on_duty(self, row: int) -> bool:
        nodes = self.program.nodes
        if not self.program.duties:
            return False
        return any(nodes[one].trigger is not None for one in (row, *self.program.ancestors(row)))
