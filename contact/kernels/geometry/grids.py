"""Grids of the vertical gap between two surfaces over the track plane, filled column by column.

All heights are at pose.z = 0. Lowering the wheel by z changes the vertical gap by -z everywhere.
"""

import math

from contact.core import kernel
from contact.kernels.arrays import Sheet, SurfaceSearch
from contact.kernels.geometry.curve import Array
from contact.kernels.geometry.search import size_of
from contact.kernels.geometry.section import (
    AWAY,
    Frame,
    about_x,
    column,
    cover,
    extent,
    of_rail,
    of_wheel,
    place,
    section,
)
from contact.kernels.rows import Box, Cell, Over

_BETWEEN = 0.5e-3  # [m], times `size_of`, by which the gap may fall from one column to the next; a slope of 1:8
_BESIDE = 3e-3  # [m], times `size_of`, beyond a grid, in which paths may reach into it at another x
_ALL = 1 << 30


@kernel
def track_frame(y: float) -> Frame:
    """Return the track frame with its origin moved sideways to `y` [m]."""
    return about_x(0.0, y, 0.0, 0.0)


@kernel
def limits_of(
    x: tuple[float, float], y: tuple[float, float], frame: Frame, space: SurfaceSearch
) -> tuple[int, int, int, int]:
    """Return first path and end of the wheel, and of the rail, that reach into a range of x and y [m] of a frame."""
    wheel, rail, motion, nodes = space.wheel, space.rail, space.motion[0], space.section
    beside = _BESIDE * size_of(motion)
    low, high = y[0] - beside, y[1] + beside
    wheel_first, wheel_end, rail_first, rail_end = _ALL, 0, _ALL, 0
    for k in range(3):
        at = x[0] + 0.5 * k * (x[1] - x[0])
        u = motion.station + frame[0] + frame[3] * at
        first, end, value, slope = section(rail, u, (0, _ALL), 2, nodes)
        place(of_rail(u, motion, frame), (first, end), 2, (value, slope), nodes)
        first, end = cover(nodes, first, end, low, high)
        rail_first, rail_end = min(rail_first, first), max(rail_end, end)
        if k == 1:
            theta = math.asin(min(max((frame[0] + at) / motion.radius, -0.9), 0.9)) - motion.rotation
            first, end, value, slope = section(wheel, theta, (0, _ALL), 2, nodes)
            place(of_wheel(theta, motion, frame), (first, end), 2, (value, slope), nodes)
            wheel_first, wheel_end = cover(nodes, first, end, low, high)
    return wheel_first - 1, wheel_end + 1, rail_first - 1, rail_end + 1


@kernel
def aligned(low: float, high: float, n: int, station: float, rail: Sheet) -> tuple[float, float]:
    """Return first position and step of `n` columns over low … high [m] of the track, at most a step further back.

    Where a part of the rail begins or ends within the range, a column stands there. So what lies on the columns changes
    smoothly as the wheel passes.
    """
    step = (high - low) / (n - 1)
    for i in range(rail.u.size - 1):
        x = rail.u[i] - station
        y = rail.u[i + 1] - station
        begins = rail.runs[i + 1, 0] < rail.runs[i, 0] or rail.runs[i + 1, 1] > rail.runs[i, 1]
        ends = rail.runs[i + 1, 0] > rail.runs[i, 0] or rail.runs[i + 1, 1] < rail.runs[i, 1]
        at = y if begins else x
        if (begins or ends) and low < at < high:
            step = (high - low) / (n - 2)
            return at - step * math.ceil((at - low) / step), step
    return low, step


@kernel
def lateral_range(reach: float, space: SurfaceSearch) -> tuple[float, float]:
    """Return the range of track y [m] over which both bodies lie."""
    motion, nodes, frame = space.motion[0], space.section, track_frame(0.0)
    first, end, value, slope = section(space.wheel, -motion.rotation, (0, _ALL), 2, nodes)
    place(of_wheel(-motion.rotation, motion, frame), (first, end), 2, (value, slope), nodes)
    low, high = extent(nodes, first, end)
    rail_low, rail_high = math.inf, -math.inf
    for k in range(5):
        u = motion.station + reach * (0.5 * k - 1.0)
        first, end, value, slope = section(space.rail, u, (0, _ALL), 2, nodes)
        place(of_rail(u, motion, frame), (first, end), 2, (value, slope), nodes)
        a, b = extent(nodes, first, end)
        rail_low, rail_high = min(rail_low, a), max(rail_high, b)
    return max(low, rail_low), min(high, rail_high)


@kernel
def fill_grid(box: Array, cells: Array, n_x: int, space: SurfaceSearch) -> float:
    """Fill the layers of a grid at `box`, of which the first `n_x` columns count. Return the least gap [m]."""
    frame = track_frame(box[Box.Y])
    n_y = cells.shape[1]
    rows = 0.0, box[Box.DY], n_y, True
    reach = box[Box.X], box[Box.X] + box[Box.DX] * (n_x - 1)
    limits = limits_of(reach, (0.0, box[Box.DY] * (n_y - 1)), frame, space)
    least, to = AWAY, space.column
    for k in range(n_x):
        column(
            box[Box.X] + k * box[Box.DX],
            rows,
            limits,
            frame,
            (space.wheel, space.rail),
            space.motion[0],
            space.section,
            to,
        )
        for i in range(n_y):
            cells[Cell.GAP, i, k] = to[Over.GAP, i]
            least = min(least, to[Over.GAP, i])
            cells[Cell.RAIL, i, k] = to[Over.RAIL, i]
            cells[Cell.SLOPE_X, i, k] = to[Over.RAIL_SLOPE_X, i]
            cells[Cell.SLOPE_Y, i, k] = to[Over.RAIL_SLOPE_S, i]
            cells[Cell.X, i, k] = to[Over.WHEEL_X, i]
    box[Box.LEAST] = least
    return least


@kernel
def fill_coarse(box: Array, gap: Array, n_x: int, space: SurfaceSearch) -> None:
    """Fill the gap of the coarse grid at `box`, of which the first `n_x` columns, an odd number, count.

    Every other column is searched only if the bodies are close in a column beside it. Otherwise it gets the lesser gap.
    """
    frame, n_y, to = track_frame(box[Box.Y]), gap.shape[0], space.column
    rows = 0.0, box[Box.DY], n_y, False
    reach = box[Box.X], box[Box.X] + box[Box.DX] * (n_x - 1)
    limits = limits_of(reach, (0.0, box[Box.DY] * (n_y - 1)), frame, space)
    surfaces, least = (space.wheel, space.rail), AWAY
    for odd in range(2):
        for k in range(odd, n_x, 2):
            beside = AWAY
            if odd == 1:
                for i in range(n_y):
                    gap[i, k] = min(gap[i, k - 1], gap[i, k + 1])
                    beside = min(beside, gap[i, k])
                if beside > least + _BETWEEN * size_of(space.motion[0]):
                    continue
            column(box[Box.X] + k * box[Box.DX], rows, limits, frame, surfaces, space.motion[0], space.section, to)
            for i in range(n_y):
                gap[i, k] = to[Over.GAP, i]
                least = min(least, gap[i, k])
    box[Box.LEAST] = least
