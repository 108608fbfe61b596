"""The dissertation's worked examples, as far as its text describes them (chapter 5)."""

import pytest

from understudy.generalization import generalize
from understudy.generalization.links import least_restrictive
from understudy.network import LinkType, Network, expand_links

from .words import edges_of, learned, tasks

ORDERING, ENABLING, PERMANENT = LinkType.ORDERING, LinkType.ENABLING, LinkType.PERMANENT

LEFT, RIGHT = "A C B F A", "A B F C"
"""Figure 5.1: A, B and F are common; A leads to B past C; after F both A and C are acceptable (§5.2)."""


def links_of(network: Network) -> dict[str, LinkType]:
    return {f"{link.source} {link.target}": link.type for link in expand_links(network).links}


def test_figure_5_1() -> None:
    *_, task = tasks(LEFT, RIGHT)
    assert edges_of(task) == {"START A", "A C", "C B", "A B", "B F", "F A-2", "F C-2", "A-2 END", "C-2 END"}
    topology = task.topology
    assert topology.candidates["A-1"] == ("B-1",)  # the direct way wins
    assert topology.candidates["F-1"] == ("A-2", "C-2")  # the robot chooses
    assert topology.bypassed == ("C-1",)


def test_figure_5_2_a_known_word_changes_nothing_but_the_evidence() -> None:
    *_, known, task = tasks(LEFT, RIGHT, "A B F A")
    assert edges_of(task) == edges_of(known)
    assert task.topology.shown_by["A-2"] == ("d1", "d3")
    assert task.topology.shown_by["B-1"] == ("d1", "d2", "d3")
    assert task.topology.bypassed_by("C-1") == ("d2", "d3")


def test_figure_5_3_a_link_of_one_demonstration_only() -> None:
    left = learned("d1", LEFT, {(0, 1): ENABLING, (1, 2): PERMANENT})
    links = links_of(generalize(left, learned("d2", RIGHT)).network)
    assert links["A-1 C-1"] is ENABLING
    assert links["C-1 B-1"] is PERMANENT


def test_figure_5_4_steps_of_different_demonstrations() -> None:
    *_, one_after_the_other = tasks("F B", "B C")
    assert edges_of(one_after_the_other) == {"START F", "START B", "F B", "B C", "B END", "C END"}
    assert links_of(one_after_the_other)["F-1 C-1"] is ORDERING  # never seen together, but F comes before C
    *_, one_or_the_other = tasks("A F B", "A C B")
    assert "F-1 C-1" not in links_of(one_or_the_other)


@pytest.mark.parametrize("net_1", [None, ORDERING, ENABLING, PERMANENT])
@pytest.mark.parametrize("net_2", [None, ORDERING, ENABLING, PERMANENT])
def test_figures_5_5_and_5_6_the_least_restrictive(net_1: LinkType | None, net_2: LinkType | None) -> None:
    strength = [None, ORDERING, ENABLING, PERMANENT]
    expected = strength[min(strength.index(net_1), strength.index(net_2))]
    assert least_restrictive(net_1, net_2) is expected
    if net_1 is None or net_2 is None:
        return
    # A and B as in Figure 5.5: on the longest common subsequence, with other steps around them.
    left, right = learned("d1", "A B F", {(0, 1): net_1}), learned("d2", "A B C", {(0, 1): net_2})
    assert links_of(generalize(left, right).network)["A-1 B-1"] is expected


FIRST = "Green PickUp Yellow Red LightOrange Pink Drop LightGreen Green"
SECOND = "LightGreen PickUp Yellow Red Pink Drop LightOrange LightGreen"
THIRD = "Green PickUp LightOrange Yellow Red Pink Drop LightGreen"
"""§5.4.3. The first is told in §6.3.4; of the others the text says that one of them begins with Light Green, that Light
Orange came at its right place in the second, and elsewhere in each, and what the result is."""

STEP_1 = {
    "START Green", "Green PickUp", "PickUp Yellow", "Yellow Red", "Red LightOrange", "LightOrange Pink", "Pink Drop",
    "Drop LightGreen", "LightGreen Green-2", "Green-2 END",
}  # fmt: skip
STEP_2 = {
    "START LightGreen-2", "LightGreen-2 PickUp", "Red Pink", "Drop LightOrange-2", "LightOrange-2 LightGreen",
    "LightGreen END",
}  # fmt: skip
STEP_3 = {"PickUp LightOrange-3", "LightOrange-3 Yellow"}


def test_section_5_4_3_after_each_demonstration() -> None:
    first, second, third = tasks(FIRST, SECOND, THIRD)
    assert edges_of(first) == STEP_1
    assert not first.paths
    assert edges_of(second) == STEP_1 | STEP_2
    assert edges_of(third) == STEP_1 | STEP_2 | STEP_3


def test_section_5_4_3_the_generalised_task() -> None:
    """(Green or Light Green), PickUp, Yellow, Red, Pink, Drop, Light Green; all visits to Light Orange bypassed."""
    *_, task = tasks(FIRST, SECOND, THIRD)
    topology = task.topology
    assert topology.candidates["START"] == ("Green-1", "LightGreen-2")
    way, id_ = [], "Green-1"
    while id_ != "END":
        way.append(id_)
        (id_,) = topology.candidates[id_]
    assert way == ["Green-1", "PickUp-1", "Yellow-1", "Red-1", "Pink-1", "Drop-1", "LightGreen-1"]
    assert topology.candidates["LightGreen-2"] == ("PickUp-1",)
    assert topology.bypassed == ("LightOrange-3", "LightOrange-1", "LightOrange-2", "Green-2")
    everywhere = [id_ for id_ in topology.ids if not topology.bypassed_by(id_)]
    assert everywhere == way[1:]
    assert topology.shown_by["Green-1"] == ("d1", "d3")
    assert topology.bypassed_by("LightOrange-2") == ("d1", "d3")
