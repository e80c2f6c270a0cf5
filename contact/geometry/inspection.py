"""Checks of the points of a profile: what is wrong with a measurement, where, and which option of `read` cures it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from contact.arrays import Array

Kind = Literal["wheel", "rail"]
Points = NDArray[np.float64]  # shape (n, 2): y, z [m]

UNITS = {"m": 1.0, "mm": 1e-3, "inch": 0.0254}  # of profile files [m]
NARROWEST, WIDEST = 0.03, 0.2  # range of the width of a wheel or a rail's head [m]
FLANGE_BACK = 0.070  # distance of the back of the flange from the tape circle [m] (EN 13715)
TIP_FROM_TAPE = 0.055  # distance of the flange's tip from the tape circle [m] (EN 13715)
FLANGE = 0.015  # a flange's tip lies at least this far below the median of a wheel's points [m]
CROWN_FROM_GAUGE = 0.036  # half the width of a rail's head [m], from its gauge face

TIP_SHARE = 0.3  # share of the width up to which an extreme point is a flange's tip, and from which a rail's crown
TIP_RISE, HEAD_DROP = 3e-3, 8e-3  # least height [m] of a flange's tip over its back, of a rail's crown over both ends

JUMP = 0.4  # of the extent: a step this long starts another scan
LOOPS = 4.0  # length of the path over the extent beyond which rows are not in order; S1002 has 1.5
MOST_SCANS = 10
RETURN = 0.2  # share of the points on the way back that makes a backward scan
_SPIKE, _OVER_NEIGHBOURS = 2e-5, 8.0  # least deviation of a spike [m], and over the median of the points around it
_GAP, _OVER_SPACING = 2.5e-3, 8.0  # least length of a gap [m], and over the median spacing
_KINK, _KINK_OVER = np.radians(8.0), 6.0  # least turn at a kink [rad], and over the median of the turns around it
_CHAMFER = 12e-3  # corners nearer to the ends of the profile are chamfers [m]
ROUGH = 3e-3  # error of tangents [rad] above which noise is reported
TANGENT_OF_NOISE = 1.2  # error of a spline's tangents over noise/spacing (docs/use/profiles.md, measured)
HEIGHT, SIDE = 1e-3, 6e-3  # offsets that are reported [m]
_DEEPER = 4e-3  # by how much the field side of a rail may be deeper than its gauge side [m]
_STEEPEST = np.radians(75.0)  # steeper parts cannot touch
#: Slope of a tread from 15 mm inside the tape circle to 20 mm outside, and of a rail's top within 20 mm of its middle: the
#: usual one, and by how much it may differ [rad]. Standard wheels have -1.4° to -2.9°, rails up to 1:20 inclined -2.5° to 2.3°.
USUAL_SLOPE = {"wheel": np.radians(-2.0), "rail": 0.0}
TURNED_BY = {"wheel": np.radians(4.5), "rail": np.radians(4.8)}
TREAD, TOP = (
    (-0.015, 0.02),
    (-0.02, 0.02),
)  # where these slopes are taken, from the tape circle and from the rail's middle [m]
GAUGE_DEPTH = 0.014  # of the gauge face below the top of a rail [m]
TALLER = 1.2  # a wheel is not as many times higher than wide


class Fault(StrEnum):
    """What can be wrong with the points of a profile."""

    UNSORTED = "unsorted rows"
    SCANS = "several scans"
    BACKWARD = "backward scan"
    ZIGZAG = "back steps"
    SPIKE = "spikes"
    GAP = "gap"
    KINK = "kinks"
    NOISE = "noise"
    HEIGHT = "offset of height"
    SIDE = "offset to the side"
    TURNED = "turned"


#: Faults with which the points are no curve: `read` refuses them unless it may repair them.
FATAL = frozenset({Fault.UNSORTED, Fault.SCANS, Fault.BACKWARD})


@dataclass(frozen=True, eq=False)
class Finding:
    """One fault of a profile.

    Attributes
    ----------
    fault : Fault
    seen : str
        What was seen, with numbers.
    cure : str
        The option of `read` that cures it, or what else helps.
    at : ndarray, shape (m, 2)
        Where: y, z [m].
    """

    fault: Fault
    seen: str
    cure: str
    at: Points

    def __str__(self) -> str:
        return f"{self.fault}: {self.seen}; {self.cure}"


def order(points: Points) -> list[Finding]:
    """Return the faults in the order of the rows: not sorted, several scans, a scan there and back."""
    extent = float(np.hypot(*np.ptp(points, axis=0)))
    if len(points) < 8 or extent == 0.0:
        return []
    parts = scans(points)
    lengths = [_length(part) / extent for part in parts]
    cure = "repair=True"
    if len(parts) > MOST_SCANS or max(lengths) > LOOPS:
        path = _length(points) / extent
        seen = f"the path through the points is {path:.0f} times as long as the profile is wide"
        return [Finding(Fault.UNSORTED, seen, f"{cure} sorts them along the profile", points[:0])]
    if len(parts) > 1:
        seen = f"the points run over the profile {len(parts)} times, with {', '.join(str(len(part)) for part in parts)} points"
        return [Finding(Fault.SCANS, seen, f"{cure} keeps the scan with the most points", parts[1][:1])]
    turn = turning(points)
    if turn:
        seen = f"after {turn + 1} of {len(points)} points, at y = {_mm(points[turn, 0])}, the scan turns and comes back"
        return [Finding(Fault.BACKWARD, seen, f"{cure} keeps the longer way", points[turn : turn + 1])]
    return []


def shape(points: Points, resolution: float = 0.0) -> list[Finding]:
    """Return the faults of points in order: back steps, spikes, gaps, kinks, noise.

    `resolution` is the last decimal place of the numbers [m].
    """
    found = []
    back = np.flatnonzero(backward(points))
    if back.size:
        seen = f"{_count(back.size)} going back along the profile, the first at y = {_mm(points[back[0], 0])}"
        found.append(Finding(Fault.ZIGZAG, seen, "repair=True drops them", points[back]))
    wild = np.flatnonzero(spikes(points))
    if wild.size:
        far = 1e6 * np.abs(_deviation(points)[wild]).max()
        seen = f"{_count(wild.size)} up to {far:.0f} µm off the neighbours, the first at y = {_mm(points[wild[0], 0])}"
        found.append(Finding(Fault.SPIKE, seen, "repair=True drops them", points[wild]))
    chord = np.hypot(*np.diff(points, axis=0).T)
    for k in np.flatnonzero((chord > max(_GAP, _OVER_SPACING * float(np.median(chord)))) & ~_steep(points)):
        seen = f"no points over {_mm(chord[k])} from y = {_mm(points[k, 0])} on, where a wheel and a rail can touch"
        found.append(Finding(Fault.GAP, seen, "measure again: no option fills it", points[k : k + 2]))
    bent = kinks(points)
    if bent.size:
        largest = np.degrees(np.abs(_turns(points))[bent - 1].max())
        seen = f"{_count(bent.size)} with a corner of up to {largest:.0f}°, the first at y = {_mm(points[bent[0], 0])}"
        found.append(Finding(Fault.KINK, seen, "if they are not real, a smoothing rounds them", points[bent]))
    sigma, h = noise(points), float(np.median(chord))
    if TANGENT_OF_NOISE * sigma > ROUGH * h > 0.0:
        rounded = 0.2 * resolution <= sigma <= 0.6 * resolution
        source = "from rounding: the" if rounded else "from the measurement, not from rounding: the"
        rounding = f" ({source} numbers are given to {1e3 * resolution:g} mm)" if resolution else ""
        seen = (
            f"points {_mm(h)} apart with a noise of {1e6 * sigma:.2g} µm{rounding} give tangents "
            f"{1e3 * TANGENT_OF_NOISE * sigma / h:.0f} mrad off"
        )
        found.append(Finding(Fault.NOISE, seen, f"smoothing={sigma:.1g} removes it, or wavelength=3e-3", points[:0]))
    return found


def place(points: Points, kind: Kind) -> list[Finding]:
    """Return a turn, and offsets from the zero that this library expects, for points in the right-side convention."""
    y, z = points.T
    found: list[Finding] = []
    if turn := turned(points, kind):
        slope = np.degrees(turn + USUAL_SLOPE[kind])
        part, usual = ("tread", "it rises by 1 to 3°") if kind == "wheel" else ("top", "it is level within 3°")
        seen = (
            f"the {part} {'falls' if slope > 0.0 else 'rises'} by {abs(slope):.1f}° to the field side, usually {usual}"
        )
        return [Finding(Fault.TURNED, seen, f"rotated({-turn:.3g}) turns the {kind} back", points[:0])]
    if kind == "rail":
        deeper = z[-1] - z[: np.argmin(z) + 1].max()
        if deeper > _DEEPER:
            seen = f"the field side reaches {_mm(deeper)} deeper than the gauge side"
            found.append(Finding(Fault.SIDE, seen, "if the file shows the other side, set side", points[[0, -1]]))
        return found
    tip = int(np.argmax(z)) if has_flange(points) else 0
    if tip and abs(y[tip] + TIP_FROM_TAPE) > SIDE:
        seen = f"the flange's tip lies at y = {_mm(y[tip])}, usually at {_mm(-TIP_FROM_TAPE)}"
        from_back = abs(y[tip] - FLANGE_BACK + TIP_FROM_TAPE) <= SIDE
        cure = (
            "set zero='flange_back': y seems to count from the back of the flange" if from_back else "set zero='shape'"
        )
        return [Finding(Fault.SIDE, seen, cure, points[tip : tip + 1])]
    if not y.min() < 0.0 < y.max():
        seen = f"the profile lies between y = {_mm(y.min())} and {_mm(y.max())}; the tape circle at y = 0 is not on it"
        return [Finding(Fault.SIDE, seen, "move its zero to the tape circle", points[[0, -1]])]
    tread = float(np.interp(0.0, y[tip:], z[tip:]))
    if abs(tread) > HEIGHT:
        change = "larger" if tread > 0.0 else "smaller"
        seen = f"the tread at the tape circle lies at z = {_mm(tread)}; the wheel's radius becomes that much {change}"
        found.append(Finding(Fault.HEIGHT, seen, "set zero='shape'", np.array([[0.0, tread]])))
    return found


def turned(points: Points, kind: Kind) -> float:
    """Return by how much a profile is turned about x [rad], positive from y towards z; 0 if it lies as usual."""
    y, z = points.T
    if kind == "wheel":
        middle = y[np.argmax(z)] + TIP_FROM_TAPE if has_flange(points) else 0.0
        low, high = (middle + end for end in TREAD)
    else:
        gauge = np.flatnonzero((z > z.min() + GAUGE_DEPTH) & (np.arange(z.size) < np.argmin(z)))
        middle = y[gauge[-1]] + CROWN_FROM_GAUGE if gauge.size else 0.5 * (y.min() + y.max())
        low, high = (middle + end for end in TOP)
    inside = (y > low) & (y < high)
    if np.count_nonzero(inside) < 5 or np.ptp(y[inside]) < 0.8 * (high - low):
        return 0.0
    turn = float(np.arctan(np.polyfit(y[inside], z[inside], 1)[0])) - USUAL_SLOPE[kind]
    return turn if abs(turn) > TURNED_BY[kind] else 0.0


def has_flange(points: Points) -> bool:
    """Return whether the lowest point of a wheel, with z down, is a flange's tip."""
    return bool(points[:, 1].max() > np.median(points[:, 1]) + FLANGE)


