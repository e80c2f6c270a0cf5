"""Compute the table of effective creepages from the table of creep forces (`contact.kernels.tangential.effective`)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from contact import friction
from contact.arrays import Array
from contact.errors import ContactError, optional
from contact.instance import workspace
from contact.instance.case import cases, set_surface
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.pipeline import press_case, set_rolling
from contact.kernels.records import RESULT
from contact.kernels.rows import Strip
from contact.kernels.tangential.fastrip_mapped import roll_patch, set_shapes
from contact.registry import lookup
from contact.study import creep_table
from contact.study.ellipse import ellipse
from contact.theory import force_table as table

#: Weights in the fit, relative to the error of force over mu N. That of moment over mu N c has the weight c over the longer
#: half axis. Over c a slender ellipse has a moment four times as large. A change that it alone asks for, from full slip on,
#: is wrong for the force between the nodes. SLIP: share of slip. STIFF, for each sweep: difference of the changes from
#: expected values, which are 0 in the first sweep and then the mean of the neighbouring nodes; twice as much beyond ln(a/b)
#: = SLENDER. It keeps changes small and smooth that the forces do not determine. All were chosen on random ellipses
#: (mapped_strip.md 9).
SLIP, STIFF, SLENDER = 0.01, (0.02, 0.03), 1.0
#: Strips and elements. Forces differ from those with 320 by .0002 of mu N in the mean, .002 at most.
_RESOLUTION = 24


def build(path: Path, forces: Path = table.FILE, *, progress: Callable[[float, str], None] | None = None) -> None:
    """Fit the march to the table of creep forces, node by node, and write the changes to `path`. It needs scipy.

    Raises
    ------
    ContactError
        If the file cannot be written, or `forces` is not a table of creep forces.
    """
    true = table.numbers(forces)
    changes = np.zeros_like(true)
    ellipses = [OneEllipse(float(u)) for u in table.nodes()[0]]
    for sweep, stiff in enumerate(STIFF):
        expected = neighbours(changes)  # 0 in the first sweep
        for n, (i, j, k) in enumerate(table.rows()):
            alphas = slice(None) if k in (0, table.N_BETA - 1) else j
            for l in range(1, table.N_RHO - 1):  # no change at vanishing creepage and in full slip
                at = i, j, k, l
                change = ellipses[i].fitted((j, k, l), true[at], changes[at], expected[at], stiff)
                changes[i, alphas, k, l] = change * _allowed(j, k)
            if progress is not None:
                progress((sweep + n / len(table.rows())) / len(STIFF), f"sweep {sweep + 1} of {len(STIFF)}")
    lines = [",".join(creep_table.short(v) for v in changes[i, j, k, 1:].ravel()) for i, j, k in table.rows()]
    names = "longitudinal creepage, lateral creepage, spin over the size of the creepage; exponent"
    heading = (
        f"# What mapped strip marching changes in {names}: contact/kernels/tangential/effective.py\n"
        "# Computed by `contact table effective` from the table of creep forces, in the order of table.rows(), for rho = "
        f"1/{table.N_RHO - 1}, ...\n"
    )
    try:
        path.write_text(heading + "\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror}") from None


def _allowed(j: int, k: int) -> tuple[float, float, float, float]:
    """Return a factor for each of the four numbers: 0 for a change that symmetry excludes at this node, else 1."""
    spin_alone, sideways = k in (0, table.N_BETA - 1), j == table.N_ALPHA - 1
    straight = j == 0 and 2 * k == table.N_BETA - 1
    return float(not (spin_alone or sideways)), float(not straight), float(not straight), 1.0


def neighbours(changes: Array) -> Array:
    """Return the mean of the eight neighbours of each node, two along each of the four coordinates."""
    around, inside = table.with_margins(changes), (slice(1, -1),) * 4
    total = np.zeros_like(changes)
    for axis, side in itertools.product(range(4), (slice(0, -2), slice(2, None))):
        total += around[(*inside[:axis], side, *inside[axis + 1 :])]
    return total / 8.0


class OneEllipse(OwnsArrays):
    """The march on one ellipse of the table, with given creepages and exponent."""

    def __init__(self, log_aspect: float) -> None:
        load, material = creep_table.LOAD, creep_table.MATERIAL
        self.log_aspect, self.limit = log_aspect, creep_table.FRICTION * load
        normal, rolling = lookup("normal", "hertz"), lookup("tangential", "fastrip_mapped")
        case = cases(1, normal, rolling, material)
        set_surface(case, friction.Friction(creep_table.FRICTION), 0.0)
        case["amount"] = load
        s = ellipse(math.exp(log_aspect), creep_table.C, load, material)
        size = _RESOLUTION, _RESOLUTION, s.y.size
        space = workspace.allocate(normal, lookup("tangential", "fastrip"), material.poisson_ratio, size, fields=False)
        self.result = np.zeros(1, RESULT)[0]
        self.n = press_case(s.samples, case[0], space, self.result)
        set_rolling(space.strips, self.n, case[0])
        set_shapes(self.n, space)
        self.case, self.own, self.strips, self.area = case[0], space, space.strips.copy(), float(self.result.area)

    @one_thread
    def forces(self, creepage: Array, exponent: float) -> Array:
        """Return Fx/(mu N), Fy/(mu N), Mz/(mu N c) and the share of slip of the march, without the table's changes."""
        strips, result = self.own.strips, self.result
        strips[:] = self.strips
        strips[Strip.VX : Strip.PHI + 1, : self.n] = creepage[:, None]
        strips[Strip.TO_EXPONENT, : self.n] = exponent
        result.Fx = result.Fy = result.Mz = result.power = result.slip_area = 0.0
        roll_patch(0, self.n, self.case, self.own, result)
        return np.array([result.Fx, result.Fy, result.Mz, result.slip_area]) / (
            self.limit,
            self.limit,
            self.limit * creep_table.C,
            self.area,
        )

    def fitted(self, at: tuple[int, int, int], true: Array, start: Array, expected: Array, stiff: float) -> Array:
        """Return the change with which the march has the forces `true` at a node, by least squares.

        `start` is the first guess. `stiff` is the weight of the difference from `expected`.
        """
        _, alpha, beta, rho = table.nodes()
        j, k, l = at
        given = creep_table.creepage(self.log_aspect, alpha[j], beta[k], rho[l])
        creepage = np.array([given.longitudinal, given.lateral, given.spin])
        sizes = np.array(creep_table.sizes(self.log_aspect, rho[l]))
        weights = np.array([1.0, 1.0, math.exp(-0.5 * abs(self.log_aspect)), SLIP])
        stiff *= 2.0 if self.log_aspect > SLENDER else 1.0

        def misfit(shifted: Array) -> Array:  # shifted by 1, so that relative steps have the right size
            change = shifted - 1.0
            found = self.forces(creepage + sizes * change[:3], change[3])
            return np.concatenate([weights * (found - true), stiff * (change - expected)])

        least_squares = optional("scipy.optimize", "fitting needs", "profiles").least_squares
        return least_squares(misfit, 1.0 + start, method="lm", diff_step=1e-3, max_nfev=60).x - 1.0
