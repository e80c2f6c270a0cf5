"""The command `rail`: a wheel on a rail, with springs under it or under a given force or torque."""

from __future__ import annotations

import math
from typing import Any

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import reported, require_trusted
from contact.cli.problem import carried
from contact.cli.report import show_columns
from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Velocity
from contact.pair import ElasticRail, WheelRailPair
from contact.results import Status

_SHOWN = (
    ("lateral deflection", "mm", "deflection_y", 1e3),
    ("vertical deflection", "mm", "deflection_z", 1e3),
    ("Fx on the wheel", "kN", "Fx", 1e-3),
    ("Fy on the wheel", "kN", "Fy", 1e-3),
    ("Fz on the wheel", "kN", "Fz", 1e-3),
    ("moment about the axle", "N m", "My", 1.0),
    ("rotation of the wheel", "rad/s", "spin", 1.0),
    ("wheelset z", "mm", "z", 1e3),
    ("peak pressure", "MPa", "max_pressure", 1e-6),
    ("status", "", "status", 1.0),
)


@reported
def rail(
    *,
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.right,
    load: opt.Load = None,
    vertical: opt.Vertical = None,
    surface: arguments.SlidingFriction,
    springs: opt.Springs = (math.inf, math.inf),
    preload: opt.Preload = (0.0, 0.0),
    spin: opt.Spin = None,
    force: opt.DriveForce = None,
    torque: opt.Torque = None,
    wheel_offset: opt.WheelOffset = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    methods: arguments.Methods,
    output: arguments.Output,
) -> None:
    """Find the forces on a wheel, the deflection of a rail on springs, and the rotation that a force or a torque needs.

    Example:  contact rail --y 6.5e-3 --load 60e3 --springs 8e6 50e6

    Example:  contact rail --y 2e-3 --torque 8e3
    """
    elastic = ElasticRail(*springs, *preload)
    case = place.position(side)
    rows: list[dict[str, Any]] = []
    for pair in case.wheels:
        solver = WheelRailPair(pair, **vars(methods))
        velocity = Velocity(forward=place.speed, spin=spin)
        options: dict[str, Any] = {"friction": surface.law(), "rail": elastic, **carried(load, vertical)}
        options["offset"] = WheelOffset(*wheel_offset) if any(wheel_offset) else None
        options |= {"force": force, "torque": torque}
        s = solver.solve(case.pose, velocity, **options)
        rows.append(
            {
                "side": pair.side,
                "deflection_y": s.deflection[0],
                "deflection_z": s.deflection[1],
                **{f"F{axis}": float(f) for axis, f in zip("xyz", s.force, strict=True)},
                "My": float(s.moment[1]),
                "spin": s.spin,
                "z": s.z,
                "max_pressure": s.max_pressure,
                "status": s.status.name,
            }
        )
    output.deliver(
        {"sides": rows},
        show=lambda console: show_columns("A wheel on a rail", "side", rows, _SHOWN, console),
        rows=lambda: rows,
    )
    require_trusted([Status[row["status"]] for row in rows], "wheels")