def _appearance(points: Points) -> tuple[Kind | None, bool]:
    """Return what points in order look like, None if they could be either, and whether their z points down.

    A wheel has its lowest or highest point, the tip of the flange, near one end, and its tread does not come back towards
    it. A rail has its crown in the middle, and both sides fall off. The groove of a grooved rail lies near one end like a
    flange, but beyond it the head comes back: its field side falls off.
    """
    y, z = points.T
    for sign in (1.0, -1.0):
        height = sign * z
        top = int(np.argmax(height))
        left, right = (height[top] - part.min() for part in (height[: top + 1], height[top:]))
        share = (y[top] - y.min()) / np.ptp(y)
        near_an_end = min(share, 1.0 - share) < TIP_SHARE
        if near_an_end and min(left, right) > TIP_RISE and height[top] > np.median(height) + FLANGE:
            beyond = height[top:] if share < 0.5 else height[top::-1]
            return "rail" if beyond[-1] - beyond.min() > HEAD_DROP else "wheel", sign > 0.0
        if not near_an_end and min(left, right) > HEAD_DROP:
            return "rail", sign < 0.0
    return None, True


def misplaced(points: Points, kind: Kind, unit: float = 0.0) -> tuple[str, str, str] | None:
    """Return what is wrong with unit, kind, direction or side of a profile, the cure of a file, and that of arrays; or None.

    `unit` is that in which the file was read [m]. It tells which other one fits.
    """
    y, z = points.T
    width, height = float(np.ptp(y)), float(np.ptp(z))
    wide = NARROWEST <= width <= WIDEST
    if NARROWEST <= height <= WIDEST and height > TALLER * width and (kind == "wheel" or not wide):
        cure = "are its columns y and z swapped, or is it turned by 90°?"
        return f"the profile is {height:g} m high and {width:g} m wide", cure, cure
    if not wide:
        seen = f"the profile is {width:g} m wide, outside the range [{NARROWEST:g}, {WIDEST:g}] of wheels and rails"
        fitting = [name for name, size in UNITS.items() if unit and NARROWEST <= width * size / unit <= WIDEST]
        return seen, f"set unit to {' or '.join(map(repr, fitting or UNITS))}", "the unit is m"
    shape, down = _appearance(points)
    if shape not in (None, kind):
        seen = "a wheel: a flange near one end" if shape == "wheel" else "a rail: a crown in the middle"
        cure = f"kind = {kind!r} must be {shape!r}"
        return f"the points have the shape of {seen}", cure, cure
    if kind == "rail" and z.mean() > np.median(z):  # the groove of a rail may look like a crown that is upside down
        down = True
    if shape is not None and not down:
        seen = "its flange points upwards" if kind == "wheel" else "its crown lies lowest"
        return f"the {kind} is upside down, {seen}", "its z must point the other way", "z points down: give -z"
    deepest = np.argmax(z)
    if kind == "wheel" and has_flange(points) and y[deepest] > y.mean():
        seen = f"the flange lies on the field side, at y = {y[deepest]:g} m"
        return seen, "set side to the other side", "y points to the field side: give -y[::-1] and z[::-1]"
    return None


