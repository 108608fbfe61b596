"""A thousand demonstrations merged into one task, beside abPOA, which aligns genomes to graphs in C with SIMD.

abPOA is no requirement of the project, since it is built by a C compiler: ``.venv/bin/pip install pyabpoa``.
"""

import importlib.util
import random
import resource
import sys
import time
from itertools import pairwise

from understudy.generalization import Merger
from understudy.network import Component, Interval, Link, LinkType, Network, Occurrence

__all__ = ["main"]

DEMONSTRATIONS, STEPS, NOISE = 1_000, 100, 0.1
SYMBOLS = "ACDEFGHIKLMN"
"""Twelve, which abPOA knows as amino acids."""
REPORTED = 200


def words(seed: int = 0) -> list[str]:
    """One task, shown with one step in ten left out, replaced or followed by another one."""
    chance = random.Random(seed)
    task = chance.choices(SYMBOLS, k=STEPS)
    return ["".join(_shown(symbol, chance) for symbol in task) for _ in range(DEMONSTRATIONS)]


def _shown(symbol: str, chance: random.Random) -> str:
    if chance.random() >= NOISE:
        return symbol
    return chance.choice(("", chance.choice(SYMBOLS), symbol + chance.choice(SYMBOLS)))


def learned(name: str, word: str) -> Network:
    ids = [f"{symbol}-{word[: place + 1].count(symbol)}" for place, symbol in enumerate(word)]
    components = tuple(
        Component(
            id=id_,
            behavior=symbol,
            occurrences=(Occurrence(demonstration=name, interval=Interval(2.0 * place, 2.0 * place + 1.0)),),
        )
        for place, (id_, symbol) in enumerate(zip(ids, word, strict=True))
    )
    links = (Link(source=a, target=b, type=LinkType.ORDERING) for a, b in pairwise(ids))
    return Network(components, tuple(links))


def main() -> None:
    shown = words()
    first, *others = [learned(f"d{number}", word) for number, word in enumerate(shown, start=1)]
    print(f"{DEMONSTRATIONS:,} demonstrations of {STEPS} steps over {len(SYMBOLS)} symbols, {NOISE:.0%} noise")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    begun = last = time.process_time()
    merger = Merger(first)
    for number, other in enumerate(others, start=2):
        merger.add(other)
        if number % REPORTED == 0:
            now = time.process_time()
            print(f"  up to the {number:>5,}th: {1000 * (now - last) / REPORTED:>5.1f} ms each")
            last = now
    network = merger.network()
    spent = time.process_time() - begun
    # Kilobytes on Linux, bytes on macOS.
    scale = 1 << 20 if sys.platform == "darwin" else 1 << 10
    more = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / scale
    print(f"  all, with the network: {spent:.1f} s, {more:.0f} MB more than before")
    print(f"  {len(network.components):,} steps, {len(network.paths):,} edges, {len(network.links):,} links")
    if importlib.util.find_spec("pyabpoa") is None:
        print("  abPOA is not installed: .venv/bin/pip install pyabpoa (needs a C compiler)")
        return
    import pyabpoa

    begun = time.process_time()
    pyabpoa.msa_aligner(is_aa=True).msa(shown, out_cons=True, out_msa=False)
    print(f"  abPOA, the same words: {time.process_time() - begun:.2f} s")


if __name__ == "__main__":
    main()
