"""Networks as definitions: what is refused, and what follows from the links."""

import networkx as nx  # type: ignore[import-untyped]  # ships no type information
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.execution.strategies import networks
from understudy.errors import NetworkError
from understudy.network import Component, Link, LinkType, Network


def chain(*ids: str) -> tuple[Component, ...]:
    return tuple(Component(id=id_, behavior="Track") for id_ in ids)


def link(source: str, target: str) -> Link:
    return Link(source=source, target=target, type=LinkType.ORDERING)


@pytest.mark.parametrize(
    ("components", "links", "inhibitions", "path", "message"),
    [
        (chain("a", "a"), (), (), "components[1].id", "'a' is used twice"),
        (chain("a"), (link("a", "b"),), (), "links[0].to", "no component is called 'b'; there are: a"),
        (chain("a"), (link("b", "a"),), (), "links[0].from", "no component is called 'b'"),
        (chain("a"), (link("a", "a"),), (), "links[0]", "linked to itself"),
        (chain("a", "b"), (link("a", "b"), link("a", "b")), (), "links[1]", "a second link"),
        (chain("a", "b"), (), (("a", "x"),), "inhibitions[0].to", "no component is called 'x'"),
    ],
)
def test_what_is_no_network(
    components: tuple[Component, ...],
    links: tuple[Link, ...],
    inhibitions: tuple[tuple[str, str], ...],
    path: str,
    message: str,
) -> None:
    with pytest.raises(NetworkError) as caught:
        Network(components, links, inhibitions)
    assert caught.value.path == path
    assert message in caught.value.problem


def test_a_circle_is_named() -> None:
    with pytest.raises(NetworkError, match=r"in a circle: .*a.*; take one of them out"):
        Network(chain("a", "b", "c"), (link("a", "b"), link("b", "c"), link("c", "a")))


@given(networks())
def test_the_topological_order_is_the_first_one_in_document_order(network: Network) -> None:
    graph = nx.DiGraph([(link.source, link.target) for link in network.links])
    graph.add_nodes_from(component.id for component in network.components)
    rank = {component.id: index for index, component in enumerate(network.components)}
    expected = list(nx.lexicographical_topological_sort(graph, key=rank.__getitem__))
    assert list(network.topological_order) == expected
    assert set(network.sinks) == {id_ for id_ in graph if graph.out_degree(id_) == 0}


@given(st.integers(2, 60))
def test_wide_networks_sort_in_document_order(count: int) -> None:
    network = Network(chain(*map(str, range(count))))
    assert network.topological_order == tuple(map(str, range(count)))
    assert network.sinks == network.topological_order


def test_link_types_go_from_the_least_to_the_most_restrictive() -> None:
    assert [type_.strength for type_ in (LinkType.ORDERING, LinkType.ENABLING, LinkType.PERMANENT)] == [0, 1, 2]
