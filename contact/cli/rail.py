"""The command `rail`: a wheel on a rail with springs under it, its deflection and the forces."""

from __future__ import annotations

import json
import math
from typing import Any, cast

import typer
from rich.console import Console
from rich.table import Table

import contact
from contact.cli import options as opt
from contact.cli.output import reported
from contact.cli.problem import standard_load
from contact.elastic_rail import ElasticRail
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from contact.study.table import number


@reported
def rail(
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    side: opt.Sides = opt.Side.right,
    y: opt.Y = 0.0,
    roll: opt.Roll = 0.0,
    yaw: opt.Yaw = 0.0,
    speed: opt.Speed = 20.0,
    load: opt.Load = None,
    friction: opt.Friction = 0.3,
    springs: opt.Springs = (math.inf, math.inf),
    preload: opt.Preload = (0.0, 0.0),
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
    as_json: opt.Json = False,
) -> None:
    """Find the deflection of a rail on springs under a wheel, and the forces on the wheel.

    Example:  contact rail --y 6.5e-3 --load 60e3 --springs 8e6 50e6
    """
    elastic = ElasticRail(*springs, *preload)
    case = opt.position(
        wheel, rail, opt.reading(inclination, unit, drawn_side, smoothing), radius, side, y, roll, yaw, speed
    )
    found: dict[str, dict[str, Any]] = {}
    for name in case.sides:
        pair = Pair(case.wheel, case.rail, side=cast(Any, name), nominal_radius=radius)
        solver = WheelRailPair(pair, normal=normal, tangential=tangential)
        pose, velocity = Pose(y=y, roll=roll, yaw=yaw), Velocity(forward=speed)
        solution = solver.solve(pose, velocity, vertical=standard_load(load, None), friction=friction, rail=elastic)
        found[name] = {
            "deflection_y": solution.deflection[0],
            "deflection_z": solution.deflection[1],
            "Fx": float(solution.force[0]),
            "Fy": float(solution.force[1]),
            "Fz": float(solution.force[2]),
            "z": solution.z,
            "max_pressure": solution.max_pressure,
            "patches": len(solution.contacts),
            "status": solution.status.name,
        }
    if as_json:
        typer.echo(json.dumps({"version": contact.__version__, "sides": found}, indent=2))
        return
    table = Table(title="A wheel on an elastic rail", title_justify="left", title_style="bold", header_style="bold")
    for heading in ("quantity", "unit", *found):
        table.add_column(heading)
    for label, unit_of, key, factor in (
        ("lateral deflection", "mm", "deflection_y", 1e3),
        ("vertical deflection", "mm", "deflection_z", 1e3),
        ("Fx on the wheel", "kN", "Fx", 1e-3),
        ("Fy on the wheel", "kN", "Fy", 1e-3),
        ("Fz on the wheel", "kN", "Fz", 1e-3),
        ("wheelset z", "mm", "z", 1e3),
        ("peak pressure", "MPa", "max_pressure", 1e-6),
    ):
        table.add_row(label, unit_of, *(number(factor * one[key]) for one in found.values()))
    table.add_row("status", "", *(str(one["status"]).lower().replace("_", " ") for one in found.values()))
    Console().print(table)