def scans(points: Points) -> list[Points]:
    """Return the parts of the points between long jumps, without parts of one or two points."""
    step = np.hypot(*np.diff(points, axis=0).T)
    jumps = np.flatnonzero(step > JUMP * np.hypot(*np.ptp(points, axis=0))) + 1
    return [part for part in np.split(points, jumps) if len(part) > 2] or [points]


def turning(points: Points) -> int:
    """Return the index at which a scan turns and comes back; 0 if it does not."""
    far = int(np.argmax(np.hypot(*(points - points[0]).T)))
    back = len(points) - 1 - far
    returned = np.hypot(*(points[-1] - points[far])) > JUMP * np.hypot(*(points[far] - points[0]))
    return far if returned and back > RETURN * len(points) else 0


def backward(points: Points) -> NDArray[np.bool_]:
    """Return which points lie behind the previous one: the step to them goes back against the chord of the points around."""
    step = np.diff(points, axis=0)
    turned = np.zeros(len(points), dtype=bool)
    padded = np.pad(points, ((2, 2), (0, 0)), mode="edge")
    around = padded[4:] - padded[:-4]  # from two points before to two points after
    turned[1:] = (step * (around[1:] + around[:-1])).sum(axis=1) < 0.0
    return turned


def spikes(points: Points) -> NDArray[np.bool_]:
    """Return which single points stand off, with both neighbours bent the other way (a corner has straight neighbours)."""
    d = _deviation(points)
    if len(points) < 9:
        return np.zeros(len(points), dtype=bool)
    around = np.median(sliding_window_view(np.pad(np.abs(d), 6, mode="edge"), 13), axis=1)
    # beside a spike taller than the spacing, the chord of a neighbour is steep: it stands off by the spacing at most
    spacing = np.pad(0.5 * np.hypot(*(points[2:] - points[:-2]).T), 1)
    bent = 0.2 * np.minimum(np.abs(d), spacing)
    opposite = (-np.roll(d, 1) * np.sign(d) > bent) & (-np.roll(d, -1) * np.sign(d) > bent)
    return (np.abs(d) > np.maximum(_SPIKE, _OVER_NEIGHBOURS * around)) & opposite


