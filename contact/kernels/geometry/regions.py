"""Where two surfaces are close: grids of the vertical gap over the track plane, and lobes of interpenetration on them.

A coarse grid over all of the wheel finds the regions. Each region has a grid of its own. No assumption is made on where a
surface is touched, so contact may lie ahead of or behind the axle, at several places, and at the beginning of a nose.
All heights are at pose.z = 0. Lowering the wheel by z changes the vertical gap by -z everywhere.
"""

import math

from contact.core import kernel
from contact.kernels.arrays import SurfaceSearch
from contact.kernels.geometry.curve import Array, Record
from contact.kernels.geometry.grids import aligned, fill_coarse, fill_grid, lateral_range
from contact.kernels.geometry.search import size_of
from contact.kernels.geometry.section import AWAY
from contact.kernels.records import MAX_LOBES
from contact.kernels.rows import Box, Cell

Extent = tuple[int, int, int, int]

# Lengths for a wheel of the usual radius (`search.size_of`).
FARTHEST = 0.3  # [m] before and behind the axle
_COARSE = 4e-3  # [m] step of the coarse grid along x
_SLACK = 80e-6  # [m] by which heights on the coarse grid may miss a lobe
_DEPTH = 130e-6  # [m] depth for which rough grids are laid at first; one of usual loads
#: A grid is laid anew over what it has found, at most so many times: while an overlap has fewer rows or columns than `_FEW`,
#: and for first touch while the gap bends by more than `_BENT` [m] at its least point. Both happen at sharp edges.
_ZOOMS, _FEW, _BENT = 4, 8, 4e-7
_STEEP = 0.1  # slope with which the gap may fall between two points of a grid, at an edge


@kernel
def label_regions(gap: Array, label: Array, n_x: int, level: float, stack: Array) -> int:
    """Number the connected regions in which the gap is below `level`, from 1; neighbours may be diagonal. Return their number.

    Cells with a label below 0 are left out.
    """
    n_y, count = gap.shape[0], 0
    for i in range(n_y):
        for k in range(n_x):
            label[i, k] = min(label[i, k], 0.0)
    for i in range(n_y):
        for k in range(n_x):
            if label[i, k] != 0.0 or gap[i, k] >= level:
                continue
            count += 1
            label[i, k], stack[0], depth = float(count), float(i * n_x + k), 1
            while depth > 0:
                depth -= 1
                here = int(stack[depth])
                row, col = here // n_x, here % n_x
                for a in range(max(row - 1, 0), min(row + 2, n_y)):
                    for b in range(max(col - 1, 0), min(col + 2, n_x)):
                        if label[a, b] == 0.0 and gap[a, b] < level:
                            label[a, b] = float(count)
                            stack[depth] = float(a * n_x + b)
                            depth += 1
    return count


@kernel
def scan(space: SurfaceSearch) -> bool:
    """Fill the coarse grid. Return whether the bodies lie above each other.

    The reach is doubled as long as the bodies still come closer at its ends, as on a steep ramp.
    """
    motion, box, coarse = space.motion[0], space.boxes[0], space.coarse
    reach, n_x, size = motion.reach, 0, size_of(motion)
    while True:
        low, high = lateral_range(reach, space)
        n_x = min(2 * math.ceil(reach / (_COARSE * size)) + 1, coarse.shape[2])
        n_y = coarse.shape[1]
        if low < high:
            box[Box.X], box[Box.DX] = -reach, 2.0 * reach / (n_x - 1)
            box[Box.Y], box[Box.DY] = low, (high - low) / (n_y - 1)
            fill_coarse(box, coarse[0], n_x, space)
        box[Box.COLUMNS] = n_x
        found = low < high and box[Box.LEAST] < AWAY
        if not found or reach >= FARTHEST * size:
            return found
        ends = AWAY, AWAY, AWAY, AWAY
        for i in range(n_y):
            ends = (
                min(ends[0], coarse[0, i, 0]), min(ends[1], coarse[0, i, 2]),
                min(ends[2], coarse[0, i, n_x - 1]), min(ends[3], coarse[0, i, n_x - 3]),
            )  # fmt: skip
        if not (ends[0] < ends[1] or ends[2] < ends[3]):
            return True
        reach = min(2.0 * reach, FARTHEST * size)


