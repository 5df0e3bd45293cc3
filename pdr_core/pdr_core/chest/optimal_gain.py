"""The paper's theory of K (Cheng eq. 14-22), as printed, with its closed-form minimum.

The attitude error over one period T of the motion, for an attitude error d_a by the acceleration and a rate error d_g
of the gyro (angles in any one unit, d_g in that unit a second; K is a plain number here):

    J(K) = sqrt((d_g T)^2 + (2 pi K d_a)^2) / (2 pi (1 + K))                                     (18)

With a = d_g T and b = 2 pi d_a, d(J^2)/dK = 0 is b^2 K (1 + K) = a^2 + b^2 K^2, so K = a^2 / b^2:

    K* = (d_g T / (2 pi d_a))^2,      J(K*) = a b / (2 pi sqrt(a^2 + b^2))

With the paper's numbers (16.5306 degrees, 0.1412 degrees a second, T = 1 s) K* is 1.8e-6, and J hardly changes below K
= 0.001: it is within 0.1 % of its value at K = 0, and the paper's grid of 1e-5, 1.1e-4 ... holds none of the K that it
calls optimal, 1.3e-5, 4.3e-5 and 1e-5, which would need three different T. So this is theory; the default K comes from
`loop_error.py`.

Why J tells so little: its feedback takes K of the error once a period, not at a rate, and acceleration is taken for a
constant that never averages out. The real loop sees the mean of a stride.
"""

from math import pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from pdr_core.records import Floats

K_MAX = 1.0  # eq. 19
LEAST_SEARCHED = 1e-12


class GainTheory(NamedTuple):
    """What the objective knows; angles in degrees as in section 3.2.4."""

    accel_deg: float = 16.5306  # d_a
    gyro_degps: float = 0.1412  # d_g
    period_s: float = 1.0  # T; the paper gives none


def attitude_error_deg(gain: Floats | float, theory: GainTheory) -> Floats | float:
    """Return J of eq. 18 [deg] for one K or many."""
    drift, shake = theory.gyro_degps * theory.period_s, 2.0 * pi * np.asarray(gain) * theory.accel_deg
    return np.sqrt(drift**2 + shake**2) / (2.0 * pi * (1.0 + np.asarray(gain)))


def closed_form(theory: GainTheory) -> float:
    """Return the K of least J, at most 1 (eq. 19)."""
    return min(K_MAX, (theory.gyro_degps * theory.period_s / (2.0 * pi * theory.accel_deg)) ** 2)


def searched(theory: GainTheory, least: float = 0.0) -> float:
    """Return the K of least J between a lower bound (eq. 20) and 1 (eq. 19), by a bounded search over log K."""
    found = minimize_scalar(
        lambda log_gain: attitude_error_deg(10.0**log_gain, theory),
        bounds=(np.log10(max(least, LEAST_SEARCHED)), np.log10(K_MAX)),
        method="bounded",
        options={"xatol": 1e-6},
    )
    return float(10.0**found.x)


def convergence_s(gain: Floats, rate_hz: float, share: float) -> Floats:
    """Return when an error is down to a share of itself, (n,) [s]: err <- err - K err a sample (eq. 21-22)."""
    steps = np.ceil(np.log(share) / np.log1p(-np.minimum(gain, 1.0 - 1e-12)))
    return np.maximum(steps, 1.0) / rate_hz


def least_gain(rate_hz: float, share: float, within_s: float) -> float:
    """Return the lower bound of K, G of eq. 20: the least with which an error converges within a time."""
    return 1.0 - share ** (1.0 / (rate_hz * within_s))


def least_error_deg(theory: GainTheory) -> float:
    """Return J at its minimum, in closed form [deg]."""
    a, b = theory.gyro_degps * theory.period_s, 2.0 * pi * theory.accel_deg
    return a * b / (2.0 * pi * sqrt(a**2 + b**2))
