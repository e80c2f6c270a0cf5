"""Checks of the points of a profile: what is wrong with a measurement, where, and which option of `read` cures it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import numpy as np

from contact.geometry.roughness import Points, backward, kinks, noise, spike_heights, steep, turns
from contact.geometry.scans import length, scans, turning

Kind = Literal["wheel", "rail"]

UNITS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "inch": 0.0254}  # of profile files [m]
NARROWEST, WIDEST = 0.03, 0.2  # usual range of the width of a wheel or a rail's head [m]
USUAL_WIDTH = 0.1  # between those of a rail's head and a wheel [m]
LEAST_WIDTH = 1e-3  # of a twin disc [m]
FLANGE_BACK = 0.070  # distance of the back of the flange from the tape circle [m] (EN 13715)
TIP_FROM_TAPE = 0.055  # distance of the flange's tip from the tape circle [m] (EN 13715)
FLANGE = 0.015  # a flange's tip lies at least this far below the median of a wheel's points [m]
HIGHEST = 0.042  # a worn flange is lower [m]
#: The middle of a rail's head, so wide, falls at least so far to its sides (EN 13674-1: 3.8 mm) [m].
HEAD, FLAT = 0.06, 3e-3
_BEHIND = 4e-3  # a wheel that goes on so far behind the usual place of the tip has a flange [m]
CROWN_FROM_GAUGE = 0.036  # half the width of a rail's head [m], from its gauge face

TIP_SHARE = 0.3  # share of the width up to which an extreme point is a flange's tip, and from which a rail's crown
TIP_RISE, HEAD_DROP = 3e-3, 8e-3  # least height [m] of a flange's tip over its back, of a rail's crown over both ends

LOOPS = 4.0  # length of the path over the extent beyond which rows are not in order; S1002 has 1.5
MOST_SCANS = 10
_GAP, _OVER_SPACING = 2.5e-3, 8.0  # least length of a gap [m], and over the median spacing
ROUGH = 3e-3  # error of tangents [rad] above which noise is reported
TANGENT_OF_NOISE = 1.2  # error of a spline's tangents over noise/spacing (docs/use/profiles.md, measured)
HEIGHT, SIDE = 1e-3, 6e-3  # offsets that are reported [m]
_LIP, _GROOVE = 2e-3, 15e-3  # least width of the lip beside a groove, and of a groove [m]
_DEEPER = 4e-3  # by how much the field side of a rail may be deeper than its gauge side [m]
#: Slope of a tread from 15 mm inside the tape circle to 20 mm outside, and of a rail's top within 20 mm of its middle: the
#: usual one, and by how much it may differ [rad]. Standard wheels have -1.4° to -2.9°, rails up to 1:20 inclined -2.5° to 2.3°.
USUAL_SLOPE = {"wheel": np.radians(-2.0), "rail": 0.0}
TURNED_BY = {"wheel": np.radians(4.5), "rail": np.radians(4.8)}
#: Where these slopes are taken, from the tape circle and from the rail's middle [m].
TREAD, TOP = (-0.015, 0.02), (-0.02, 0.02)
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
    FILE = "file"
    FALSE = "false rows"
    OUTLINE = "closed outline"
    NARROWED = "narrowed"
    NARROW = "narrow"
    HEIGHT = "offset of height"
    SIDE = "offset to the side"
    TURNED = "turned"
    FLANGE = "flange"
    FLAT = "flat"
    PART = "not whole"


#: Faults with which the points are no curve: `read` refuses them unless it may repair them.
FATAL = frozenset({Fault.UNSORTED, Fault.SCANS, Fault.BACKWARD})
#: Faults that `repair` cures.
REPAIRED = FATAL | {Fault.ZIGZAG, Fault.SPIKE}


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
    lengths = [length(part) / extent for part in parts]
    cure = "repair=True"
    if len(parts) > MOST_SCANS or max(lengths) > LOOPS:
        path = length(points) / extent
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


def shape(points: Points, resolution: float = 0.0, scale: float = 1.0) -> list[Finding]:
    """Return the faults of points in order: back steps, spikes, gaps, kinks, noise.

    `resolution` is the last decimal place of the numbers [m], `scale` that of a model.
    """
    found = []
    back = np.flatnonzero(backward(points))
    if back.size:
        seen = f"{_count(back.size)} going back along the profile, the first at y = {_mm(points[back[0], 0])}"
        found.append(Finding(Fault.ZIGZAG, seen, "repair=True drops them", points[back]))
    heights = spike_heights(points)
    wild = np.flatnonzero(heights)
    if wild.size:
        far = 1e6 * np.abs(heights[wild]).max()
        seen = f"{_count(wild.size)} up to {far:.0f} µm off the neighbours, the first at y = {_mm(points[wild[0], 0])}"
        found.append(Finding(Fault.SPIKE, seen, "repair=True drops them", points[wild]))
    chord = np.hypot(*np.diff(points, axis=0).T)
    for k in np.flatnonzero((chord > max(_GAP * scale, _OVER_SPACING * float(np.median(chord)))) & ~steep(points)):
        seen = f"no points over {_mm(chord[k])} from y = {_mm(points[k, 0])} on, where a wheel and a rail can touch"
        found.append(Finding(Fault.GAP, seen, "measure again: no option fills it", points[k : k + 2]))
    bent = kinks(points, scale)
    if bent.size:
        largest = np.degrees(np.abs(turns(points))[bent - 1].max())
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


def place(points: Points, kind: Kind, scale: float = 1.0) -> list[Finding]:
    """Return a turn, and offsets from the zero that this library expects, for points in the right-side convention."""
    y, z = points.T
    if turn := turned(points / scale, kind):
        slope = np.degrees(turn + USUAL_SLOPE[kind])
        part, usual = ("tread", "it rises by 1 to 3°") if kind == "wheel" else ("top", "it is level within 3°")
        seen = (
            f"the {part} {'falls' if slope > 0.0 else 'rises'} by {abs(slope):.1f}° to the field side, usually {usual}"
        )
        return [Finding(Fault.TURNED, seen, f"rotated({-turn:.3g}) turns the {kind} back", points[:0])]
    found = _part(points, kind, scale)
    if kind == "rail":
        deeper = z[-1] - z[: np.argmin(z) + 1].max()
        if deeper > _DEEPER * scale:
            seen = f"the field side reaches {_mm(deeper)} deeper than the gauge side"
            found.append(Finding(Fault.SIDE, seen, "if the file shows the other side, set side", points[[0, -1]]))
        if np.ptp(y) > HEAD * scale and np.ptp(z) < FLAT * scale:
            seen = f"all points of {_mm(np.ptp(y))} of width lie within {_mm(np.ptp(z))} of height, a head falls to its sides"
            found.append(Finding(Fault.FLAT, seen, "are y and z in one unit?", points[:0]))
        return found
    tip = int(np.argmax(z)) if has_flange(points / scale) else 0
    if tip and abs(y[tip] + TIP_FROM_TAPE * scale) > SIDE * scale:
        seen = f"the flange's tip lies at y = {_mm(y[tip])}, usually at {_mm(-TIP_FROM_TAPE * scale)}"
        from_back = abs(y[tip] - (FLANGE_BACK - TIP_FROM_TAPE) * scale) <= SIDE * scale
        cure = (
            "set zero='flange_back': y seems to count from the back of the flange" if from_back else "set zero='shape'"
        )
        return [Finding(Fault.SIDE, seen, cure, points[tip : tip + 1])]
    if not y.min() < 0.0 < y.max():
        seen = f"the profile lies between y = {_mm(y.min())} and {_mm(y.max())}; the tape circle at y = 0 is not on it"
        return [Finding(Fault.SIDE, seen, "move its zero to the tape circle", points[[0, -1]])]
    if not tip and y.min() < -(TIP_FROM_TAPE + _BEHIND) * scale:
        seen = (
            f"there is no flange at y = {_mm(-TIP_FROM_TAPE * scale)}; all points lie within {_mm(np.ptp(z))} of height"
        )
        return [Finding(Fault.FLANGE, seen, "are y and z in one unit?", points[:0])]
    tread = float(np.interp(0.0, y[tip:], z[tip:]))
    if tip and z[tip] - tread > HIGHEST * scale:
        seen = f"the flange is {_mm(z[tip] - tread)} high, usually 25 to 40 mm"
        return [Finding(Fault.FLANGE, seen, "are y and z in one unit and to one scale?", points[tip : tip + 1])]
    if abs(tread) > HEIGHT * scale:
        change = "larger" if tread > 0.0 else "smaller"
        seen = f"the tread at the tape circle lies at z = {_mm(tread)}; the wheel's radius becomes that much {change}"
        found.append(Finding(Fault.HEIGHT, seen, "set zero='shape'", np.array([[0.0, tread]])))
    return found


def _middle(points: Points, kind: Kind) -> tuple[float, float, bool]:
    """Return between which y a wheel's tread or a rail's top is judged [m], and whether a flange or a gauge face says so."""
    y, z = points.T
    if kind == "wheel":
        sure, (low, high) = has_flange(points), TREAD
        middle = y[np.argmax(z)] + TIP_FROM_TAPE if sure else 0.0
    else:
        gauge = np.flatnonzero((z > z.min() + GAUGE_DEPTH) & (np.arange(z.size) < np.argmin(z)))
        middle, top = 0.5 * (y.min() + y.max()), int(np.argmin(z))
        sure, (low, high) = gauge.size > 0, TOP
        if sure:
            middle = y[gauge[-1]] + CROWN_FROM_GAUGE
            if z[top:].max() > z[top] + HEAD_DROP:  # the field side is there: a head may be narrower
                middle = min(middle, 0.5 * (y[gauge[-1]] + y.max()))
    return middle + low, middle + high, sure


def _part(points: Points, kind: Kind, scale: float) -> list[Finding]:
    """Return a finding for a wheel or a rail whose tread or top is known in part only."""
    low, high, sure = _middle(points / scale, kind)
    end = float(points[:, 0].max()) / scale
    if not sure or end > high - 0.2 * (high - low):
        return []
    part = "tread" if kind == "wheel" else "top"
    seen = f"the {part} is known up to y = {_mm(end)} only, wheels and rails touch up to {_mm(high)}"
    return [Finding(Fault.PART, seen, "measure it whole: no option fills it", points[-1:])]


def turned(points: Points, kind: Kind) -> float:
    """Return by how much a profile is turned about x [rad], positive from y towards z; 0 if it lies as usual."""
    y, z = points.T
    low, high, _ = _middle(points, kind)
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

    `unit` is that in which the file was read [m]. It tells which other one fits. The points are those of full size.
    """
    y, z = points.T
    width = float(np.ptp(y))
    if fault := tall(points, kind):
        return fault
    if not LEAST_WIDTH <= width <= WIDEST:
        seen = f"the profile is {width:g} m wide, outside the range [{LEAST_WIDTH:g}, {WIDEST:g}] of wheels and rails"
        fitting = " or ".join(map(repr, _fitting(width, unit)))
        cure = (
            f"set unit to {fitting}" if fitting else f"no unit of {', '.join(UNITS)} fits: which columns hold y and z?"
        )
        return seen, cure, "the unit is m"
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
    if kind == "rail" and (groove := _groove_beyond(y, z)):
        seen = f"the groove lies on the field side, around y = {groove:g} m"
        return seen, "set side to the other side", "y points to the field side: give -y[::-1] and z[::-1]"
    deepest = np.argmax(z)
    if kind == "wheel" and has_flange(points) and y[deepest] > y.mean():
        seen = f"the flange lies on the field side, at y = {y[deepest]:g} m"
        return seen, "set side to the other side", "y points to the field side: give -y[::-1] and z[::-1]"
    return None


