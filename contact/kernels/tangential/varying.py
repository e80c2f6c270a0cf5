"""Friction that varies along a strip with the slip velocity and the temperature of each element (theory.md 8.1, 8.5).

Both follow from the slip that an element has under the coefficient at rest. So the march does not change, and what is
added to it is causal: from the leading edge on, element by element. The temperature needs the heat of all elements
ahead, which takes n²/2 products per strip. Each of their weights takes a root. The weights are the same for a block of
strips.
"""

import math

from contact.core import kernel
from contact.kernels.friction import fallen, falls_hot, falls_locally, heating, of_heat
from contact.kernels.rows import Element, Strip
from contact.kernels.tangential.lanes import LANES, Now, Trace, Varying


@kernel
def varies(case):
    """Return whether the coefficient differs from element to element of a strip."""
    return falls_locally(case) or falls_hot(case)


@kernel
def begin_varying(strips, block, n, case, peaks, lanes):
    """Set the state at the leading edges of the strips from `block` on.

    `peaks` are their peaks of mu p, a row of `lanes`.
    """
    for l in range(LANES):
        lanes[Varying.SLOWED + l] = 1.0
        lanes[Varying.HEATING + l] = heating(case, strips[Strip.A, min(block + l, n - 1)], peaks[l])


@kernel
def _fill_warm(elements, k, lanes, trace):
    """Fill the row WARM with the rise of temperature [K] at the middle of element k by the heat of the elements ahead.

    Return the weight of the element's own heat. The weights are ∫ds'/√(s' - s) over each element, in which the heat is
    taken as constant.
    """
    start = elements[Element.END, k - 1] if k > 0 else 1.0
    middle = 0.5 * (start + elements[Element.END, k])
    for l in range(LANES):
        lanes[Varying.WARM + l] = 0.0
    before = math.sqrt(1.0 - middle)
    for j in range(k):
        root = math.sqrt(elements[Element.END, j] - middle)
        weight = 2.0 * (before - root)
        for l in range(LANES):
            lanes[Varying.WARM + l] += weight * trace[j, Trace.HEAT + l]
        before = root
    return 2.0 * before


@kernel
def soften(case, k, elements, lanes, trace):
    """Fill the row FALL with the coefficients of element k of a block, over those at rest.

    The caller has filled the slip over V (row SLIP), the heat under the coefficient at rest (FLUX, by HEATING), and the
    share of the element that sticks (STICK of `Now`). This share has no heat, so that the temperature is continuous as well.
    """
    for l in range(LANES):
        lanes[Varying.SLOWED + l] = fallen(
            case, lanes[Varying.SLIP + l], lanes[Now.STICK + l], lanes[Varying.SLOWED + l]
        )
        lanes[Varying.FALL + l] = lanes[Varying.SLOWED + l]
    if not falls_hot(case):
        return
    weight = _fill_warm(elements, k, lanes, trace)
    for l in range(LANES):
        heat = (1.0 - lanes[Now.STICK + l]) * lanes[Varying.FLUX + l]
        fall = of_heat(case, lanes[Varying.FALL + l], lanes[Varying.WARM + l], weight * heat)
        lanes[Varying.FALL + l], trace[k, Trace.HEAT + l] = fall, fall * heat
