"""Small vectors in compiled code, without the cost of general linear algebra."""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats


@compiled
def cross_matrix(v: Floats) -> Floats:
    """Return [v x], (3, 3), so that [v x] u = v x u."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


@compiled
def rotated(R: Floats, v: Floats) -> Floats:
    """Return R v for a (3, 3) matrix and a (3,) vector."""
    return np.array(
        [
            R[0, 0] * v[0] + R[0, 1] * v[1] + R[0, 2] * v[2],
            R[1, 0] * v[0] + R[1, 1] * v[1] + R[1, 2] * v[2],
            R[2, 0] * v[0] + R[2, 1] * v[1] + R[2, 2] * v[2],
        ]
    )


@compiled
def product(A: Floats, B: Floats) -> Floats:
    """Return A B for small matrices, (m, k) and (k, n)."""
    out = np.zeros((A.shape[0], B.shape[1]))
    for i in range(A.shape[0]):
        for k in range(A.shape[1]):
            a = A[i, k]
            if a != 0.0:
                for j in range(B.shape[1]):
                    out[i, j] += a * B[k, j]
    return out


@compiled
def norm(v: Floats) -> float:
    """Return the Euclidean length of a (3,) vector."""
    return np.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)


@compiled
def inverse_symmetric(S: Floats) -> Floats:
    """Return the inverse of a symmetric positive definite (n, n) matrix by Cholesky's method."""
    n = S.shape[0]
    L = np.zeros((n, n))
    for i in range(n):
        for j in range(i + 1):
            total = S[i, j]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            L[i, j] = np.sqrt(total) if i == j else total / L[j, j]
    out = np.zeros((n, n))
    for c in range(n):
        y = np.zeros(n)
        for i in range(n):
            total = 1.0 if i == c else 0.0
            for k in range(i):
                total -= L[i, k] * y[k]
            y[i] = total / L[i, i]
        for i in range(n - 1, -1, -1):
            total = y[i]
            for k in range(i + 1, n):
                total -= L[k, i] * out[k, c]
            out[i, c] = total / L[i, i]
    return out
