"""Smooth curves from one value to the next.

Septic smoothsteps: the polynomial of least degree that is at rest at both ends up to the third derivative, so even
the jerk is continuous where pieces meet; and a piece between equal values is constant to the last bit.
"""

import numpy as np

from pdr_core.records import Floats


class Curve:
    """Passes through m values at each of k times, (k, m), and rests for an instant there."""

    def __init__(self, key_s: Floats, values: Floats) -> None:
        self._key_s = key_s
        self._values = values

    def at(self, time_s: Floats) -> tuple[Floats, Floats, Floats]:
        """Return the values at n times and their first two derivatives, (n, m) each; beyond the ends it stands."""
        i = np.clip(np.searchsorted(self._key_s, time_s, side="right") - 1, 0, len(self._key_s) - 2)
        span_s = (self._key_s[i + 1] - self._key_s[i])[:, None]
        u = np.clip((time_s - self._key_s[i])[:, None] / span_s, 0.0, 1.0)
        change = self._values[i + 1] - self._values[i]
        value = u**4 * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u)))
        first = 140.0 * (u * (1.0 - u)) ** 3
        second = 420.0 * (u * (1.0 - u)) ** 2 * (1.0 - 2.0 * u)
        return self._values[i] + change * value, change * first / span_s, change * second / span_s**2
