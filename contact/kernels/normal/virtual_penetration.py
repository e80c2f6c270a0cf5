"""Steps that the methods of virtual penetration share: cut the gap at a level, set pressures, describe the ellipse.

The undeformed bodies penetrate each other. The patch is where they would overlap at a share of the approach. Let G be
an effective gap and S an effective half curvature, both in `work`. A strip at y is in contact where G(y) < delta, and
its half length is a = √((delta - G)/S). With a constant share eps, G = g/eps and S = A/eps, so A a² = eps·delta - g.
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.cubic import locate, slopes
from contact.kernels.normal.influence import centre_slope
from contact.kernels.normal.lay import at_end, find_patches, lay_strips
from contact.kernels.rows import Sample, Strip


@kernel
def share_gap(y, g, A, n, g_least, share, work):
    """Fill effective gap and curvature of a penetration that is a constant share of the approach."""
    for i in range(n):
        work[Sample.EFFECTIVE_GAP, i] = (g[i] - g_least) / share
        work[Sample.STRETCHED_A, i] = A[i] / share
    slopes(y, work[Sample.EFFECTIVE_GAP], n, work[Sample.EFFECTIVE_SLOPE])


@kernel
def cut(sep, level, across, work, strips, edges):
    """Fill y, dy, x_c, a and patch of strips where G < level. P0 holds the depth level - G [m].

    Returns
    -------
    n_strips, touches_end
    """
    y, xc, n = sep.y, sep.x_c, sep.y.size
    G, m, S = work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE], work[Sample.STRETCHED_A]
    count = find_patches(y, G, m, n, level, edges)
    n_strips = lay_strips(edges, count, across, strips)
    k = 0
    for i in range(n_strips):
        at = strips[Strip.Y, i]
        k = locate(y, n, at, k)
        h = y[k + 1] - y[k]
        t = (at - y[k]) / h
        depth = max(level - cubic.value(h, G[k], m[k], G[k + 1], m[k + 1], t), 0.0)
        strips[Strip.A, i] = math.sqrt(depth / ((1.0 - t) * S[k] + t * S[k + 1]))
        strips[Strip.P0, i] = depth
        strips[Strip.XC, i] = (1.0 - t) * xc[k] + t * xc[k + 1]
    return n_strips, at_end(y, n, edges, count)


@kernel
def carried(strips, n):
    """Return the load of strips with semi-elliptic pressure [N]."""
    N = 0.0
    for i in range(n):
        N += 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
    return N


@kernel
def displacement(strips, n, edges, at, a_at, peak):
    """Return the surface displacement times pi E* [N/m] at the lateral position `at` on the centre line.

    Half length `a_at` and p0 `peak` there are given. A strip adds p0 dy U'(eta/a) (`influence`). The part that is
    singular at eta = 0 is taken out of the sum over the strips of the patch around `at` and integrated in closed form.
    It is 2 peak asinh(c/eta) with c = 2 a/e, which is U' for small and, to 6 %, for large eta/a. The contact locus is
    taken as straight.
    """
    total, width, patch = 0.0, 0.0, -1.0
    c = 2.0 * math.exp(-1.0) * a_at
    for i in range(n):
        k = int(strips[Strip.PATCH, i])
        if peak > 0.0 and edges[2 * k] < at < edges[2 * k + 1]:
            width, patch = edges[2 * k + 1] - edges[2 * k], strips[Strip.PATCH, i]
            for s in (at - edges[2 * k], edges[2 * k + 1] - at):
                total += 2.0 * peak * (s * math.asinh(c / s) + c * math.asinh(s / c))
            break
    for i in range(n):
        a, p0 = strips[Strip.A, i], strips[Strip.P0, i]
        if a <= 0.0:
            continue
        eta = max(abs(strips[Strip.Y, i] - at), 1e-9 * width)
        density = p0 * centre_slope(eta / a)
        if strips[Strip.PATCH, i] == patch:
            density -= 2.0 * peak * math.asinh(c / eta)
        total += density * strips[Strip.DY, i]
    return total


@kernel
def set_pressures(strips, n, edges, at, a_at, delta, modulus):
    """Set p0 = kappa·a [Pa] such that the displacement at `at`, with the half length `a_at`, is delta.

    One kappa serves all patches, so the load stays continuous where patches appear and merge.
    """
    for i in range(n):
        strips[Strip.P0, i] = strips[Strip.A, i]
    kappa = math.pi * modulus * delta / displacement(strips, n, edges, at, a_at, a_at)
    for i in range(n):
        strips[Strip.P0, i] *= kappa


@kernel
def equivalent_aspect(strips, n):
    """Set LN_ASPECT of each strip to ln(a/b) of its patch's equivalent ellipse.

    This ellipse has the longest strip as a and the area of the patch.
    """
    i = 0
    while i < n:
        a, area, end = 0.0, 0.0, i
        while end < n and strips[Strip.PATCH, end] == strips[Strip.PATCH, i]:
            a = max(a, strips[Strip.A, end])
            area += 2.0 * strips[Strip.A, end] * strips[Strip.DY, end]
            end += 1
        log_aspect = math.log(math.pi * a * a / area) if area > 0.0 else 0.0
        for k in range(i, end):
            strips[Strip.LN_ASPECT, k] = log_aspect
        i = end
