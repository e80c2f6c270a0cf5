"""One patch under several creepages at once, for derivatives: copies of its strips march together and fill the lanes.

A march works on `LANES` strips at a time. A patch of 20 strips leaves most of its second block idle; three copies of it
fill four blocks instead of six, and their shapes are found once. Each copy has the bits that it would have alone.
"""

import math
from enum import IntEnum

from contact.core import kernel
from contact.kernels.enumerations import FrictionLaw, TangentialFamily
from contact.kernels.pipeline import set_rolling
from contact.kernels.rows import Strip
from contact.kernels.tangential.effective import set_effective
from contact.kernels.tangential.fastrip_mapped import Uneven, energy, forces_of, set_shapes, slip_factor
from contact.kernels.tangential.lanes import LANES, room_for
from contact.kernels.tangential.mapped_lanes import set_block
from contact.kernels.tangential.march import march
from contact.kernels.tangential.pulls import is_divided, set_forces, set_pulls
from contact.kernels.tangential.stick_zone import add_zone

#: Number of copies: one for each creepage.
COPIES = 3


class _Borne(IntEnum):
    """What a strip of a copy bears, in rows that its march has read before."""

    FX = Strip.TO_X
    FY = Strip.TO_Y
    MZ = Strip.TO_PHI
    POWER = Strip.TO_EXPONENT
    WORK = Strip.STIFFNESS


@kernel
def fits_together(n, case, result, strips):
    """Return whether `n` strips can march with their copies: one plane patch of mapped strips with constant friction."""
    constant = case.law == FrictionLaw.COULOMB and not case.drop > 0.0 and case.slope == 1.0 and case.slope_far == 1.0
    plain = constant and case.conformal == 0 and result.limited == 0
    mapped = case.tangential_family == TangentialFamily.FASTRIP_MAPPED
    return plain and mapped and strips[Strip.PATCH, n - 1] == strips[Strip.PATCH, 0] and COPIES * n <= strips.shape[1]


@kernel
def _copy_with(n, copy, vx, vy, phi, strips):
    """Write copy number `copy` of the first `n` strips, with creepages of its own."""
    for row in range(strips.shape[0] if copy > 0 else 0):
        for i in range(n):
            strips[row, copy * n + i] = strips[row, i]
    for i in range(copy * n, (copy + 1) * n):
        strips[Strip.VX, i], strips[Strip.VY, i], strips[Strip.PHI, i] = vx, vy, phi


@kernel
def roll_together(n, creepage, spin, case, workspace):
    """Roll `n` strips with one more `creepage` along x, in copy 0, along y, in copy 1, or `spin` [1/m], in copy 2.

    The rows of `_Borne` then hold the forces of each strip.
    """
    strips, elements = workspace.strips, workspace.rule.elements
    set_rolling(strips, n, case)
    set_shapes(n, workspace)
    _copy_with(n, 2, case.vx, case.vy, case.phi + spin, strips)
    _copy_with(n, 1, case.vx, case.vy + creepage, case.phi, strips)
    _copy_with(n, 0, case.vx + creepage, case.vy, case.phi, strips)
    divided = is_divided(strips, 0, n)
    for copy in range(COPIES):
        first, end = copy * n, (copy + 1) * n
        if divided:
            set_forces(strips, first, end, (first, end), case, workspace.tables)
            set_pulls(strips, first, end, (first, end), case)
        set_effective(strips, first, end, (first, end), case, workspace.tables)
    last = COPIES * n
    for block in range(0, last, LANES):
        lanes = workspace.space.lanes[: room_for(last - block)]
        set_block(strips, block, last, case, workspace.tables.kalker, lanes)
        march(Uneven(0), elements, lanes, workspace.space.trace)
        add_zone(elements, lanes)
        for l in range(min(LANES, last - block)):
            i = block + l
            power, work = energy(strips, i, l, lanes)
            Fx, Fy, Mz = forces_of(strips, i, l, lanes)
            strips[_Borne.FX, i], strips[_Borne.FY, i], strips[_Borne.MZ, i] = Fx, Fy, Mz
            strips[_Borne.POWER, i], strips[_Borne.WORK, i] = power, work
    for i in range(n):
        strips[Strip.ASPECT, i] = math.exp(strips[Strip.ASPECT, i])  # as `roll_case` leaves it


@kernel
def sum_copy(n, copy, strips):
    """Return force (Fx, Fy), moment and power per metre rolled of one copy, after `roll_together`."""
    Fx, Fy, Mz, power, work = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(copy * n, (copy + 1) * n):
        Fx += strips[_Borne.FX, i]
        Fy += strips[_Borne.FY, i]
        Mz += strips[_Borne.MZ, i]
        power += strips[_Borne.POWER, i]
        work += strips[_Borne.WORK, i]
    return Fx, Fy, Mz, slip_factor(power, work) * power
