"""What the strips of a patch do to a profile: their rates, where they lie on it, and their shares in bins of its arc length.

One source for `contact.accumulation`, `contact.pair` and the FMUs. A profile is an array with the rows y, z [m] first, in the
convention of the right side; its arc length counts from the point nearest to y = 0, positive to the field side.
"""

import math

from contact._jit import kernel
from contact.kernels.damage.assess import strip_width
from contact.kernels.damage.usfd import usfd_kernel
from contact.kernels.layout import Bin, Curve, DamageField, Field, Strip, WearLaw

_TURNED = 0.17  # cosine of the angle to the contact plane, 80°, beyond which a profile no longer faces it


@kernel
def _depth(i, chord, area, fields, parameters, damage, damage_fields):
    """What strip i takes off per metre rolled, spread over the wheel's circumference [m].

    The laws for a whole patch are spread evenly over its area: a particle of the wheel loses what its way through it, the
    strip's `chord`, is of that.
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


@kernel
def strip_rates(strips, n, fields, parameters, damage, damage_fields, rates):
    """What each of `n` strips does per metre rolled and metre across, from the arrays of `damage_kernel`.

    WEAR is the depth of a wheel; the volume, per metre across, is the depth of a rail per pass. T-gamma, of the whole patch,
    is shared by contact area. A strip may have none, where a patch is about to part.
    """
    area = 0.0
    for i in range(n):
        area += 2.0 * strips[Strip.A, i] * strip_width(strips, i)
    for i in range(n):
        chord, length, energy, stress, greatest = 2.0 * strips[Strip.A, i], 0.0, 0.0, -math.inf, -math.inf
        for j in range(fields.shape[2]):
            length += fields[Field.DX, i, j]  # of the elements, which are exact for the pressure, not for the area
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
        rates[Bin.ENERGY_INDEX_MAX, i] = greatest


@kernel
def arc_length(profile, arc):
    """Fill the arc length of each point of a profile."""
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
    """Position of a point of the profile along the contact plane through (y0, z0)."""
    return (profile[Curve.Y, i] - y0) * c + (profile[Curve.Z, i] - z0) * s


@kernel
def _faces(profile, arc, i, c, s):
    """Whether the profile faces the plane between the points i and i + 1."""
    step = (profile[Curve.Y, i + 1] - profile[Curve.Y, i]) * c + (profile[Curve.Z, i + 1] - profile[Curve.Z, i]) * s
    return step >= _TURNED * (arc[i + 1] - arc[i])


@kernel
def _facing(profile, arc, y0, z0, c, s):
    """First and last point around that nearest to (y0, z0) between which the profile faces the plane."""
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


@kernel
def place(profile, arc, point, angle, mirror, strips, n, edges):
    """Fill the arc lengths at which each strip begins and ends on the profile.

    Its edges are projected along the normal of the contact plane, which lies at `angle` through the profile's `point` (y0, z0);
    `mirror` is -1 where angle and strips are those of the left side. The plane is taken not to be rolled relative to the
    profile: a roll of 10 mrad shifts a point 0.1 mm off the plane by 1 µm. Beyond its ends, and where it turns away from
    the plane, the profile is continued straight.

    Returns
    -------
    float
        How far the profile passes (y0, z0) by, along the normal, or ends before it [m].
    """
    y0, z0 = point
    c, s = math.cos(angle), mirror * math.sin(angle)
    first, last = _facing(profile, arc, y0, z0, c, s)
    k, off = first, 0.0
    for i in range(-1, 2 * n):  # the first is the reference point
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


@kernel
def deposit(rates, edges, strips, n, settings, share, is_wheel, bins):
    """Let `n` strips act on a wheel or a rail over a distance: each is shared over the bins that it overlaps.

    `settings` is a record LEDGER of `layout`, `share` that with which the patch counts. Bin k begins at width·(start + k); the
    first and the last are open outwards, so that nothing is lost.
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
                of_the_bin = row == Bin.VOLUME or row == Bin.T_GAMMA  # the others are means over its width
                bins[row, k] += amount * rate if of_the_bin else amount * rate / width
            if amount > 0.0:
                bins[Bin.ENERGY_INDEX_MAX, k] = max(bins[Bin.ENERGY_INDEX_MAX, k], rates[Bin.ENERGY_INDEX_MAX, i])
