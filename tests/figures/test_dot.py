import re

from tests.figures.samples import component, network, transport
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
