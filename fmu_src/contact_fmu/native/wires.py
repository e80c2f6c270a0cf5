"""The functions that copy variables of an FMU to members of records and back, as its table says (`Variable.member`)."""

from __future__ import annotations

from collections import namedtuple
from typing import Any

import numpy as np
from numba import carray

import contact
from contact.compile.pointers import integers_of, numbers_of
from contact.core import arranging
from contact.inputs import material
from contact.kernels.arrays import Size
from contact.kernels.records import CASE
from ..rows import identifier
from ..variables import Table
from .component import numbers, places

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
    """Return `numbers` of a table, which compiled code reads by their names: an array of one record `places`."""
    return numbers(table).view(places(table))


def _wired(
    table: Table, record: str, dtype: np.dtype, *, given: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return four arrays: positions in `places`, positions in the record, whether a member is an integer, and value offsets.

    The offset is needed for enumerations: their items count from 1, the values of a member from 0.
    """
    assert dtype.fields is not None
    wires, names = table.members(record, given=given), places(table).names
    references = np.array([names.index(identifier(name)) for name in wires])
    positions = np.array([dtype.fields[member][1] // 8 for member in wires.values()])
    whole = np.array([dtype.fields[member][0].kind == "i" for member in wires.values()])
    first = np.array([0.0 if table.row[name].enumeration is None else 1.0 for name in wires])
    return references, positions, whole, first


def reader(table: Table, record: str, dtype: np.dtype) -> Any:
    """Return a compiled function `read(v, at, records)` that copies given values to the first record.

    `at` is an array of one record `places` of a table with the rows of `table`.
    """
    references, positions, whole, first = _wired(table, record, dtype, given=True)
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


def writer(table: Table, record: str, dtype: np.dtype) -> Any:
    """Return a compiled function `write(v, at, records, k)` that copies members of the first record to element k of outputs.

    The value of a status is already the number of its item.
    """
    references, positions, whole, _ = _wired(table, record, dtype, given=False)
    size, n_places = dtype.itemsize // 8, len(places(table))

    @arranging
    def write(v, at, records, k):
        numbers, integers = carray(numbers_of(records), (size,)), carray(integers_of(records), (size,))
        starts = carray(integers_of(at), (n_places,))
        for i in range(references.size):
            v[starts[references[i]] + k] = float(integers[positions[i]]) if whole[i] else numbers[positions[i]]

    return write


def case_reader(table: Table) -> Any:
    """Return a compiled function that fills a case from values: its members, and the heat of friction."""
    read = reader(table, "case", CASE)

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
