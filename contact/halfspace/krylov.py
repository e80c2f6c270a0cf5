"""GMRES without a matrix (Saad and Schultz 1986), preconditioned on the right."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from contact.arrays import Array


def dot(a: Array, b: Array) -> float:
    """Return the scalar product of two fields. einsum runs in this thread; BLAS would use all cores for few terms."""
    return float(np.einsum("i,i->", a.ravel(), b.ravel()))


def size(a: Array) -> float:
    """Return the Euclidean norm of a field."""
    return math.sqrt(dot(a, a))


def gmres(
    apply: Callable[[Array], Array],
    precondition: Callable[[Array], Array],
    rhs: Array,
    tolerance: float,
    most: int,
) -> tuple[Array, int]:
    """Solve apply(v) = rhs to |residual| <= tolerance·|rhs|, in at most `most` steps.

    Returns
    -------
    v, steps
        The best solution found, and the number of calls of `apply`.
    """
    start = size(rhs)
    if start == 0.0:
        return np.zeros_like(rhs), 0
    basis, solved = np.empty((most + 1, rhs.size)), np.empty((most, rhs.size))
    basis[0] = rhs.ravel() / start
    hessenberg, rotations = np.zeros((most + 1, most)), np.zeros((2, most))
    residual = np.zeros(most + 1)
    residual[0] = start
    steps = most
    for j in range(most):
        ready = precondition(basis[j].reshape(rhs.shape))
        solved[j] = ready.ravel()
        v = apply(ready).ravel()
        known = basis[: j + 1]
        for _ in range(2):  # the second pass keeps the basis orthogonal to round-off
            parts = np.einsum("ij,j->i", known, v)
            v = v - np.einsum("i,ij->j", parts, known)
            hessenberg[: j + 1, j] += parts
        length = size(v)
        column = hessenberg[:, j]
        for i in range(j):
            c, s = rotations[:, i]
            column[i], column[i + 1] = c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]
        diagonal = math.hypot(column[j], length)
        c, s = rotations[:, j] = (column[j] / diagonal, length / diagonal) if diagonal > 0.0 else (1.0, 0.0)
        column[j] = diagonal
        residual[j], residual[j + 1] = c * residual[j], -s * residual[j]
        if abs(residual[j + 1]) <= tolerance * start or length <= 1e-14 * diagonal:
            steps = j + 1
            break
        basis[j + 1] = v / length
    weights = np.zeros(steps)
    for i in range(steps - 1, -1, -1):
        if hessenberg[i, i] != 0.0:
            weights[i] = (residual[i] - float(hessenberg[i, i + 1 : steps] @ weights[i + 1 :])) / hessenberg[i, i]
    return np.einsum("i,ij->j", weights, solved[:steps]).reshape(rhs.shape), steps
