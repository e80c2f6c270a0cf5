"""The command `stress`: the largest stresses below the patches of a wheel on a rail, and a picture of one patch."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

import contact
from contact.cli import options as opt
from contact.cli import problem
from contact.cli.output import drawing, reported, write_picture
from contact.cli.problem import Touch
from contact.creepage import Creepage
from contact.errors import require_number
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from contact.stress import SurfaceLoad, dang_van, largest
from contact.stress.field import CRITERIA, require_criterion
from contact.study.table import number

#: Depths for Dang Van's criterion over the radius of a circle with the contact's area.
_DEPTHS = np.linspace(0.0, 1.5, 16)


@reported
def stress(
    context: typer.Context,
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    inclination: opt.Inclination = None,
    radius: opt.Radius = 0.46,
    side: opt.Sides = opt.Side.right,
    y: opt.Y = 0.0,
    roll: opt.Roll = 0.0,
    yaw: opt.Yaw = 0.0,
    speed: opt.Speed = 20.0,
    load: opt.Load = None,
    penetration: opt.Penetration = None,
    friction: opt.Friction = 0.3,
    creepage: opt.Creep = None,
    curvatures: opt.Curvatures = None,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
    body: opt.Body = "rail",
    criterion: opt.Criterion = "von_mises",
    slope: opt.DangVanSlope = 1.0 / 3.0,
    as_json: opt.Json = False,
    plot: opt.Plot = None,
) -> None:
    """Compute the largest stresses below the contact of a wheel on a rail, or of two curvatures, and their depth.

    Examples:  contact stress --y 3e-3 --plot stress.png   ·   contact stress --curvatures 1.1 0.8 --creepage 2e-3 0 0
    """
    if plot is not None:
        drawing()
    require_criterion(criterion)
    require_number("slope", slope, 0.0, 3.0)
    options = {"friction": opt.surface(friction, None, "global"), "normal": normal, "tangential": tangential}
    given = None if creepage is None else Creepage(*creepage)
    opt.require_use(context)
    if curvatures is not None:
        touches = [problem.solve_hertzian(curvatures, load, penetration, given, options | {"speed": speed})]
    else:
        reading = opt.reading(inclination, None, None, None)
        case = opt.position(wheel, rail, reading, radius, side, y, roll, yaw, speed)
        touches = problem.solve_position(case, load, penetration, given, options)
    touches = [touch for touch in touches if touch.solution.N > 0.0]
    found = [stresses(touch, body, slope) for touch in touches]
    if as_json:
        typer.echo(json.dumps({"version": contact.__version__, "patches": found}, indent=2))
    else:
        _show(touches, found, body, Console())
    if plot is not None and touches:
        worst = max(touches, key=lambda touch: largest(touch.solution, criterion, body=body).value)
        title = f"{body}, {worst.name}"
        write_picture(drawing().stress(worst.solution, criterion, body=body, title=title), plot)


def stresses(touch: Touch, body: str, slope: float) -> dict[str, Any]:
    """Return the largest stresses of a patch [Pa] with their places [m], as plain data."""
    surface, nu = SurfaceLoad.of(touch.solution), touch.solution.material.poisson_ratio
    content: dict[str, Any] = {"name": touch.name, "body": body, "N": touch.solution.N}
    for name in CRITERIA:
        peak = largest(surface, name, body=body, poisson_ratio=nu)
        content[name] = {"value": peak.value, "x": peak.x, "y": peak.y, "z": peak.z}
    worst = dang_van(surface, surface.radius * _DEPTHS, slope=slope, body=body, poisson_ratio=nu).peak
    content["dang_van"] = {"value": worst.value, "y": worst.y, "z": worst.z, "slope": slope}
    return content


def _show(touches: Sequence[Touch], found: Sequence[dict[str, Any]], body: str, console: Console) -> None:
    if not touches:
        console.print("no contact: no stress")
        return
    title = f"Largest stresses in the {body}"
    table = Table(title=title, title_justify="left", title_style="bold", header_style="bold")
    for heading in ("quantity", "unit"):
        table.add_column(heading)
    for touch in touches:
        table.add_column(touch.name, justify="right")
    for name in (*CRITERIA, "dang_van"):
        table.add_row(name.replace("_", " "), "MPa", *(number(1e-6 * one[name]["value"]) for one in found))
        table.add_row("  depth", "mm", *(number(1e3 * one[name]["z"]) for one in found))
    console.print(table)
