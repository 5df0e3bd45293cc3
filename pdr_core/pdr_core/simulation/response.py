"""How the three axes of a sensor answer to the true vector before it is sampled: alignment, linearity, bandwidth.

Alignment: each axis leans towards the two others by small angles of their own, which is a turn and a skew at once.
Linearity: the largest distance from the straight line over the whole range. The curve is the third Chebyshev
polynomial, of all cubics the one that departs equally far at all its turns; it passes through zero, where a sensor is
trimmed. The figure is a limit: each axis draws its share of it, evenly between -1 and 1.
Bandwidth: a low-pass of the first order, as a sensor has whose bandwidth one capacitor sets. It is causal: it delays by
1 / (2 pi bandwidth), and rates and forces of different bandwidths not alike.
"""

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from pdr_core.records import Floats

OVERSAMPLED_HZ = 1000.0  # at least: what is filtered is followed so closely


@dataclass(frozen=True)
class Response:
    """What a data sheet says of the axes."""

    alignment_sd_rad: float = 0.0
    linearity: float = 0.0  # largest distance from the straight line, as a share of the range
    bandwidth_hz: float = np.inf


def answer(true: Floats, rate_hz: float, response: Response, full_scale: float, rng: np.random.Generator) -> Floats:
    """Return what the axes show of true vectors, (n, 3) both, that follow one another at `rate_hz`."""
    shares, leaning = rng.uniform(-1.0, 1.0, 3), rng.standard_normal((3, 3))
    shown = true
    if response.alignment_sd_rad > 0.0:
        shown = shown @ (np.eye(3) + response.alignment_sd_rad * leaning * (1.0 - np.eye(3))).T
    if response.linearity > 0.0:
        shown = shown + response.linearity * full_scale * shares * bend(shown / full_scale)
    if np.isfinite(response.bandwidth_hz):
        shown = low_passed(shown, rate_hz, response.bandwidth_hz)
    return shown


def bend(share: Floats) -> Floats:
    """Return the distance from the straight line, within -1 .. 1, at shares of the range."""
    u = np.clip(share, -1.0, 1.0)
    return 4.0 * u**3 - 3.0 * u


def low_passed(values: Floats, rate_hz: float, bandwidth_hz: float) -> Floats:
    """Return values, (n, 3), after a low-pass of the first order that has always seen the first one.

    It is exact for what runs straight from value to value: y' = w (u - y), with w = 2 pi bandwidth, over an interval
    T gives y1 = a y0 + (b - a) u0 + (1 - b) u1, a = exp(-w T), b = (1 - a) / (w T).
    """
    turns = 2.0 * np.pi * bandwidth_hz / rate_hz
    a = np.exp(-turns)
    b = (1.0 - a) / turns
    return lfilter([1.0 - b, b - a], [1.0, -a], values, axis=0, zi=b * values[:1])[0]
