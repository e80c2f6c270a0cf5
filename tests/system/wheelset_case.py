"""A short run of a wheelset with forces that change in each step."""

import math

from fmu_instance import Instance

from contact_fmu.tables.wheelset import table
from contact_models.wheelset.components import DirectWheelset
from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.ports import (
    CHANGE,
    CREEPAGE,
    ENERGY,
    FRAME,
    MOTION,
    PROBLEM,
    REACTION,
    SIDES,
    WHEELSET_PORTS,
)

STATES = [row.name for row in table().states]
INPUT_PORTS = {"irregularity", *(f"{side}.reaction" for side in SIDES)}
NUMBERS = {*MOTION, *ENERGY, *CHANGE, *(f"{s}.{n}" for s in SIDES for n in (*PROBLEM[CREEPAGE], *FRAME))}

#: Parameters with other values than their defaults.
PARAMETERS = [
    ("mass", 900.0),
    ("yaw_inertia", 700.0),
    ("spin_inertia", 90.0),
    ("axle_load", 9e4),
    ("suspension.lateral_stiffness", 3e6),
    ("suspension.yaw_stiffness", 3e6),
    ("suspension.lateral_damping", 1e5),
    ("suspension.yaw_damping", 1e5),
    ("initial.lateral_velocity", 0.1),
    ("initial.yaw_rate", 0.1),
    ("initial.approach", 1e-4),
    ("wheel.radius", 0.5),
    ("wheel.flange_back", 1.363),
    ("track.gauge", 1.433),
    ("geometry.y0", -0.021),
    ("geometry.dy", 0.9e-3),
    ("rail.inclination", 1.0 / 20.0),
    ("resolution.substeps", 3),
]


def reactions(k: int) -> dict[str, dict[str, float]]:
    """Return forces and approaches of step `k` for each side."""
    return {
        side: dict(zip(REACTION, (900.0 * m * math.sin(k), -1500.0 + 300.0 * k, 5.0 * m, 7e-5 + 1e-6 * k), strict=True))
        for side, m in zip(SIDES, (1.0, -1.0), strict=True)
    }


def inputs(k: int) -> dict[str, float]:
    """Return the same by the names of the FMU's inputs."""
    return {f"{side}.{name}": v for side, forces in reactions(k).items() for name, v in forces.items()}


def trajectory(fmu: Instance, start: int) -> list[dict[str, float]]:
    """Return the outputs of three steps with changing forces from step `start` on."""
    rows = []
    for k in range(start, start + 3):
        fmu.update(inputs(k))
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows


def reported(model: WheelsetModel) -> dict[str, float]:
    """Return all outputs of the model by name."""
    columns = {port: DirectWheelset(model).read(port) for port in WHEELSET_PORTS if port not in INPUT_PORTS}
    return {
        n: v for port, column in columns.items() for n, v in zip(WHEELSET_PORTS[port], column.tolist(), strict=True)
    }


def commands(kind: int) -> str:
    """Return commands for `host/script.c`: three steps, or derivatives at three states."""
    at = {scalar.name: reference for reference, scalar in enumerate(table().scalars)}
    lines = [f"s {at['initial.lateral']} 0.005", "i"]
    for k in range(3):
        lines += [f"s {at[name]} {value!r}" for name, value in inputs(k).items()]
        if kind:
            lines += [f"d {k * 1e-3!r} 0.001", *(f"g {r}" for name, r in at.items() if name in NUMBERS)]
        else:
            states = (0.002 * k, 1e-3, 0.01 * k, 0.02, 61.0, 1.0, 2.0, 3.0)
            lines += [f"t {k * 1e-3!r}", f"x {len(states)} {' '.join(map(repr, states))}"]
    return "\n".join(lines)
