import re

from hypothesis import given, settings

from tests.execution.strategies import hierarchies
from tests.figures import nested
from tests.figures.samples import component, network, transport
from understudy.behaviors import installed_skills
from understudy.figures import to_dot
from understudy.network import Network


def test_every_component_and_link_is_there():
    text = to_dot(transport(), name="fetch")
    assert text.startswith('digraph "fetch" {\n')
    assert text.endswith("}\n")
    assert text.count(" -> ") == 10
    assert (
        '"pick-up" -> "orange" [style=solid, color="black:white:black", arrowhead=normal, tooltip=permanent];' in text
    )
    assert '"orange" -> "drop-2" [style=dashed, arrowhead=vee, tooltip=ordering];' in text
    assert '"yellow" [label="Track yellow\\n0.50 m, 178°", color="#ebdc23", penwidth=2.5];' in text


def test_what_would_end_a_string_or_begin_an_escape_is_escaped():
    made = network([component('a"b', 'say "\\N"'), component("c\\", "d")], [('a"b', "c\\", "ordering")])
    text = to_dot(made, name='the "task"\nof today\\')
    assert 'digraph "the \\"task\\"\\nof today\\\\" {' in text
    assert '"a\\"b" [label="say \\"\\\\N\\""];' in text
    assert '"a\\"b" -> "c\\\\" [' in text
    # Outside of strings nothing of the labels is left.
    bare = re.sub(r'"(?:[^"\\]|\\.)*"', "S", text)
    assert '"' not in bare
    assert "\\" not in bare


def test_inhibitions_are_edges_of_their_own():
    made = transport()
    text = to_dot(Network(made.components, made.links, (("green", "yellow"),)))
    assert '"green" -> "yellow" [style=dotted, arrowhead=tee, constraint=false, tooltip=inhibits];' in text


def test_networks_are_clusters_and_links_end_at_their_borders():
    text = to_dot(nested.hierarchical())
    assert "  compound=true;\n" in text
    assert [line.strip() for line in text.splitlines() if "subgraph" in line] == [
        'subgraph "cluster transport" {',
        'subgraph "cluster transport/gate" {',
        'subgraph "cluster visit" {',
    ]
    assert text.count(" -> ") == nested.hierarchical().link_count
    assert (
        '"transport/pick-up" -> "transport/gate" [style=solid, color="black:white:black", arrowhead=normal, '
        'tooltip=permanent, lhead="cluster transport/gate"];' in text
    )
    assert 'ltail="cluster transport", lhead="cluster visit"];' in text
    assert "compound" not in to_dot(transport())


def test_cases_switches_and_controls():
    text = to_dot(nested.delivery(), skills=installed_skills())
    assert 'label="Deliver a box\\n3 times"; penwidth=3;' in text
    assert 'label="a · loaded\\nif the orange box is in the gripper"; penwidth=1;' in text
    assert '"deliver/empty/" -> "deliver/loaded/" [style="dashed,bold", arrowhead=empty, constraint=false, ' in text
    assert 'label="when it is done", ltail="cluster deliver/empty/", lhead="cluster deliver/loaded/"];' in text
    assert '"home" [label="Track blue\\n0.60 m, 90°\\n60 s, then skip", color="' in text


@given(hierarchies())
@settings(max_examples=40)
def test_everything_is_there_once_and_every_brace_is_closed(made):
    text = to_dot(made)
    bare = re.sub(r'"(?:[^"\\]|\\.)*"', "S", text)
    assert bare.count("{") == bare.count("}")
    nodes = re.findall(r'^ *"((?:[^"\\]|\\.)*)" \[', text, flags=re.MULTILINE)
    assert len(nodes) == len(set(nodes))
    assert set(made.by_path) <= set(nodes)
    # A line leads only from a node to a node.
    ends = re.findall(r'^ *"((?:[^"\\]|\\.)*)" -> "((?:[^"\\]|\\.)*)" \[', text, flags=re.MULTILINE)
    assert {end for pair in ends for end in pair} <= set(nodes)
