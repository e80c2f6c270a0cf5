"""What the strips of a patch do to a profile: their rates, where they lie on it, and their shares in bins of its arc length.

One source for `contact.accumulation`, `contact.pair` and the FMUs. A profile is an array with the rows y, z [m] first, in the
convention of the right side; its arc length counts from the point nearest to y = 0, positive to the field side.
"""

import math

from contact._jit import kernel
from contact._layout import FIELD_DX, FIELD_QX, FIELD_QY, FIELD_SX, FIELD_SY, STRIP_A, STRIP_DY, STRIP_Y
from contact.damage._kernel import (
    ARCHARD,
    DAMAGE_FATIGUE_INDEX,
    DAMAGE_PEARCE_SHERRATT,
    DAMAGE_T_GAMMA,
    DAMAGE_USFD,
    DFIELD_DEPTH,
    DFIELD_ENERGY_INDEX,
    DFIELD_STRESS_INDEX,
    PAR_ARCHARD,
    PAR_USFD,
    PAR_WEAR_LAW,
    PAR_WHEEL_RADIUS,
    PEARCE_SHERRATT,
    USFD,
)
from contact.damage.usfd import usfd_kernel

# rates[ROW, strip] per metre rolled, and bins[ROW, bin]: the names of `contact.accumulation`, the last is a maximum
ROLLED, WEAR, VOLUME, T_GAMMA, ENERGY_INDEX, STRESS_EXCEEDANCE, FATIGUE_EXCEEDANCE, ENERGY_INDEX_MAX = range(8)
N_ROWS = 8
_OF_THE_BIN = (VOLUME, T_GAMMA)  # the others are means over its width

Y, Z = range(2)  # profile[ROW, point]
_TURNED = 0.17  # cosine of the angle to the contact plane, 80°, beyond which a profile no longer faces it


@kernel
def _depth(i, chord, area, fields, parameters, damage, damage_fields):
    """What strip i takes off per metre rolled, spread over the wheel's circumference [m].

    The laws for a whole patch are spread evenly over its area: a particle of the wheel loses what its way through it, the
    strip's `chord`, is of that.
    """
    law, per_circumference = parameters[PAR_WEAR_LAW], 0.5 / (math.pi * parameters[PAR_WHEEL_RADIUS])
    if law == PEARCE_SHERRATT:
        return damage[DAMAGE_PEARCE_SHERRATT] * chord / area
    if law == USFD:
        return damage[DAMAGE_USFD] * chord * per_circumference
    lost = 0.0
    for j in range(fields.shape[2]):
        if law == ARCHARD:
            lost += damage_fields[DFIELD_DEPTH, i, j]
        else:
            power = fields[FIELD_QX, i, j] * fields[FIELD_SX, i, j] + fields[FIELD_QY, i, j] * fields[FIELD_SY, i, j]
            rate = usfd_kernel(max(-power, 0.0), 1.0, parameters[PAR_USFD:PAR_ARCHARD])
            lost += rate * fields[FIELD_DX, i, j] * per_circumference
    return lost


@kernel
def strip_rates(strips, n, fields, parameters, damage, damage_fields, rates):
    """What each of `n` strips does per metre rolled and metre across, from the arrays of `damage_kernel`.

    WEAR is the depth of a wheel; the volume, per metre across, is the depth of a rail per pass. T-gamma, of the whole patch,
    is shared by contact area. A strip may have none, where a patch is about to part.
    """
    area = 0.0
    for i in range(n):
        area += 2.0 * strips[STRIP_A, i] * strips[STRIP_DY, i]
    for i in range(n):
        chord, length, energy, stress, greatest = 2.0 * strips[STRIP_A, i], 0.0, 0.0, -math.inf, -math.inf
        for j in range(fields.shape[2]):
            length += fields[FIELD_DX, i, j]  # of the elements, which are exact for the pressure, not for the area
            energy += damage_fields[DFIELD_ENERGY_INDEX, i, j] * fields[FIELD_DX, i, j]
            greatest = max(greatest, damage_fields[DFIELD_ENERGY_INDEX, i, j])
            stress = max(stress, damage_fields[DFIELD_STRESS_INDEX, i, j])
        depth = _depth(i, chord, area, fields, parameters, damage, damage_fields) if chord > 0.0 else 0.0
        rates[ROLLED, i], rates[WEAR, i] = 1.0, depth
        rates[VOLUME, i] = 2.0 * math.pi * parameters[PAR_WHEEL_RADIUS] * depth
        rates[T_GAMMA, i] = damage[DAMAGE_T_GAMMA] * chord / area if area > 0.0 else 0.0
        rates[ENERGY_INDEX, i] = energy / length if length > 0.0 else 0.0
        rates[STRESS_EXCEEDANCE, i] = 1.0 if stress > 0.0 else 0.0
        rates[FATIGUE_EXCEEDANCE, i] = 1.0 if damage[DAMAGE_FATIGUE_INDEX] > 0.0 else 0.0
        rates[ENERGY_INDEX_MAX, i] = greatest