@kernel
def _least_between(before: float, here: float, after: float) -> tuple[float, float]:
    """Return by how much the parabola through three values falls below the middle one, the least, and their difference.

    The difference is the second one, `before` - 2 `here` + `after`.
    """
    bend = before - 2.0 * here + after
    if before >= AWAY or after >= AWAY or bend <= 0.0:
        return 0.0, 0.0
    return (before - after) ** 2 / (8.0 * bend), bend


@kernel
def least_gap(gap: Array) -> tuple[float, int, int, float]:
    """Return the least value between the points of a grid, by parabolas along both directions, its row and column.

    The last number is the greatest second difference there.
    """
    row, col = 0, 0
    for i in range(gap.shape[0]):
        for k in range(gap.shape[1]):
            if gap[i, k] < gap[row, col]:
                row, col = i, k
    here = gap[row, col]
    fall, bend, further, bent = 0.0, 0.0, 0.0, 0.0
    if 0 < row < gap.shape[0] - 1:
        fall, bend = _least_between(gap[row - 1, col], here, gap[row + 1, col])
    if 0 < col < gap.shape[1] - 1:
        further, bent = _least_between(gap[row, col - 1], here, gap[row, col + 1])
    return here - (fall + further), row, col, max(bend, bent)


@kernel
def _extent(label: Array, n_x: int, wanted: float) -> Extent:
    """Return the first and last row and the first and last column of a region of a grid; with `wanted` = 0 of all regions.

    Without one the last row is -1.
    """
    top, bottom, left, right = label.shape[0], -1, n_x, -1
    for i in range(label.shape[0]):
        for k in range(n_x):
            if label[i, k] == wanted if wanted > 0.0 else label[i, k] > 0.0:
                top, bottom, left, right = min(top, i), max(bottom, i), min(left, k), max(right, k)
    return top, bottom, left, right


@kernel
def _cover(extent: Extent, box: Array, to: Array, n: tuple[int, int]) -> None:
    """Set the place of a grid of n rows and columns `to` cover a part of another grid with one cell around it."""
    top, bottom, left, right = extent
    to[Box.X], to[Box.DX] = box[Box.X] + (left - 1) * box[Box.DX], (right - left + 2) * box[Box.DX] / (n[1] - 1)
    to[Box.Y], to[Box.DY] = box[Box.Y] + (top - 1) * box[Box.DY], (bottom - top + 2) * box[Box.DY] / (n[0] - 1)


@kernel
def lay_rough(level: float, space: SurfaceSearch) -> int:
    """Lay a rough grid over every region of the coarse one in which the gap may be below `level` [m]. Return their number."""
    coarse, rough, boxes, layers = space.coarse, space.rough, space.boxes, len(Cell)
    n_coarse = int(boxes[0, Box.COLUMNS])
    coarse[1, :, :] = 0.0
    n = min(
        label_regions(coarse[0], coarse[1], n_coarse, level + _SLACK * size_of(space.motion[0]), space.stack),
        rough.shape[0] // layers,
    )
    for k in range(n):
        cells, box = rough[layers * k : layers * (k + 1)], boxes[k + 1]
        size = cells.shape[1], cells.shape[2]
        _cover(_extent(coarse[1], n_coarse, k + 1.0), boxes[0], box, size)
        box[Box.LABEL] = k + 1.0
        fill_grid(box, cells, size[1], space)
        _exclude(cells[Cell.LABEL], box, n_coarse, space)
    boxes[0, Box.GRIDS], boxes[0, Box.ROUGH] = n, level
    return n


