"""Colors that the camera takes for others, for a picture or for a while (§4.5.6: "assigns different colors")."""

from collections.abc import Sequence

import numpy as np

from understudy.clock import CONTROL_PERIOD_S
from understudy.robot import RGB
from understudy.sim.noise import NoiseLevels
from understudy.sim.scenery import Paint

__all__ = ["Misreading"]

_PAINTS: tuple[Paint, ...] = tuple(RGB.values())


class Misreading:
    """The paints of some things as one camera takes them.

    Each reading of a color lasts for ``misread_s`` on average, and then the next one is drawn: another of the trained
    colors, any of them, with the probability ``misread_colors``, else the true one. So that probability is the share of
    the pictures that show a thing in another color, however long a reading lasts.

    Args:
        paints: the true ones.
        which: indices of the things that can be misread.
        noise: how often, and for how long.
        rng: where the errors come from; without any, nothing is drawn from it.
    """

    def __init__(self, paints: Sequence[Paint], which: Sequence[int], noise: NoiseLevels, rng: np.random.Generator):
        self.paints = list(paints)
        self._true, self._which, self._rng = tuple(paints), tuple(which), rng
        self._rate = noise.misread_colors
        self._renewed = min(1.0, CONTROL_PERIOD_S / noise.misread_s) if noise.misread_s > 0.0 else 1.0
        self._read_before = False

    def look(self) -> None:
        """Reads the colors for the next picture."""
        if not self._rate:
            return
        for i in self._which:
            if self._read_before and self._rng.random() >= self._renewed:
                continue
            self.paints[i] = self._true[i]
            if self._rng.random() < self._rate:
                others = [paint for paint in _PAINTS if paint != self._true[i]]
                self.paints[i] = others[int(self._rng.integers(len(others)))]
        self._read_before = True