def kinks(points: Points) -> NDArray[np.intp]:
    """Return the indices of corners where wheel and rail can touch, away from the ends of the profile."""
    if len(points) < 12:
        return np.zeros(0, dtype=np.intp)
    turn = np.abs(_turns(points))
    around = np.median(sliding_window_view(np.pad(turn, 5, mode="edge"), 11), axis=1)
    wild = spikes(points) | backward(points) | np.roll(backward(points), -1)
    free = ~(wild[:-2] | wild[1:-1] | wild[2:])
    steep = _steep(points)
    flank = steep & (np.roll(steep, 1) | np.roll(steep, -1))  # one steep step between flat ones is a jump, no flank
    along = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    inner = np.minimum(along, along[-1] - along)[1:-1] > _CHAMFER
    found = (turn > np.maximum(_KINK, _KINK_OVER * around)) & free & inner & ~flank[1:] & ~flank[:-1]
    return np.flatnonzero(found) + 1


def noise(points: Points) -> float:
    """Return the root mean square of the noise across the profile [m]: the rest beside local cubics through nine points."""
    if len(points) < 9:
        return 0.0
    windows = sliding_window_view(points, 9, axis=0)  # (windows, 2, 9)
    along = windows[:, :, -1] - windows[:, :, 0]
    length = np.hypot(*along.T)
    good = length > 0.0
    along, windows = along[good] / length[good, None], windows[good] - windows[good, :, :1]
    u = (along[:, :, None] * windows).sum(axis=1) / length[good, None]
    v = along[:, 0, None] * windows[:, 1] - along[:, 1, None] * windows[:, 0]
    powers = u[:, :, None] ** np.arange(4)
    rest = v - (powers @ (np.linalg.pinv(powers) @ v[:, :, None]))[:, :, 0]
    return float(np.sqrt(np.median((rest**2).sum(axis=1)) / 4.35)) if rest.size else 0.0  # median of χ² with 5 degrees


