"""Ellipses that stand for a patch or for a strip of it, and the flexibilities of simplified theory on them (theory.md 2.5)."""

import math

from contact._jit import kernel
from contact.kernels import kalker
from contact.kernels.layout import Strip


@kernel
def equivalent_ellipse(strips, n):
    """Semi-axes of the ellipse with the longest strip as a and the area of the patch."""
    a = 0.0
    area = 0.0
    for i in range(n):
        a = max(a, strips[Strip.A, i])
        area += 2.0 * strips[Strip.A, i] * strips[Strip.DY, i]
    return a, (area / (math.pi * a) if a > 0.0 else 0.0)


@kernel
def mean_ellipse(strips, first, last):
    """Semi-axes of the ellipse with the area of the patch and its mean length: ∫a² dy/∫a dy is 8a/(3π) on an ellipse."""
    area, square = 0.0, 0.0
    for i in range(first, last):
        area += strips[Strip.A, i] * strips[Strip.DY, i]
        square += strips[Strip.A, i] ** 2 * strips[Strip.DY, i]
    a = 0.375 * math.pi * square / area
    return a, 2.0 * area / (math.pi * a)


@kernel
def flexibilities(G, a, b, table):
    """L1, L2, L3 [m/Pa] with which the forces of vanishing creepage are Kalker's (thesis Eqs. 4.28-4.30); 1 for no ellipse."""
    if a <= 0.0 or b <= 0.0:
        return 1.0, 1.0, 1.0
    c11, c22, c23, _ = kalker.coefficients(table, math.log(a / b))
    return (
        8.0 * a / (3.0 * G * c11),
        8.0 * a / (3.0 * G * c22),
        math.pi * a * a / (4.0 * G * math.sqrt(a * b) * c23),
    )


@kernel
def weighted(vx, vy, phi, c, L1, L2, L3):
    """The one flexibility, (|vx| L1 + |vy| L2 + |phi| c L3)/√(vx² + vy² + phi² c²) (Kalker 1982; thesis Eqs. 4.31-4.32)."""
    spin = c * phi
    size = math.sqrt(vx * vx + vy * vy + spin * spin)
    return (abs(vx) * L1 + abs(vy) * L2 + abs(spin) * L3) / size if size > 0.0 else L1