@kernel
def _below(cells: Array, box: Array, level: float, space: SurfaceSearch) -> Extent:
    """Return the extent of the part of a grid in which the gap is below `level` [m], without excluded cells.

    A part that may lie between the points counts as the point with the least gap.
    """
    gap, label = cells[Cell.GAP], cells[Cell.LABEL]
    label_regions(gap, label, gap.shape[1], level, space.stack)
    found = _extent(label, gap.shape[1], 0.0)
    if found[1] >= 0:
        return found
    least, row, col = level + _STEEP * (box[Box.DX] + box[Box.DY]), -1, -1
    for i in range(gap.shape[0]):
        for k in range(gap.shape[1]):
            if label[i, k] >= 0.0 and gap[i, k] < least:
                least, row, col = gap[i, k], i, k
    return row, row, col, col


@kernel
def lay_fine(level: float, space: SurfaceSearch) -> None:
    """Lay a fine grid over the part of every rough one in which the gap is below `level` [m]. An absent one has the label 0.

    A part with few rows or columns even there, such as the overlap at the sharp end of a flat, gets a finer one.
    """
    layers, boxes = len(Cell), space.boxes
    if level > boxes[0, Box.ROUGH]:
        lay_rough(level, space)
    n, most = int(boxes[0, Box.GRIDS]), space.fine.shape[0] // layers
    for k in range(n):
        cells, box = space.fine[layers * k : layers * (k + 1)], boxes[most + 1 + k]
        n_x = cells.shape[2]
        part = _below(space.rough[layers * k : layers * (k + 1)], boxes[k + 1], level, space)
        box[Box.LABEL] = boxes[k + 1, Box.LABEL] if part[1] >= 0 else 0.0
        for zoom in range(_ZOOMS):
            if part[1] < 0 or (zoom > 0 and min(part[1] - part[0], part[3] - part[2]) + 1 >= _FEW):
                break
            _cover(part, box if zoom > 0 else boxes[k + 1], box, (cells.shape[1], n_x))
            ahead = box[Box.X] + (n_x - 1) * box[Box.DX]
            box[Box.X], box[Box.DX] = aligned(box[Box.X], ahead, n_x, space.motion[0].station, space.rail)
            fill_grid(box, cells, n_x, space)
            _exclude(cells[Cell.LABEL], box, int(boxes[0, Box.COLUMNS]), space)
            part = _below(cells, box, level, space)
    boxes[0, Box.LAID] = level


@kernel
def _exclude(label: Array, box: Array, n_coarse: int, space: SurfaceSearch) -> None:
    """Set the label of cells that belong to another region of the coarse grid to -1, that of all others to 0."""
    coarse, place_ = space.coarse[1], space.boxes[0]
    for i in range(label.shape[0]):
        row = (box[Box.Y] + i * box[Box.DY] - place_[Box.Y]) / place_[Box.DY]
        a = int(min(max(row + 0.5, 0.0), coarse.shape[0] - 1.0))
        for k in range(label.shape[1]):
            col = (box[Box.X] + k * box[Box.DX] - place_[Box.X]) / place_[Box.DX]
            b = int(min(max(col + 0.5, 0.0), n_coarse - 1.0))
            label[i, k] = 0.0 if coarse[a, b] == 0.0 or coarse[a, b] == box[Box.LABEL] else -1.0


