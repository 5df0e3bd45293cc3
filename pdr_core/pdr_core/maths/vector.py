"""Small vectors and matrices in compiled code, without the cost of general linear algebra.

Vectors of three and (3, 3) matrices are returned as tuples, which cost nothing in compiled code; an array must be
allocated.
"""

import numpy as np

from pdr_core.maths.compiled import compiled
from pdr_core.records import Floats

Triple = tuple[float, float, float]
Vector = Triple | Floats  # three numbers
Rows = tuple[Triple, Triple, Triple]
Matrix = Rows | Floats  # (3, 3)


@compiled
def dot(u: Vector, v: Vector) -> float:
    """Return u' v."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


@compiled
def cross(u: Vector, v: Vector) -> Triple:
    """Return u x v."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


@compiled
def rotated(R: Matrix, v: Vector) -> Triple:
    """Return R v."""
    return dot(R[0], v), dot(R[1], v), dot(R[2], v)


@compiled
def transposed(R: Matrix) -> Rows:
    """Return R', which for a rotation is the inverse."""
    return (R[0][0], R[1][0], R[2][0]), (R[0][1], R[1][1], R[2][1]), (R[0][2], R[1][2], R[2][2])


@compiled
def each_rotated(R: Floats, vectors: Floats) -> Floats:
    """Return R v for every row v of (n, 3); row by row, so that one sample gives the same bits as many."""
    out = np.empty_like(vectors)
    for i in range(vectors.shape[0]):
        out[i] = rotated(R, vectors[i])
    return out


@compiled
def scaled(factor: float, v: Vector) -> Triple:
    """Return factor v."""
    return factor * v[0], factor * v[1], factor * v[2]


@compiled
def mean(u: Vector, v: Vector) -> Triple:
    """Return (u + v) / 2."""
    return 0.5 * (u[0] + v[0]), 0.5 * (u[1] + v[1]), 0.5 * (u[2] + v[2])


@compiled
def added(u: Vector, v: Vector) -> Triple:
    """Return u + v."""
    return u[0] + v[0], u[1] + v[1], u[2] + v[2]


@compiled
def difference(u: Vector, v: Vector) -> Triple:
    """Return u - v."""
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


@compiled
def row(M: Floats, i: int) -> Triple:
    """Return row i of (n, 3)."""
    return M[i, 0], M[i, 1], M[i, 2]


@compiled
def column(M: Floats, row: int, j: int) -> Triple:
    """Return three numbers of column j, from a row on."""
    return M[row, j], M[row + 1, j], M[row + 2, j]


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
def norm(v: Vector) -> float:
    """Return the Euclidean length."""
    return np.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)


@compiled
def within(v: Vector, bound: float) -> bool:
    """Return whether every magnitude is below the bound; NaN never is."""
    return abs(v[0]) < bound and abs(v[1]) < bound and abs(v[2]) < bound


@compiled
def cholesky(S: Floats) -> Floats:
    """Return the lower triangle L, (n, n), of a symmetric positive definite matrix S = L L'."""
    L = np.zeros(S.shape)
    for i in range(S.shape[0]):
        for j in range(i + 1):
            rest = S[i, j]
            for k in range(j):
                rest -= L[i, k] * L[j, k]
            L[i, j] = np.sqrt(rest) if i == j else rest / L[j, j]
    return L


@compiled
def solve_positive(S: Floats, B: Floats) -> None:
    """Replace B, (n, m), by S^-1 B, for S (n, n) symmetric and positive definite."""
    L, n = cholesky(S), S.shape[0]
    for i in range(n):
        for k in range(i):
            for j in range(B.shape[1]):
                B[i, j] -= L[i, k] * B[k, j]
        for j in range(B.shape[1]):
            B[i, j] /= L[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            for j in range(B.shape[1]):
                B[i, j] -= L[k, i] * B[k, j]
        for j in range(B.shape[1]):
            B[i, j] /= L[i, i]


@compiled
def inverse_positive(S: Floats) -> Floats:
    """Return the inverse of a small symmetric positive definite matrix (n, n): Cholesky's L, its inverse, L'^-1 L^-1.

    LAPACK would do it too, but takes as long for the call as this for the work, and 0.4 s to load.
    """
    n = S.shape[0]
    L = cholesky(S)
    M = np.zeros((n, n))  # the inverse of L
    for i in range(n):
        M[i, i] = 1.0 / L[i, i]
        for j in range(i):
            for k in range(j, i):
                M[i, j] -= L[i, k] * M[k, j] / L[i, i]
    return product(M.T, M)
