"""A wheel for each row of a motion, over time or along the way, with friction memory and contact damping.

The page docs/understand/other_wheels.md tells how it is used.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from inspect import signature
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.errors import ContactError, require_kind, require_number, warn
from contact.friction import Friction, as_friction
from contact.geometry.flexible import WheelOffset
from contact.geometry.posed import Posed
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.surfaces import SurfacePair
from contact.instance.ownership import OwnsArrays
from contact.pair.contact_damping import ContactDamping
from contact.pair.elastic_rail import ElasticRail
from contact.pair.friction_memory import FrictionMemory
from contact.pair.solution import PairSolution
from contact.view.tables import Table, Tabular

MOST_ROWS = 1_000_000
TIME, STATION, LOAD, COEFFICIENT = "time", "station", "load.normal_force", "friction.coefficient"
_RECORDS = {"pose": Pose, "velocity": Velocity, "irregularity": Irregularity, "offset": WheelOffset}
#: Group → name in a motion → member of its record. The names are those of the inputs of the FMU `WheelRailPair`.
_MEMBERS = {
    group: {f"{group}.{'x' if member.name == 'forward' else member.name}": member.name for member in fields(record)}
    for group, record in _RECORDS.items()
}
#: What gives the height of a wheel.
AMOUNTS = ("load", "penetration", "vertical")
#: Columns that are arguments of `solve`. `load.normal_force` is the name of `load` in the FMU.
_ARGUMENTS = {name: name for name in (*AMOUNTS, "force", "torque")} | {LOAD: "load"}
NAMES = (*(name for members in _MEMBERS.values() for name in members), *_ARGUMENTS, COEFFICIENT)
_OF_PATCH = ("angle", "approach", "N", "Fx", "Fy", "Mz", "max_pressure", "area", "gap_error")


class PairRun(Mapping[str, Array], Tabular):
    """Results of a motion: a mapping of names to columns, one row for each row of the motion, in SI units.

    The columns are ``time`` or ``station`` and ``rotation`` as given; the force on the wheel ``Fx``, ``Fy``, ``Fz``, and
    ``Q``, ``Y`` as in `PairSolution` [N]; ``friction``, the coefficient at rest; ``z``, ``deflection_y``, ``deflection_z``
    [m]; ``spin`` [rad/s]; ``patches``; ``max_pressure`` [Pa]; ``power`` of friction [W] and ``power_per_metre`` [N];
    ``gap_error``; ``status``.

    Attributes
    ----------
    solutions : tuple of PairSolution, one for each row
    """

    def __init__(self, columns: Mapping[str, Array], solutions: Sequence[PairSolution]) -> None:
        self._columns, self.solutions = dict(columns), tuple(solutions)

    def __getitem__(self, name: str) -> Array:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def _table(self) -> Table:
        first = TIME if TIME in self else STATION
        beside = {name: self[name] for name in (STATION, "rotation") if name in self and name != first}
        columns = {name: values for name, values in self.items() if name not in {first, *beside}}
        return Table({first: self[first]}, columns, beside, units={"spin": "rad/s"})

    def __repr__(self) -> str:
        return f"PairRun({len(self.solutions)} rows: {', '.join(self)})"

    def patches(self) -> list[dict[str, Any]]:
        """Return one row for each patch: where it lies, angle, normal and creep forces in its frame, quality; SI units."""
        rows = []
        given = [name for name in (TIME, STATION, "rotation") if name in self]
        for i, one in enumerate(self.solutions):
            for k, contact in enumerate(one.contacts):
                x, y, z = contact.position
                row = {name: float(self[name][i]) for name in given}
                row |= {"wheel_z": one.z, "patch": k, "x": x, "y": y, "z": z}
                row |= {name: getattr(contact, name) for name in _OF_PATCH}
                row["status"] = int(contact.status)
                rows.append(row)
        return rows


class AnyPair(OwnsArrays, ABC):
    """Base class of `WheelRailPair`, `HalfspacePair` and `RollerRig`.

    Each serves one thread, and has a copy of the pair that it is made of. A copy, by `copy.copy` or a pickle, has arrays of its
    own and starts from the same last solution.

    Attributes
    ----------
    pair : contact.geometry.wheelset.Pair or contact.geometry.surfaces.SurfacePair
    """

    pair: Posed

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.pair!r})"

    @abstractmethod
    def solve(self, *args: Any, **kwargs: Any) -> PairSolution:
        """Return the solution at one instant, for a pose, a velocity and what is given."""

    def run(
        self,
        motion: Mapping[str, ArrayLike],
        *,
        rotation: float = 0.0,
        friction: float | Friction = 0.3,
        memory: FrictionMemory | None = None,
        damping: ContactDamping | None = None,
        rail: ElasticRail | None = None,
    ) -> PairRun:
        """Return the forces on the wheel for each row of a motion.

        Parameters
        ----------
        motion : mapping of str to array_like, shape (n,), or to a number that holds for all rows
            ``time`` [s], increasing, or ``station``, positions of the axle along the rail [m] in any order; both may be given.
            Then any inputs of the FMU `WheelRailPair` by their names: ``pose.y``, ``velocity.spin``, ``irregularity.z_rate``,
            ``offset.yaw``, ``friction.coefficient``, …, and the arguments ``load``, ``penetration``, ``vertical``, ``force``,
            ``torque`` of `WheelRailPair.solve`; ``load.normal_force`` is another name for ``load``. What is not given is 0,
            but forward speed ``velocity.x`` is 1 m/s, the wheel rolls freely without ``velocity.spin``, and without a load
            ``pose.z`` is given.
        rotation : float
            Angle of the wheel at the first station [rad]. Over the stations it rolls on with the nominal radius.
        friction : float or contact.friction.Friction
            For all rows; the column ``friction.coefficient`` takes the place of its coefficient at rest.
        memory : FrictionMemory
            In place of `friction`. It follows the sliding velocity of the patch with the largest normal force. Needs ``time``.
        damping : ContactDamping
            Its forces are added to ``Fx``, ``Fy``, ``Fz``, ``Q`` and ``Y``, from the second row on. Needs ``time``.
        rail : contact.pair.ElasticRail

        Returns
        -------
        PairRun

        Raises
        ------
        ContactError
            For unknown names, columns of other lengths, times that do not increase, and as the pair's `solve`; the message then
            names the time or the station.
        """
        motion = motion if isinstance(motion, Mapping) or not hasattr(motion, "keys") else dict(motion)  # a DataFrame
        require_kind("motion", motion, Mapping)
        require_kind("memory", memory, FrictionMemory | None)
        require_kind("damping", damping, ContactDamping | None)
        columns = _columns(motion)
        if memory is not None and COEFFICIENT in columns:
            raise ContactError(f"memory and {COEFFICIENT} exclude each other: the memory gives the coefficient")
        if TIME not in columns and (memory is not None or damping is not None):
            raise ContactError("motion has no column 'time', which friction memory and contact damping need")
        self._require_arguments(columns, rail)
        way = {name: columns.pop(name) for name in (TIME, STATION) if name in columns}
        time = way.get(TIME)
        if STATION in way:
            along = way[STATION]
            _doubt_stations(self.pair, along)
            way["rotation"] = require_number("rotation", rotation) - (along - along[0]) / self.pair.nominal_radius
        law = as_friction(friction)
        rows, solutions = [], []
        for k in range(len(next(iter(way.values())))):
            values = {name: float(column[k]) for name, column in columns.items()}
            if memory is not None:
                law = memory.friction
            elif COEFFICIENT in values:
                law = replace(law, static=values[COEFFICIENT])
            try:
                parts = {group: _record(group, values) for group in _RECORDS}
                pose, velocity = parts.pop("pose"), parts.pop("velocity")
                options = {group: part for group, part in parts.items() if part != _RECORDS[group]()}
                options |= {name: float(way[name][k]) for name in (STATION, "rotation") if name in way}
                options |= {argument: values[name] for name, argument in _ARGUMENTS.items() if name in values}
                if rail is not None:
                    options["rail"] = rail
                s = self.solve(pose, velocity, friction=law, **options)
            except ContactError as error:
                at = f"time {time[k]:g} s" if time is not None else f"station {way[STATION][k]:g} m"
                raise ContactError(f"at {at}: {error}") from None
            force = s.force
            if damping is not None and time is not None:
                force = damping.force(s, float(time[k] - time[k - 1]) if k else 1e30)
            if memory is not None and time is not None and k + 1 < time.size:
                memory.advance(_sliding(s, velocity.forward), float(time[k + 1] - time[k]))
            rows.append(_row(s, force, self.pair.side, law.static, velocity.forward))
            solutions.append(s)
        return PairRun(way | {name: np.array([row[name] for row in rows]) for name in rows[0]}, solutions)

    def _require_arguments(self, columns: Mapping[str, Array], rail: ElasticRail | None) -> None:
        """Raise a ContactError for a column that this pair's `solve` does not take."""
        taken = signature(self.solve).parameters
        needed = {name: _ARGUMENTS.get(name, name.split(".")[0]) for name in columns if name != TIME}
        needed |= {} if rail is None else {"rail": "rail"}
        for name, argument in needed.items():
            if argument not in taken:
                raise ContactError(f"motion has {name!r}; {type(self).__name__}.solve takes no {argument}")


