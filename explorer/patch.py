"""Entries that the page calls: those of the native FMU `WheelRailPair`, and the fields of one of its patches."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import carray

from contact.compile.library import Added
from contact.kernels.block import ahead
from contact.kernels.pair_patches import solve_patch
from contact.kernels.rows import DamageField, Field, Strip
from contact_fmu.native import kinds, wheel_rail_pair
from contact_fmu.tables.wheel_rail_pair import ACCUMULATED, table

#: Rows of a patch that the page draws, one number a strip.
STRIPS = (Strip.Y, Strip.DY, Strip.XC, Strip.A)
#: Rows with one number an element. After them comes the energy index.
FIELDS = (Field.X, Field.DX, Field.P, Field.QX, Field.QY, Field.SX, Field.SY, Field.STICK)
N_ELEMENT_ROWS = len(FIELDS) + 1

_STRIPS, _FIELDS = np.array(STRIPS), np.array(FIELDS)  # an index into a tuple could raise an exception


def added() -> list[Added]:
    """Return what the page adds to the kernels (`contact.compile.library`). It compiles them itself."""
    return kinds.of_kind("page", entries(), "")


def entries() -> dict[str, Callable[..., Any]]:
    """Return the entries of WheelRailPair, with a `model_field` that writes patch k behind the values.

    It writes the rows STRIPS and then those of FIELDS and the energy index, row by row, with as many strips as it returns.
    """
    rows = table()
    arrange = wheel_rail_pair.layout_of(rows).arrange
    n_values = rows.span[ACCUMULATED[0]].start
    elements = rows.span["resolution.n_elements"].start
    energy = DamageField.ENERGY_INDEX

    def model_field(values, work, k, given):
        v = carray(values, (n_values,))
        arrays, _, _ = arrange(v, work, given)
        workspace, n = arrays.workspace, solve_patch(k, arrays)
        m = int(v[elements])
        by_strip = carray(ahead(values, n_values), (len(STRIPS), n))
        by_element = carray(ahead(values, n_values + len(STRIPS) * n), (N_ELEMENT_ROWS, n, m))
        for i in range(n):
            for row in range(_STRIPS.size):
                by_strip[row, i] = workspace.strips[_STRIPS[row], i]
            for j in range(m):
                for row in range(_FIELDS.size):
                    by_element[row, i, j] = workspace.fields[_FIELDS[row], i, j]
                by_element[_FIELDS.size, i, j] = arrays.damage_fields[energy, i, j]
        return n

    return {**wheel_rail_pair.entries(), "model_field": model_field}
