"""Compute the table of effective creepages from that of creep forces (`contact.tangential.effective`)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact import friction, workspace
from contact._layout import (
    CASE_G,
    CASE_LOAD,
    CASE_NORMAL,
    CASE_NU,
    CASE_TANGENTIAL,
    N_CASE,
    RES_AREA,
    RES_FX,
    RES_MZ,
    RES_SLIP_AREA,
    STRIP_PHI,
    STRIP_TO_EXPONENT,
    STRIP_VX,
)
from contact.errors import ContactError
from contact.pipeline import press_case
from contact.registry import lookup
from contact.study import creep_table
from contact.study.ellipse import ellipse
from contact.tangential import table
from contact.tangential.ellipses import equivalent_ellipse
from contact.tangential.fastrip_mapped import roll_patch
from contact.tangential.mapping import elastic_centre

Array = NDArray[np.float64]

#: What counts beside force over mu N and moment over mu N c: the share of slip and, in each sweep, how far changes are from
#: what is expected, nothing at first and the mean of the neighbouring nodes then. It keeps small and smooth what the forces
#: leave open. Chosen on 300 random ellipses (`benchmarks/creep_table.py`) and 400 states of new and worn profiles by our half
#: space.
SLIP, STIFF = 0.01, (0.01, 0.02, 0.02, 0.02)
#: Strips and elements: the march's own error is below .001 of mu N.
_RESOLUTION = 40


def build(path: Path, forces: Path = table.FILE, *, progress: Callable[[float, str], None] | None = None) -> None:
    """Fit the march to the table of creep forces, node by node, and write the changes to `path`; needs scipy.

    Raises
    ------
    ContactError
        A file that cannot be written, or `forces` no table of creep forces.
    """
    true = table.numbers(forces)
    changes = np.zeros_like(true)
    ellipses = [OneEllipse(float(u)) for u in table.nodes()[0]]
    for sweep, stiff in enumerate(STIFF):
        expected = neighbours(changes)  # at first nothing
        for n, (i, j, k) in enumerate(table.rows()):
            own = slice(None) if k in (0, table.N_BETA - 1) else j
            for l in range(1, table.N_RHO - 1):  # nothing at vanishing creepage and in full slip
                at = i, j, k, l
                change = ellipses[i].fitted((j, k, l), true[at], changes[at], expected[at], stiff)
                changes[i, own, k, l] = change * _allowed(j, k)
            if progress is not None:
                progress((sweep + n / len(table.rows())) / len(STIFF), f"sweep {sweep + 1} of {len(STIFF)}")
    lines = [",".join(creep_table.short(v) for v in changes[i, j, k, 1:].ravel()) for i, j, k in table.rows()]
    names = "longitudinal creepage, lateral creepage, spin over the size of the creepage; exponent"
    heading = (
        f"# What mapped strip marching changes in {names}: contact/tangential/effective.py\n"
        "# Computed by `contact table effective` from the table of creep forces, in the order of table.rows(), for rho = "
        f"1/{table.N_RHO - 1}, ...\n"
    )
    try:
        path.write_text(heading + "\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror}") from None


def _allowed(j: int, k: int) -> tuple[float, float, float, float]:
    """1 for each of the four numbers, 0 for changes of a creepage that symmetry rules out at a node."""
    spin_alone, sideways = k in (0, table.N_BETA - 1), j == table.N_ALPHA - 1
    straight = j == 0 and 2 * k == table.N_BETA - 1
    return float(not (spin_alone or sideways)), float(not straight), float(not straight), 1.0


def neighbours(changes: Array) -> Array:
    """Mean over the four coordinates of the two neighbours of each node."""
    around, inside = table.with_margins(changes), (slice(1, -1),) * 4
    total = np.zeros_like(changes)
    for axis, side in itertools.product(range(4), (slice(0, -2), slice(2, None))):
        total += around[(*inside[:axis], side, *inside[axis + 1 :])]
    return total / 8.0


class OneEllipse:
    """The march on one ellipse of the table, with any change."""

    def __init__(self, log_aspect: float) -> None:
        load, material = creep_table.LOAD, creep_table.MATERIAL
        self.log_aspect, self.limit = log_aspect, creep_table.FRICTION * load
        case = np.zeros(N_CASE)
        case[CASE_LOAD], case[CASE_G], case[CASE_NU] = load, material.shear_modulus, material.poisson_ratio
        normal, rolling = lookup("normal", "hertz"), lookup("tangential", "fastrip_mapped")
        case[CASE_NORMAL], case[CASE_TANGENTIAL] = normal.id, rolling.id
        friction.fill(case, friction.Friction(creep_table.FRICTION), 0.0)
        s = ellipse(math.exp(log_aspect), creep_table.C, load, material)
        own = workspace.allocate(
            normal,
            lookup("tangential", "fastrip"),
            material.poisson_ratio,
            _RESOLUTION,
            _RESOLUTION,
            s.y.size,
            fields=False,
        )
        self.n = press_case(s.y, s.g, s.A, s.x_c, case, *own)
        a, b = equivalent_ellipse(own.strips, self.n)
        self.centres = elastic_centre(own.strips, 0, self.n, own.tables.kalker, math.log(a / b))
        self.case, self.own, self.strips, self.area = case, own, own.strips.copy(), own.result[RES_AREA]

    def forces(self, creepage: Array, exponent: float) -> Array:
        """Fx, Fy over mu N, Mz over mu N c and the share of slip of the march, without what the table says."""
        strips, result, space = self.own.strips, self.own.result, self.own.space
        strips[:] = self.strips
        strips[STRIP_VX : STRIP_PHI + 1, : self.n] = creepage[:, None]
        strips[STRIP_TO_EXPONENT, : self.n] = exponent
        result[:] = 0.0
        roll_patch(
            strips, 0, self.n, self.case, self.own.tables.kalker, self.centres, self.own.rule.elements, space.lanes,
            space.trace, self.own.fields, result,
        )  # fmt: skip
        return np.array([*result[RES_FX : RES_MZ + 1], result[RES_SLIP_AREA]]) / (
            self.limit,
            self.limit,
            self.limit * creep_table.C,
            self.area,
        )

    def fitted(self, at: tuple[int, int, int], true: Array, start: Array, expected: Array, stiff: float) -> Array:
        """The change with which the march has the forces `true` at a node, as near to `expected` as they let it."""
        from scipy.optimize import least_squares

        _, alpha, beta, rho = table.nodes()
        j, k, l = at
        given = creep_table.creepage(self.log_aspect, alpha[j], beta[k], rho[l])
        creepage = np.array([given.longitudinal, given.lateral, given.spin])
        sizes = np.array(creep_table.sizes(self.log_aspect, rho[l]))
        weights = np.array([1.0, 1.0, 1.0, SLIP])

        def misfit(shifted: Array) -> Array:  # by 1, for steps in proportion
            change = shifted - 1.0
            found = self.forces(creepage + sizes * change[:3], change[3])
            return np.concatenate([weights * (found - true), stiff * (change - expected)])

        return least_squares(misfit, 1.0 + start, method="lm", diff_step=1e-3, max_nfev=60).x - 1.0
