"""A wheel on a rail over time: one solution for each row of a motion, with friction memory and damping (other_wheels.md)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.errors import ContactError
from contact.friction import Friction, as_friction
from contact.geometry.flexible import WheelOffset
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.pair.contact_damping import ContactDamping
from contact.pair.elastic_rail import ElasticRail
from contact.pair.friction_memory import FrictionMemory
from contact.pair.wheel_rail import PairSolution, WheelRailPair

Array = NDArray[np.float64]

LOAD, COEFFICIENT = "load.normal_force", "friction.coefficient"
_RECORDS = {"pose": Pose, "velocity": Velocity, "irregularity": Irregularity, "offset": WheelOffset}
#: Group → name in a motion → member of its record. The names are those of the inputs of the FMU `WheelRailPair`.
_MEMBERS = {
    group: {f"{group}.{'x' if member.name == 'forward' else member.name}": member.name for member in fields(record)}
    for group, record in _RECORDS.items()
}
NAMES = (*(name for members in _MEMBERS.values() for name in members), LOAD, COEFFICIENT)


def over_time(
    pair: WheelRailPair,
    motion: Mapping[str, ArrayLike],
    *,
    friction: float | Friction = 0.3,
    memory: FrictionMemory | None = None,
    damping: ContactDamping | None = None,
    rail: ElasticRail | None = None,
) -> dict[str, Array]:
    """Return the forces on a wheel for each row of a motion.

    Parameters
    ----------
    pair : WheelRailPair
    motion : mapping of str to array_like, shape (n,)
        ``time`` [s], increasing, and any inputs of the FMU `WheelRailPair` by their names: ``pose.y``, ``velocity.spin``,
        ``irregularity.z_rate``, ``offset.yaw``, ``friction.coefficient``, … Others are 0, but forward speed ``velocity.x`` is 1
        m/s, and the wheel rolls freely without ``velocity.spin``. ``load.normal_force`` is the vertical force on the wheel
        [N], friction included; without it ``pose.z`` is given.
    friction : float or contact.friction.Friction
        For all rows; the column ``friction.coefficient`` takes the place of its coefficient at rest.
    memory : FrictionMemory
        In place of `friction`. It follows the sliding velocity of the patch with the largest normal force.
    damping : ContactDamping
        Its forces are added to ``Fx``, ``Fy``, ``Fz``, ``Q`` and ``Y``, from the second row on.
    rail : contact.pair.ElasticRail

    Returns
    -------
    dict of str to array, shape (n,)
        ``time``; the force on the wheel ``Fx``, ``Fy``, ``Fz``, and ``Q``, ``Y`` as in `PairSolution` [N]; ``friction``, the
        coefficient at rest; ``z``, ``deflection_y``, ``deflection_z`` [m]; ``max_pressure`` [Pa]; ``power`` of friction [W];
        ``status``.

    Raises
    ------
    ContactError
        For unknown names, columns of other lengths, times that do not increase, and as `WheelRailPair.solve`; the message
        then names the time.
    """
    columns = _columns(motion)
    if memory is not None and COEFFICIENT in columns:
        raise ContactError(f"memory and {COEFFICIENT} exclude each other: the memory gives the coefficient")
    law, time = as_friction(friction), columns.pop("time")
    found = []
    for k, at in enumerate(time.tolist()):
        values = {name: float(column[k]) for name, column in columns.items()}
        step = float(time[k] - time[k - 1]) if k else math.inf
        if memory is not None:
            law = memory.friction
        elif COEFFICIENT in values:
            law = replace(law, static=values[COEFFICIENT])
        try:
            parts = {group: _record(group, values) for group in _RECORDS}
            pose, velocity = parts["pose"], parts["velocity"]
            s = pair.solve(
                pose,
                velocity,
                irregularity=parts["irregularity"],
                offset=parts["offset"],
                vertical=values.get(LOAD),
                friction=law,
                rail=rail,
            )
        except ContactError as error:
            raise ContactError(f"at time {at:g} s: {error}") from None
        force = s.force if damping is None else damping.force(s, min(step, 1e30))
        if memory is not None and k + 1 < time.size:
            memory.advance(_sliding(s, velocity.forward), float(time[k + 1] - at))
        outwards = -1.0 if pair.pair.side == "right" else 1.0
        found.append(
            {
                "time": at,
                **dict(zip(("Fx", "Fy", "Fz"), force.tolist(), strict=True)),
                "Q": -force[2],
                "Y": outwards * force[1],
                "friction": law.static,
                "z": s.z,
                "deflection_y": s.deflection[0],
                "deflection_z": s.deflection[1],
                "max_pressure": s.max_pressure,
                "power": velocity.forward * s.power_per_metre,
                "status": float(s.status),
            }
        )
    return {name: np.array([row[name] for row in found]) for name in found[0]}


def _columns(motion: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Return the columns of a motion as arrays of one length."""
    unknown = [name for name in motion if name != "time" and name not in NAMES]
    if unknown:
        raise ContactError(f"motion has {unknown[0]!r}; known are time, {', '.join(NAMES)}")
    if "time" not in motion:
        raise ContactError("motion has no column 'time'")
    try:
        columns = {name: np.array(column, dtype=np.float64) for name, column in motion.items()}
    except (TypeError, ValueError, OverflowError):
        raise ContactError("motion holds something that is not a number") from None
    time = columns["time"]
    if time.ndim != 1 or time.size < 1 or not np.isfinite(time).all() or not (np.diff(time) > 0.0).all():
        raise ContactError("motion: 'time' is not a column of increasing numbers")
    for name, column in columns.items():
        if column.shape != time.shape:
            raise ContactError(f"motion: {name!r} has shape {column.shape}, 'time' has {time.shape}")
    return columns


def _record(group: str, values: Mapping[str, float]) -> Any:
    """Return a record of a row."""
    return _RECORDS[group](**{member: values[name] for name, member in _MEMBERS[group].items() if name in values})


def _sliding(solution: PairSolution, speed: float) -> float:
    """Return the sliding velocity [m/s] of the patch with the largest normal force."""
    if not solution.contacts:
        return 0.0
    creepage = max(solution.contacts, key=lambda patch: patch.N).creepage
    return speed * math.hypot(creepage.longitudinal, creepage.lateral)
