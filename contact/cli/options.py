"""The options of the commands, as annotations for typer. Square brackets in help texts would be rich markup."""

from __future__ import annotations

from enum import StrEnum
from functools import partial
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


#: Options by the panel of the help page in which they stand.
in_profiles, in_position, in_loading, in_method, in_output, in_track = (
    partial(typer.Option, rich_help_panel=panel)
    for panel in ("Profiles", "Wheelset position", "Loading", "Method", "Output", "Track and wheelset")
)
WheelName = Annotated[str, in_profiles("--wheel", help="a name from `contact profiles`, or a file")]
RailName = Annotated[str, in_profiles("--rail", help="a name from `contact profiles`, or a file")]
Inclination = Annotated[
    str | None,
    in_profiles(help="inclination of a rail, like 1/40 or 0.05; default 1/40 for EN 13674-1, as it lies in a file"),
]
Rotation = Annotated[
    tuple[float, float],
    in_profiles(
        "--profile-rotation",
        help="angles in rad by which wheel and rail are turned about x, positive from the field side down",
        metavar="WHEEL RAIL",
    ),
]
Unit = Annotated[str | None, in_profiles(help=f"unit of profile files: {', '.join(profile.UNITS)}")]
Drawn = Annotated[str | None, in_profiles(help=f"side that profile files show: {', '.join(profile.SIDES)}")]
Zero = Annotated[
    str | None,
    in_profiles(
        help=f"zero of profile files: {', '.join(profile.ZEROS)}, or the distance of the tape circle from the back of the "
        "flange in m"
    ),
]
Scale = Annotated[float, in_profiles(help="scale of profiles of a model, like 0.2 for a roller rig of 1:5")]
Columns = Annotated[
    tuple[int, int] | None, in_profiles(help="columns of y and z in profile files, from 1", metavar="Y Z")
]
Rows = Annotated[
    tuple[int, int] | None,
    in_profiles(help="first and last line of profile files; 0 as the last is the end", metavar="FIRST LAST"),
]
Section = Annotated[
    str | None, in_profiles(help="which list of points of a profile file that has several: a number, or joined")
]
Repair = Annotated[
    bool, in_profiles("--profile-repair", help="sort rows, keep one scan, drop spikes and back steps of profile files")
]
Smoothing = Annotated[
    float | None, in_profiles(help="noise of profile files in m, to be removed by smoothing, like 2e-6")
]
Wavelength = Annotated[
    float | None, in_profiles(help="instead: waves of this length in m along the profile are halved, like 3e-3")
]
Radius = Annotated[float, in_profiles(help="nominal rolling radius of the wheel in m")]
Sides = Annotated[SideOption, in_position(help="which wheel")]
Y = Annotated[float, in_position("--y", help="lateral displacement, to the right, in m")]
Roll = Annotated[float, in_position(help="roll in rad, positive lowers the right wheel")]
Yaw = Annotated[float, in_position(help="yaw in rad, positive steers to the right")]
Speed = Annotated[float, in_position(help="rolling speed in m/s")]
Load = Annotated[
    float | None,
    in_loading(
        help="vertical load of a wheel, which the normal forces alone carry (normal force with --curvatures), in N; "
        f"default {STANDARD_LOAD:g}"
    ),
]
Vertical = Annotated[
    float | None,
    in_loading(help="instead of a load: vertical force in N that normal and friction forces carry together"),
]
Penetration = Annotated[float | None, in_loading(help="instead of a load: depth below first touch, or approach in m")]
Friction = Annotated[float, in_loading(help="coefficient of friction")]
Falling = Annotated[
    tuple[str, float, float] | None,
    in_loading(
        help=f"law by which friction falls from --friction at rest ({', '.join(LAWS[1:])}), coefficient in fast sliding, "
        "velocity in m/s at which it is halfway",
        metavar="LAW KINETIC HALF_SPEED",
    ),
]
SlipVelocity = Annotated[str, in_loading(help=f"velocity over which friction falls: {', '.join(VELOCITIES)}")]
GaugeFriction = Annotated[
    tuple[float, float, float] | None,
    in_loading(
        help="friction on the gauge side of the rail: factor, y of its border in the profile (negative), width of the "
        "transition, both in m",
        metavar="FACTOR Y WIDTH",
    ),
]
Hot = Annotated[
    tuple[float, float, float] | None,
    in_loading(
        help="factor on friction when hot, 0 to 1; temperature above which friction falls and range over which it falls, "
        "in K",
        metavar="FACTOR FROM RANGE",
    ),
]
Background = Annotated[float, in_loading("--temperature", help="temperature of wheel and rail in K, for --hot")]
PressureLimit = Annotated[float, in_loading(help="upper limit of the pressure in Pa, elastic-perfectly plastic")]
Bodies = Annotated[
    tuple[float, float, float, float] | None,
    in_loading(
        help="Young's modulus in Pa and Poisson's ratio of the rail, then of the wheel; default steel",
        metavar="E_RAIL NU_RAIL E_WHEEL NU_WHEEL",
    ),
]
Layer = Annotated[
    tuple[float, float, float] | None,
    in_method(
        help="third body for the half space: flexibility in m/Pa, yield stress in Pa (inf: elastic), hardening in Pa/m",
        metavar="FLEXIBILITY YIELD HARDENING",
    ),
]
Conformal = Annotated[bool, in_method("--conformal", help="let the contact angle vary over the patch")]
Trace = Annotated[bool, in_method("--trace", help="print the iterations of the normal and tangential problem")]
Creep = Annotated[
    tuple[float, float, float] | None,
    in_loading(
        "--creepage",
        help="longitudinal, lateral and spin creepage (in 1/m); default those of the rolling wheelset",
        metavar="VX VY PHI",
    ),
]
LongitudinalForce = Annotated[
    float | None, in_loading("--fx", help="longitudinal force on the wheel in N instead of its creepage")
]
LateralForce = Annotated[
    float | None, in_loading("--fy", help="lateral force on the wheel in N instead of its creepage")
]
Shift = Annotated[
    tuple[float, float, float] | None,
    in_loading(
        "--shift",
        help="shift of the wheel against the rail before rolling: along x and y in m, rotation in rad",
        metavar="X Y ROTATION",
    ),
]
Rolled = Annotated[float, in_loading("--distance", help="distance rolled in m")]
RollingStep = Annotated[float | None, in_method("--step", help="length of a step in m; default one element")]
Spacing = Annotated[float, in_method(help="size of the half space's elements in m")]
Springs = Annotated[
    tuple[float, float], in_track(help="lateral and vertical stiffness under the rail in N/m; inf is rigid")
]
Preload = Annotated[tuple[float, float], in_track(help="external force on the rail in N, to the right and down")]
RollerRadius = Annotated[float, typer.Argument(help="radius of the roller in m")]
Spin = Annotated[float | None, in_position(help="rotation of the wheel in rad/s, negative; default free")]
DriveForce = Annotated[
    float | None, in_loading("--force", help="longitudinal force on the wheelset in N instead of its rotation")
]
Torque = Annotated[float | None, in_loading(help="drive torque about the axle in N m instead of its rotation")]
WheelOffset = Annotated[
    tuple[float, float, float, float, float, float],
    in_position(help="displacement x y z in m and rotation roll pitch yaw in rad of the wheel against its wheelset"),
]
Offset = Annotated[float, in_position(help="distance of the wheelset ahead of the roller's axle in m")]
Curvatures = Annotated[
    tuple[float, float] | None,
    in_loading(help="half curvatures along x and y in 1/m, instead of wheel, rail and position", metavar="A B"),
]
Normal = Annotated[str, in_method(help="normal method, see `contact methods`")]
Tangential = Annotated[str, in_method(help="tangential method")]
Tangentials = Annotated[list[str], in_method("--tangential", help="tangential method; repeat to compare")]
Body = Annotated[str, in_method(help="body of the stresses: rail or wheel")]
Criterion = Annotated[
    str, in_method(help="stress of the picture: von_mises, tresca, largest_principal, shear_xz, shear_yz")
]
DangVanSlope = Annotated[float, in_method("--slope", help="weight of the hydrostatic stress in Dang Van's criterion")]
EnduranceLine = Annotated[
    tuple[float, float, float] | None,
    in_method(
        "--endurance",
        help="Dang Van stress in Pa, exponent and passages of a Woehler line; gives the passages to failure",
    ),
]
Json = Annotated[bool, in_output("--json", help="print JSON with inputs, units and version")]
Over = Annotated[Motion, in_loading(help="creepage to vary")]
Largest = Annotated[float | None, in_loading("--max", help="last value of that creepage; default 0.01, or 1 for spin")]
Points = Annotated[int, in_loading(min=2, max=10001, help="number of creepages")]
Ellipse = Annotated[
    tuple[float, float], in_loading("--curvatures", help="half curvatures along x and y in 1/m", metavar="A B")
]
LeftWheel = Annotated[str | None, in_profiles(help="left wheel, if different", show_default=False)]
LeftRail = Annotated[str | None, in_profiles(help="left rail, if different", show_default=False)]
LeftRadius = Annotated[float | None, in_profiles(help="radius of the left wheel in m, if different")]
Gauge = Annotated[float, in_track(help="track gauge in m, 14 mm below the top of the rails")]
BackToBack = Annotated[float, in_track(help="distance of the backs of both flanges in m")]
Rolls = Annotated[bool, in_track("--roll", help="let the wheelset roll, unlike EN 15302")]
Reach = Annotated[float, in_position("--max", help="largest lateral displacement in m", min=1e-4, max=0.03)]
Step = Annotated[float, in_position(help="step of the displacements in m", min=1e-6)]
Amplitudes = Annotated[
    list[float] | None,
    in_position("--amplitude", help="amplitude in m; may be repeated. Default: 1 to 7 mm", show_default=False),
]
CurveRadius = Annotated[
    list[float] | None, in_track(help="radius of a curve in m, for the radial steering index; may be repeated")
]
Files = Annotated[list[Path] | None, in_output("--out", help="write .png, .pdf, .svg, .csv or .json; may be repeated")]
Pages = Annotated[
    list[Path] | None, in_output("--out", help="write .html, .md, .json, .csv, .png, .pdf or .svg; may be repeated")
]
