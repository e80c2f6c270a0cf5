"""Positions of strips and elements inside a patch: cosine nodes, dense at the edges where pressure and traction are steep."""

import math

from contact.core import entry
from contact.kernels.arrays import Matrix, Numbers
from contact.kernels.rows import Element


@entry
def on_circle(k: int, n: int) -> tuple[float, float]:
    """Return cosine and sine of pi k/n, with an error of at most 2e-16.

    No libm is used, so strips lie at the same positions on every platform to the last digit. Integers reduce k/n
    exactly to an eighth of the circle, in which Taylor's series is evaluated.
    """
    k %= 2 * n
    lower, left = k > n, False
    if lower:
        k = 2 * n - k
    if 2 * k > n:
        k, left = n - k, True
    steep = 4 * k > n
    angle = math.pi * (n - 2 * k) / (2 * n) if steep else math.pi * k / n
    square = angle * angle
    cosine, sine = 1.0, 1.0
    for i in range(18, 0, -2):
        cosine = 1.0 - square / (i * (i - 1)) * cosine
        sine = 1.0 - square / (i * (i + 1)) * sine
    sine *= angle
    if steep:
        cosine, sine = sine, cosine
    return -cosine if left else cosine, -sine if lower else sine


@entry
def fill_fejer(nodes: Numbers, weights: Numbers) -> None:
    """Fill nodes and weights of Fejér's first rule on [-1, 1], as many as the arrays hold."""
    n = nodes.size
    for i in range((n + 1) // 2):  # the other half is the mirror image, so the rule is symmetric to round-off
        total = 0.0
        for k in range(1, n // 2 + 1):
            total += on_circle((2 * i + 1) * k, n)[0] / (4.0 * k * k - 1.0)
        nodes[i] = -on_circle(2 * i + 1, 2 * n)[0]
        weights[i] = 2.0 / n * (1.0 - 2.0 * total)
        nodes[n - 1 - i], weights[n - 1 - i] = -nodes[i], weights[i]


@entry
def fill_panel(edges: Numbers, logs: Matrix) -> None:
    """Fill `edges` of cosine-spaced strips on [-1, 1], and `logs[i, k]` = ln|edge k - middle of strip i|."""
    n = logs.shape[0]
    for k in range(n // 2 + 1):
        edges[k] = -on_circle(k, n)[0]
        edges[n - k] = -edges[k]
    for i in range(n):
        for k in range(n + 1):
            logs[i, k] = math.log(abs(edges[k] - 0.5 * (edges[i + 1] + edges[i])))


@entry
def fill_elements(rows: Matrix) -> None:
    """Fill the rows of `Element` for as many elements as `rows` holds."""
    n = rows.shape[1]
    # tangent of half the angle; atanh(cos) is minus its logarithm. The first is not used, but compilers divide by it.
    before, half_angle = 1.0, 1.0
    for k in range(n):
        end = (k + 1) * math.pi / n
        (s, sine), (end_s, end_sine) = on_circle(2 * k + 1, 2 * n), on_circle(k + 1, n)
        rows[Element.S, k], rows[Element.SINE, k], rows[Element.DX, k] = s, sine, sine * math.pi / n
        rows[Element.STEP, k], rows[Element.MIDDLE, k] = before - s, 0.5 * (before + s)
        rows[Element.ATANH, k] = math.log(sine / (1.0 + s) / half_angle) if k > 0 else math.inf
        rows[Element.ANGLE_END, k], rows[Element.LOAD_END, k] = end, 0.5 * (end - end_sine * end_s)
        rows[Element.MOMENT_END, k], rows[Element.END, k] = end_sine**3 / 3.0, end_s
        before, half_angle = s, sine / (1.0 + s)