@kernel
def touch(space: SurfaceSearch) -> float:
    """Return the smallest vertical gap at pose.z = 0 [m].

    The surroundings of the least point of every rough grid are divided once more, at an edge several times.
    """
    layers, boxes, size = len(Cell), space.boxes, size_of(space.motion[0])
    n, most = lay_rough(boxes[0, Box.LEAST] + _DEPTH * size, space), space.fine.shape[0] // layers
    lowest = AWAY
    for k in range(n):
        lowest = min(lowest, boxes[k + 1, Box.LEAST])
    for k in range(n):
        box, cells = boxes[most + 1 + k], space.fine[layers * k : layers * (k + 1)]
        least, row, col, _ = least_gap(space.rough[layers * k])
        if least > lowest + _SLACK * size:
            continue
        for zoom in range(_ZOOMS):
            _cover((row, row, col, col), box if zoom > 0 else boxes[k + 1], box, (cells.shape[1], cells.shape[2]))
            fill_grid(box, cells, cells.shape[2], space)
            least, row, col, bend = least_gap(cells[Cell.GAP])
            if bend <= _BENT * size:
                break
        lowest = min(lowest, least)
    return lowest


@kernel
def _measure(cells: Array, box: Array, wanted: float, z: float, lobe: Record) -> None:
    """Fill the lobe of one region of a grid.

    Points are weighted with depth², as `search.lobes` does when integrated along x. A point at the end of a surface counts
    for half a step.
    """
    lobe.weight, lobe.moment, lobe.moment_x = 0.0, 0.0, 0.0
    lobe.cosine, lobe.sine, lobe.slant, lobe.tie = 0.0, 0.0, 0.0, 0.0
    lobe.low, lobe.high, lobe.x_low, lobe.x_high = math.inf, -math.inf, math.inf, -math.inf
    lobe.low_z, lobe.high_z = 0.0, 0.0
    lobe.step_x, lobe.step_y = box[Box.DX], box[Box.DY]
    area = box[Box.DX] * box[Box.DY]
    for i in range(cells.shape[1]):
        y = box[Box.Y] + i * box[Box.DY]
        for k in range(cells.shape[2]):
            if cells[Cell.LABEL, i, k] != wanted:
                continue
            x, depth = cells[Cell.X, i, k], z - cells[Cell.GAP, i, k]
            before = k > 0 and cells[Cell.GAP, i, k - 1] >= AWAY
            after = k < cells.shape[2] - 1 and cells[Cell.GAP, i, k + 1] >= AWAY
            weight = depth * depth * (0.5 * area if before or after else area)
            slope_x, slope_y = cells[Cell.SLOPE_X, i, k], cells[Cell.SLOPE_Y, i, k]
            normal = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
            lobe.weight += weight
            lobe.moment += weight * y
            lobe.moment_x += weight * x
            lobe.cosine += weight * normal
            lobe.sine += weight * slope_y * normal
            lobe.slant -= weight * slope_x * normal
            if y < lobe.low:
                lobe.low, lobe.low_z = y, cells[Cell.RAIL, i, k]
            if y > lobe.high:
                lobe.high, lobe.high_z = y, cells[Cell.RAIL, i, k]
            lobe.x_low, lobe.x_high = min(lobe.x_low, x), max(lobe.x_high, x)


@kernel
def lobes(z: float, space: SurfaceSearch) -> int:
    """Fill `space.lobes` with the regions in which the wheel, lowered by z, lies inside the rail. Return their number.

    They are ordered by their place across.
    """
    count, layers, lobe = 0, len(Cell), space.lobes
    most = space.fine.shape[0] // layers
    for k in range(int(space.boxes[0, Box.GRIDS])):
        cells, box = space.fine[layers * k : layers * (k + 1)], space.boxes[most + 1 + k]
        if box[Box.LABEL] == 0.0:
            continue
        n = label_regions(cells[Cell.GAP], cells[Cell.LABEL], cells.shape[2], z, space.stack)
        for region in range(n):
            if count == MAX_LOBES - 1:
                return count
            _measure(cells, box, region + 1.0, z, lobe[count])
            spare, j = MAX_LOBES - 1, count
            while j > 0 and lobe[j - 1].moment / lobe[j - 1].weight > lobe[j].moment / lobe[j].weight:
                lobe[spare] = lobe[j]
                lobe[j] = lobe[j - 1]
                lobe[j - 1] = lobe[spare]
                j -= 1
            count += 1
    return count
