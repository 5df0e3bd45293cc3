"""How the errors grow from one sample to the next: transition F and noise Q (Gui eq. 12-19, Zhou eq. 7-9).

With the definitions of `error_state.py` the errors obey
    d position / dt = velocity error
    d velocity / dt = -[f x] attitude - R accel_bias + noise          (f: specific force in the world frame)
    d attitude / dt = -R gyro_bias + noise
    d bias / dt = -bias / correlation time + noise                    (first-order Markov)
Gui eq. 18 prints +beta for the Markov terms, opposite to its eq. 15-16, which would make the biases diverge, and calls
beta a time constant though it is the inverse of one. `Link` and `carry` are the exact derivative of
`mechanisation.advance`, up to second order in the rotation of one interval; the tests compare them with finite
differences. F itself is mostly zeros, so it is never built: `carry` multiplies by it.
"""

from typing import NamedTuple

import numpy as np

from pdr_core.eskf.error_state import ACCEL_BIAS, ATTITUDE, GYRO_BIAS, POSITION, SIZE, VELOCITY
from pdr_core.maths.compiled import compiled
from pdr_core.maths.kalman import symmetrise
from pdr_core.maths.vector import Matrix, Rows, Triple, Vector, column, cross, difference, mean, rotated, scaled
from pdr_core.records import Floats


class ProcessNoise(NamedTuple):
    """What drives the errors beside the sensor's own noise."""

    accel_bias_walk: float  # [m/s^2/sqrt(s)]
    gyro_bias_walk: float  # [rad/s/sqrt(s)]
    bias_correlation_s: float
    gap_speed_mps: float
    gap_rate_radps: float
    share_about_up: float = 1.0  # of the noise of a rate: less, where the turn about the vertical is known better


class Link(NamedTuple):
    """One interval as the errors see it: what the blocks of F are made of."""

    dt_s: float
    bias_decay: float
    force_mps2: Triple  # mean over the interval, in the world frame
    turned_force_mps: Triple  # force at its end times half its length: what the turn within it acts on
    mean_R: Rows  # noqa: N815  world from foot


NO_TIME = Link(0.0, 1.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))  # F = I


@compiled
def link(
    R_before: Matrix, R_after: Matrix, force_before: Vector, force_after: Vector, dt_s: float, correlation_s: float
) -> Link:
    """Return what F is made of; rotations as `advance` returns them, forces [m/s^2] in the foot frame, without bias."""
    after = rotated(R_after, force_after)
    force = mean(rotated(R_before, force_before), after)
    mean_R = mean(R_before[0], R_after[0]), mean(R_before[1], R_after[1]), mean(R_before[2], R_after[2])
    return Link(dt_s, np.exp(-dt_s / correlation_s), force, scaled(0.5 * dt_s, after), mean_R)


@compiled
def carry(k: Link, M: Floats) -> None:
    """Replace M, (15, m), by F M."""
    for j in range(M.shape[1]):
        turn = rotated(k.mean_R, column(M, GYRO_BIAS, j))
        tilted = difference(cross(k.turned_force_mps, turn), cross(k.force_mps2, column(M, ATTITUDE, j)))
        accel = difference(tilted, rotated(k.mean_R, column(M, ACCEL_BIAS, j)))
        for i in range(3):
            M[POSITION + i, j] += k.dt_s * (M[VELOCITY + i, j] + 0.5 * k.dt_s * accel[i])
            M[VELOCITY + i, j] += k.dt_s * accel[i]
            M[ATTITUDE + i, j] -= k.dt_s * turn[i]
            M[ACCEL_BIAS + i, j] *= k.bias_decay
            M[GYRO_BIAS + i, j] *= k.bias_decay


@compiled
def propagate_covariance(P: Floats, k: Link, q: Floats) -> None:
    """Replace P, (15, 15), by F P F' + diag(q) (Gui eq. 17, Zhou eq. 9), exactly symmetric."""
    carry(k, P)
    transpose(P)
    carry(k, P)
    for i in range(SIZE):
        P[i, i] += q[i]
    symmetrise(P)


@compiled
def transpose(P: Floats) -> None:
    """Transpose a square matrix in place."""
    for i in range(P.shape[0]):
        for j in range(i):
            upper = P[j, i]
            P[j, i] = P[i, j]
            P[i, j] = upper


@compiled
def noise(accel_sd_mps2: float, gyro_sd_radps: float, dt_s: float, process: ProcessNoise) -> Floats:
    """Return the diagonal of Q, (15,), over one interval: white sensor noise and the drift of the biases."""
    q = np.empty(SIZE)
    velocity_sd = accel_sd_mps2 * dt_s
    for i in range(3):
        q[POSITION + i] = (0.5 * velocity_sd * dt_s) ** 2
        q[VELOCITY + i] = velocity_sd**2
        q[ATTITUDE + i] = (gyro_sd_radps * dt_s) ** 2
        q[ACCEL_BIAS + i] = process.accel_bias_walk**2 * dt_s
        q[GYRO_BIAS + i] = process.gyro_bias_walk**2 * dt_s
    q[ATTITUDE + 2] *= process.share_about_up**2
    return q


@compiled
def cross_gap(P: Floats, cross: Floats, dt_s: float, process: ProcessNoise) -> None:
    """Let P (15, 15) and the covariances `cross` (15, m) cross a gap in which a person may have walked and turned.

    The velocity is forgotten: a foot may end a gap at any phase of its swing. The position wanders, at random below a
    second and steadily beyond.
    """
    forget_velocity(P)
    forget_velocity(P.T)
    forget_velocity(cross)
    spread_s2 = dt_s * max(dt_s, 1.0)
    turn_rad2 = min(process.gap_rate_radps**2 * spread_s2, np.pi**2)  # more than unknown it cannot be
    for i in range(3):
        P[POSITION + i, POSITION + i] += process.gap_speed_mps**2 * spread_s2
        P[VELOCITY + i, VELOCITY + i] = process.gap_speed_mps**2
        P[ATTITUDE + i, ATTITUDE + i] += turn_rad2


@compiled
def forget_velocity(M: Floats) -> None:
    """Replace M, (15, m), by F M across a gap."""
    M[VELOCITY : VELOCITY + 3] = 0.0
