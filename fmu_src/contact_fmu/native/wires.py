"""Connect variables of an FMU's table with members of records, and make the functions that copy one to the other."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Mapping
from typing import Any

import numpy as np
from numba import carray

import contact
from contact.compile.pointers import integers_of, numbers_of
from contact.core import arranging
from contact.inputs import material
from contact.kernels.arrays import Size
from contact.kernels.records import CASE
from ..variables import Table, identifier
from .component import numbers, places

#: Inputs and parameters of a contact → members of the record CASE.
SURFACE = {
    "friction.coefficient": "mu",
    "friction.law": "law",
    "friction.kinetic": "kinetic",
    "friction.half_speed": "half_speed",
    "friction.slope": "slope",
    "friction.slope_far": "slope_far",
    "friction.slope_rate": "slope_rate",
    "friction.velocity": "velocity",
    "friction.gauge_factor": "gauge_factor",
    "friction.border": "border",
    "friction.border_width": "border_width",
    "friction.k_A": "k_A",
    "friction.k_S": "k_S",
    "friction.temperature_range": "warm_range",
}
MATERIAL = {
    "material.shear_modulus": "G",
    "material.poisson_ratio": "nu",
    "material.pressure_limit": "pressure_limit",
    "method.max_iterations": "max_iterations",
}

_METHODS = contact.methods().batched
#: Indexed by the value of `method.normal` or `method.tangential`, less 1.
_NORMAL = np.array([(int(m.id), int(m.family), int(m.interacting)) for m in _METHODS.normal.values()])
_TANGENTIAL = np.array([(int(m.id), int(m.family)) for m in _METHODS.tangential.values()])
_heating = arranging(material.heating)


@arranging
def size_of(normal, n_strips, n_elements, samples):
    """Return the sizes of a workspace. `normal` is the value of `method.normal`."""
    return Size(n_strips, n_elements, samples, _NORMAL[normal - 1, 2], 1)


@arranging
def choose(normal, tangential, case):
    """Write the methods into a case. The arguments are the values of `method.normal` and `method.tangential`."""
    case.normal, case.normal_family = _NORMAL[normal - 1, 0], _NORMAL[normal - 1, 1]
    case.tangential, case.tangential_family = _TANGENTIAL[tangential - 1, 0], _TANGENTIAL[tangential - 1, 1]


def references(table: Table) -> Any:
    """Return a named tuple of the value references of the table's rows, for a table without options that change them."""
    return namedtuple("References", map(identifier, table.span))(*(span.start for span in table.span.values()))


def constant(table: Table) -> np.ndarray:
    """Return the same as an array of one record `places`."""
    return numbers(table).view(places(table))


def _wired(
    table: Table, dtype: np.dtype, wires: Mapping[str, str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return four arrays: positions in `places`, positions in the record, whether a member is an integer, and value offsets.

    The offset is needed for enumerations: their items count from 1, the values of a member from 0.
    """
    assert dtype.fields is not None
    names = places(table).names
    references = np.array([names.index(identifier(name)) for name in wires])
    positions = np.array([dtype.fields[member][1] // 8 for member in wires.values()])
    whole = np.array([dtype.fields[member][0].kind == "i" for member in wires.values()])
    first = np.array([0.0 if table.row[name].enumeration is None else 1.0 for name in wires])
    return references, positions, whole, first


def reader(table: Table, dtype: np.dtype, wires: Mapping[str, str]) -> Any:
    """Return a compiled function `read(v, at, records)` that copies values to the first record.

    `at` is an array of one record `places` of a table with the rows of `table`.
    """
    references, positions, whole, first = _wired(table, dtype, wires)
    size, n_places = dtype.itemsize // 8, len(places(table))

    @arranging
    def read(v, at, records):
        numbers, integers = carray(numbers_of(records), (size,)), carray(integers_of(records), (size,))
        starts = carray(integers_of(at), (n_places,))
        for i in range(references.size):
            value = v[starts[references[i]]] - first[i]
            if whole[i]:
                integers[positions[i]] = int(value)
            else:
                numbers[positions[i]] = value

    return read


def writer(table: Table, dtype: np.dtype, wires: Mapping[str, str]) -> Any:
    """Return a compiled function `write(v, at, records)` that copies members of the first record to values.

    The value of a status is already the number of its item.
    """
    references, positions, whole, _ = _wired(table, dtype, wires)
    size, n_places = dtype.itemsize // 8, len(places(table))

    @arranging
    def write(v, at, records):
        numbers, integers = carray(numbers_of(records), (size,)), carray(integers_of(records), (size,))
        starts = carray(integers_of(at), (n_places,))
        for i in range(references.size):
            v[starts[references[i]]] = float(integers[positions[i]]) if whole[i] else numbers[positions[i]]

    return write


def case_reader(table: Table, wires: Mapping[str, str]) -> Any:
    """Return a compiled function that fills a case from values: the members in `wires`, and friction with its heat."""
    read = reader(table, CASE, {**SURFACE, **wires})

    @arranging
    def read_case(v, places, cases):
        read(v, places, cases)
        case, at = cases[0], places[0]
        case.tolerance = 0.0
        case.drop = 1.0 - v[at.friction_hot_factor]
        case.warm = v[at.friction_reference_temperature] - v[at.friction_background_temperature]
        case.heating = _heating(
            v[at.thermal_conductivity], v[at.thermal_density], v[at.thermal_heat_capacity], v[at.thermal_heat_share]
        )

    return read_case
