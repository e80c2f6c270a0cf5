"""The command `curving`: a wheelset that runs steadily through a curve."""

from __future__ import annotations

from typing import Annotated, Any

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import reported, require_trusted
from contact.cli.problem import load_or_standard
from contact.cli.report import show_columns
from contact.pair.curving import in_curve

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


_SHOWN = (
    ("Q, down", "kN", "Q", 1e-3),
    ("Y, outwards", "kN", "Y", 1e-3),
    ("Y/Q", "-", "Y_over_Q", 1.0),
    ("Fx on the wheel", "kN", "Fx", 1e-3),
    ("T-gamma", "N", "T_gamma", 1.0),
    ("contact angle, main patch", "mrad", "contact_angle", 1e3),
    ("peak pressure", "MPa", "max_pressure", 1e-6),
    ("patches", "", "patches", 1),
    ("status", "", "status", 1.0),
)


@reported
def curving(
    *,
    curve_radius: CurveRadius = 300.0,
    cant: Cant = 0.0,
    yaw_stiffness: Stiffness = 0.0,
    lead: Lead = 0.0,
    height: Height = None,
    wheels: arguments.Wheels,
    speed: opt.Speed = 20.0,
    load: opt.Load = None,
    surface: arguments.SlidingFriction,
    methods: arguments.Methods,
    output: arguments.Output,
) -> None:
    """Find the steady motion of a wheelset in a curve to the right: position, angle of attack, forces, wear numbers.

    --load is that of each wheel on level track. Example:  contact curving --curve-radius 300 --speed 15 --cant 0.1
    --yaw-stiffness 10e6 --lead 1.28
    """
    wheel, rail = wheels.profiles
    found = in_curve(
        wheel,
        rail,
        curve_radius,
        load=load_or_standard(load),
        speed=speed,
        cant=cant,
        yaw_stiffness=yaw_stiffness,
        lead=lead,
        height=height,
        friction=surface.law(),
        **wheels.lengths,
        **vars(methods),
    )
    rows = [_wheel(name, getattr(found, name)) for name in ("outer", "inner")]
    names = ("y", "yaw", "roll", "z", "spin", "lateral", "steering", "guiding")
    axle = {name: getattr(found, name) for name in names}
    title = (
        f"A wheelset in a curve: {1e3 * abs(found.y):.3g} mm to the {'outside' if found.y < 0.0 else 'inside'}, "
        f"yaw {1e3 * found.yaw:.3g} mrad, ΣY {1e-3 * found.guiding:.3g} kN"
    )
    output.deliver(
        {"wheelset": axle, "wheels": rows},
        show=lambda console: show_columns(title, "wheel", rows, _SHOWN, console),
        rows=lambda: [{**axle, **row} for row in rows],
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
