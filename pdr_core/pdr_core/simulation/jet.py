"""Quantities that know their first two derivatives, so that a motion that is made of them does too."""

from typing import NamedTuple

import numpy as np

from pdr_core.records import Floats


class Jet(NamedTuple):
    """A quantity at n times and its first two derivatives, (n,) each."""

    value: Floats
    rate: Floats
    bend: Floats

    def plus(self, other: "Jet") -> "Jet":
        """Return the sum."""
        return Jet(self.value + other.value, self.rate + other.rate, self.bend + other.bend)

    def by(self, factor: float) -> "Jet":
        """Return a multiple."""
        return Jet(factor * self.value, factor * self.rate, factor * self.bend)

    def times(self, other: "Jet") -> "Jet":
        """Return the product."""
        bend = self.bend * other.value + 2.0 * self.rate * other.rate + self.value * other.bend
        return Jet(self.value * other.value, self.rate * other.value + self.value * other.rate, bend)

    def sine(self, phase_rad: float = 0.0) -> "Jet":
        """Return the sine of this angle plus a phase."""
        s, c = np.sin(self.value + phase_rad), np.cos(self.value + phase_rad)
        return Jet(s, c * self.rate, c * self.bend - s * self.rate**2)

    def cosine(self) -> "Jet":
        """Return the cosine of this angle."""
        return self.sine(0.5 * np.pi)


def turned(x: Jet, y: Jet, angle: Jet) -> tuple[Jet, Jet]:
    """Return a level vector turned counter-clockwise by an angle."""
    s, c = angle.sine(), angle.cosine()
    return x.times(c).plus(y.times(s).by(-1.0)), x.times(s).plus(y.times(c))
