"""FASTSIM (Kalker 1982) on any patch: simplified theory with a choice of flexibilities and bound (theory.md 2.5).

    fastsim           three flexibilities, parabolic bound
    fastsim_one       one flexibility, weighted by the creepages, parabolic bound
    fastsim_elliptic  three flexibilities, elliptic bound mu p
    fastsim_linder    three of each strip's own ellipse, as wide as the patch (Linder 1997; `normal.linder`)
    fastsim_stripes   three of each strip's own ellipse, as long as the patch, with a/b of the local curvatures (Ayasse and
                      Chollet 2005, as in theory.md 4.4; the published length of this ellipse is not at hand)
    fastsim_knothe    three with which the slopes of the forces are those of the half space on the patch itself, given as
                      coefficients (`halfspace.linear`; after Knothe and Le The 1984)

`fastsim_linder` and `fastsim_stripes` are local. All others take the equivalent ellipse of each separate patch: its area
with the longest strip as semi-axis a. On an ellipse the local ellipses are that ellipse too, so the local methods equal
`fastsim`.

The parabolic bound of a strip has its peak proportional to its p0·a, scaled so that the bounds carry the patch's load.
On an ellipse this is exactly Kalker's paraboloid. On any patch full slip gives mu N. The weighted flexibility depends
on the ratio of the creepages, however small they are.
"""

import math
from enum import auto

from contact.core import kernel
from contact.kernels.enumerations import Tangential
from contact.kernels.normal.linder import local_ellipse
from contact.kernels.rows import Element, Field, Strip
from contact.kernels.tangential.ellipses import equivalent_ellipse, flexibilities, weighted
from contact.kernels.tangential.lanes import LANES, Now, Row, Trace, Varying, after
from contact.kernels.tangential.march import Even, March, march
from contact.kernels.tangential.varying import begin_varying, soften, varies

#: A traction bound below this fraction of G counts as zero. Creepage divided by it would overflow.
NO_FRICTION = 1e-15


class _Lane(Row):
    """Rows of `lanes` after those of the march."""

    PEAK = after(March)
    L1 = auto()
    L2 = auto()
    PER_LENGTH = auto()


@kernel
def _local_axes(strips, i, method, a0, edges):
    """Return the semi-axes [m] of the ellipse of strip i by Linder or STRIPES."""
    if method == Tangential.FASTSIM_STRIPES:
        return a0, a0 * math.exp(-strips[Strip.ASPECT, i])
    k = int(strips[Strip.PATCH, i])
    return local_ellipse(strips[Strip.A, i], strips[Strip.Y, i], edges[2 * k], edges[2 * k + 1])


@kernel
def _peak_per_load(part, strips, elements, mu, elliptic):
    """Return the peak of a strip's bound over p0 (elliptic bound) or over p0·a (parabolic bound).

    The parabolas carry the load by the quadrature of the fields.
    """
    if elliptic:
        return mu
    cubes, spread = 0.0, 0.0
    for k in range(elements.shape[1]):
        cubes += elements[Element.SINE, k] ** 2 * elements[Element.DX, k]
    for i in range(part.first, part.last):
        spread += cubes * strips[Strip.P0, i] * strips[Strip.A, i] ** 2 * strips[Strip.DY, i]
    return mu * part.N / spread if spread > 0.0 else 0.0


@kernel
def _slip(lanes, trace, k, l):
    """Return the slip over V (sx, sy) of element k in lane l."""
    slip = trace[k, Now.SLIP + l] * lanes[_Lane.PER_LENGTH + l]
    return -lanes[_Lane.L1 + l] * slip * trace[k, Now.X + l], -lanes[_Lane.L2 + l] * slip * trace[k, Now.Y + l]


@kernel
def _fill_friction(case, elliptic, elements, lanes, trace):
    """Fill the column FALL of `trace` with the coefficients of friction along the strips of a block, over those at rest."""
    for k in range(elements.shape[1]):
        size = elements[Element.SINE, k] if elliptic else elements[Element.SINE, k] ** 2
        for l in range(LANES):
            sx, sy = _slip(lanes, trace, k, l)
            lanes[Varying.SLIP + l] = math.sqrt(sx * sx + sy * sy)
            lanes[Varying.FLUX + l] = (
                -lanes[Varying.HEATING + l] * size * (sx * trace[k, Now.X + l] + sy * trace[k, Now.Y + l])
            )
            lanes[Now.STICK + l] = trace[k, Now.STICK + l] if lanes[_Lane.PEAK + l] > 0.0 else 0.0
        soften(case, k, elements, lanes, trace)
        for l in range(LANES):
            trace[k, Trace.FALL + l] = lanes[Varying.FALL + l]


