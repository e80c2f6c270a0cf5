"""The command `curving`: a wheelset that runs steadily through a curve."""

from __future__ import annotations

from typing import Annotated, Any

from rich.console import Console
from rich.table import Table

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import deliver, prepare, reported, require_trusted
from contact.cli.problem import load_or_standard
from contact.errors import ContactError
from contact.inputs.options import FLANGE_BACK, GAUGE, RADIUS
from contact.pair.curving import Curving, in_curve
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from contact.study.table import number

CurveRadius = Annotated[float, opt.in_track("--curve-radius", help="radius of the curve in m", min=10.0)]
Cant = Annotated[float, opt.in_track(help="height of the outer rail above the inner one in m")]
Stiffness = Annotated[float, opt.in_track(help="stiffness of the guidance about z in N m/rad; 0 is a free wheelset")]
Lead = Annotated[
    float, opt.in_track(help="distance of the axle ahead of its bogie's centre in m; behind it is negative")
]
Height = Annotated[
    float | None,
    opt.in_track(
        help="height of the centre of gravity of what the axle carries above the rails in m; default the axle's"
    ),
]


@reported
def curving(
    *,
    curve_radius: CurveRadius = 300.0,
    cant: Cant = 0.0,
    yaw_stiffness: Stiffness = 0.0,
    lead: Lead = 0.0,
    height: Height = None,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    radius: opt.Radius = RADIUS.usual,
    gauge: opt.Gauge = GAUGE.usual,
    back_to_back: opt.BackToBack = FLANGE_BACK.usual,
    speed: opt.Speed = 20.0,
    reading: arguments.Reading,
    load: opt.Load = None,
    surface: arguments.SlidingFriction,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
    as_json: opt.Json = False,
    out: opt.Files = None,
) -> None:
    """Find the steady motion of a wheelset in a curve to the right: position, angle of attack, forces, wear numbers.

    --load is that of each wheel on level track. Example:  contact curving --curve-radius 300 --speed 15 --cant 0.1
    --yaw-stiffness 10e6 --lead 1.28
    """
    if radius > RADIUS.most:
        raise ContactError(
            f"--radius {radius:g} is outside the allowed range [{RADIUS.least:g}, {RADIUS.most:g}]: the wheel has it; the "
            "curve's is --curve-radius"
        )
    prepare(out)
    found = in_curve(
        reading.load(wheel, "wheel"),
        reading.load(rail, "rail"),
        curve_radius,
        load=load_or_standard(load),
        speed=speed,
        cant=cant,
        yaw_stiffness=yaw_stiffness,
        lead=lead,
        height=height,
        friction=surface.law(),
        nominal_radius=radius,
        gauge=gauge,
        flange_back=back_to_back,
        normal=normal,
        tangential=tangential,
    )
    wheels = [_wheel(name, getattr(found, name)) for name in ("outer", "inner")]
    names = ("y", "yaw", "roll", "z", "spin", "lateral", "steering", "guiding")
    axle = {name: getattr(found, name) for name in names}
    deliver(
        {"wheelset": axle, "wheels": wheels},
        show=lambda console: _show(found, wheels, console),
        as_json=as_json,
        out=out,
        rows=lambda: [{**axle, **row} for row in wheels],
    )
    require_trusted([found.outer.status, found.inner.status], "wheels")


def _wheel(name: str, s: Any) -> dict[str, Any]:
    """Return the numbers of a wheel."""
    main = max(s.contacts, key=lambda patch: patch.N, default=None)
    return {
        "wheel": name,
        "Q": s.Q,
        "Y": s.Y,
        "Y_over_Q": s.Y_over_Q,
        "Fx": float(s.force[0]),
        "T_gamma": s.damage.T_gamma,
        "max_pressure": s.max_pressure,
        "contact_angle": 0.0 if main is None else main.contact_angle,
        "patches": len(s.contacts),
        "status": s.status.name,
    }


def _show(found: Curving, wheels: list[dict[str, Any]], console: Console) -> None:
    title = (
        f"A wheelset in a curve: {1e3 * abs(found.y):.3g} mm to the {'outside' if found.y < 0.0 else 'inside'}, "
        f"yaw {1e3 * found.yaw:.3g} mrad, ΣY {1e-3 * found.guiding:.3g} kN"
    )
    table = Table(title=title, title_justify="left", title_style="bold", header_style="bold")
    for heading in ("quantity", "unit", *(row["wheel"] for row in wheels)):
        table.add_column(heading)
    for label, unit, key, factor in (
        ("Q, down", "kN", "Q", 1e-3),
        ("Y, outwards", "kN", "Y", 1e-3),
        ("Y/Q", "-", "Y_over_Q", 1.0),
        ("Fx on the wheel", "kN", "Fx", 1e-3),
        ("T-gamma", "N", "T_gamma", 1.0),
        ("contact angle, main patch", "mrad", "contact_angle", 1e3),
        ("peak pressure", "MPa", "max_pressure", 1e-6),
    ):
        table.add_row(label, unit, *(number(factor * row[key]) for row in wheels))
    table.add_row("patches", "", *(str(row["patches"]) for row in wheels))
    table.add_row("status", "", *(row["status"].lower().replace("_", " ") for row in wheels))
    console.print(table)
