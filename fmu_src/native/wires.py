"""Connect variables of an FMU's table with members of records, and make the functions that copy one to the other."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Mapping
from typing import Any

import numpy as np
from numba import carray

from contact.kernels.records import CASE
from fmu_src.native.memory import compiled, integers_of, numbers_of
from fmu_src.variables import Table, identifier

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


def references(table: Table) -> Any:
    """Return a named tuple of the value references of the table's rows."""
    return namedtuple("References", map(identifier, table.span))(*(span.start for span in table.span.values()))


def _wired(
    table: Table, dtype: np.dtype, wires: Mapping[str, str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return four arrays: value references, positions in the record, whether a member is an integer, and value offsets.

    The offset is needed for enumerations: their items count from 1, the values of a member from 0.
    """
    assert dtype.fields is not None
    references = np.array([table.span[name].start for name in wires])
    places = np.array([dtype.fields[member][1] // 8 for member in wires.values()])
    whole = np.array([dtype.fields[member][0].kind == "i" for member in wires.values()])
    first = np.array([0.0 if table.row[name].enumeration is None else 1.0 for name in wires])
    return references, places, whole, first


def reader(table: Table, dtype: np.dtype, wires: Mapping[str, str]) -> Any:
    """Return a compiled function `read(v, records)` that copies values to the first record."""
    references, places, whole, first = _wired(table, dtype, wires)
    size = dtype.itemsize // 8

    @compiled
    def read(v, records):
        numbers, integers = carray(numbers_of(records), (size,)), carray(integers_of(records), (size,))
        for i in range(references.size):
            if whole[i]:
                integers[places[i]] = int(v[references[i]] - first[i])
            else:
                numbers[places[i]] = v[references[i]] - first[i]

    return read


def writer(table: Table, dtype: np.dtype, wires: Mapping[str, str]) -> Any:
    """Return a compiled function `write(v, records)` that copies members of the first record to values.

    The value of a status is already the number of its item.
    """
    references, places, whole, _ = _wired(table, dtype, wires)
    size = dtype.itemsize // 8

    @compiled
    def write(v, records):
        numbers, integers = carray(numbers_of(records), (size,)), carray(integers_of(records), (size,))
        for i in range(references.size):
            v[references[i]] = float(integers[places[i]]) if whole[i] else numbers[places[i]]

    return write


def case_reader(table: Table, wires: Mapping[str, str]) -> Any:
    """Return a compiled function that fills a case from values: the members in `wires`, and friction with its heat."""
    from fmu_src.native.solver import heating

    read = reader(table, CASE, {**SURFACE, **wires})
    hot, reference, background, conductivity, density, capacity, share = (
        table.span[name].start
        for name in (
            "friction.hot_factor",
            "friction.reference_temperature",
            "friction.background_temperature",
            "thermal.conductivity",
            "thermal.density",
            "thermal.heat_capacity",
            "thermal.heat_share",
        )
    )

    @compiled
    def read_case(v, cases):
        read(v, cases)
        case = cases[0]
        case.drop, case.warm = 1.0 - v[hot], v[reference] - v[background]
        case.heating = heating(v[conductivity], v[density], v[capacity], v[share])

    return read_case
