"""The Kalman filter's algebra for any state and measurement: innovation, gain, correction; and the smoother's."""

from typing import NamedTuple

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import inverse_positive, product, solve_positive
from pdr_core.records import Floats

HIDDEN_SHARE = 1e-13  # of every variance, so that rounding leaves a covariance positive; .3 millionth of a deviation


class Innovation(NamedTuple):
    """What a measurement says beyond the prediction."""

    residual: Floats  # (m,) truth minus estimate
    HP: Floats  # (m, n) covariance of measurement and state
    S: Floats  # (m, m) covariance of the residual
    S_inverse: Floats  # (m, m)


@compiled
def innovation(P: Floats, H: Floats, R: Floats, residual: Floats) -> Innovation:
    """Return the innovation of a measurement with Jacobian H (m, n) and noise R (m, m) on the covariance P (n, n)."""
    HP = product(H, P)
    S = product(H, HP.T)
    S += R
    return Innovation(residual, HP, S, inverse_positive(S))


@compiled
def normalised_squared(y: Innovation) -> float:
    """Return y' S^-1 y, which is chi-square distributed with m degrees of freedom where the model holds."""
    total = 0.0
    for i in range(y.residual.shape[0]):
        for j in range(y.residual.shape[0]):
            total += y.residual[i] * y.S_inverse[i, j] * y.residual[j]
    return total


@compiled
def gain(y: Innovation) -> Floats:
    """Return the optimal gain K = P H' S^-1, (n, m) (Gui eq. 20, Zhou eq. 13)."""
    return product(y.S_inverse, y.HP).T


@compiled
def correct(P: Floats, K: Floats, y: Innovation) -> None:
    """Replace P by Joseph's form (I - K H) P (I - K H)' + K R K', in place.

    It holds for any gain, also for one with rows set to zero; the shorter (I - K H) P of Gui eq. 26 and Zhou eq. 12
    holds for the optimal gain alone. Multiplied out it is P - K HP - (K HP)' + K S K', and with B = HP - S K' / 2 it is
    P - K B - (K B)': symmetric by construction, at a tenth of the cost.
    """
    B = product(y.S, K.T)
    B *= -0.5
    B += y.HP
    for m in range(K.shape[1]):
        for i in range(P.shape[0]):
            for j in range(P.shape[0]):
                P[i, j] -= K[i, m] * B[m, j] + K[j, m] * B[m, i]


@compiled
def estimated_error(K: Floats, y: Innovation) -> Floats:
    """Return K y, (n,): what the measurement says of the errors."""
    error = np.zeros(K.shape[0])
    for i in range(K.shape[0]):
        for m in range(K.shape[1]):
            error[i] += K[i, m] * y.residual[m]
    return error


@compiled
def correct_cross(C: Floats, K: Floats, HC: Floats) -> None:
    """Correct C, (n, k), the covariance of the state with something that is not corrected, in place.

    HC, (m, k), is the covariance of the measurement with it: H C, and more where the measurement shows it too.
    """
    for m in range(K.shape[1]):
        for i in range(C.shape[0]):
            for j in range(C.shape[1]):
                C[i, j] -= K[i, m] * HC[m, j]


@compiled
def symmetrise(P: Floats) -> None:
    """Make a matrix that rounding has made lopsided exactly symmetric, in place."""
    for i in range(P.shape[0]):
        for j in range(i):
            mean = 0.5 * (P[i, j] + P[j, i])
            P[i, j] = mean
            P[j, i] = mean


@compiled
def smoother_gain(cross: Floats, P: Floats) -> Floats:
    """Return C = cross' P^-1, (m, n): the best estimate of an earlier error is C times a later one.

    P (n, n) is the covariance of the later error, `cross` (n, m) that of the later with the earlier one. Each error is
    scaled by its deviation first, for they differ by powers of ten; one that is certain tells nothing.
    """
    n = P.shape[0]
    scale, scaled, C_transposed = np.zeros(n), np.empty((n, n)), np.empty_like(cross)
    for i in range(n):
        scale[i] = 1.0 / np.sqrt(P[i, i]) if P[i, i] > 0.0 else 0.0
    for i in range(n):
        for j in range(n):
            scaled[i, j] = P[i, j] * scale[i] * scale[j]
        scaled[i, i] = 1.0 + HIDDEN_SHARE
        C_transposed[i] = cross[i] * scale[i]
    solve_positive(scaled, C_transposed)
    for i in range(n):
        C_transposed[i] *= scale[i]
    return C_transposed.T


@compiled
def smoothed(P: Floats, C: Floats, P_later: Floats, P_later_smoothed: Floats) -> None:
    """Replace P by P + C (P_later_smoothed - P_later) C', in place: it holds for any gain of the filter."""
    change = product(C, product(P_later_smoothed - P_later, C.T))
    for i in range(P.shape[0]):
        for j in range(P.shape[0]):
            P[i, j] += 0.5 * (change[i, j] + change[j, i])
