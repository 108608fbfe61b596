"""A behavior network in Graphviz's DOT language, as text; drawing it takes Graphviz, writing it takes nothing."""

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from understudy.behaviors import Skill
from understudy.figures.labels import label_of
from understudy.figures.numbering import cases_of
from understudy.figures.ways import is_bypassed, with_ways
from understudy.figures.words_controls import Wording
from understudy.network import Case, Component, LinkType, Nab, Network
from understudy.robot import RGB, Color

__all__ = ["to_dot"]

_LINK = {
    LinkType.ORDERING: "style=dashed, arrowhead=vee",
    LinkType.ENABLING: "style=solid, arrowhead=vee",
    LinkType.PERMANENT: 'style=solid, color="black:white:black", arrowhead=normal',
}
_RIVAL = "style=dotted, arrowhead=tee, constraint=false, tooltip=inhibits"
_SWITCH = 'style="dashed,bold", arrowhead=empty, constraint=false, tooltip=switch'


def to_dot(network: Network, *, name: str = "task", skills: Mapping[str, Skill] = MappingProxyType({})) -> str:
    """The network as a directed graph.

    Args:
        network: components become nodes called by their paths, in document order; networks in a component's place, and
            their cases, clusters; links, inhibitions and switches edges; controls lines of the labels.
        name: of the graph.
        skills: by name, for the words of conditions.

    Returns:
        A DOT document that ends in a newline.
    """
    lines = [
        f"digraph {_quoted(name)} {{",
        "  rankdir=TB;",
        *([] if network.flat else ["  compound=true;"]),
        '  node [shape=box, style="rounded,filled", fillcolor=white, fontname="DejaVu Sans", fontsize=10];',
        '  edge [fontname="DejaVu Sans", fontsize=8];',
        *([] if network.flat else ['  graph [fontname="DejaVu Sans", fontsize=10, labeljust=l];']),
    ]
    return "\n".join([*lines, *_network(network, "", Wording(network, skills), "  "), "}", ""])


def _network(network: Network, inside: str, wording: Wording, margin: str) -> Iterator[str]:
    for component in network.components:
        if isinstance(component, Nab):
            yield from _nab(component, inside, wording, margin, network)
        else:
            yield margin + _behavior(component, inside, wording, network)

    def edge(source: str, target: str, kind: str) -> str:
        ends = [
            f", {end}={_quoted(f'cluster {inside}{id_}')}"
            for end, id_ in (("ltail", source), ("lhead", target))
            if isinstance(network.by_id[id_], Nab)
        ]
        return f"{margin}{_quoted(inside + source)} -> {_quoted(inside + target)} [{kind}{''.join(ends)}];"

    for link in with_ways(network).links:
        yield edge(link.source, link.target, f"{_LINK[link.type]}, tooltip={link.type.value}")
    for source, target in network.inhibitions:
        yield edge(source, target, _RIVAL)


def _behavior(component: Component, inside: str, wording: Wording, network: Network) -> str:
    named = label_of(component)
    color = f", color={_quoted(_hex(named.color))}, penwidth=2.5" if named.color else ""
    past = ', style="rounded,dashed"' if is_bypassed(network, component.id) else ""
    return (
        f"{_quoted(inside + component.id)} [label={_quoted(_text(component, inside, wording, network))}{color}{past}];"
    )


def _nab(nab: Nab, inside: str, wording: Wording, margin: str, network: Network) -> Iterator[str]:
    """A cluster around a point to which the lines lead that are drawn to its border."""
    path, deeper = inside + nab.id, f"{margin}  "
    yield f"{margin}subgraph {_quoted(f'cluster {path}')} {{"
    yield f"{deeper}label={_quoted(_text(nab, inside, wording, network))}; penwidth=3;"
    yield deeper + _point(path)
    for index, (below, letter, case) in enumerate(cases_of(path, nab)):
        choice = wording.choice(nab, index, inside)
        if case.name or choice:
            named = "\n".join(filter(None, (_case(letter, case), choice)))
            yield f"{deeper}subgraph {_quoted(f'cluster {below}')} {{"
            yield f"{deeper}  label={_quoted(named)}; penwidth=1;"
            yield f"{deeper}  {_point(below)}"
            yield from _network(case.network, below, wording, f"{deeper}  ")
            yield f"{deeper}}}"
        else:
            yield from _network(case.network, below, wording, deeper)
    points = {case.name: below for below, _, case in cases_of(path, nab)}
    for source, target, when in wording.switches(path, nab):
        ends = f"ltail={_quoted(f'cluster {points[source]}')}, lhead={_quoted(f'cluster {points[target]}')}"
        label = f"{_SWITCH}, label={_quoted(when)}"
        # From a case to itself Graphviz draws the line at the point.
        kind = label if source == target else f"{label}, {ends}"
        yield f"{deeper}{_quoted(points[source])} -> {_quoted(points[target])} [{kind}];"
    yield f"{margin}}}"


def _point(name: str) -> str:
    return f"{_quoted(name)} [shape=point, style=invis];"


def _case(letter: str, case: Case) -> str:
    return " · ".join(filter(None, (letter, case.name)))


def _text(component: Component | Nab, inside: str, wording: Wording, network: Network) -> str:
    named = label_of(component)
    notes = [note.text for note in wording.notes(component, inside, network)]
    return "\n".join(filter(None, (named.title, named.details, *notes)))


def _quoted(text: str) -> str:
    r"""A double-quoted string. A backslash would begin an escape (``\N`` is the node's name), so it is doubled."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "\\n".join(escaped.splitlines()) + '"'


def _hex(color: str) -> str:
    return "#" + "".join(f"{part:02x}" for part in RGB[Color(color)])
