"""Partition of the contact into panels: idle parts cut off, panels parted where strips are idle or the gap has a ridge, joined
and removed.
"""

import math

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Matrix, Numbers
from contact.kernels.cubic import locate
from contact.kernels.normal.panels import resample, take_over
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Vector

#: A panel narrower than this, over the widest, is removed.
NO_PANEL = 1e-5
#: Width of idle strips between loaded ones, over that of the panel, from which on it is parted there, and the least number
#: of loaded strips on either side.
_GAP, _BESIDE = 0.1, 3
#: The same width over the half length of the shorter strip beside it. A thin lobe, all of whose strips touch, has idle ones too
#: before it comes to rest.
_APART = 0.1
#: Height of a ridge of the gap over the lobes at its sides, over the approach, from which on a panel is parted there. Below it
#: one panel does as well.
_RIDGE = 2e-2


@kernel
def cut_idle(n, n_panels, panels, cosines, vectors):
    """Move the ends by Vector.R without mixing, and transfer the half lengths."""
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        low, high = panels[2 * p], panels[2 * p + 1]
        panels[2 * p], panels[2 * p + 1] = low + vectors[Vector.R, first], high + vectors[Vector.R, last]
        resample(low, high, panels[2 * p], panels[2 * p + 1], cosines, vectors, first)
        vectors[Vector.ACTIVE, first : first + n] = 1.0


@kernel
def _widest_gap(p, n, panels, cosines, vectors):
    """Return the first and the last strip of the widest idle part between loaded strips of panel p; -1, -1 for none.

    At least `_BESIDE` loaded strips lie on either side of it. Strips are counted from the panel's first one.
    """
    pressures, lengths = vectors[Vector.P, p * n : p * n + n], vectors[Vector.A, p * n : p * n + n]
    panel_width = panels[2 * p + 1] - panels[2 * p]
    first, last, widest, before, total = -1, -1, _GAP, 0, 0
    for i in range(n):
        total += 1 if pressures[i] > 0.0 else 0
    i = 0
    while i < n:
        if pressures[i] > 0.0:
            before += 1
            i += 1
            continue
        k = i
        while k < n and not pressures[k] > 0.0:
            k += 1
        width = 0.5 * (cosines[k] - cosines[i])
        beside = before >= _BESIDE and total - before >= _BESIDE  # so there are strips i - 1 and k
        if beside and width > widest and width * panel_width > _APART * min(lengths[i - 1], lengths[k]):
            first, last, widest = i, k - 1, width
        i = k
    return first, last


@kernel
def _split(p, end, begin, q, panels, cosines, vectors):
    """Let panel p end at `end`. The new panel q reaches from `begin` to where p ended."""
    n = cosines.size - 1
    low, high = panels[2 * p], panels[2 * p + 1]
    for i in range(n):
        for row in (Vector.LN_A, Vector.OFFSET, Vector.A):
            vectors[row, q * n + i] = vectors[row, p * n + i]
    panels[2 * p + 1], panels[2 * q], panels[2 * q + 1] = end, begin, high
    resample(low, high, low, end, cosines, vectors, p * n)
    resample(low, high, begin, high, cosines, vectors, q * n)
    for part in (p, q):
        vectors[Vector.ACTIVE, part * n : part * n + n] = vectors[Vector.P, part * n : part * n + n] = 1.0


@kernel
def part_panels(n, n_panels, panels, cosines, vectors):
    """Part panels where strips between loaded ones are idle. Return their number.

    Both parts begin at the loaded strips. Strips of one panel would be wasted between them, and the patches' inner ends would
    lie at the sides of strips.
    """
    known = n_panels
    for p in range(known):
        first, last = _widest_gap(p, n, panels, cosines, vectors)
        if first < 0 or n_panels == MAX_PATCHES:
            continue
        centre, half = 0.5 * (panels[2 * p] + panels[2 * p + 1]), 0.5 * (panels[2 * p + 1] - panels[2 * p])
        _split(p, centre + half * cosines[first], centre + half * cosines[last + 1], n_panels, panels, cosines, vectors)
        n_panels += 1
    return n_panels


@entry
def have_gap(n: int, n_panels: int, panels: Numbers, cosines: Numbers, vectors: Matrix) -> bool:
    """Return whether a panel has a wide idle part between loaded strips, and there is room for one more panel."""
    for p in range(n_panels):
        if _widest_gap(p, n, panels, cosines, vectors)[0] > 0:
            return n_panels < MAX_PATCHES
    return False


@kernel
def _remove_panel(p, n, n_panels, panels, vectors):
    """Remove panel p from the lists; those after it move up."""
    for q in range(p, n_panels - 1):
        panels[2 * q], panels[2 * q + 1] = panels[2 * q + 2], panels[2 * q + 3]
        for i in range(n):
            for row in (Vector.LN_A, Vector.ACTIVE, Vector.P, Vector.END, Vector.A, Vector.HALF, Vector.R):
                vectors[row, q * n + i] = vectors[row, (q + 1) * n + i]
            for row in (Vector.OFFSET, Vector.OFFSET_R, Vector.XC, Vector.Y, Vector.LN_LENGTH):
                vectors[row, q * n + i] = vectors[row, (q + 1) * n + i]


