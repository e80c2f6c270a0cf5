"""Influence of strips on each other: the tables that kernels interpolate."""

from __future__ import annotations

import functools

import numpy as np

from contact.arrays import Array
from contact.core import COMPILING, library
from contact.kernels.normal import influence


@functools.cache
def tables() -> tuple[Array, Array]:
    """Return U on the centre line, shape (401, 2), and over (X, ln t), shape (203, 534), from the library if there is one."""
    if not COMPILING:
        return library.constants(1, influence.CENTRE), library.constants(2, influence.PLANE)
    centre, plane = np.empty(influence.CENTRE), np.empty(influence.PLANE)
    influence.fill(centre, plane)
    for table in (centre, plane):
        table.setflags(write=False)
    return centre, plane
