"""Effective creepages, at which mapped strip marching has the half space's forces on the patch's equivalent ellipse.

On an ellipse the march differs from the half space by .011 of mu N in the mean over the nodes of the table of creep
forces (`tangential.table`), because it treats each strip by itself (theory.md 4.4). For every node the table holds the
relative change of (X, Y, w Z), divided by r, and a change of the exponent of the map. With these changes the march has
force and moment of the half space, and its share of slip is closer. A strip gets the changes for the equivalent ellipse,
load and mean creepages of its shape, which is the patch or a lobe of it (`ties`). So the effect of a non-elliptic shape
still comes from pressure, strips and march. Tractions are those of the march and never exceed friction. At vanishing
creepage and in full slip nothing changes.

The slip follows the given creepages. `fastrip_mapped` scales it for each patch so that it dissipates the work of the forces.

`contact table effective` computes the table from that of creep forces (`contact.study.effective`). No case of CONTACT
is in it.
"""

import math

from contact.core import kernel
from contact.kernels import kalker
from contact.kernels.rows import Strip
from contact.kernels.tangential.ellipses import mean_ellipse
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.skew import coupled
from contact.kernels.tangential.table import Part, interpolated, is_beyond, signs, units
from contact.kernels.tangential.ties import is_read, share_shape

#: What a lopsided shape adds (mapped_strip.md Eq. lopsided): longitudinal creepage by spin, creepage without spin, and lateral
#: creepage by spin if the shape is skewed.
_SPIN, _WITHOUT_SPIN, _AHEAD = 0.6, 0.4, 0.7
#: What a shape with a tail adds: a part of the creepages, and lateral creepage by spin.
_OF_TAIL, _SPIN_OF_TAIL = -0.1, 0.33
#: Most that counts of how lopsided a shape is.
_MOST = 0.2


@kernel
def _on_shape(lopsided, ahead, tail, X, Y, Z):
    """Return what a shape that is no ellipse adds to X and Y (mapped_strip.md Eq. lopsided).

    `lopsided` is the way from the centre of its load to that of its stiffness along y, over c, `ahead` the same along x. Strips
    do not displace each other evenly then. `tail` is the logarithm of its longest strip over that of the ellipse with its mean
    length. On an ellipse all three are 0.
    """
    square = X * X + Y * Y + Z * Z
    fading = 1.0 / (1.0 + square)
    cube = fading * math.sqrt(fading)
    to_x = _SPIN * fading * Z + Y * (_WITHOUT_SPIN * cube * Y * Y - fading * fading * Z * Z)
    to_y = X * (_WITHOUT_SPIN * square * fading * fading - cube * Y * Z)
    by_tail = tail * (_OF_TAIL * fading * Y + _SPIN_OF_TAIL * square * cube * Z)
    return lopsided * to_x + tail * _OF_TAIL * fading * X, lopsided * to_y + by_tail + ahead * _AHEAD * fading * Z


