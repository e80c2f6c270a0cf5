"""Lay out and fill the solver's workspace in raw memory, with the layouts of `contact.kernels.memory`."""

from __future__ import annotations

import numpy as np
from numba import carray

import contact
from contact import force_table, kalker, material, workspace
from contact.kernels import memory, quadrature
from contact.kernels.arrays import Size, Tables, Workspace
from contact.kernels.kalker import N_TABLE, fill_table
from contact.kernels.normal import influence
from contact.kernels.normal.between_panels import fill_probes
from contact.kernels.normal.descent import fill_descent
from contact.kernels.records import MAX_PATCHES
from contact.kernels.tangential.table import SHAPE as CREEP
from fmu_src.native.memory import compiled

_METHODS = contact.methods().batched
#: Indexed by the value of `method.normal` or `method.tangential`, less 1.
NORMAL = np.array([int(method.id) for method in _METHODS.normal.values()])
NORMAL_FAMILY = np.array([int(method.family) for method in _METHODS.normal.values()])
TANGENTIAL = np.array([int(method.id) for method in _METHODS.tangential.values()])
TANGENTIAL_FAMILY = np.array([int(method.family) for method in _METHODS.tangential.values()])
INTERACTING = np.array([int(method.interacting) for method in _METHODS.normal.values()])

heating = compiled(material.heating)


def data() -> tuple[np.ndarray, ...]:
    """Return the constants for `lay_out` and `fill`.

    They are Kalker's coefficients, the influence of strips on the centre line, that off it, and the table of creep forces.
    """
    return kalker.published(), *workspace.strip_tables(), force_table.load()


@compiled
def size_of(normal, n_strips, n_elements, samples):
    """Return the sizes of a workspace. `normal` is the value of `method.normal`."""
    return Size(n_strips, n_elements, samples, INTERACTING[normal - 1], 1)


@compiled
def choose(normal, tangential, case):
    """Write the methods into a case. The arguments are the values of `method.normal` and `method.tangential`."""
    case.normal, case.normal_family = NORMAL[normal - 1], NORMAL_FAMILY[normal - 1]
    case.tangential, case.tangential_family = TANGENTIAL[tangential - 1], TANGENTIAL_FAMILY[tangential - 1]


@compiled
def lay_out(work, end, kept, size, constants):
    """Lay out a workspace in `work` from index `end` on. Return it and the index where it ends.

    `kept` is the memory of the warm start, of size `memory_size`; `constants` are pointers to those of `data`.
    """
    _, centre, plane, creep = constants
    rule, end = memory.lay_rule(work, end, size)
    coefficients, end = memory.lay_kalker(work, end)
    space, end = memory.lay_space(work, end, size, kept)
    strips, fields, end = memory.lay_strips_and_fields(work, end, size)
    tables = Tables(
        coefficients,
        carray(centre, influence.CENTRE),
        carray(plane, influence.PLANE),
        carray(creep, CREEP),
    )
    return Workspace(rule, tables, space, strips, fields), end


@compiled
def forget_forged(kept):
    """Forget a warm start that says more panels than there can be, which a host can restore (FMU states)."""
    if kept.size > 0 and not 0.0 <= kept[0] <= MAX_PATCHES:
        kept[0] = 0.0


@compiled
def fill(own, poisson_ratio, constants):
    """Fill the arrays that depend only on resolution and material. `constants` are pointers to those of `data`."""
    rule, tables = own.rule, own.tables
    quadrature.fill_fejer(rule.across.nodes, rule.across.weights)
    quadrature.fill_elements(rule.elements)
    quadrature.fill_panel(rule.cosines, rule.cosine_logs)
    fill_probes(rule.cosines, rule.probes, rule.spread)
    if rule.columns.size > 1:
        fill_descent(tables.centre, tables.plane, rule.columns, rule.descent)
        influence.fill_columns(rule.cosine_logs, tables.centre, rule.columns)
    fill_table(carray(constants[0], (N_TABLE, 4, 3)), poisson_ratio, tables.kalker)