def _row(s: PairSolution, force: Array, side: str, coefficient: float, speed: float) -> dict[str, float]:
    """Return the columns' values of one solution."""
    return {
        **dict(zip(("Fx", "Fy", "Fz"), force.tolist(), strict=True)),
        "Q": -force[2],
        "Y": -force[1] if side == "right" else force[1],
        "friction": coefficient,
        "z": s.z,
        "deflection_y": s.deflection[0],
        "deflection_z": s.deflection[1],
        "spin": s.spin,
        "patches": float(len(s.contacts)),
        "max_pressure": s.max_pressure,
        "power": abs(speed) * s.power_per_metre,
        "power_per_metre": s.power_per_metre,
        "gap_error": s.gap_error,
        "status": float(s.status),
    }


def _columns(motion: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Return the columns of a motion as arrays of one length."""
    unknown = [name for name in motion if name not in (TIME, STATION, *NAMES)]
    if unknown:
        raise ContactError(f"motion has {unknown[0]!r}; known are {', '.join((TIME, STATION, *NAMES))}")
    if TIME not in motion and STATION not in motion:
        raise ContactError("motion has no column 'time' and no column 'station'")
    columns = {name: as_array(f"motion[{name!r}]", column) for name, column in motion.items()}
    first = TIME if TIME in columns else STATION
    shape = columns[first].shape
    if len(shape) != 1 or not 1 <= shape[0] <= MOST_ROWS or not np.isfinite(columns[first]).all():
        raise ContactError(f"motion: {first!r} has shape {shape}; 1 to {MOST_ROWS} finite numbers are needed")
    if TIME in columns and not (np.diff(columns[TIME]) > 0.0).all():
        raise ContactError("motion: 'time' is not a column of increasing numbers")
    for name, column in columns.items():
        if column.shape not in (shape, ()) or (column.shape == () and name in (TIME, STATION)):
            raise ContactError(f"motion: {name!r} has shape {column.shape}, {first!r} has {shape}")
    return {name: np.broadcast_to(column, shape) for name, column in columns.items()}


def _doubt_stations(pair: Posed, along: Array) -> None:
    """Warn of a way that leads past the slices of a rail: beyond them it is constant."""
    if isinstance(pair, SurfacePair) and not pair.rail.sheet.constant:
        first, last = pair.rail.sheet.u[[0, -1]].tolist()
        if along.max() < first or along.min() > last:
            warn(
                f"station = {along.min():g} to {along.max():g}: the slices of the rail lie at {first:g} to {last:g} m; beyond "
                "them it is constant"
            )


def _record(group: str, values: Mapping[str, float]) -> Any:
    """Return a record of a row."""
    return _RECORDS[group](**{member: values[name] for name, member in _MEMBERS[group].items() if name in values})


def _sliding(solution: PairSolution, speed: float) -> float:
    """Return the sliding velocity [m/s] of the patch with the largest normal force."""
    if not solution.contacts:
        return 0.0
    creepage = max(solution.contacts, key=lambda patch: patch.N).creepage
    return abs(speed) * math.hypot(creepage.longitudinal, creepage.lateral)
