"""Shocks at heel strike: what the sensor feels beside the motion of the foot.

Case, shoe and skin ring for some milliseconds when the heel comes down. The sensor feels it, the foot does not move by
it: so it is added to the specific force alone, and the true motion knows nothing of it. Each shock is half a sine, so
it leaves a velocity that is not there; a filter must live with that until the stance ends it.
"""

import numpy as np

from pdr_core.records import Floats

SHOCK_S = 0.008
WEAKEST = 0.5  # of the strongest; each strike is between them
SHOCKS = 2  # this stream of a seed


def shocks_mps2(time_s: Floats, strikes_s: Floats, strongest_mps2: float, seed: int) -> Floats:
    """Return the force of the shocks in the foot frame, (n, 3) [m/s^2], at ascending times (n,): up and sideways."""
    rng = np.random.default_rng([seed, SHOCKS])
    direction = rng.standard_normal((len(strikes_s), 3))
    direction[:, 2] = np.abs(direction[:, 2])
    size_mps2 = strongest_mps2 * rng.uniform(WEAKEST, 1.0, (len(strikes_s), 1))
    shock = size_mps2 * direction / np.linalg.norm(direction, axis=1, keepdims=True)
    felt = np.zeros((len(time_s), 3))
    for strike_s, force in zip(strikes_s, shock, strict=True):
        first, last = np.searchsorted(time_s, [strike_s, strike_s + SHOCK_S])
        felt[first:last] += np.sin(np.pi * (time_s[first:last] - strike_s) / SHOCK_S)[:, None] * force
    return felt
