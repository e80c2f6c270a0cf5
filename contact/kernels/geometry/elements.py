"""The undeformed distance of two surfaces at the centres of elements, and the search of their patches for Python.

A surface is known by its cross-sections (`section`). An element has a given place in a frame, so the cross-section through it
is found first, by secants. In a frame turned about x only, that of the rail is known.
"""

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers, Sheet, SurfaceSearch
from contact.kernels.geometry.grids import limits_of
from contact.kernels.geometry.section import AWAY, Frame, angle_near, heights, of_rail, of_wheel, place, section, tilted
from contact.kernels.geometry.settle import settle
from contact.kernels.rows import Node

_WHEEL, _RAIL = -1.0, 1.0  # sign of the heights of which the least one counts
_STEPS, _NEAR = 8, 1e-10  # secants for the cross-section through an element: most of them, and [m] along x

Limits = tuple[int, int]


@entry
def find(mode: int, amount: float, space: SurfaceSearch) -> int:
    """Describe the patches at a height that `mode` prescribes, as `settle` does, and return their number or a `NoAnswer`."""
    return settle(mode, amount, space)


@kernel
def _over(
    body: float, sheet: Sheet, u: float, y: float, limits: Limits, frame: Frame, space: SurfaceSearch
) -> tuple[float, float]:
    """Return the height of the cross-section at `u` over the row `y` of a frame, and x of the point there [m]."""
    motion, nodes, to, count = space.motion[0], space.section, space.column, len(Node)
    first, end, value, slope = section(sheet, u, limits, count, nodes)
    placing = of_wheel(u, motion, frame) if body == _WHEEL else of_rail(u, motion, frame)
    place(placing, (first, end), count, (value, slope), nodes)
    heights(nodes, (first, end), (y, 1.0, 1, True), body, placing, to)
    return to[0, 0], to[1, 0]


@kernel
def _height(
    body: float,
    sheet: Sheet,
    at: tuple[float, float],
    start: tuple[float, float],
    limits: Limits,
    frame: Frame,
    space: SurfaceSearch,
) -> float:
    """Return the height of a body over a point (x, y) of a frame [m], ±AWAY where it is absent.

    `start` is the cross-section with which the search begins, and its expected change with x.
    """
    x, y = at
    u, per_x = start
    height, here = _over(body, sheet, u, y, limits, frame, space)
    for _ in range(_STEPS):
        if abs(height) >= AWAY or abs(x - here) <= _NEAR:
            break
        before, last = u, here
        u += (x - here) * per_x
        height, here = _over(body, sheet, u, y, limits, frame, space)
        if here != last:
            per_x = (u - before) / (here - last)
    return height


@entry
def fill_distance(
    origin: tuple[float, float, float],
    turn: tuple[float, float],
    x: Numbers,
    y: Numbers,
    h: Matrix,
    space: SurfaceSearch,
) -> None:
    """Fill h[row, column] with the distance of rail and wheel along the normal of a frame [m], AWAY where one is absent.

    The frame has its `origin` in track coordinates [m] and is turned by the angles `turn` [rad], as that of a patch is.
    The wheel stands where `space.motion` says. `x` and `y` are the centres of the elements [m].
    """
    motion, wheel, rail = space.motion[0], space.wheel, space.rail
    frame = tilted(origin[0], origin[1], origin[2], turn[0], turn[1])
    a, b, c, d = limits_of((x[0], x[x.size - 1]), (y[0], y[y.size - 1]), frame, space)
    for k in range(x.size):
        u, theta = motion.station + frame[0] + frame[3] * x[k], angle_near(x[k], motion, frame)
        for i in range(y.size):
            high = _height(_RAIL, rail, (x[k], y[i]), (u, 1.0 / frame[3]), (c, d), frame, space)
            low = _height(_WHEEL, wheel, (x[k], y[i]), (theta, 1.0 / motion.radius), (a, b), frame, space)
            h[i, k] = high - low if high < AWAY and low > -AWAY else AWAY