@kernel
def fastsim(part, case, workspace, result):
    """Fill the traction, slip and stick fields of one patch. Add its forces, power and slip area to `result`."""
    strips, fields, elements, table = (
        workspace.strips,
        workspace.fields,
        workspace.rule.elements,
        workspace.tables.kalker,
    )
    lanes, trace = workspace.space.lanes, workspace.space.trace
    method, G = case.tangential, case.G
    Fx, Fy, Mz, power, slip_area = 0.0, 0.0, 0.0, 0.0, 0.0
    elliptic = method == Tangential.FASTSIM_ELLIPTIC
    local = method == Tangential.FASTSIM_LINDER or method == Tangential.FASTSIM_STRIPES
    a0, b0 = equivalent_ellipse(strips, part.first, part.last)
    L1, L2, L3 = flexibilities(G, a0, b0, table)
    if method == Tangential.FASTSIM_ONE:
        vx, vy = case.vx - case.phi * part.y, case.vy + case.phi * part.x
        L1 = L2 = L3 = weighted(vx, vy, case.phi, math.sqrt(a0 * b0), L1, L2, L3)
    falling = varies(case)
    per_load = _peak_per_load(part, strips, elements, case.mu, elliptic)
    for block in range(part.first, part.last, LANES):
        for l in range(LANES):
            i = min(block + l, part.last - 1)
            a = strips[Strip.A, i]
            peak = per_load * strips[Strip.BOUND, i] * (1.0 if elliptic else a)
            scale = a / peak if peak > NO_FRICTION * G else 0.0
            if local:
                local_a, local_b = _local_axes(strips, i, method, a0, result.edges)
                L1, L2, L3 = flexibilities(G, local_a, local_b, table)
            vx, vy, phi = strips[Strip.VX, i], strips[Strip.VY, i], strips[Strip.PHI, i]
            lanes[_Lane.PEAK + l], lanes[_Lane.L1 + l], lanes[_Lane.L2 + l] = peak if scale > 0.0 else 0.0, L1, L2
            lanes[_Lane.PER_LENGTH + l] = lanes[_Lane.PEAK + l] / a if a > 0.0 else 0.0
            vx, vy = vx - phi * part.y, vy + phi * part.x  # L3 belongs to the spin about the patch's own place
            lanes[March.X + l] = scale * (vx / L1 - phi * (strips[Strip.Y, i] - part.y) / L3)
            x = strips[Strip.XC, i] - strips[Strip.OFFSET, i]  # as in `mapped_lanes`
            lanes[March.Y + l] = scale * (vy / L2 + phi * (x - part.x) / L3)
            lanes[March.Z + l] = scale * a * phi / L3
        march(Even(elliptic), elements, lanes, trace)
        if falling:
            begin_varying(strips, block, part.last, case, lanes[_Lane.PEAK : _Lane.PEAK + LANES], lanes)
            _fill_friction(case, elliptic, elements, lanes, trace)
        for l in range(min(LANES, part.last - block)):
            i = block + l
            row = min(i, fields.shape[1] - 1)  # one row serves all strips if only forces are wanted
            a, y, dy = strips[Strip.A, i], strips[Strip.Y, i], strips[Strip.DY, i]
            peak = lanes[_Lane.PEAK + l]
            frictionless = peak <= 0.0
            for k in range(elements.shape[1]):
                ex, ey = trace[k, Now.X + l], trace[k, Now.Y + l]
                stick = trace[k, Now.STICK + l]
                size = peak * (elements[Element.SINE, k] if elliptic else elements[Element.SINE, k] ** 2)
                qx, qy = size * ex, size * ey
                sx, sy = _slip(lanes, trace, k, l)
                stick = 0.0 if frictionless else stick
                slides = trace[k, Now.SLIDES + l]
                if falling:
                    fall = trace[k, Trace.FALL + l]
                    used = math.sqrt(ex * ex + ey * ey)
                    if fall < 1.0 and used > fall:
                        qx, qy = qx * (fall / used), qy * (fall / used)
                        stick, slides = 0.0, 1.0
                fields[Field.QX, row, k], fields[Field.QY, row, k] = qx, qy
                fields[Field.SX, row, k], fields[Field.SY, row, k] = sx, sy
                fields[Field.STICK, row, k] = 0.0 if frictionless else 1.0 - slides
                dA = a * elements[Element.DX, k] * dy
                Fx += qx * dA
                Fy += qy * dA
                Mz += ((strips[Strip.XC, i] + a * elements[Element.S, k]) * qy - y * qx) * dA
                power -= (qx * sx + qy * sy) * dA
                slip_area += (1.0 - stick) * elements[Element.STEP, k] * a * dy
            slides = 1.0 if frictionless else trace[elements.shape[1] - 1, Now.SLIDES + l]
            slip_area += slides * (1.0 + elements[Element.S, -1]) * a * dy  # after the middle of the last element
    result.Fx += Fx
    result.Fy += Fy
    result.Mz += Mz
    result.power += power
    result.slip_area += slip_area
