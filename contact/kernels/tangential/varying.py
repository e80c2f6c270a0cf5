"""Friction that varies along a strip with the slip velocity and the temperature of each element (theory.md 8.1, 8.5).

Both follow from the slip that an element has under the coefficient at rest. So the march does not change, and what is
added to it is causal: from the leading edge on, element by element. The temperature needs the heat of all elements
ahead, which takes n²/2 products per strip. Each of their weights takes a root. The weights are the same for a block of
strips.
"""

import math

from contact._jit import kernel
from contact.kernels.friction import fallen, falls_hot, falls_locally, heating, of_heat
from contact.kernels.layout import Element, Strip
from contact.kernels.tangential.lanes import FALL, FLUX, HEATING, LANES, NOW_STICK, SLIP, SLOWED, TRACE_HEAT, WARM


@kernel
def varies(case):
    """Return whether the coefficient differs from element to element of a strip."""
    return falls_locally(case) or falls_hot(case)


@kernel
def begin_varying(strips, block, n, case, bound, lanes):
    """Set the state at the leading edges of the strips from `block` on.

    `bound` is the row of `lanes` with their peaks of mu p.
    """
    for l in range(LANES):
        lanes[SLOWED + l] = 1.0
        lanes[HEATING + l] = heating(case, strips[Strip.A, min(block + l, n - 1)], lanes[bound + l])


@kernel
def _fill_warm(elements, k, lanes, trace):
    """Fill WARM with the rise of temperature [K] at the middle of element k by the heat of the elements ahead.

    Return the weight of the element's own heat. The weights are ∫ds'/√(s' - s) over each element, in which the heat is
    taken as constant.
    """
    start = elements[Element.END, k - 1] if k > 0 else 1.0
    middle = 0.5 * (start + elements[Element.END, k])
    for l in range(LANES):
        lanes[WARM + l] = 0.0
    before = math.sqrt(1.0 - middle)
    for j in range(k):
        root = math.sqrt(elements[Element.END, j] - middle)
        weight = 2.0 * (before - root)
        for l in range(LANES):
            lanes[WARM + l] += weight * trace[j, TRACE_HEAT + l]
        before = root
    return 2.0 * before


@kernel
def soften(case, k, elements, lanes, trace):
    """Fill lanes[FALL + l] with the coefficients of element k of a block, over those at rest.

    The caller has filled the slip over V (SLIP), the heat under the coefficient at rest (FLUX, by HEATING), and the
    share of the element that sticks (NOW_STICK). This share has no heat, so that the temperature is continuous as well.
    """
    for l in range(LANES):
        lanes[SLOWED + l] = fallen(case, lanes[SLIP + l], lanes[NOW_STICK + l], lanes[SLOWED + l])
        lanes[FALL + l] = lanes[SLOWED + l]
    if not falls_hot(case):
        return
    weight = _fill_warm(elements, k, lanes, trace)
    for l in range(LANES):
        heat = (1.0 - lanes[NOW_STICK + l]) * lanes[FLUX + l]
        fall = of_heat(case, lanes[FALL + l], lanes[WARM + l], weight * heat)
        lanes[FALL + l], trace[k, TRACE_HEAT + l] = fall, fall * heat
