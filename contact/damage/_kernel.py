"""All damage models over the arrays of one solved case: one source for `evaluate`, batches and the native FMU."""

import math

from contact._jit import kernel
from contact._layout import (
    CASE_PHI,
    CASE_TANGENTIAL,
    CASE_VX,
    CASE_VY,
    FIELD_DX,
    FIELD_P,
    FIELD_QX,
    FIELD_QY,
    FIELD_SX,
    FIELD_SY,
    FIELD_X,
    RES_AREA,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_N,
    RES_PMAX,
    RES_POWER,
    RES_PRESSURE_Y,
    STRIP_DY,
    STRIP_Y,
)
from contact.damage.archard import depth_times_hardness
from contact.damage.burstow import burstow_kernel
from contact.damage.energy_index import energy_index_kernel
from contact.damage.fatigue_index import fatigue_index_kernel
from contact.damage.pearce_sherratt import pearce_sherratt_kernel
from contact.damage.stress_index import stress_index_kernel
from contact.damage.t_gamma import t_gamma_kernel
from contact.damage.usfd import usfd_kernel
from contact.registry import CARTER

# parameters[...]: DamageParameters.array()
(
    PAR_SPEED,
    PAR_WHEEL_RADIUS,
    PAR_HARDNESS,
    PAR_SHEAR_YIELD,
    PAR_WITH_SPIN,
    PAR_WEAR_LAW,  # which law profiles wear by (`deposit`)
    PAR_PEARCE_SHERRATT,
) = range(7)
PAR_BURSTOW = PAR_PEARCE_SHERRATT + 7
PAR_USFD = PAR_BURSTOW + 5
PAR_ARCHARD = PAR_USFD + 7
N_PAR = PAR_ARCHARD + 7

#: Wear laws, in the order of `contact.damage.WEAR_LAWS`.
ARCHARD, USFD, USFD_LOCAL, PEARCE_SHERRATT = range(4)

# damage[...]: the numbers of `Damage`, in SI units
(
    DAMAGE_T_GAMMA,
    DAMAGE_T_GAMMA_SPIN,
    DAMAGE_DISSIPATION,
    DAMAGE_PEARCE_SHERRATT,
    DAMAGE_BURSTOW,
    DAMAGE_USFD,
    DAMAGE_ARCHARD_DEPTH,  # maximum [m per m rolled]
    DAMAGE_ARCHARD_VOLUME,  # [m³ per m rolled]
    DAMAGE_FATIGUE_INDEX,
    DAMAGE_STRESS_INDEX,  # maximum [Pa]
    DAMAGE_ENERGY_INDEX,  # maximum [Pa]
) = range(11)
N_DAMAGE = 11

# damage_fields[ROW, strip, element]
DFIELD_DEPTH, DFIELD_STRESS_INDEX, DFIELD_ENERGY_INDEX = range(3)
N_DAMAGE_FIELDS = 3


@kernel
def damage_kernel(strips, n, fields, case, result, parameters, damage_fields, damage):
    """Fill `damage` and the first `n` strips of `damage_fields` from a solved case (see `contact._layout`).

    The depth of an element is spread over the circumference, so it is metre per metre rolled; the volume is that of all
    strips, ∬ k p |s|/H dA. With n = 0 everything is zero, and what needs fields where the law gives forces alone.
    """
    damage[:] = 0.0
    nothing = n == 0 or result[RES_N] <= 0.0 or result[RES_AREA] <= 0.0 or result[RES_PMAX] <= 0.0
    if nothing or case[CASE_TANGENTIAL] >= CARTER:
        damage_fields[:, :n] = 0.0
    if nothing:
        return
    vx, vy, phi = case[CASE_VX], case[CASE_VY], case[CASE_PHI]
    Fx, Fy, Mz = result[RES_FX], result[RES_FY] - result[RES_PRESSURE_Y], result[RES_MZ]
    radius, shear_yield = parameters[PAR_WHEEL_RADIUS], parameters[PAR_SHEAR_YIELD]
    circumference = 2.0 * math.pi * radius

    T_gamma = t_gamma_kernel(Fx, Fy, 0.0, vx, vy, 0.0)
    T_gamma_spin = t_gamma_kernel(Fx, Fy, Mz, vx, vy, phi)
    load = T_gamma_spin if parameters[PAR_WITH_SPIN] > 0.5 else T_gamma
    damage[DAMAGE_T_GAMMA], damage[DAMAGE_T_GAMMA_SPIN] = T_gamma, T_gamma_spin
    damage[DAMAGE_DISSIPATION] = result[RES_POWER]
    damage[DAMAGE_PEARCE_SHERRATT] = pearce_sherratt_kernel(
        load, 2.0 * radius, parameters[PAR_PEARCE_SHERRATT:PAR_BURSTOW]
    )
    damage[DAMAGE_BURSTOW] = burstow_kernel(load, parameters[PAR_BURSTOW:PAR_USFD])
    damage[DAMAGE_USFD] = usfd_kernel(load, result[RES_AREA], parameters[PAR_USFD:PAR_ARCHARD])
    utilisation = math.sqrt(Fx * Fx + Fy * Fy) / result[RES_N]
    damage[DAMAGE_FATIGUE_INDEX] = fatigue_index_kernel(utilisation, result[RES_PMAX], shear_yield)

    if case[CASE_TANGENTIAL] >= CARTER:
        return
    depth_max, volume, stress_max, energy_max = 0.0, 0.0, -math.inf, -math.inf
    speed, hardness, archard = parameters[PAR_SPEED], parameters[PAR_HARDNESS], parameters[PAR_ARCHARD:N_PAR]
    columns, to_depth = fields.shape[2], 1.0 / (circumference * hardness)
    for i in range(n):
        y = strips[STRIP_Y, i]
        # one loop an index: with more the compiler gives up vector instructions
        for j in range(columns):
            slip = math.sqrt(fields[FIELD_SX, i, j] ** 2 + fields[FIELD_SY, i, j] ** 2)
            work = depth_times_hardness(slip, fields[FIELD_P, i, j], fields[FIELD_DX, i, j], speed, hardness, archard)
            damage_fields[DFIELD_DEPTH, i, j] = work * to_depth
        for j in range(columns):
            stress = stress_index_kernel(fields[FIELD_QX, i, j], fields[FIELD_QY, i, j], shear_yield)
            damage_fields[DFIELD_STRESS_INDEX, i, j] = stress
        for j in range(columns):
            damage_fields[DFIELD_ENERGY_INDEX, i, j] = energy_index_kernel(
                fields[FIELD_QX, i, j], fields[FIELD_QY, i, j], fields[FIELD_X, i, j], y, vx, vy, phi
            )
        lost = 0.0  # by a particle that crosses the patch along this strip, over the circumference
        for j in range(columns):
            lost += damage_fields[DFIELD_DEPTH, i, j]
            stress_max = max(stress_max, damage_fields[DFIELD_STRESS_INDEX, i, j])
            energy_max = max(energy_max, damage_fields[DFIELD_ENERGY_INDEX, i, j])
        depth_max = max(depth_max, lost)
        volume += lost * circumference * strips[STRIP_DY, i]
    damage[DAMAGE_ARCHARD_DEPTH], damage[DAMAGE_ARCHARD_VOLUME] = depth_max, volume
    damage[DAMAGE_STRESS_INDEX], damage[DAMAGE_ENERGY_INDEX] = stress_max, energy_max
