"""The Kalman filter's algebra for any state size: the only code that writes a covariance."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.maths.vector import inverse_symmetric, product
from pdr_core.records import Floats


@compiled
def predict(P: Floats, F: Floats, q: Floats) -> None:
    """Replace the covariance P (n, n) by F P F' + diag(q), kept symmetric (Gui eq. 17, Zhou eq. 9)."""
    half = product(F, P)
    P[:] = product(F, half.T.copy())  # (F (F P)')' = F P F', which is symmetric
    n = P.shape[0]
    for i in range(n):
        P[i, i] += q[i]
    symmetrise(P)


@compiled
def symmetrise(P: Floats) -> None:
    """Average P (n, n) with its transpose."""
    for i in range(P.shape[0]):
        for j in range(i):
            mean = 0.5 * (P[i, j] + P[j, i])
            P[i, j] = mean
            P[j, i] = mean


@compiled
def innovation_covariance(P: Floats, H: Floats, R: Floats) -> Floats:
    """Return S = H P H' + R, (m, m)."""
    return product(product(H, P), H.T.copy()) + R


@compiled
def normalised_innovation_squared(residual: Floats, S: Floats) -> float:
    """Return y' S^-1 y, which is chi-square distributed with m degrees of freedom where all is modelled."""
    weighted = product(inverse_symmetric(S), residual.reshape(-1, 1))[:, 0]
    return np.sum(residual * weighted)


@compiled
def gain(P: Floats, H: Floats, S: Floats) -> Floats:
    """Return the optimal gain K = P H' S^-1, (n, m) (Gui eq. 20, Zhou eq. 13)."""
    return product(product(P, H.T.copy()), inverse_symmetric(S))


@compiled
def correct(P: Floats, K: Floats, H: Floats, R: Floats) -> None:
    """Replace P by (I - K H) P (I - K H)' + K R K'.

    Joseph's form holds for any gain, also for one with rows set to zero; the shorter form of Gui eq. 26 and Zhou
    eq. 12 holds for the optimal gain alone.
    """
    half = P - product(K, product(H, P))
    Kt = K.T.copy()
    P[:] = half - product(product(half, H.T.copy()), Kt) + product(K, product(R, Kt))
    symmetrise(P)
