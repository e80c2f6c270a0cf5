"""The orientation in which a separation is solved, so that mirror images have mirrored answers to the last bit.

An iteration that stops at a tolerance amplifies round-off: it ended up to 5 % apart for mirror images in the flange, where two
panels of strips compete. Of a separation and its mirror image, y → −y, one is solved. The answer of the other is its image.
"""

from contact.core import kernel
from contact.kernels.arrays import Samples
from contact.kernels.rows import Sep, Strip


@kernel
def is_image(g):
    """Return whether the mirror image is solved: whether the gaps `g` on the left are larger, summed over all samples.

    Samples are compared in pairs from both ends. So the sum of the image is the negative one to the last bit.
    """
    n, more = g.size, 0.0
    for i in range(n // 2):
        more += g[i] - g[n - 1 - i]
    return more > 0.0


@kernel
def turn_samples(sep, image, rows):
    """Return the separation in the orientation in which it is solved: a copy in `rows`, mirrored if `image`."""
    n, sign = sep.y.size, -1.0 if image else 1.0
    for i in range(n):
        k = n - 1 - i if image else i
        rows[Sep.Y, i], rows[Sep.TILT, i] = sign * sep.y[k], sign * sep.tilt[k]
        rows[Sep.G, i], rows[Sep.A, i], rows[Sep.XC, i] = sep.g[k], sep.A[k], sep.x_c[k]
    return Samples(rows[Sep.Y, :n], rows[Sep.G, :n], rows[Sep.A, :n], rows[Sep.XC, :n], rows[Sep.TILT, :n])


@kernel
def _reverse(row, n):
    for i in range(n // 2):
        row[i], row[n - 1 - i] = row[n - 1 - i], row[i]


@kernel
def turn_back(n, strips, edges):
    """Mirror the `n` strips of the normal problem and the edges of their patches."""
    if n == 0:
        return
    last = strips[Strip.PATCH, n - 1]
    for row in (Strip.Y, Strip.DY, Strip.XC, Strip.A, Strip.P0, Strip.LN_ASPECT, Strip.PATCH, Strip.OFFSET):
        _reverse(strips[row], n)
    for i in range(n):
        strips[Strip.Y, i] = -strips[Strip.Y, i]
        strips[Strip.PATCH, i] = last - strips[Strip.PATCH, i]
    count = 2 * (int(last) + 1)
    _reverse(edges, count)
    for k in range(count):
        edges[k] = -edges[k]
