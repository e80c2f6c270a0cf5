"""Damage by the strips of a patch on a profile: rates, positions on the profile, and shares in bins of its arc length.

`contact.accumulation`, `contact.pair` and the FMUs use this code. A profile is an array whose first rows are y, z [m],
in the convention of the right side. Its arc length counts from the point nearest to y = 0, positive to the field side.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Cube, Damage, DamageParameters, Matrix, Numbers, Setting
from contact.kernels.damage.assess import strip_width
from contact.kernels.damage.usfd import usfd_kernel
from contact.kernels.enumerations import WearLaw
from contact.kernels.rows import Bin, Curve, DamageField, Field, Strip

_LEAST_COSINE = 0.17  # of the angle between profile and contact plane, 80°; at larger angles it does not face the plane


@kernel
def _depth(i, chord, area, fields, parameters, damage, damage_fields):
    """Return the depth that strip i removes per metre rolled, spread over the wheel's circumference [m].

    Laws for a whole patch are spread evenly over its area. The loss of a particle of the wheel is proportional to its
    way through the patch, which is the strip's `chord`.
    """
    law, per_circumference = parameters.wear_law, 0.5 / (math.pi * parameters.wheel_radius)
    if law == WearLaw.PEARCE_SHERRATT:
        return damage.pearce_sherratt * chord / area
    if law == WearLaw.USFD:
        return damage.usfd * chord * per_circumference
    lost = 0.0
    for j in range(fields.shape[2]):
        if law == WearLaw.ARCHARD:
            lost += damage_fields[DamageField.DEPTH, i, j]
        else:
            power = fields[Field.QX, i, j] * fields[Field.SX, i, j] + fields[Field.QY, i, j] * fields[Field.SY, i, j]
            rate = usfd_kernel(max(-power, 0.0), 1.0, parameters.usfd)
            lost += rate * fields[Field.DX, i, j] * per_circumference
    return lost


@entry
def strip_rates(
    strips: Matrix,
    n: int,
    fields: Cube,
    parameters: DamageParameters,
    damage: Damage,
    damage_fields: Cube,
    forward: float,
    rates: Matrix,
) -> None:
    """Fill the rates of each of `n` strips, per metre rolled and metre across, from the arrays of `damage_kernel`.

    WEAR is the depth on a wheel. VOLUME, per metre across, is the depth on a rail per pass. T-gamma of the whole patch
    is shared in proportion to contact area. A strip may have no area when a patch is about to separate. Burstow's index
    holds for every place that the patch passes. The sign of `forward`, the longitudinal creep force on the wheel [N],
    decides in which row it counts.
    """
    area = 0.0
    for i in range(n):
        area += 2.0 * strips[Strip.A, i] * strip_width(strips, i)
    for i in range(n):
        chord, length, energy, stress, greatest = 2.0 * strips[Strip.A, i], 0.0, 0.0, -math.inf, -math.inf
        for j in range(fields.shape[2]):
            length += fields[Field.DX, i, j]  # of the elements, which are exact for the pressure but not for the area
            energy += damage_fields[DamageField.ENERGY_INDEX, i, j] * fields[Field.DX, i, j]
            greatest = max(greatest, damage_fields[DamageField.ENERGY_INDEX, i, j])
            stress = max(stress, damage_fields[DamageField.STRESS_INDEX, i, j])
        depth = _depth(i, chord, area, fields, parameters, damage, damage_fields) if chord > 0.0 else 0.0
        rates[Bin.ROLLED, i], rates[Bin.WEAR, i] = 1.0, depth
        rates[Bin.VOLUME, i] = 2.0 * math.pi * parameters.wheel_radius * depth
        rates[Bin.T_GAMMA, i] = damage.T_gamma * chord / area if area > 0.0 else 0.0
        rates[Bin.ENERGY_INDEX, i] = energy / length if length > 0.0 else 0.0
        rates[Bin.STRESS_EXCEEDANCE, i] = 1.0 if stress > 0.0 else 0.0
        rates[Bin.FATIGUE_EXCEEDANCE, i] = 1.0 if damage.fatigue_index > 0.0 else 0.0
        rates[Bin.RCF_FORWARD, i] = damage.burstow if forward > 0.0 else 0.0
        rates[Bin.RCF_BACKWARD, i] = damage.burstow if forward < 0.0 else 0.0
        rates[Bin.ENERGY_INDEX_MAX, i] = greatest


@entry
def arc_length(profile: Matrix, arc: Numbers) -> None:
    """Fill `arc` with the arc length of each point of a profile [m]."""
    nearest = 0
    arc[0] = 0.0
    for i in range(1, profile.shape[1]):
        dy, dz = profile[Curve.Y, i] - profile[Curve.Y, i - 1], profile[Curve.Z, i] - profile[Curve.Z, i - 1]
        arc[i] = arc[i - 1] + math.sqrt(dy * dy + dz * dz)
        nearest = i if abs(profile[Curve.Y, i]) < abs(profile[Curve.Y, nearest]) else nearest
    origin = arc[nearest]
    for i in range(profile.shape[1]):
        arc[i] -= origin


@kernel
def _along(profile, i, y0, z0, c, s):
    """Return the coordinate of a point of the profile along the contact plane through (y0, z0) [m]."""
    return (profile[Curve.Y, i] - y0) * c + (profile[Curve.Z, i] - z0) * s


@kernel
def _faces(profile, arc, i, c, s):
    """Return whether the profile faces the plane between the points i and i + 1."""
    step = (profile[Curve.Y, i + 1] - profile[Curve.Y, i]) * c + (profile[Curve.Z, i + 1] - profile[Curve.Z, i]) * s
    return step >= _LEAST_COSINE * (arc[i + 1] - arc[i])


@kernel
def _facing(profile, arc, y0, z0, c, s):
    """Return the first and last point of the part of the profile that faces the plane.

    The part contains the point nearest to (y0, z0).
    """
    n, nearest, least = profile.shape[1], 0, math.inf
    for i in range(n):
        distance = (profile[Curve.Y, i] - y0) ** 2 + (profile[Curve.Z, i] - z0) ** 2
        if distance < least:
            nearest, least = i, distance
    first, last = nearest, nearest
    while first > 0 and _faces(profile, arc, first - 1, c, s):
        first -= 1
    while last < n - 1 and _faces(profile, arc, last, c, s):
        last += 1
    return first, last


@entry
def place(
    profile: Matrix,
    arc: Numbers,
    point: tuple[float, float],
    angle: float,
    mirror: float,
    strips: Matrix,
    n: int,
    edges: Matrix,
) -> float:
    """Fill `edges` with the arc lengths at which each strip begins and ends on the profile [m].

    The edges of the strips are projected along the normal of the contact plane. The plane has the `angle` and passes
    through the profile's `point` (y0, z0). `mirror` is -1 if angle and strips are those of the left side. The roll of
    the plane relative to the profile is neglected: a roll of 10 mrad shifts a point 0.1 mm off the plane by 1 µm.
    Beyond its ends, and where it turns away from the plane, the profile is continued straight.

    Returns
    -------
    float
        Distance at which the profile passes (y0, z0) along the normal or, if larger, at which it ends before that point [m].
    """
    y0, z0 = point
    c, s = math.cos(angle), mirror * math.sin(angle)
    first, last = _facing(profile, arc, y0, z0, c, s)
    k, off = first, 0.0
    for i in range(-1, 2 * n):  # i = -1 is the reference point
        side = -0.5 if i % 2 == 0 else 0.5
        at = 0.0 if i < 0 else mirror * strips[Strip.Y, i // 2] + side * strips[Strip.DY, i // 2]
        while k < last - 1 and _along(profile, k + 1, y0, z0, c, s) <= at:
            k += 1
        while k > first and _along(profile, k, y0, z0, c, s) > at:
            k -= 1
        next_one = min(k + 1, last)
        left, right = _along(profile, k, y0, z0, c, s), _along(profile, next_one, y0, z0, c, s)
        beyond = min(at - left, 0.0) + max(at - right, 0.0)
        t = (at - beyond - left) / (right - left) if right > left else 0.0
        if i >= 0:
            edges[i % 2, i // 2] = arc[k] + t * (arc[next_one] - arc[k]) + beyond
        else:
            here = (profile[Curve.Z, k] - z0) * c - (profile[Curve.Y, k] - y0) * s
            there = (profile[Curve.Z, next_one] - z0) * c - (profile[Curve.Y, next_one] - y0) * s
            off = max(abs(here + t * (there - here)), abs(beyond))
    return off


@entry
def deposit(
    rates: Matrix,
    edges: Matrix,
    strips: Matrix,
    n: int,
    settings: Setting,
    share: float,
    is_wheel: bool,
    wear: float,
    bins: Matrix,
) -> None:
    """Add the damage by `n` strips over a distance to the bins of a wheel or a rail.

    Each strip is shared among the bins that it overlaps. `settings` is a record LEDGER of `layout`. `share` is the
    weight of the patch, `wear` that of depth and volume worn off. Bin k begins at width·(start + k). The first and the
    last bin are open outwards, so that nothing is lost.
    """
    start, width, distance = settings.start, settings.width, share * settings.distance
    greatest = bins.shape[1] - 1
    for i in range(n):
        low, high = edges[0, i], edges[1, i]
        first = int(min(max(low / width - start, 0.0), greatest))
        last = int(min(max(high / width - start, 0.0), greatest))
        left = low
        for k in range(first, last + 1):
            right = high if k == last else min(max(width * (start + k + 1.0), left), high)
            share = (right - left) / (high - low) if high > low else 1.0
            left = right
            amount = distance * strip_width(strips, i) * share
            for row in range(Bin.ENERGY_INDEX_MAX):
                rate = rates[Bin.VOLUME, i] if row == Bin.WEAR and not is_wheel else rates[row, i]
                if row == Bin.WEAR or row == Bin.VOLUME:
                    rate *= wear
                of_the_bin = row == Bin.VOLUME or row == Bin.T_GAMMA  # the others are means over the width of the bin
                bins[row, k] += amount * rate if of_the_bin else amount * rate / width
            if amount > 0.0:
                bins[Bin.ENERGY_INDEX_MAX, k] = max(bins[Bin.ENERGY_INDEX_MAX, k], rates[Bin.ENERGY_INDEX_MAX, i])
