"""The commands `solve`, `patch`, `curve` and `methods`; those of other modules and plug-ins are added. Input in SI units."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.markup import escape

import contact
from contact.cli import arguments, creep_table, extras, problem, report
from contact.cli import options as opt
from contact.cli.along import along
from contact.cli.commas import Commands
from contact.cli.compare import compare
from contact.cli.curving import curving
from contact.cli.document import in_effect
from contact.cli.geometry import conicity, list_profiles
from contact.cli.geometry import geometry as points
from contact.cli.in_time import in_time
from contact.cli.inp import inp
from contact.cli.lut import lut
from contact.cli.output import deliver, drawing, reported, require_trusted
from contact.cli.plugins import add_plugins
from contact.cli.problem import Position
from contact.cli.profile_check import check
from contact.cli.rail import rail as elastic_rail
from contact.cli.roller import roller
from contact.cli.stress import stress
from contact.cli.transient import transient
from contact.errors import require_number
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, methods
from contact.results import Status

PICTURE_RESOLUTION = {"n_strips": 60, "n_elements": 60}

app = typer.Typer(
    cls=Commands,
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
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.right,
    amount: arguments.Amount,
    curvatures: opt.Curvatures = None,
    surface: arguments.SlidingFriction,
    gauge_friction: opt.GaugeFriction = None,
    pressure_limit: opt.PressureLimit = math.inf,
    bodies: opt.Bodies = None,
    fx: opt.LongitudinalForce = None,
    fy: opt.LateralForce = None,
    methods: arguments.Methods,
    conformal: opt.Conformal = False,
    layer: opt.Layer = None,
    trace: opt.Trace = False,
    output: arguments.Output,
) -> None:
    """Solve the contact of a wheel on a rail, or of two curvatures: patch, forces, damage.

    Examples:  contact solve --y 3e-3 --load 80e3   ·   contact solve --curvatures 1.1 0.8 --creepage 1e-3 0 0.1
    ·   contact solve --curvatures 1.1 0.8 --fx 12e3
    """
    options = {"friction": surface.law(gauge_friction), "material": arguments.material(pressure_limit, bodies)}
    options |= {**vars(methods), **(PICTURE_RESOLUTION if output.out else {})}
    options |= {"force": arguments.force(fx, fy), "layer": arguments.third_body(layer)}
    options |= {"trace": trace, "conformal": conformal}
    arguments.require_use(context, arguments.OF_A_POSITION - {"radius"})
    with redirect_stdout(sys.stderr if output.as_json else sys.stdout):  # a trace is not part of the JSON
        case = curvatures or place.position(side)
        touches = amount.touches(case, place.speed, options)
    report.deliver_patches(touches, _title(case), place.radius, output)


@app.command()
@reported
def patch(
    *,
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.both,
    amount: arguments.Amount,
    surface: arguments.SlidingFriction,
    gauge_friction: opt.GaugeFriction = None,
    pressure_limit: opt.PressureLimit = math.inf,
    methods: arguments.Methods,
    conformal: opt.Conformal = False,
    output: arguments.Output,
) -> None:
    """Draw the contact patches of a wheelset position: profiles, pressure, stick and slip, tractions, energy index.

    Without --out it writes patch.png. Example:  contact patch --y 6e-3 --yaw 2e-3 --out flange.png
    """
    drawing()
    output.out = output.out or [Path("patch.png")]
    case = place.position(side)
    options = {"friction": surface.law(gauge_friction), "material": arguments.material(pressure_limit)}
    options |= {**vars(methods), "conformal": conformal, **PICTURE_RESOLUTION}
    touches = amount.touches(case, place.speed, options)

    def figure() -> Any:
        drawn, wheels = drawing(), []
        for pair in case.wheels:
            of = [t for t in touches if t.side == pair.side]
            wheels.append(drawn.Wheel(pair.side, *pair.profiles, [t.patch for t in of], [t.solution for t in of]))
        return drawn.position(wheels, place.roll)

    report.deliver_patches(touches, _title(case), place.radius, output, figure)


@app.command()
@reported
def curve(
    context: typer.Context,
    *,
    over: opt.Over = opt.Motion.longitudinal,
    largest: opt.Largest = None,
    points: opt.Points = 41,
    curvatures: opt.Curvatures = None,
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.right,
    creepage: opt.Creep = None,
    load: opt.Load = None,
    surface: arguments.SlidingFriction,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangentials = [DEFAULT_TANGENTIAL],  # noqa: B006 (typer copies it)
    output: arguments.Output,
) -> None:
    """Compute creep curves: force over one creepage, for one or several tangential methods. The others are in --creepage.

    Two curvatures, by default 1.09 0.83, or the patch with the largest load of a wheel on a rail: --wheel, --rail, --y, --yaw.
    Example:  contact curve --over lateral --tangential fastrip --tangential fastsim --out curve.png   ·
    contact curve --wheel s1002 --rail 60e1 --y 5e-3
    """
    end = largest if largest is not None else (1.0 if over is opt.Motion.spin else 0.01)
    arguments.require_use(context)
    carried = problem.load_or_standard(load)
    if arguments.used(context):
        patch = problem.main_patch(place.position(side), carried)
        separation, start, normal_force = patch.separation, patch.creepage, float(patch.load or 0.0)
        held = f"{place.wheel} on {place.rail}, y = {1e3 * place.y:g} mm, N = {1e-3 * normal_force:.3g} kN"
    else:
        curvatures = curvatures or (1.09, 0.83)
        in_effect(curvatures=curvatures)
        separation, start, normal_force = Separation.hertzian(*curvatures), Creepage(), carried
        held = f"A = {curvatures[0]:g}, B = {curvatures[1]:g} 1/m, {1e-3 * carried:g} kN"
    start = start if creepage is None else Creepage(*creepage)
    values = np.linspace(0.0, require_number("max", end), points).tolist()
    options = {"friction": surface.law(), "normal": normal, "speed": place.speed}
    held = f"{held}, friction {surface.friction:g}"
    rows = problem.sweep(over.value, values, start, separation, normal_force, tangential, options)
    force, unit = ("Fx" if over is opt.Motion.longitudinal else "Fy"), ("1/m" if over is opt.Motion.spin else "-")
    axis, ordinate = f"{over} creepage [{unit}]", f"−{force}/N"
    curves = {
        method: [0.0 - row[force] / max(row["N"], 1e-300) for row in rows if row["tangential"] == method]
        for method in tangential
    }
    output.deliver(
        {"rows": rows},
        show=lambda console: report.show_curve(values, curves, axis, ordinate, console),
        rows=lambda: rows,
        figure=lambda: drawing().curve(
            values, curves, xlabel=axis, ylabel=f"{ordinate} [-]", limit=surface.friction, title=f"{held}, {normal}"
        ),
    )
    require_trusted([Status[row["status"]] for row in rows], "points")


app.command()(compare)
app.command()(stress)
app.command()(transient)
app.command("rail")(elastic_rail)
app.command()(in_time)
app.command()(inp)
app.command()(roller)
app.command()(curving)
app.command()(lut)
app.command()(along)
app.command("geometry")(points)
app.command()(conicity)
app.command("profiles")(list_profiles)
app.command()(check)
app.add_typer(creep_table.app)


@app.command("methods")
@reported
def list_methods(as_json: opt.Json = False) -> None:
    """List the normal and tangential methods and what each can do."""
    known = methods()
    names = ("name", "title", "source", "abilities")
    content = {
        kind: [{name: getattr(method, name) for name in names} for method in of_kind.values()]
        for kind, of_kind in known._asdict().items()
    }
    deliver(content, show=lambda console: report.show_methods(known, console), as_json=as_json)


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


def _title(case: Position | tuple[float, float]) -> str:
    if not isinstance(case, Position):
        return f"Half curvatures {case[0]:g} and {case[1]:g} 1/m"
    pose, (wheel, rail) = case.pose, case.wheels[0].profiles
    return (
        f"{wheel.name or 'wheel'} on {rail.name or 'rail'}: y = {1e3 * pose.y:g} mm, "
        f"roll {1e3 * pose.roll:g} mrad, yaw {1e3 * pose.yaw:g} mrad, {case.speed:g} m/s"
    )
