"""Look-up tables of a wheel on its rail, for Simulink's n-D Lookup Table and for everything else that interpolates."""

from __future__ import annotations

import csv
import itertools
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers
from contact.errors import ContactError, optional, require_integer, suggestion, warn
from contact.pair import WheelRailPair, over_poses
from contact.study import files

#: Axes in the order of the tables' dimensions, and the units.
AXES = {
    "y": "m",
    "roll": "rad",
    "yaw": "rad",
    "load": "N",
    "longitudinal": "1",
    "lateral": "1",
    "spin": "1/m",
    "speed": "m/s",
}
#: Tables that are made by default, and the units of all tables.
DEFAULT_TABLES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz", "z", "max_pressure")
TABLES = dict.fromkeys(("Fx", "Fy", "Fz", "N", "Q", "Y", "power_per_metre", "T_gamma"), "N")
TABLES |= {"Mx": "N m", "My": "N m", "Mz": "N m", "z": "m", "max_pressure": "Pa", "area": "m²", "slip_area": "m²"}
ENDINGS = (".mat", ".npz", ".csv")
_TRIAL = 32  # poses that are timed for an estimate
_MOST = 50_000_000  # numbers in all tables: 400 MB


@dataclass(frozen=True)
class Estimate:
    """Number of poses, size of the tables in memory [byte] and computing time [s]."""

    poses: int
    size: int
    seconds: float


@dataclass(frozen=True)
class TableError:
    """Error of linear interpolation in one table on random points, in the unit of the table.

    Attributes
    ----------
    rms, largest : root mean square and largest difference from the solution
    scale : largest magnitude of the solutions
    points : points that were compared; the others have no trustworthy solution
    """

    rms: float
    largest: float
    scale: float
    points: int


class LookupTable:
    """Tables over breakpoints.

    Attributes
    ----------
    axes : dict of str → ndarray
        Name → breakpoints, in the order of the tables' dimensions.
    tables : dict of str → ndarray
        Name → values at the breakpoints; NaN where a pose has no answer.
    untrusted : int
        Number of points whose status is neither OK, SATURATED nor NO_CONTACT.
    """

    def __init__(self, axes: Mapping[str, Array], tables: Mapping[str, Array], untrusted: int) -> None:
        self.axes, self.tables, self.untrusted = dict(axes), dict(tables), untrusted

    def interpolated(self, **at: ArrayLike) -> dict[str, Array]:
        """Return all tables at these points by linear interpolation, as Simulink's block does. Points are cut to the range."""
        if set(at) != set(self.axes):
            raise ContactError(f"at = {', '.join(at)}: the table has the axes {', '.join(self.axes)}")
        places, weights = [], []
        for name, points in self.axes.items():
            given = require_numbers(name, at[name])
            x = np.clip(given, points[0], points[-1])
            if (x != given).any():
                beyond = given[x != given].flat[0]
                warn(
                    f"at: {name} = {beyond:g} is outside of the table, {points[0]:g} to {points[-1]:g}, and is cut to it"
                )
            k = np.clip(np.searchsorted(points, x, side="right") - 1, 0, points.size - 2)
            places.append(k)
            weights.append((x - points[k]) / (points[k + 1] - points[k]))
        found = {name: np.zeros(np.broadcast_shapes(*(k.shape for k in places))) for name in self.tables}
        for corner in itertools.product((0, 1), repeat=len(places)):
            share = prod((w if c else 1.0 - w) for c, w in zip(corner, weights, strict=True))
            index = tuple(k + c for c, k in zip(corner, places, strict=True))
            for name, table in self.tables.items():
                # a corner without weight may have no number
                found[name] += np.where(share > 0.0, share * table[index], 0.0)
        return found

    def write(self, path: str | Path) -> None:
        """Write to a .mat, .npz or .csv file. Breakpoints are called bp_y, bp_load, …; CSV has a row for each point.

        Raises
        ------
        ContactError
            For another ending, or if the file cannot be written.
        ImportError
            For .mat without scipy.
        """
        ending = files.require_ending(path, ENDINGS)
        content = {**{f"bp_{name}": points for name, points in self.axes.items()}, **self.tables}
        try:
            if ending == ".npz":
                np.savez_compressed(path, allow_pickle=False, **content)
            elif ending == ".mat":
                _savemat()(
                    path, {**content, "axes": np.array(list(self.axes), object)}, oned_as="row", do_compression=True
                )
            else:
                self._write_csv(path)
        except OSError as error:
            raise ContactError(f"{path} cannot be written: {error.strerror or error}") from None

    def _write_csv(self, path: str | Path) -> None:
        columns = [values.ravel() for values in np.meshgrid(*self.axes.values(), indexing="ij")]
        columns += [table.ravel() for table in self.tables.values()]
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([*self.axes, *self.tables])
            writer.writerows(zip(*(column.tolist() for column in columns), strict=True))


