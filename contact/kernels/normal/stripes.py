"""STRIPES (Ayasse and Chollet 2005): Hertz's contact strip by strip, corrected so that an ellipse is reproduced.

Strips lie where g < eps·delta. Their length follows from a corrected curvature along x (theory.md 5):

    A correction    eps = n0² B0/(r0 (A0 + B0)) = 1/(1 + beta0),   A_c = (n/m)² B
    AB correction   eps = n0²/(r0 (1 + (n0/m0)²)),                 A_c = (A + B) (n/m)²/(1 + (n/m)²)

    a² = (eps·delta - g)/A_c,   p0 = (2 E*/pi) (eps·delta - g)/(eps n r a)

m, n, r are those of the local A(y), B(y). The index 0 stands for the smallest gap. On an ellipse the A correction is
Hertz's solution. The AB correction has Hertz's a, but b² = eps·delta/B. B is smoothed and floored as in ANALYN, because
the published smoothing is not at hand. The pressure is our choice: it is Hertz's on the A-corrected ellipse. [R]:
recalled from Ayasse and Chollet, Vehicle System Dynamics 43 (2005) 161, by way of the thesis, ch. 7.
"""

import math

from contact.core import kernel
from contact.kernels.cubic import slopes
from contact.kernels.hertz import local_factors
from contact.kernels.normal.curvature import floored, lateral_curvature
from contact.kernels.rows import Sample


@kernel
def prepare(y, g, A, n, point, both, work):
    """Fill effective gap, effective curvature and Hertz's factors of all samples. `both` selects the AB correction."""
    ratio2 = math.exp(-2.0 * point.log_aspect)  # (n0/m0)²
    share = 1.0 / point.one_beta
    if both:
        share *= (1.0 + point.A / point.B) / (1.0 + ratio2)
    below, above = 0, 0
    for i in range(n):
        B, below, above = lateral_curvature(y, g, work[Sample.GAP_SLOPE], n, i, point.base, below, above)
        B = floored(B, point.floor)
        _, _, nr, log_aspect = local_factors(A[i], B)
        ratio2 = math.exp(-2.0 * log_aspect)
        corrected = (A[i] + B) * ratio2 / (1.0 + ratio2) if both else ratio2 * B
        work[Sample.EFFECTIVE_GAP, i] = (g[i] - point.g) / share
        work[Sample.STRETCHED_A, i] = corrected / share
        work[Sample.NR, i], work[Sample.LOG_ASPECT, i] = nr, log_aspect
    slopes(y, work[Sample.EFFECTIVE_GAP], n, work[Sample.EFFECTIVE_SLOPE])