@kernel
def arc_length(profile, arc):
    """Fill the arc length of each point of a profile."""
    nearest = 0
    arc[0] = 0.0
    for i in range(1, profile.shape[1]):
        dy, dz = profile[Y, i] - profile[Y, i - 1], profile[Z, i] - profile[Z, i - 1]
        arc[i] = arc[i - 1] + math.sqrt(dy * dy + dz * dz)
        nearest = i if abs(profile[Y, i]) < abs(profile[Y, nearest]) else nearest
    origin = arc[nearest]
    for i in range(profile.shape[1]):
        arc[i] -= origin


@kernel
def _along(profile, i, y0, z0, c, s):
    """Position of a point of the profile along the contact plane through (y0, z0)."""
    return (profile[Y, i] - y0) * c + (profile[Z, i] - z0) * s


@kernel
def _faces(profile, arc, i, c, s):
    """Whether the profile faces the plane between the points i and i + 1."""
    step = (profile[Y, i + 1] - profile[Y, i]) * c + (profile[Z, i + 1] - profile[Z, i]) * s
    return step >= _TURNED * (arc[i + 1] - arc[i])


@kernel
def _facing(profile, arc, y0, z0, c, s):
    """First and last point around that nearest to (y0, z0) between which the profile faces the plane."""
    n, nearest, least = profile.shape[1], 0, math.inf
    for i in range(n):
        distance = (profile[Y, i] - y0) ** 2 + (profile[Z, i] - z0) ** 2
        if distance < least:
            nearest, least = i, distance
    first, last = nearest, nearest
    while first > 0 and _faces(profile, arc, first - 1, c, s):
        first -= 1
    while last < n - 1 and _faces(profile, arc, last, c, s):
        last += 1
    return first, last


@kernel
def place(profile, arc, y0, z0, angle, mirror, strips, n, edges):
    """Fill the arc lengths at which each strip begins and ends on the profile.

    Its edges are projected along the normal of the contact plane, which lies at `angle` through the profile's point (y0, z0);
    `mirror` is -1 where angle and strips are those of the left side. The plane is taken not to be rolled relative to the
    profile: a roll of 10 mrad shifts a point 0.1 mm off the plane by 1 µm. Beyond its ends, and where it turns away from
    the plane, the profile is continued straight.

    Returns
    -------
    float
        How far the profile passes (y0, z0) by, along the normal, or ends before it [m].
    """
    c, s = math.cos(angle), mirror * math.sin(angle)
    first, last = _facing(profile, arc, y0, z0, c, s)
    k, off = first, 0.0
    for i in range(-1, 2 * n):  # the first is the reference point
        side = -0.5 if i % 2 == 0 else 0.5
        at = 0.0 if i < 0 else mirror * strips[STRIP_Y, i // 2] + side * strips[STRIP_DY, i // 2]
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
            here = (profile[Z, k] - z0) * c - (profile[Y, k] - y0) * s
            there = (profile[Z, next_one] - z0) * c - (profile[Y, next_one] - y0) * s
            off = max(abs(here + t * (there - here)), abs(beyond))
    return off


@kernel
def deposit(rates, edges, strips, n, distance, is_wheel, start, width, bins):
    """Let `n` strips act on a wheel or a rail over a `distance` [m]: each is shared over the bins that it overlaps.

    Bin k begins at width·(start + k); the first and the last are open outwards, so that nothing is lost.
    """
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
            amount = distance * strips[STRIP_DY, i] * share
            for row in range(ENERGY_INDEX_MAX):
                rate = rates[VOLUME if row == WEAR and not is_wheel else row, i]
                bins[row, k] += amount * rate if row in _OF_THE_BIN else amount * rate / width
            if amount > 0.0:
                bins[ENERGY_INDEX_MAX, k] = max(bins[ENERGY_INDEX_MAX, k], rates[ENERGY_INDEX_MAX, i])
