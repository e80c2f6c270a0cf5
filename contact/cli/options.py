"""The options of the commands, as annotations for typer. Square brackets in help texts would be rich markup."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from contact.cli.problem import STANDARD_LOAD
from contact.friction import LAWS, VELOCITIES
from contact.geometry import profile


class SideOption(StrEnum):
    """The wheel to solve."""

    left = "left"
    right = "right"
    both = "both"


class Motion(StrEnum):
    """The creepage on the axis of a creep curve."""

    longitudinal = "longitudinal"
    lateral = "lateral"
    spin = "spin"


PROFILES, POSITION, LOADING, METHOD, OUTPUT = "Profiles", "Wheelset position", "Loading", "Method", "Output"
TRACK = "Track and wheelset"
WheelName = Annotated[
    str, typer.Option("--wheel", help="a name from `contact profiles`, or a file", rich_help_panel=PROFILES)
]
RailName = Annotated[
    str, typer.Option("--rail", help="a name from `contact profiles`, or a file", rich_help_panel=PROFILES)
]
Inclination = Annotated[
    str | None,
    typer.Option(
        help="inclination of a rail, like 1/40 or 0.05; default 1/40 for EN 13674-1, as it lies in a file",
        rich_help_panel=PROFILES,
    ),
]
Rotation = Annotated[
    tuple[float, float],
    typer.Option(
        "--profile-rotation",
        help="angles in rad by which wheel and rail are turned about x, positive from the field side down",
        metavar="WHEEL RAIL",
        rich_help_panel=PROFILES,
    ),
]
Unit = Annotated[
    str | None, typer.Option(help=f"unit of profile files: {', '.join(profile.UNITS)}", rich_help_panel=PROFILES)
]
Drawn = Annotated[
    str | None, typer.Option(help=f"side that profile files show: {', '.join(profile.SIDES)}", rich_help_panel=PROFILES)
]
Zero = Annotated[
    str | None,
    typer.Option(help=f"zero of profile files: {', '.join(profile.ZEROS)}", rich_help_panel=PROFILES),
]
Repair = Annotated[
    bool,
    typer.Option(
        "--profile-repair",
        help="sort rows, keep one scan, drop spikes and back steps of profile files",
        rich_help_panel=PROFILES,
    ),
]
Smoothing = Annotated[
    float | None,
    typer.Option(help="noise of profile files in m, to be removed by smoothing, like 2e-6", rich_help_panel=PROFILES),
]
Wavelength = Annotated[
    float | None,
    typer.Option(
        help="instead: waves of this length in m along the profile are halved, like 3e-3", rich_help_panel=PROFILES
    ),
]
Radius = Annotated[float, typer.Option(help="nominal rolling radius in m", rich_help_panel=PROFILES)]
Sides = Annotated[SideOption, typer.Option(help="which wheel", rich_help_panel=POSITION)]
Y = Annotated[float, typer.Option("--y", help="lateral displacement, to the right, in m", rich_help_panel=POSITION)]
Roll = Annotated[float, typer.Option(help="roll in rad, positive lowers the right wheel", rich_help_panel=POSITION)]
Yaw = Annotated[float, typer.Option(help="yaw in rad, positive steers to the right", rich_help_panel=POSITION)]
Speed = Annotated[float, typer.Option(help="rolling speed in m/s", rich_help_panel=POSITION)]
Load = Annotated[
    float | None,
    typer.Option(
        help=f"vertical load of a wheel (normal force with --curvatures) in N; default {STANDARD_LOAD:g}",
        rich_help_panel=LOADING,
    ),
]
Penetration = Annotated[
    float | None,
    typer.Option(help="instead of a load: depth below first touch, or approach in m", rich_help_panel=LOADING),
]
Friction = Annotated[float, typer.Option(help="coefficient of friction", rich_help_panel=LOADING)]
Falling = Annotated[
    tuple[str, float, float] | None,
    typer.Option(
        help=f"law by which friction falls from --friction at rest ({', '.join(LAWS[1:])}), coefficient in fast sliding, "
        "velocity in m/s at which it is halfway",
        metavar="LAW KINETIC HALF_SPEED",
        rich_help_panel=LOADING,
    ),
]
SlipVelocity = Annotated[
    str,
    typer.Option(help=f"velocity over which friction falls: {', '.join(VELOCITIES)}", rich_help_panel=LOADING),
]
GaugeFriction = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        help="friction on the gauge side of the rail: factor, y of its border in the profile (negative), width of the "
        "transition, both in m",
        metavar="FACTOR Y WIDTH",
        rich_help_panel=LOADING,
    ),
]
Hot = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        help="factor on friction when hot, 0 to 1; temperature above which friction falls and range over which it falls, "
        "in K",
        metavar="FACTOR FROM RANGE",
        rich_help_panel=LOADING,
    ),
]
Background = Annotated[
    float, typer.Option("--temperature", help="temperature of wheel and rail in K, for --hot", rich_help_panel=LOADING)
]
PressureLimit = Annotated[
    float,
    typer.Option(help="upper limit of the pressure in Pa, elastic-perfectly plastic", rich_help_panel=LOADING),
]
Bodies = Annotated[
    tuple[float, float, float, float] | None,
    typer.Option(
        help="Young's modulus in Pa and Poisson's ratio of the rail, then of the wheel; default steel",
        metavar="E_RAIL NU_RAIL E_WHEEL NU_WHEEL",
        rich_help_panel=LOADING,
    ),
]
Layer = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        help="third body for the half space: flexibility in m/Pa, yield stress in Pa (inf: elastic), hardening in Pa/m",
        metavar="FLEXIBILITY YIELD HARDENING",
        rich_help_panel=METHOD,
    ),
]
Conformal = Annotated[
    bool,
    typer.Option("--conformal", help="let the contact angle vary over the patch", rich_help_panel=METHOD),
]
Trace = Annotated[
    bool,
    typer.Option("--trace", help="print the iterations of the normal and tangential problem", rich_help_panel=METHOD),
]
Creep = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        "--creepage",
        help="longitudinal, lateral and spin creepage (in 1/m); default those of the rolling wheelset",
        metavar="VX VY PHI",
        rich_help_panel=LOADING,
    ),
]
LongitudinalForce = Annotated[
    float | None,
    typer.Option("--fx", help="longitudinal force on the wheel in N instead of its creepage", rich_help_panel=LOADING),
]
LateralForce = Annotated[
    float | None,
    typer.Option("--fy", help="lateral force on the wheel in N instead of its creepage", rich_help_panel=LOADING),
]
Shift = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        "--shift",
        help="shift of the wheel against the rail before rolling: along x and y in m, rotation in rad",
        metavar="X Y ROTATION",
        rich_help_panel=LOADING,
    ),
]
Rolled = Annotated[float, typer.Option("--distance", help="distance rolled in m", rich_help_panel=LOADING)]
RollingStep = Annotated[
    float | None, typer.Option("--step", help="length of a step in m; default one element", rich_help_panel=METHOD)
]
Spacing = Annotated[float, typer.Option(help="size of the half space's elements in m", rich_help_panel=METHOD)]
Springs = Annotated[
    tuple[float, float],
    typer.Option(help="lateral and vertical stiffness under the rail in N/m; inf is rigid", rich_help_panel=TRACK),
]
Preload = Annotated[
    tuple[float, float],
    typer.Option(help="external force on the rail in N, to the right and down", rich_help_panel=TRACK),
]
RollerRadius = Annotated[float, typer.Argument(help="radius of the roller in m")]
Spin = Annotated[
    float | None, typer.Option(help="rotation of the wheel in rad/s, negative; default free", rich_help_panel=POSITION)
]
DriveForce = Annotated[
    float | None,
    typer.Option(
        "--force", help="longitudinal force on the wheelset in N instead of its rotation", rich_help_panel=LOADING
    ),
]
Torque = Annotated[
    float | None,
    typer.Option(help="drive torque about the axle in N m instead of its rotation", rich_help_panel=LOADING),
]
WheelOffset = Annotated[
    tuple[float, float, float, float, float, float],
    typer.Option(
        help="displacement x y z in m and rotation roll pitch yaw in rad of the wheel against its wheelset",
        rich_help_panel=POSITION,
    ),
]
Offset = Annotated[
    float, typer.Option(help="distance of the wheelset ahead of the roller's axle in m", rich_help_panel=POSITION)
]
Curvatures = Annotated[
    tuple[float, float] | None,
    typer.Option(
        help="half curvatures along x and y in 1/m, instead of wheel, rail and position",
        metavar="A B",
        rich_help_panel=LOADING,
    ),
]
Normal = Annotated[str, typer.Option(help="normal method, see `contact methods`", rich_help_panel=METHOD)]
Tangential = Annotated[str, typer.Option(help="tangential method", rich_help_panel=METHOD)]
Tangentials = Annotated[
    list[str], typer.Option("--tangential", help="tangential method; repeat to compare", rich_help_panel=METHOD)
]
Body = Annotated[str, typer.Option(help="body of the stresses: rail or wheel", rich_help_panel=METHOD)]
Criterion = Annotated[
    str,
    typer.Option(
        help="stress of the picture: von_mises, tresca, largest_principal, shear_xz, shear_yz", rich_help_panel=METHOD
    ),
]
DangVanSlope = Annotated[
    float,
    typer.Option("--slope", help="weight of the hydrostatic stress in Dang Van's criterion", rich_help_panel=METHOD),
]
EnduranceLine = Annotated[
    tuple[float, float, float] | None,
    typer.Option(
        "--endurance",
        help="Dang Van stress in Pa, exponent and passages of a Woehler line; gives the passages to failure",
        rich_help_panel=METHOD,
    ),
]
Json = Annotated[bool, typer.Option("--json", help="print JSON with inputs, units and version", rich_help_panel=OUTPUT)]
Over = Annotated[Motion, typer.Option(help="creepage to vary", rich_help_panel=LOADING)]
Largest = Annotated[
    float | None,
    typer.Option("--max", help="last value of that creepage; default 0.01, or 1 for spin", rich_help_panel=LOADING),
]
Points = Annotated[int, typer.Option(min=2, max=10001, help="number of creepages", rich_help_panel=LOADING)]
Ellipse = Annotated[
    tuple[float, float],
    typer.Option("--curvatures", help="half curvatures along x and y in 1/m", metavar="A B", rich_help_panel=LOADING),
]
LeftWheel = Annotated[
    str | None, typer.Option(help="left wheel, if different", rich_help_panel=PROFILES, show_default=False)
]
LeftRail = Annotated[
    str | None, typer.Option(help="left rail, if different", rich_help_panel=PROFILES, show_default=False)
]
LeftRadius = Annotated[
    float | None, typer.Option(help="radius of the left wheel in m, if different", rich_help_panel=PROFILES)
]
Gauge = Annotated[float, typer.Option(help="track gauge in m, 14 mm below the top of the rails", rich_help_panel=TRACK)]
BackToBack = Annotated[float, typer.Option(help="distance of the backs of both flanges in m", rich_help_panel=TRACK)]
Rolls = Annotated[bool, typer.Option("--roll", help="let the wheelset roll, unlike EN 15302", rich_help_panel=TRACK)]
Reach = Annotated[
    float, typer.Option("--max", help="largest lateral displacement in m", rich_help_panel=POSITION, min=1e-4, max=0.03)
]
Step = Annotated[float, typer.Option(help="step of the displacements in m", rich_help_panel=POSITION, min=1e-6)]
Amplitudes = Annotated[
    list[float] | None,
    typer.Option(
        "--amplitude",
        help="amplitude in m; may be repeated. Default: 1 to 7 mm",
        rich_help_panel=POSITION,
        show_default=False,
    ),
]
CurveRadius = Annotated[
    list[float] | None,
    typer.Option(help="radius of a curve in m, for the radial steering index; may be repeated", rich_help_panel=TRACK),
]
Files = Annotated[
    list[Path] | None,
    typer.Option("--out", help="write .png, .pdf, .svg, .csv or .json; may be repeated", rich_help_panel=OUTPUT),
]
Pages = Annotated[
    list[Path] | None,
    typer.Option(
        "--out", help="write .html, .md, .json, .csv, .png, .pdf or .svg; may be repeated", rich_help_panel=OUTPUT
    ),
]
