"""A behavior network in Graphviz's DOT language, as text; drawing it takes Graphviz, writing it takes nothing."""

from understudy.figures.labels import label_of
from understudy.network import LinkType, Network
from understudy.robot import RGB, Color

__all__ = ["to_dot"]

_LINK = {
    LinkType.ORDERING: "style=dashed, arrowhead=vee",
    LinkType.ENABLING: "style=solid, arrowhead=vee",
    LinkType.PERMANENT: 'style=solid, color="black:white:black", arrowhead=normal',
}


def to_dot(network: Network, *, name: str = "task") -> str:
    """The network as a directed graph.

    Args:
        network: components become nodes in document order, links and inhibitions edges.
        name: of the graph.

    Returns:
        A DOT document that ends in a newline.
    """
    lines = [
        f"digraph {_quoted(name)} {{",
        "  rankdir=TB;",
        '  node [shape=box, style="rounded,filled", fillcolor=white, fontname="DejaVu Sans", fontsize=10];',
        '  edge [fontname="DejaVu Sans", fontsize=8];',
    ]
    for component in network.components:
        named = label_of(component)
        text = "\n".join(part for part in (named.title, named.details) if part)
        color = f", color={_quoted(_hex(named.color))}, penwidth=2.5" if named.color else ""
        lines.append(f"  {_quoted(component.id)} [label={_quoted(text)}{color}];")
    for link in network.links:
        kind = f"{_LINK[link.type]}, tooltip={link.type.value}"
        lines.append(f"  {_quoted(link.source)} -> {_quoted(link.target)} [{kind}];")
    for source, target in network.inhibitions:
        kind = "style=dotted, arrowhead=tee, constraint=false, tooltip=inhibits"
        lines.append(f"  {_quoted(source)} -> {_quoted(target)} [{kind}];")
    return "\n".join([*lines, "}", ""])


def _quoted(text: str) -> str:
    r"""A double-quoted string. A backslash would begin an escape (``\N`` is the node's name), so it is doubled."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "\\n".join(escaped.splitlines()) + '"'


def _hex(color: str) -> str:
    return "#" + "".join(f"{part:02x}" for part in RGB[Color(color)])