def repaired(points: Points) -> Points:
    """Return the points as one scan in order (`in_order`), without back steps and spikes."""
    points = in_order(points)
    for faulty in (spikes, backward, spikes):
        while faulty(points).any() and len(points) > 9:
            points = points[~faulty(points)]
    return points


def in_order(points: Points) -> Points:
    """Return the points as one scan in order.

    Unsorted rows are joined from an end of the profile, each to its nearest neighbour. Of several scans the one with the
    most points is kept, of a scan there and back the longer way.
    """
    for finding in order(points):
        if finding.fault is Fault.UNSORTED:
            points = _joined(points)
        elif finding.fault is Fault.SCANS:
            points = max(scans(points), key=len)
    turn = turning(points)
    if turn:
        points = points[: turn + 1] if turn + 1 >= len(points) - turn else points[turn:]
    return points


def _joined(points: Points) -> Points:
    """Return the points in the order of their nearest neighbours, from the one with the least y."""
    left = points[np.lexsort(points.T[::-1])]
    chain = [left[0]]
    left = left[1:]
    while len(left):
        k = int(np.argmin(((left - chain[-1]) ** 2).sum(axis=1)))
        chain.append(left[k])
        left = np.delete(left, k, axis=0)
    return np.array(chain)


def _deviation(points: Points) -> Array:
    """Return the distance of each point from the chord of its neighbours [m], with its sign; 0 at both ends."""
    d = np.zeros(len(points))
    chord = points[2:] - points[:-2]
    arm = points[1:-1] - points[:-2]
    length = np.hypot(*chord.T)
    cross = chord[:, 0] * arm[:, 1] - chord[:, 1] * arm[:, 0]
    d[1:-1] = np.where(length > 0.0, cross / np.where(length > 0.0, length, 1.0), 0.0)
    return d


def _turns(points: Points) -> Array:
    """Return the change of direction at every inner point [rad]."""
    direction = np.unwrap(np.arctan2(*np.diff(points, axis=0).T[::-1]))
    return np.diff(direction)


def _steep(points: Points) -> NDArray[np.bool_]:
    """Return which segments are too steep to touch."""
    dy, dz = np.abs(np.diff(points, axis=0).T)
    return np.arctan2(dz, dy) > _STEEPEST


def _length(points: Points) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _count(n: int) -> str:
    return "1 point" if n == 1 else f"{n} points"


def _mm(value: float) -> str:
    return f"{1e3 * value:.3g} mm"
