"""The commands `solve`, `patch`, `curve` and `methods`; those of other modules and plug-ins are added. Input in SI units."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.markup import escape

import contact
from contact.cli import creep_table, extras, problem, report
from contact.cli import options as opt
from contact.cli.along import along
from contact.cli.compare import compare
from contact.cli.geometry import conicity, list_profiles
from contact.cli.geometry import geometry as points
from contact.cli.manchester import manchester
from contact.cli.output import drawing, reported, write_csv, write_picture
from contact.cli.plugins import add_plugins
from contact.cli.problem import Position, Touch
from contact.cli.statistics import statistics
from contact.creepage import Creepage
from contact.errors import require_number
from contact.friction import ROOM_TEMPERATURE
from contact.geometry import profile
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, methods

PICTURE_RESOLUTION = {"n_strips": 60, "n_elements": 60}

app = typer.Typer(
    name="contact",
    help="Wheel-rail contact: patches, pressure, creep forces and damage. All input and JSON are in SI units; "
    "forces act on the wheel.",
    epilog=escape(extras.note()),
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.command()
@reported
def solve(
    context: typer.Context,
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
    penetration: opt.Penetration = None,
    friction: opt.Friction = 0.3,
    falling: opt.Falling = None,
    slip_velocity: opt.SlipVelocity = "global",
    gauge_friction: opt.GaugeFriction = None,
    hot: opt.Hot = None,
    temperature: opt.Background = ROOM_TEMPERATURE,
    pressure_limit: opt.PressureLimit = math.inf,
    creepage: opt.Creep = None,
    curvatures: opt.Curvatures = None,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
    conformal: opt.Conformal = False,
    as_json: opt.Json = False,
    plot: opt.Plot = None,
) -> None:
    """Solve the contact of a wheel on a rail, or of two curvatures: patch, forces, damage.

    Examples:  contact solve --y 3e-3 --load 80e3   ·   contact solve --curvatures 1.1 0.8 --creepage 1e-3 0 0.1
    """
    if plot is not None:
        drawing()
    surface = opt.surface(friction, falling, slip_velocity, gauge_friction, hot, temperature)
    material = opt.steel(pressure_limit)
    options = {"friction": surface, "material": material, "normal": normal, "tangential": tangential}
    options |= PICTURE_RESOLUTION if plot else {}
    given = None if creepage is None else Creepage(*creepage)
    opt.require_use(context)
    if curvatures is not None:
        touches = [problem.solve_hertzian(curvatures, load, penetration, given, options | {"speed": speed})]
        title = f"Half curvatures {curvatures[0]:g} and {curvatures[1]:g} 1/m"
    else:
        case = _position(
            wheel, rail, opt.reading(inclination, unit, drawn_side, smoothing), radius, side, y, roll, yaw, speed
        )
        touches = problem.solve_position(case, load, penetration, given, options | {"conformal": conformal})
        title = _title(case)
    if as_json:
        patches = [report.data(touch, radius) for touch in touches]
        typer.echo(json.dumps({"version": contact.__version__, "patches": patches}, indent=2))
    else:
        report.show(touches, title, radius, Console())
    if plot is not None:
        _draw(plot, touches, lambda drawn: drawn.patch([t.solution for t in touches], [t.name for t in touches]))


@app.command()
@reported
def patch(
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    side: opt.Sides = opt.Side.both,
    y: opt.Y = 0.0,
    roll: opt.Roll = 0.0,
    yaw: opt.Yaw = 0.0,
    speed: opt.Speed = 20.0,
    load: opt.Load = None,
    penetration: opt.Penetration = None,
    friction: opt.Friction = 0.3,
    falling: opt.Falling = None,
    slip_velocity: opt.SlipVelocity = "global",
    gauge_friction: opt.GaugeFriction = None,
    hot: opt.Hot = None,
    temperature: opt.Background = ROOM_TEMPERATURE,
    pressure_limit: opt.PressureLimit = math.inf,
    creepage: opt.Creep = None,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
    conformal: opt.Conformal = False,
    out: opt.Out = Path("patch.png"),
) -> None:
    """Draw the contact patches of a wheelset position: profiles, pressure, stick and slip, tractions, energy index.

    Example:  contact patch --y 6e-3 --yaw 2e-3 --out flange.png
    """
    drawing()
    case = _position(
        wheel, rail, opt.reading(inclination, unit, drawn_side, smoothing), radius, side, y, roll, yaw, speed
    )
    surface = opt.surface(friction, falling, slip_velocity, gauge_friction, hot, temperature)
    material = opt.steel(pressure_limit)
    options = {
        "friction": surface,
        "material": material,
        "normal": normal,
        "tangential": tangential,
        **PICTURE_RESOLUTION,
    }
    options |= {"conformal": conformal}
    touches = problem.solve_position(
        case, load, penetration, None if creepage is None else Creepage(*creepage), options
    )
    report.show(touches, _title(case), radius, Console())
    sides = {name: [t for t in touches if t.side == name] for name in case.sides}
    _draw(
        out,
        touches,
        lambda drawn: drawn.position(
            [
                drawn.Wheel(name, case.wheel, case.rail, [t.patch for t in one], [t.solution for t in one])
                for name, one in sides.items()
            ],
            roll,
        ),
    )


@app.command()
@reported
def curve(
    *,
    over: opt.Over = opt.Motion.longitudinal,
    largest: opt.Largest = None,
    points: opt.Points = 21,
    curvatures: opt.Ellipse = (1.09, 0.83),
    creepage: opt.Creep = None,
    load: opt.Load = None,
    speed: opt.Speed = 20.0,
    friction: opt.Friction = 0.3,
    falling: opt.Falling = None,
    slip_velocity: opt.SlipVelocity = "global",
    hot: opt.Hot = None,
    temperature: opt.Background = ROOM_TEMPERATURE,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangentials = [DEFAULT_TANGENTIAL],  # noqa: B006 (typer copies it)
    table: opt.Csv = None,
    plot: opt.Plot = None,
) -> None:
    """Compute creep curves: force over one creepage, for one or several tangential methods. The others are in --creepage.

    Example:  contact curve --over lateral --tangential fastrip --tangential fastsim --plot curve.png
    """
    if plot is not None:
        drawing()
    end = largest if largest is not None else (1.0 if over is opt.Motion.spin else 0.01)
    start = Creepage() if creepage is None else Creepage(*creepage)
    values = np.linspace(0.0, require_number("max", end), points).tolist()
    surface = opt.surface(friction, falling, slip_velocity, hot=hot, background=temperature)
    options = {"friction": surface, "normal": normal, "speed": speed}
    rows = problem.sweep(over.value, values, start, curvatures, load, tangential, options)
    force, unit = ("Fx" if over is opt.Motion.longitudinal else "Fy"), ("1/m" if over is opt.Motion.spin else "-")
    axis, ordinate = f"{over} creepage [{unit}]", f"−{force}/N"
    curves = {
        method: [0.0 - row[force] / max(row["N"], 1e-300) for row in rows if row["tangential"] == method]
        for method in tangential
    }
    report.show_curve(values, curves, axis, ordinate, Console())
    if table is not None:
        write_csv(rows, table)
    if plot is not None:
        write_picture(drawing().curve(values, curves, xlabel=axis, ylabel=f"{ordinate} [-]", limit=friction), plot)


app.command()(compare)
app.command()(statistics)
app.command()(along)
app.command("geometry")(points)
app.command()(conicity)
app.command("profiles")(list_profiles)
app.command()(manchester)
app.add_typer(creep_table.app)


@app.command("methods")
def list_methods() -> None:
    """List the normal and tangential methods and what each can do."""
    report.show_methods(methods(), Console())


@app.callback(invoke_without_command=True)
def version(
    show: Annotated[bool, typer.Option("--version", help="print the version", is_eager=True)] = False,
) -> None:
    """Handle the options that precede a command."""
    if show:
        typer.echo(contact.__version__)
        raise typer.Exit


def run(arguments: Sequence[str]) -> None:
    """Run the command. Plug-ins are loaded only if the command is not one of this package, to save their import time."""
    built_in = {command.name or command.callback.__name__ for command in app.registered_commands if command.callback}
    if next((word for word in arguments if not word.startswith("-")), None) not in built_in:
        for problem_line in add_plugins(app):
            typer.echo(f"contact: {problem_line}", err=True)
    app(args=list(arguments), prog_name="contact")


def _position(
    wheel: str,
    rail: str,
    reading: dict[str, Any],
    radius: float,
    side: opt.Side,
    y: float,
    roll: float,
    yaw: float,
    speed: float,
) -> Position:
    return Position(
        profile.load(wheel, "wheel", **reading),
        profile.load(rail, "rail", **reading),
        ("left", "right") if side is opt.Side.both else (side.value,),
        problem.Pose(y=y, roll=roll, yaw=yaw),
        speed,
        radius,
    )


def _title(case: Position) -> str:
    pose = case.pose
    return (
        f"{case.wheel.name or 'wheel'} on {case.rail.name or 'rail'}: y = {1e3 * pose.y:g} mm, "
        f"roll {1e3 * pose.roll:g} mrad, yaw {1e3 * pose.yaw:g} mrad, {case.speed:g} m/s"
    )


def _draw(path: Path, touches: Sequence[Touch], picture: Callable[[Any], Any]) -> None:
    """Write the figure that `picture` makes with `contact.plot`. Without contact, print a message instead."""
    if touches:
        write_picture(picture(drawing()), path)
    else:
        typer.echo("no contact: no picture is written", err=True)