def _groove_beyond(y: Points, z: Points) -> float:
    """Return where a groove lies [m] whose lip, narrower than the head, is on the field side; 0 without one."""
    high = np.flatnonzero(z < z.min() + GAUGE_DEPTH)
    parts = [y[part] for part in np.split(high, np.flatnonzero(np.diff(high) > 1) + 1)]
    wide = [part for part in parts if np.ptp(part) > _LIP]
    if len(wide) != 2 or wide[1][0] - wide[0][-1] < _GROOVE or np.ptp(wide[0]) < np.ptp(wide[1]):
        return 0.0
    return float(0.5 * (wide[0][-1] + wide[1][0]))


def tall(points: Points, kind: Kind) -> tuple[str, str, str] | None:
    """Return what is wrong with a profile that is much higher than wide, as `misplaced` does; its points need no order."""
    width, height = (float(extent) for extent in np.ptp(points, axis=0))
    seen = f"the profile is {height:g} m high and {width:g} m wide"
    if width == 0.0:
        cure = "which columns hold y and z? columns=(2, 3) chooses them"
        return f"all points have y = {points[0, 0]:g} m", cure, "y is the same in all points"
    if width <= WIDEST < height:
        cure = "are its columns y and z in one unit?"
        return seen, cure, cure
    across, along = np.abs(points[-1] - points[0])  # a head on its side ends where it begins, one below the other
    lies = height > width and along > 0.8 * height and across < 0.7 * width
    slim = height > TALLER * width and (kind == "wheel" or width < NARROWEST)
    if NARROWEST <= height <= WIDEST and (slim or (kind == "rail" and lies)):
        cure = "are its columns y and z swapped, or is it turned by 90°?"
        return seen, cure, cure
    return None


def narrow(points: Points, unit: float) -> list[Finding]:
    """Return a finding for a profile that is narrow in its unit [m] and as wide as usual in another."""
    width = float(np.ptp(points[:, 0]))
    fitting = _fitting(width, unit) if width < NARROWEST else []
    seen = f"the profile is {_mm(width)} wide, usually {_mm(NARROWEST)} to {_mm(WIDEST)}"
    cure = f"set unit to {' or '.join(map(repr, fitting))}; a model has a scale"
    return [Finding(Fault.NARROW, seen, cure, points[[0, -1]])] if fitting else []


def _fitting(width: float, unit: float) -> list[str]:
    """Return the units in which a profile would have a usual width, the likeliest first; `unit` is that of `width` [m]."""
    widths = {name: width * size / unit for name, size in UNITS.items()} if unit and width else {}
    likely = sorted(widths, key=lambda name: abs(np.log(widths[name] / USUAL_WIDTH)))
    return [name for name in likely if NARROWEST <= widths[name] <= WIDEST]


def _count(n: int) -> str:
    return "1 point" if n == 1 else f"{n} points"


def _mm(value: float) -> str:
    return f"{1e3 * value:.3g} mm"