@entry
def remove_unloaded(n: int, n_panels: int, panels: Numbers, vectors: Matrix) -> int:
    """Remove the panels that carry no load or have shrunk to nothing. Return the number of panels left."""
    widest = 0.0
    for p in range(n_panels):
        widest = max(widest, panels[2 * p + 1] - panels[2 * p])
    p = 0
    while p < n_panels:
        loaded = False
        if panels[2 * p + 1] - panels[2 * p] < NO_PANEL * widest:
            _remove_panel(p, n, n_panels, panels, vectors)
            n_panels -= 1
            continue
        for i in range(n):
            loaded = loaded or vectors[Vector.P, p * n + i] > 0.0
        if loaded:
            p += 1
        else:
            _remove_panel(p, n, n_panels, panels, vectors)
            n_panels -= 1
    return n_panels


@kernel
def _join(p, q, n, n_panels, panels, cosines, vectors):
    """Let panel p reach over panel q > p too, which is removed."""
    wider = p if panels[2 * p + 1] - panels[2 * p] >= panels[2 * q + 1] - panels[2 * q] else q
    low, high = min(panels[2 * p], panels[2 * q]), max(panels[2 * p + 1], panels[2 * q + 1])
    resample(panels[2 * wider], panels[2 * wider + 1], low, high, cosines, vectors, wider * n)
    take_over(p + q - wider, panels, low, high, cosines, vectors, wider * n)
    for i in range(n):
        vectors[Vector.LN_A, p * n + i] = vectors[Vector.LN_A, wider * n + i]
        vectors[Vector.OFFSET, p * n + i] = vectors[Vector.OFFSET, wider * n + i]
    vectors[Vector.ACTIVE, p * n : p * n + n] = 1.0
    panels[2 * p], panels[2 * p + 1] = low, high
    _remove_panel(q, n, n_panels, panels, vectors)


@kernel
def join_panels(n, n_panels, panels, cosines, vectors):
    """Join panels that overlap into one. Return their number and whether any were joined."""
    known = n_panels
    p = 0
    while p < n_panels:
        q = p + 1
        while q < n_panels:
            if panels[2 * q] < panels[2 * p + 1] and panels[2 * p] < panels[2 * q + 1]:
                _join(p, q, n, n_panels, panels, cosines, vectors)
                n_panels -= 1
            else:
                q += 1
        p += 1
    return n_panels, n_panels < known


@kernel
def _ridge(sep, slopes, least, low, high, near):
    """Return the number of ridges of the gap between `low` and `high`, and the place of the one next to `near`.

    From a ridge the gap falls by more than `least` to both sides.
    """
    y, g, size = sep.y, sep.g, sep.y.size
    k = locate(y, size, low, 0) + 1
    bottom = top = k
    rising, count, at = False, 0, math.inf
    while k < size and y[k] < high:
        top = k if g[k] > g[top] else top
        bottom = k if g[k] < g[bottom] else bottom
        if not rising and g[k] > g[bottom] + least:
            rising, top = True, k
        elif rising and g[k] < g[top] - least:
            m = top if slopes[top] > 0.0 else top - 1
            h = y[m + 1] - y[m]
            t, _ = cubic.least(h, -g[m], -slopes[m], -g[m + 1], -slopes[m + 1])
            place = y[m] + t * h
            count, at = count + 1, place if abs(place - near) < abs(at - near) else at
            rising, bottom = False, k
        k += 1
    return count, at


@kernel
def divide(sep, slopes, delta, n, n_panels, panels, cosines, vectors):
    """Part panels at ridges of the gap, where both parts meet, and join those that meet without one. Return their number.

    So lobes that a neck joins have the strips of lobes that a narrow gap parts, and nothing jumps where it closes. A panel with
    more ridges than there are panels left is rough rather than lobed, and stays whole. Return also whether anything changed.
    """
    least, changed = _RIDGE * delta, False
    p = 0
    while p < n_panels:
        q = 0
        while q < n_panels and panels[2 * p + 1] != panels[2 * q]:
            q += 1
        if q == n_panels:
            p += 1
            continue
        border = panels[2 * q]
        count, at = _ridge(sep, slopes, least, panels[2 * p], panels[2 * q + 1], border)
        if count == 0:
            _join(min(p, q), max(p, q), n, n_panels, panels, cosines, vectors)
            n_panels, changed, p = n_panels - 1, True, 0
            continue
        if at != border:  # it has moved with the pose since a warm start
            panels[2 * p + 1] = panels[2 * q] = at
            changed = True
        p += 1
    p = 0
    while p < n_panels:
        low, high = panels[2 * p], panels[2 * p + 1]
        longest = vectors[Vector.LN_A, p * n]
        for i in range(p * n, p * n + n):
            longest = max(longest, vectors[Vector.LN_A, i])
        margin = max(0.5 * (1.0 + cosines[min(_BESIDE, n // 2)]) * (high - low), _APART * math.exp(longest))
        count, at = _ridge(sep, slopes, least, low, high, low + margin)
        if 0 < count <= MAX_PATCHES - n_panels and low + margin < at < high - margin:
            _split(p, at, at, n_panels, panels, cosines, vectors)
            n_panels, changed = n_panels + 1, True
        else:
            p += 1
    return n_panels, changed
