"""The flat network that is to behave as a hierarchy does, executed beside it."""

from collections.abc import Collection

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from understudy.errors import NetworkError
from understudy.execution import Activation, Context
from understudy.network import Component, Nab, Network, expand_links, flattened

from .reference import Behaviors
from .strategies import KINDS, networks
from .support import compiled

FREE: Behaviors = {kind: (frozenset[str](), False) for kind in KINDS}
"""Nobody locks anything: the order of locks counts the steps of a network singly in the flat one only."""


@st.composite
def plain_hierarchies(draw: st.DrawFn, depth: int = 2) -> Network:
    """Networks in networks that are executed always and once, without rivals."""
    around = draw(networks(max_components=4 if depth == 2 else 3))
    components: list[Component | Nab] = []
    for component in around.components:
        if depth and draw(st.booleans()):
            components.append(Nab.of(component.id, draw(plain_hierarchies(depth - 1))))
        else:
            components.append(component)
    return Network(tuple(components), around.links)


Settled = tuple[set[str], set[str], bool]


class Executed:
    """A network that is executed, with every world staying as it is until nothing changes any more."""

    def __init__(self, network: Network, still: int) -> None:
        self.program = compiled(network, FREE)
        self.context = Context.start(self.program)
        self.activation = Activation(self.program, self.context)
        self.names = {node.row: node.id.replace("/", ".") for node in self.program.nodes if node.skill is not None}
        self.still = still

    def settle(self, holding: Collection[str]) -> Settled:
        """Which behaviors are achieved and active, and whether all is done, after a while with these goals true."""
        effects = [self.names.get(node.row) in holding for node in self.program.nodes]
        for _ in range(self.still):
            step = self.activation.decide(effects, lambda row: True)
            self.activation.commit(step)
        achieved = {name for row, name in self.names.items() if self.context.achieved[row]}
        active = {name for row, name in self.names.items() if row in self.context.active}
        return achieved, active, step.complete


@settings(max_examples=300)
@given(st.data(), plain_hierarchies())
def test_the_flat_network_behaves_as_the_hierarchy(data: st.DataObject, hierarchy: Network) -> None:
    try:
        flat = flattened(hierarchy)
    except NetworkError:
        assume(False)  # an enabling link that has no flat equivalent
    ids = [component.id for component in flat.components]
    still = 2 + 2 * sum(isinstance(part, Nab) for _, part in hierarchy.walk())
    runs = [Executed(network, still) for network in (hierarchy, flat, expand_links(flat))]
    holding = data.draw(st.frozensets(st.sampled_from(ids), max_size=2), label="true from the beginning")
    for _ in range(3 * len(ids)):
        expected, *others = [run.settle(holding) for run in runs]
        assert others == [expected, expected]
        # One goal changes: mostly one comes true for which something is being done; sometimes any ceases to be.
        changes = sorted(expected[1] - holding) if data.draw(st.integers(0, 2)) else sorted(holding)
        holding ^= {data.draw(st.sampled_from(changes or ids))}
