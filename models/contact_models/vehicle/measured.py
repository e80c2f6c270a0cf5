"""Track that was measured: a series of stations with alignment, height, cross-level and gauge."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_number, suggestion
from contact.reading.columns import table
from .spectra import CHANNELS

RAIL_DISTANCE = 1.5  # distance of the rails' centres, over which cant and cross-level are measured [m]
_FARTHEST = 1e9  # distance or value of a measured series; products of larger numbers overflow
#: Largest alignment or height that can be metres, least that can only be millimetres.
_METRES, _MILLIMETRES = 0.05, 0.15
_LARGEST_ANGLE = 0.2  # a cross-level of 300 mm [rad]
_HALF_GAUGE = 0.5  # a mean above this is a gauge, not a deviation of it [m]
_GAP = 8.0  # a distance of stations is a gap from so many times the median on
DIRECTIONS = ("rising", "falling")
UNITS = ("m", "mm")


@dataclass(frozen=True, kw_only=True)
class Measured:
    """A station series of a track.

    Parameters
    ----------
    file : path of a CSV file with the columns distance, alignment, vertical, cross_level, gauge by these headings, or in this
        order below others: stations [m]; centre line to the right, height downwards [m]; angle by which the left rail lies
        higher [rad]; gauge minus nominal gauge [m]
    start : station at which the run begins [m]; default 0
    direction : "rising", or "falling" for a run towards smaller stations. The channels are as one sees them looking towards
        larger stations
    unit : "m", or "mm" for alignment, vertical and gauge in mm and cross-level in mm over 1.5 m; default: mm if alignment and
        height are too large for metres
    """

    file: str
    start: float = 0.0
    direction: str = "rising"
    unit: str | None = None

    def __post_init__(self) -> None:
        require_number("start", self.start, -_FARTHEST, _FARTHEST)
        if self.direction not in DIRECTIONS:
            told = suggestion(self.direction, DIRECTIONS)
            raise ContactError(f"direction = {self.direction!r} is neither 'rising' nor 'falling'{told}")
        if self.unit is not None and self.unit not in UNITS:
            raise ContactError(f"unit = {self.unit!r} is neither 'm' nor 'mm'")

    @property
    def resolution(self) -> float:
        """Least distance of the stations [m]."""
        return float(np.diff(self._rows[:, 0]).min())

    def require_covered(self, end: float) -> None:
        """Check that the stations cover the run from its start to `end` [m].

        Raises
        ------
        ContactError
            If they do not. The message has both intervals.
        """
        first, last = np.sort(self._rows[[0, -1], 0]).tolist()
        begin, to = self.start, self.start + (end if self.direction == "rising" else -end)
        if first <= min(begin, to) and max(begin, to) <= last:
            return
        low, high = (first, last - end) if self.direction == "rising" else (first + end, last)
        allowed = f"at most {last - first:.6g} m can be run"
        if low <= high:
            allowed = f"with direction = {self.direction!r}, start may be {low:.9g} to {high:.9g} m"
        raise ContactError(
            f"file = {self.file!r}: the run leads from station {begin:.9g} to {to:.9g} m (front axle), and the file has the "
            f"stations {first:.9g} to {last:.9g} m; {allowed}"
        )

    def gaps(self, end: float) -> list[tuple[float, float]]:
        """Return the places of a run of length `end` between which stations are missing [m]."""
        along = self._along()[:, 0]
        steps = np.diff(along)
        wide = (steps > _GAP * np.median(steps)) & (along[1:] > 0.0) & (along[:-1] < end)
        return list(zip(along[:-1][wide].tolist(), along[1:][wide].tolist(), strict=True))

    def over(self, s: Array) -> list[Array]:
        """Return values and slopes of the channels at distances of the run, shape (2, n) each.

        Before the first station and behind the last one they are constant.
        """
        rows = self._along()
        inside = np.clip(s, rows[0, 0], rows[-1, 0])
        slopes = np.gradient(rows[:, 1:], rows[:, 0], axis=0)
        k = np.clip(np.searchsorted(rows[:, 0], inside, "right") - 1, 0, rows.shape[0] - 2)
        width = rows[k + 1, 0] - rows[k, 0]
        t = (inside - rows[k, 0]) / width
        found = []
        for c in range(len(CHANNELS)):  # Hermite's cubic with central differences as slopes
            a, b, ma, mb = rows[k, 1 + c], rows[k + 1, 1 + c], width * slopes[k, c], width * slopes[k + 1, c]
            second, third = 3.0 * (b - a) - 2.0 * ma - mb, 2.0 * (a - b) + ma + mb
            value, slope = a + t * (ma + t * (second + t * third)), (ma + t * (2.0 * second + 3.0 * t * third)) / width
            found.append(np.stack((value, np.where(inside == s, slope, 0.0))))
        return found

    def _along(self) -> Array:
        """Return the rows in SI units over the distance of the run."""
        rows = self._rows
        if self._in_mm(rows):
            rows = rows * np.array([1.0, 1e-3, 1e-3, 1e-3 / RAIL_DISTANCE, 1e-3])
        self._require_sizes(rows)
        if self.direction == "rising":
            return rows - np.array([self.start, 0.0, 0.0, 0.0, 0.0])
        turned = rows[::-1] * np.array([-1.0, -1.0, 1.0, -1.0, 1.0])  # right is left when one looks the other way
        return turned + np.array([self.start, 0.0, 0.0, 0.0, 0.0])

    def _in_mm(self, rows: Array) -> bool:
        """Return whether the values are millimetres."""
        if self.unit is not None:
            return self.unit == "mm"
        largest = float(np.abs(rows[:, 1:3]).max())
        if _METRES < largest < _MILLIMETRES:
            raise ContactError(
                f"file = {self.file!r}: alignment and height of up to {largest:.3g} can be metres or millimetres; set unit"
            )
        return largest >= _MILLIMETRES

    def _require_sizes(self, rows: Array) -> None:
        """Refuse what no track has, in SI units: other units of a column, a gauge in place of its deviation."""
        for name, column, largest, unit in (
            ("alignment", 1, 1.0, "m"),
            ("vertical", 2, 1.0, "m"),
            ("cross_level", 3, _LARGEST_ANGLE, "rad"),
        ):
            found = float(np.abs(rows[:, column]).max())
            if found > largest:
                raise ContactError(
                    f"file = {self.file!r}: {name} is up to {found:.3g} {unit}, and {largest:g} {unit} are allowed; with "
                    "unit = 'mm' alignment, vertical and gauge are in mm and cross_level in mm over 1.5 m"
                )
        mean = float(rows[:, 4].mean())
        if abs(mean) > _HALF_GAUGE:
            raise ContactError(
                f"file = {self.file!r}: the mean of gauge is {mean:.4g} m; give its deviation, the gauge minus the nominal one"
            )

    @cached_property
    def _rows(self) -> Array:
        """The rows of the file, in its units: stations and channels."""
        names, rows = table(self.file, "file")
        wanted = ("distance", *CHANNELS)
        if set(wanted) <= set(names):
            rows = rows[:, [names.index(name) for name in wanted]]
        elif displaced := [k for k, name in enumerate(names) if name in wanted and wanted.index(name) != k]:
            raise ContactError(
                f"file = {self.file!r}: {names[displaced[0]]!r} stands over column {displaced[0] + 1}; name all of "
                f"{', '.join(wanted)}, or put them in this order"
            )
        if not (np.abs(rows) < _FARTHEST).all():
            raise ContactError(f"file = {self.file!r}: a distance or a value is not within {_FARTHEST:g}")
        steps = np.diff(rows[:, 0])
        if rows.shape[0] < 4 or rows.shape[1] != 1 + len(CHANNELS) or not ((steps > 0.0).all() or (steps < 0.0).all()):
            raise ContactError(
                f"file = {self.file!r} needs the columns distance, {', '.join(CHANNELS)} and at least four distances that "
                "all rise or all fall"
            )
        return rows if steps[0] > 0.0 else rows[::-1]
