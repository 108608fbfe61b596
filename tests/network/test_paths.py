"""Alternatives: the ways through a network, in the definition and in documents."""

from dataclasses import replace
from typing import Any

import pytest
import yaml

from understudy.errors import NetworkError
from understudy.network import (
    END,
    START,
    Component,
    Edge,
    LinkType,
    Network,
    Task,
    differences,
    expand_links,
    load_task,
    parse_task,
    reduce_links,
    save_task,
    task_text,
)

DOCUMENT = """
understudy: task/1
name: visit one, then the other
components:
  - {id: a, behavior: A}
  - {id: b, behavior: B}
  - {id: c, behavior: C}
  - {id: d, behavior: D}
links:
  - {from: a, to: d, type: permanent}
paths:
  - {from: START, to: a, shown: [first]}
  - {from: START, to: b, shown: [second]}
  - {from: a, to: c, shown: [first]}
  - {from: b, to: d, shown: [second]}
  - {from: c, to: d, shown: [first]}
  - {from: a, to: d}
  - {from: d, to: END, shown: [first, second]}
"""


def data() -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(DOCUMENT)
    return found


def test_a_document_tells_the_ways() -> None:
    _, network = parse_task(data())
    topology = network.topology
    assert topology.ids == ("a", "b", "c", "d")
    assert topology.candidates == {START: ("a", "b"), "a": ("d",), "b": ("d",), "c": ("d",), "d": (END,), END: ()}
    assert topology.bypassed == ("c",)
    assert topology.demonstrations == ("first", "second")
    assert topology.shown_by["d"] == ("first", "second")
    assert topology.bypassed_by("b") == ("first",)
    assert network.sinks == ("d",)


def test_what_may_follow_is_told_by_all_paths_and_by_those_that_are_taken() -> None:
    topology = parse_task(data())[1].topology
    assert topology.leads("a", "c")
    assert not topology.goes("a", "c")
    assert topology.goes("c", "d")
    assert topology.leads(START, END)
    assert not topology.leads("a", "b")


def test_a_document_is_written_as_it_was_read(tmp_path: Any) -> None:
    task, network = parse_task(data())
    assert Task.of(task.name, network) == task
    assert yaml.safe_load(task_text(task)) == data()
    save_task(tmp_path / "task.json", task)
    assert load_task(tmp_path / "task.json") == (task, network)


def test_a_document_without_alternatives_says_nothing_of_paths() -> None:
    text = task_text(Task.of("plain", Network((Component(id="a", behavior="A"),))))
    assert "paths" not in text


def test_the_ways_of_a_plain_network_are_its_topological_form() -> None:
    plain = data()
    plain.pop("paths")
    topology = parse_task(plain)[1].topology
    assert topology.is_chain
    assert topology.ids == ("a", "b", "c", "d")


def test_the_ways_imply_every_order() -> None:
    _, network = parse_task(data())
    pairs = {(link.source, link.target): link.type for link in expand_links(network).links}
    assert pairs.keys() == {("a", "c"), ("a", "d"), ("b", "d"), ("c", "d")}
    assert pairs["a", "d"] is LinkType.PERMANENT
    assert reduce_links(expand_links(network)).links == network.links


@pytest.mark.parametrize(
    ("change", "place", "reason"),
    [
        ({"from": "a", "to": "e"}, r"paths\[7\].to", "no component is called 'e'"),
        ({"from": "e", "to": "a"}, r"paths\[7\].from", "no component is called 'e'"),
        ({"from": "a", "to": "START"}, r"paths\[7\].to", "leads back to START"),
        ({"from": "END", "to": "a"}, r"paths\[7\].from", "leads on from END"),
        ({"from": "a", "to": "c"}, r"paths\[7\]", "a second step"),
        ({"from": "START", "to": "END"}, r"paths\[7\]", "past every step"),
        ({"from": "d", "to": "a"}, "paths", "in a circle"),
        ({"from": "a", "to": "a"}, "paths", "in a circle"),
        ({"from": "a", "too": "d"}, r"paths\[7\].too", "unknown key"),
    ],
)
def test_a_step_that_is_none_is_refused(change: dict[str, str], place: str, reason: str) -> None:
    wrong = data()
    wrong["paths"].append(change)
    with pytest.raises(NetworkError, match=f"^t.yaml: {place}: .*{reason}"):
        parse_task(wrong, source="t.yaml")


def test_a_component_on_no_way_is_refused() -> None:
    wrong = data()
    wrong["components"].append({"id": "e", "behavior": "E"})
    with pytest.raises(NetworkError, match=r"components\[4\].id: no path from START to END leads through 'e'"):
        parse_task(wrong)
    wrong["paths"].append({"from": "a", "to": "e"})
    with pytest.raises(NetworkError, match=r"components\[4\].id"):
        parse_task(wrong)


def test_a_link_that_nobody_would_ask_for_is_refused() -> None:
    wrong = data()
    wrong["links"].append({"from": "a", "to": "b", "type": "ordering"})
    with pytest.raises(NetworkError, match=r"links\[1\]: no path leads from 'a' to 'b'"):
        parse_task(wrong)


def test_duties_stand_beside_the_ways() -> None:
    beside = data()
    beside["components"].append({"id": "e", "behavior": "E", "trigger": {"every": 5}})
    assert parse_task(beside)[1].topology.ids == ("a", "b", "c", "d")
    through = data() | {"components": beside["components"]}
    through["paths"] = [*data()["paths"], {"from": "a", "to": "e"}]
    with pytest.raises(NetworkError, match=r"paths\[7\].to: 'e' is a duty"):
        parse_task(through)
    waiting = data() | {"components": beside["components"]}
    waiting["links"] = [{"from": "a", "to": "e", "type": "ordering"}]
    with pytest.raises(NetworkError, match=r"links\[0\]: 'e' is a duty beside alternatives"):
        parse_task(waiting)


def test_ways_that_differ_are_told() -> None:
    _, network = parse_task(data())
    direct = replace(network, paths=tuple(edge for edge in network.paths if (edge.source, edge.target) != ("a", "d")))
    assert differences(network, direct) == ("the way a -> d is gone",)
    assert differences(direct, network) == ("the way a -> d is new",)


@pytest.mark.parametrize("name", [START, END])
def test_a_component_is_not_called_like_an_end(name: str) -> None:
    components = (Component(id=name, behavior="A"), Component(id="b", behavior="B"))
    with pytest.raises(NetworkError, match=f"{name} is where all paths"):
        Network(components, paths=(Edge(source=START, target="b"), Edge(source="b", target=END)))
    assert Network(components).topology.ids == (name, "b")
