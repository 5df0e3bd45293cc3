"""What a data sheet calls bias stability and sensitivity error: a bias that wanders, and axes that show too much.

The wandering is a Gauss-Markov process of the first order with the stability as its deviation. It begins anywhere in
it, so its start adds to the constant bias.
"""

import numpy as np
from scipy.signal import lfilter

from pdr_core.records import Floats


def wandering(count: int, rate_hz: float, sd: float, correlation_s: float, rng: np.random.Generator) -> Floats:
    """Return a bias of three axes that wanders, (count, 3), with a deviation and a time after which it is forgotten."""
    keep = np.exp(-1.0 / (rate_hz * correlation_s))
    fresh = rng.standard_normal((count, 3))
    fresh[1:] *= np.sqrt(1.0 - keep**2)
    return sd * lfilter([1.0], [1.0, -keep], fresh, axis=0)


def scales(sd: float, rng: np.random.Generator) -> Floats:
    """Return by what factor each axis shows what it feels, (3,)."""
    return 1.0 + sd * rng.standard_normal(3)