@kernel
def _changes(strips, first, last, i, case, tables):
    """Return the changes of creepages and map exponent for the shape of strip i, and 1 if it is beyond the table.

    Rigid slip is referred to the centre of the shape, `SHARE` are the shares in it.

    The equivalent ellipse has the shape's area and mean length. On our own patches this is better than
    the longest strip (.0054 instead of .0058 of mu N on new profiles). Creepages that differ from strip to strip enter by
    their means, with the weights a·dy.
    """
    G = case.G
    a, b = mean_ellipse(strips, first, last)
    longest, weights, x, vx, vy, phi, limit = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    load, load_y, load_x, stiffness, stiffness_y, stiffness_x = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(first, last):
        weight, y = strips[Strip.SHARE, j] * strips[Strip.A, j] * strips[Strip.DY, j], strips[Strip.Y, j]
        longest = max(longest, strips[Strip.SHARE, j] * strips[Strip.A, j])
        weights += weight
        pressed = weight * strips[Strip.P0, j]
        load, load_y, load_x = load + pressed, load_y + pressed * y, load_x + pressed * strips[Strip.XC, j]
        stiff = weight * strips[Strip.A, j]
        stiffness, stiffness_y = stiffness + stiff, stiffness_y + stiff * y
        stiffness_x += stiff * strips[Strip.XC, j]
        limit += weight * strips[Strip.BOUND, j]
        x += weight * strips[Strip.XC, j]
        vx += weight * (strips[Strip.VX, j] + strips[Strip.BY_PULL_X, j] - strips[Strip.PHI, j] * strips[Strip.Y, j])
        vy += weight * (strips[Strip.VY, j] + strips[Strip.BY_PULL_Y, j] + strips[Strip.PHI, j] * strips[Strip.XC, j])
        phi += weight * strips[Strip.PHI, j]
    limit *= 0.5 * math.pi * case.mu
    if not limit > NO_FRICTION * G * a * b or (vx == 0.0 and vy == 0.0 and phi == 0.0):
        return 0.0, 0.0, 0.0, 0.0, 0.0
    x, vx, vy, phi = x / weights, vx / weights, vy / weights, phi / weights
    log_aspect, c = math.log(a / b) + strips[Strip.TURN, i], math.sqrt(a * b)
    coefficients = kalker.coefficients(tables.kalker, log_aspect)
    unit_x, unit_y, unit_z, weight = units(G, c, limit, log_aspect, coefficients)
    unit_spin = weight * unit_z
    X, Y, spin = unit_x * vx, unit_y * vy, unit_spin * phi
    sign_x, sign_y = signs(X, Y, spin)
    to_x, to_y, to_spin, exponent = interpolated(
        log_aspect, sign_x * X, sign_y * Y, sign_y * spin, Part.EFFECTIVE, tables.creep
    )
    r = math.sqrt(X * X + Y * Y + spin * spin)
    to_spin *= sign_y * r / unit_spin
    by_turn_x, by_turn_y = coupled(strips[Strip.COUPLING, i], case.nu, r, coefficients, c, (vx, vy, phi))
    lopsided = min(max((stiffness_y / stiffness - load_y / load) / c, -_MOST), _MOST)
    ahead = min(max((stiffness_x / stiffness - load_x / load) / c, -_MOST), _MOST)
    by_shape_x, by_shape_y = _on_shape(lopsided, ahead, math.log(longest / a), X, Y, unit_z * phi)
    return (
        (sign_x * r * to_x + by_shape_x) / unit_x + to_spin * strips[Strip.CENTRE, i] + by_turn_x,
        (sign_y * r * to_y + by_shape_y) / unit_y - to_spin * x + by_turn_y,
        to_spin,
        exponent,
        1.0 if is_beyond(log_aspect) else 0.0,
    )


@kernel
def _mix(strips, i, j, k, share):
    """Set the changes of strip i between those of strips j and k."""
    strips[Strip.TO_X, i] = strips[Strip.TO_X, j] + share * (strips[Strip.TO_X, k] - strips[Strip.TO_X, j])
    strips[Strip.TO_Y, i] = strips[Strip.TO_Y, j] + share * (strips[Strip.TO_Y, k] - strips[Strip.TO_Y, j])
    strips[Strip.TO_PHI, i] = strips[Strip.TO_PHI, j] + share * (strips[Strip.TO_PHI, k] - strips[Strip.TO_PHI, j])
    here, there = strips[Strip.TO_EXPONENT, j], strips[Strip.TO_EXPONENT, k]
    strips[Strip.TO_EXPONENT, i] = here + share * (there - here)


@kernel
def _set_changes(strips, first, around, i, back, case, tables, beyond):
    """Set the changes of strip i of a patch: those of strip i - `back` if it has the same shape.

    Return 1 if they were read beyond the table, else 0; `beyond` is what strip i - `back` had.
    """
    if i - back >= first and strips[Strip.TIE, i] * strips[Strip.TIE, i - back + 1] == 1.0:
        _mix(strips, i, i - back, i - back, 0.0)
        return beyond
    share_shape(strips, around[0], around[1], i)
    to_x, to_y, to_phi, exponent, outside = _changes(strips, around[0], around[1], i, case, tables)
    strips[Strip.TO_X, i], strips[Strip.TO_Y, i] = to_x, to_y
    strips[Strip.TO_PHI, i], strips[Strip.TO_EXPONENT, i] = to_phi, exponent
    return outside


@kernel
def set_effective(strips, first, last, around, case, tables):
    """Set the effective creepages and the map exponent of every strip of one patch, as changes.

    Return the share of the load of the strips for which the table was read beyond its a/b. `around` are the first of all strips
    of the separation and the one after its last.
    The table takes .9 µs. Where shapes change it is read for every other strip. A strip between two others gets a mean of
    theirs, in which the one that it is tied to more closely has the greater weight.
    """
    before, beyond, outside, load = first, 0.0, 0.0, 0.0
    for i in range(first, last):
        if is_read(i, first, last):
            beyond = _set_changes(strips, first, around, i, max(i - before, 1), case, tables, beyond)
            before = i
            share = strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
            load, outside = load + share, outside + beyond * share
    for i in range(first + 1, last - 1):
        if not is_read(i, first, last):
            low, high = 1.0 - strips[Strip.TIE, i], 1.0 - strips[Strip.TIE, i + 1]
            _mix(strips, i, i - 1, i + 1, low / max(low + high, 1e-300))  # 0 / 0 would be a trap
    return outside / max(load, 1e-300)