def require_writable(path: str | Path) -> None:
    """Raise, before the computation, what `LookupTable.write` would raise for the ending or the folder of `path`."""
    if files.require_writable(path, ENDINGS) == ".mat":
        _savemat()


def estimate(
    pair: WheelRailPair, axes: Mapping[str, ArrayLike], *, tables: int = len(DEFAULT_TABLES), **options: Any
) -> Estimate:
    """Return number of poses, size and time of `lookup_table`, from the time of some random poses in all threads."""
    points = _breakpoints(axes)
    n = prod(values.size for values in points.values())
    at = _random(points, _TRIAL, 0)
    over_poses(pair, **{name: values[:1] for name, values in at.items()}, **options)  # what is loaded at the first call
    start = time.perf_counter()
    over_poses(pair, **at, **options)
    return Estimate(n, 8 * n * tables, n * (time.perf_counter() - start) / _TRIAL)


def lookup_table(
    pair: WheelRailPair,
    axes: Mapping[str, ArrayLike],
    *,
    tables: tuple[str, ...] = DEFAULT_TABLES,
    progress: Callable[[float, str], None] | None = None,
    **options: Any,
) -> LookupTable:
    """Return tables of forces and other results of a wheel on its rail over a grid of breakpoints.

    Parameters
    ----------
    pair : WheelRailPair
    axes : mapping of str → array_like
        Names from `AXES`, arguments of `contact.pair.over_poses` → increasing breakpoints, two at least. The tables'
        dimensions are in the order of `AXES`.
    tables : tuple of str
        Names from `TABLES`.
    progress : callable
        Called with the share that is done, 0 to 1, and a description.
    **options
        Other arguments of `over_poses`, such as ``load=80e3`` without an axis of load, ``friction``, ``threads``.

    Returns
    -------
    LookupTable

    Raises
    ------
    ContactError
        For unknown names, breakpoints that do not increase, more than 5e7 numbers, and as `over_poses`.
    """
    points = _breakpoints(axes)
    for name in tables:
        if name not in TABLES:
            raise ContactError(f"tables: {name!r} is none of {', '.join(TABLES)}{suggestion(name, TABLES)}")
    count = prod(values.size for values in points.values()) * len(tables)
    if count > _MOST:
        raise ContactError(f"axes: the tables have {count} numbers; allowed: {_MOST}")
    mesh: dict[str, Any] = dict(zip(points, np.meshgrid(*points.values(), indexing="ij", sparse=True), strict=True))
    found = over_poses(pair, **mesh, progress=progress, **options)
    return LookupTable(points, {name: getattr(found, name) for name in tables}, int((found.status > 3).sum()))


def interpolation_error(
    pair: WheelRailPair, table: LookupTable, *, points: int = 500, seed: int = 0, **options: Any
) -> dict[str, TableError]:
    """Return the error of each table on random points within its range, against the solution there.

    `options` are those that the table was made with. Points without a trustworthy solution are left out.
    """
    at = _random(table.axes, require_integer("points", points, 1, 1_000_000), seed)
    found, interpolated = over_poses(pair, **at, **options), table.interpolated(**at)
    errors = {}
    for name, values in interpolated.items():
        known = getattr(found, name)
        good = (found.status <= 3) & np.isfinite(values)
        off = np.abs(values - known)[good]
        if not off.size:
            raise ContactError(f"points = {points}: none of them has a trustworthy solution")
        scale = float(np.abs(known[good]).max())
        errors[name] = TableError(float(np.sqrt(np.mean(off**2))), float(off.max()), scale, off.size)
    return errors


def _breakpoints(axes: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Return the checked breakpoints in the order of `AXES`."""
    for name in axes:
        if name not in AXES:
            raise ContactError(f"axes: {name!r} is none of {', '.join(AXES)}{suggestion(name, AXES)}")
    if not axes:
        raise ContactError(f"axes is empty; give breakpoints of one of {', '.join(AXES)}")
    found = {name: require_numbers(f"axes[{name!r}]", axes[name]) for name in AXES if name in axes}
    for name, values in found.items():
        if values.ndim != 1 or values.size < 2 or not (np.diff(values) > 0.0).all():
            raise ContactError(f"axes[{name!r}] has no increasing breakpoints, two at least")
    return found


def _random(axes: Mapping[str, Array], n: int, seed: int) -> dict[str, Any]:
    random = np.random.default_rng(seed)
    return {name: random.uniform(points[0], points[-1], n) for name, points in axes.items()}


def _savemat() -> Callable[..., None]:
    return optional("scipy.io", "a .mat file needs", "profiles").savemat
