"""Small networks in networks, with what the reference knows."""

from itertools import combinations

from hypothesis import strategies as st

from understudy.network import Case, Component, Happened, Link, LinkType, Nab, Network, Repeat, Timeout

__all__ = ["nested"]


@st.composite
def nested(draw: st.DrawFn, depth: int = 1, size: int = 2) -> Network:
    count = draw(st.integers(1, size))
    ids = [f"c{index}" for index in range(count)]
    parts: list[Component | Nab] = []
    for id_ in ids:
        if depth and draw(st.integers(0, 2)) == 0:
            several = draw(st.booleans())
            cases = [
                Case(name=f"k{index}" if several else "", network=draw(nested(depth - 1, 2)), when=when)
                for index, when in enumerate(
                    draw(st.sampled_from(((None,), (Happened(event="a"),))))
                    if not several
                    else draw(
                        st.sampled_from(((Happened(event="a"), None), (Happened(event="a"), Happened(event="b"))))
                    )
                )
            ]
            loop = None
            if draw(st.booleans()):
                ending = Happened(event="c") if draw(st.booleans()) else None
                loop = Repeat(times=draw(st.integers(1, 2)), until=ending)
            parts.append(Nab(id=id_, cases=tuple(cases), repeat=loop))
        else:
            timeout = Timeout(seconds=1, then="skip") if draw(st.integers(0, 4)) == 0 else None
            parts.append(
                Component(id=id_, behavior=draw(st.sampled_from(("Track", "PickUp", "Drop"))), timeout=timeout)
            )
    order = draw(st.permutations(ids))
    links = tuple(
        Link(source=a, target=b, type=draw(st.sampled_from(LinkType)))
        for a, b in combinations(order, 2)
        if draw(st.booleans())
    )
    return Network(tuple(parts), links)
