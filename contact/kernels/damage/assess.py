"""All damage models over the arrays of one solved case. `evaluate`, batches and the native FMU use this code."""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Case, Cube, Damage, DamageParameters, Matrix, Result
from contact.kernels.damage.archard import depth_times_hardness
from contact.kernels.damage.burstow import burstow_kernel
from contact.kernels.damage.indices import (
    energy_index_kernel,
    fatigue_index_kernel,
    stress_index_kernel,
    t_gamma_kernel,
)
from contact.kernels.damage.pearce_sherratt import pearce_sherratt_kernel
from contact.kernels.damage.usfd import usfd_kernel
from contact.kernels.enumerations import TangentialFamily
from contact.kernels.rows import DamageField, Field, Strip


@kernel
def clear_damage(damage):
    """Set every damage number of a record to zero."""
    damage.T_gamma, damage.T_gamma_spin, damage.dissipation, damage.pearce_sherratt = 0.0, 0.0, 0.0, 0.0
    damage.burstow, damage.usfd, damage.archard_depth, damage.archard_volume = 0.0, 0.0, 0.0, 0.0
    damage.fatigue_index, damage.stress_index, damage.energy_index = 0.0, 0.0, 0.0


@kernel
def strip_width(strips, i):
    """Return the width of strip i along the surface [m], dy/cos Δ. It exceeds dy where the surface is bent (`conformal`)."""
    return strips[Strip.DY, i] * math.sqrt(1.0 + strips[Strip.TILT, i] ** 2)


@kernel
def damage_of_patch(case, result, parameters, damage):
    """Fill what follows from the resultants of a loaded patch, T-gamma and the indices that are functions of it."""
    vx, vy, phi = case.vx, case.vy, case.phi
    Fx, Fy, Mz = result.Fx, result.Fy - result.pressure_y, result.Mz
    T_gamma = t_gamma_kernel(Fx, Fy, 0.0, vx, vy, 0.0)
    T_gamma_spin = t_gamma_kernel(Fx, Fy, Mz, vx, vy, phi)
    load = T_gamma_spin if parameters.with_spin != 0 else T_gamma
    damage.T_gamma, damage.T_gamma_spin = T_gamma, T_gamma_spin
    damage.dissipation = result.power
    damage.pearce_sherratt = pearce_sherratt_kernel(load, 2.0 * parameters.wheel_radius, parameters.pearce_sherratt)
    damage.burstow = burstow_kernel(load, parameters.burstow)
    damage.usfd = usfd_kernel(load, result.area, parameters.usfd)
    utilisation = math.sqrt(Fx * Fx + Fy * Fy) / result.N
    damage.fatigue_index = fatigue_index_kernel(utilisation, result.pmax, parameters.shear_yield)


@kernel
def bears_nothing(n, result):
    """Return whether there is no patch that could be damaged."""
    return n == 0 or result.N <= 0.0 or result.area <= 0.0 or result.pmax <= 0.0


@entry
def damage_kernel(
    strips: Matrix,
    n: int,
    fields: Cube,
    case: Case,
    result: Result,
    parameters: DamageParameters,
    damage_fields: Cube,
    damage: Damage,
) -> None:
    """Fill `damage` and the first `n` strips of `damage_fields` from a solved case (see `DamageField`).

    The depth of an element is spread over the circumference, so it is in metres per metre rolled. The volume is that of
    all strips, ∬ k p |s|/H dA over the surface. The energy index uses the rigid slip of each strip at its position on
    the surface. T-gamma uses the creepages of the plane and the resultants in its frame. With n = 0 all values are
    zero. If the law gives only forces, the values that need fields are zero.
    """
    clear_damage(damage)
    without_fields = case.tangential_family == TangentialFamily.CREEP_FORCE
    nothing = bears_nothing(n, result)
    if nothing or without_fields:
        damage_fields[:, :n] = 0.0
    if nothing:
        return
    damage_of_patch(case, result, parameters, damage)
    if without_fields:
        return
    depth_max, volume, stress_max, energy_max = 0.0, 0.0, -math.inf, -math.inf
    circumference, shear_yield = 2.0 * math.pi * parameters.wheel_radius, parameters.shear_yield
    speed, hardness, archard = parameters.speed, parameters.hardness, parameters.archard
    columns, to_depth = fields.shape[2], 1.0 / (circumference * hardness)
    for i in range(n):
        y, vx_i, vy_i, phi_i = strips[Strip.Y, i], strips[Strip.VX, i], strips[Strip.VY, i], strips[Strip.PHI, i]
        # one loop per index: the compiler does not vectorise a loop with several
        for j in range(columns):
            slip = math.sqrt(fields[Field.SX, i, j] ** 2 + fields[Field.SY, i, j] ** 2)
            work = depth_times_hardness(slip, fields[Field.P, i, j], fields[Field.DX, i, j], speed, hardness, archard)
            damage_fields[DamageField.DEPTH, i, j] = work * to_depth
        for j in range(columns):
            stress = stress_index_kernel(fields[Field.QX, i, j], fields[Field.QY, i, j], shear_yield)
            damage_fields[DamageField.STRESS_INDEX, i, j] = stress
        for j in range(columns):
            damage_fields[DamageField.ENERGY_INDEX, i, j] = energy_index_kernel(
                fields[Field.QX, i, j], fields[Field.QY, i, j], fields[Field.X, i, j], y, vx_i, vy_i, phi_i
            )
        lost = 0.0  # loss of a particle that crosses the patch along this strip, over the circumference
        for j in range(columns):
            lost += damage_fields[DamageField.DEPTH, i, j]
            stress_max = max(stress_max, damage_fields[DamageField.STRESS_INDEX, i, j])
            energy_max = max(energy_max, damage_fields[DamageField.ENERGY_INDEX, i, j])
        depth_max = max(depth_max, lost)
        volume += lost * circumference * strip_width(strips, i)
    damage.archard_depth, damage.archard_volume = depth_max, volume
    damage.stress_index, damage.energy_index = stress_max, energy_max
