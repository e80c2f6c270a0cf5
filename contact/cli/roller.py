"""The command `roller`: a wheel on a roller of a test rig."""

from __future__ import annotations

from typing import Annotated, Any, cast

import typer
from rich.console import Console

from contact.cli import options as opt
from contact.cli import report
from contact.cli.output import reported
from contact.cli.problem import Touch, standard_load
from contact.friction import as_friction
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from contact.roller import RollerRig


@reported
def roller(
    roller_radius: Annotated[float, typer.Argument(help="radius of the roller in m")],
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    y: opt.Y = 0.0,
    roll: opt.Roll = 0.0,
    yaw: opt.Yaw = 0.0,
    speed: opt.Speed = 20.0,
    spin: Annotated[float | None, typer.Option(help="rotation of the wheel in rad/s, negative; default free")] = None,
    offset: Annotated[float, typer.Option(help="distance of the wheelset ahead of the roller's axle in m")] = 0.0,
    load: opt.Load = None,
    friction: opt.Friction = 0.3,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
) -> None:
    """Solve the contact of the right wheel on a roller; the rail profile is that of the roller, --speed that of its surface.

    Example:  contact roller 0.6 --y 3e-3 --load 60e3 --spin -43.5
    """
    case = opt.position(
        wheel,
        rail,
        opt.reading(inclination, unit, drawn_side, smoothing),
        radius,
        opt.Side.right,
        y,
        roll,
        yaw,
        speed,
    )
    pair = Pair(case.wheel, case.rail, side=cast(Any, "right"), nominal_radius=radius)
    rig = RollerRig(pair, roller_radius, offset=offset, normal=normal, tangential=tangential)
    pose, velocity = Pose(y=y, roll=roll, yaw=yaw), Velocity(forward=speed, spin=spin)
    load = standard_load(load, None)
    found = rig.solve(pose, velocity, vertical=load, friction=as_friction(friction))
    touches = [Touch(s, "right", p, k) for k, (p, s) in enumerate(zip(found.patches, found.solutions, strict=True), 1)]
    title = (
        f"{case.wheel.name or 'wheel'} on a roller of {roller_radius:g} m: y = {1e3 * y:g} mm, yaw {1e3 * yaw:g} mrad"
    )
    report.show(touches, title, radius, Console())
