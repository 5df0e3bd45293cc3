"""The attitude error of the real loop, from the sensor's noise and the person's motion: it gives the default K.

The loop of `correction.py`, step by step, for one level axis. p_k is the tilt error at the end of step k, b the error
of the gyro's bias, and what a stride shows is the mean of p over it and the change of speed that it holds:

    m_k = (p_k + 2 p_k-1 + p_k-2) / 4 + (v_k - v_k-2) / (2 T g)
    p_k+1 = p_k + b T - K T m_k                 (K = 0 in the first steps)

It is linear in the error at the start, in b, and in the speeds v, which vary slowly: so its mean square over a walk
from stop to stop follows from their covariances without a draw. Small K leaves b / K, large K follows the speed.
"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from pdr_core.conventions import STANDARD_GRAVITY_MPS2
from pdr_core.records import Floats

LARGEST_PER_S = 2.0


class LoopNoise(NamedTuple):
    """What disturbs the loop."""

    bias_sd_radps: float = 0.0006  # 0.034 deg/s: what short rests leave and the wander of Cheng Table 1 adds
    level_sd_rad: float = 0.0012  # 0.07 deg: of the attitude after a rest
    speed_sd_mps: float = 0.029  # 2.3 % of 1.25 m/s: Collins and Kuo 2013
    speed_steps: float = 5.0  # over so many steps it is forgotten
    step_s: float = 0.55
    steps: int = 18  # from stop to stop: 12 m
    start_steps: int = 2  # without feedback


def rms_rad(gain_per_s: float, noise: LoopNoise) -> float:
    """Return the root mean square of the tilt error of one axis over the steps of a walk [rad]."""
    told = responses(gain_per_s, noise)
    return float(np.sqrt(np.mean(np.einsum("ij,jk,ik->i", told, covariance(noise), told))))


def responses(gain_per_s: float, n: LoopNoise) -> Floats:
    """Return what each step's p owes to b, to the error at the start, and to each speed, (steps, 2 + steps + 3)."""
    unknowns = n.steps + 5
    p = [np.eye(unknowns)[1]] * 3
    for k in range(n.steps):
        shown = (p[-1] + 2.0 * p[-2] + p[-3]) / 4.0
        shown[[k + 2, k + 4]] += np.array([-0.5, 0.5]) / (n.step_s * STANDARD_GRAVITY_MPS2)
        fed = gain_per_s * n.step_s * shown if k >= n.start_steps else 0.0
        p.append(p[-1] + n.step_s * np.eye(unknowns)[0] - fed)
    return np.array(p[3:])


def covariance(n: LoopNoise) -> Floats:
    """Return the covariance of b, of the error at the start, and of the speeds."""
    whole = np.zeros((n.steps + 5, n.steps + 5))
    whole[0, 0], whole[1, 1] = n.bias_sd_radps**2, n.level_sd_rad**2
    apart = np.abs(np.subtract.outer(np.arange(n.steps + 3), np.arange(n.steps + 3)))
    whole[2:, 2:] = n.speed_sd_mps**2 * np.exp(-apart / n.speed_steps)
    return whole


def best_gain_per_s(noise: LoopNoise) -> float:
    """Return the K of least error [1/s]."""
    found = minimize_scalar(lambda K: rms_rad(K, noise), bounds=(0.0, LARGEST_PER_S), method="bounded")
    return float(found.x)
