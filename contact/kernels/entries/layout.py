"""Lay out and fill a workspace in raw memory, with the layouts of `contact.kernels.memory`."""

from __future__ import annotations

from typing import Any

from contact.core import COMPILING, arranging
from contact.kernels import block, memory, quadrature
from contact.kernels.arrays import Size, Tables, Workspace
from contact.kernels.kalker import N_TABLE, fill_table
from contact.kernels.normal import influence
from contact.kernels.normal.between_panels import fill_probes
from contact.kernels.normal.descent import fill_descent
from contact.kernels.normal.factors import fill_factors
from contact.kernels.records import MAX_PATCHES
from contact.kernels.tangential.table import SHAPE as CREEP

#: Entry → function, type of the result, types of the arguments.
Entries = dict[str, tuple[Any, str, tuple[str, ...]]]

if COMPILING:
    from numba import carray


@arranging
def size_of(sizes):
    """Return the `Size` in the first four numbers of `sizes`: interacting, strips, elements, samples."""
    s = carray(sizes, (4,))
    return Size(int(s[1]), int(s[2]), int(s[3]), int(s[0]), 1)


@arranging
def lay_out(work, end, kept, size, constants):
    """Lay out a workspace in `work` from index `end` on. Return it, the index of its strips, and the index where it ends.

    `kept` is the memory of the warm start, of size `memory_size`; `constants` are pointers to the arrays of `tables.data`.
    """
    _, centre, plane, creep = constants
    rule, end = memory.lay_rule(work, end, size)
    coefficients, end = block.matrix(work, end, N_TABLE, 8)
    space, at_strips = memory.lay_space(work, end, size, kept)
    strips, fields, end = memory.lay_strips_and_fields(work, at_strips, size)
    tables = Tables(
        coefficients, carray(centre, influence.CENTRE), carray(plane, influence.PLANE), carray(creep, CREEP)
    )
    return Workspace(rule, tables, space, strips, fields), at_strips, end


@arranging
def copy(source, to):
    """Copy a vector. An assignment of arrays would check their shapes and raise an exception."""
    for i in range(to.size):
        to[i] = source[i]


@arranging
def copy_rows(source, to):
    """Copy a matrix."""
    for i in range(to.shape[0]):
        copy(source[i], to[i])


@arranging
def forget_forged(kept):
    """Forget a warm start that says more panels than there can be, which a host can write there."""
    if kept.size > 0 and not 0.0 <= kept[0] <= MAX_PATCHES:
        kept[0] = 0.0


@arranging
def fill(workspace, poisson_ratio, constants):
    """Fill the arrays that depend only on resolution and material. `constants` are pointers to the arrays of `tables.data`."""
    rule, tables = workspace.rule, workspace.tables
    quadrature.fill_fejer(rule.across.nodes, rule.across.weights)
    quadrature.fill_elements(rule.elements)
    quadrature.fill_panel(rule.cosines, rule.cosine_logs)
    fill_probes(rule.cosines, rule.probes, rule.spread)
    if rule.columns.size > 1:
        fill_descent(tables.centre, tables.plane, rule.columns, rule.descent)
        fill_factors(tables.centre, tables.plane, rule.columns, rule.factors)
        influence.fill_columns(rule.cosine_logs, tables.centre, rule.columns)
    fill_table(carray(constants[0], (N_TABLE, 4, 3)), poisson_ratio, tables.kalker)
