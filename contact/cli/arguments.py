"""What the options of the commands give to the library: profiles, friction, positions, loads, materials, forces."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, cast

import typer

from contact.cli import options as opt
from contact.cli import output
from contact.cli.document import in_effect
from contact.cli.problem import Pose, Position, Touch, solve_hertzian, solve_position
from contact.errors import ContactError, warn
from contact.friction import Friction, as_friction
from contact.geometry import profile
from contact.geometry.wheelset import Pair
from contact.halfspace.third_body import ThirdBody
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import FLANGE_BACK, GAUGE, RADIUS, ROOM_TEMPERATURE
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL


@dataclass
class ProfileFile:
    """How a profile's file is read: arguments of `contact.geometry.profile.load`, with the prefix `profile`."""

    profile_unit: opt.Unit = None
    profile_side: opt.Drawn = None
    profile_zero: opt.Zero = None
    profile_scale: opt.Scale = 1.0
    profile_columns: opt.Columns = None
    profile_rows: opt.Rows = None
    profile_section: opt.Section = None
    profile_repair: opt.Repair = False
    profile_smoothing: opt.Smoothing = None
    profile_wavelength: opt.Wavelength = None

    @property
    def given(self) -> dict[str, Any]:
        """The arguments by the library's names."""
        return {key.removeprefix("profile_"): value for key, value in vars(self).items() if key.startswith("profile_")}


@dataclass
class Reading(ProfileFile):
    """How the profiles of a wheel and a rail are read, and how they lie."""

    inclination: opt.Inclination = None
    profile_rotation: opt.Rotation = (0.0, 0.0)

    @property
    def names(self) -> tuple[str | None, ...]:
        """Names of the profiles that this is for, as far as it has them."""
        return ()

    def load(self, name: str, kind: profile.Kind) -> profile.Profile:
        """Return the profile with this name or in this file."""
        profile.require_file((name, *self.names), self.given)
        return self._read(name, kind)

    def chosen(self, wheel: str | None, rail: str | None) -> dict[profile.Kind, profile.Profile]:
        """Return the profiles that have a name."""
        names: dict[profile.Kind, str | None] = {"wheel": wheel, "rail": rail}
        profile.require_file(names.values(), self.given)
        return {kind: self._read(name, kind) for kind, name in names.items() if name is not None}

    def _read(self, name: str, kind: profile.Kind) -> profile.Profile:
        rotation = self.profile_rotation[0 if kind == "wheel" else 1]
        found = profile.load(name, kind, inclination=self.inclination, **self.given | {"rotation": rotation})
        if kind == "rail":
            in_effect(inclination=profile.default_inclination(name))
        return found


@dataclass
class SlidingFriction:
    """Friction, and how it falls with velocity and temperature."""

    friction: opt.Friction = 0.3
    falling: opt.Falling = None
    slip_velocity: opt.SlipVelocity = "global"
    hot: opt.Hot = None
    temperature: opt.Background = ROOM_TEMPERATURE

    def law(self, gauge: tuple[float, float, float] | None = None) -> Friction:
        """Return the friction options as an argument of `contact.solve`."""
        law, kinetic, half_speed = self.falling or ("coulomb", self.friction, 1.0)
        factor, border, width = gauge or (1.0, 0.0, 1.0)
        hot_factor, reference, over = self.hot or (1.0, self.temperature, 1.0)
        return replace(
            as_friction(self.friction),
            kinetic=kinetic,
            half_speed=half_speed,
            law=law,
            velocity=self.slip_velocity,
            gauge_factor=factor,
            border=border,
            border_width=width,
            hot_factor=hot_factor,
            reference_temperature=reference,
            temperature_range=over,
            background_temperature=self.temperature,
        )


@dataclass
class _OnRails:
    """Names and lengths of wheels on rails."""

    wheel: opt.WheelName = "s1002"
    rail: opt.RailName = "60e1"
    radius: opt.Radius = RADIUS.usual
    gauge: opt.Gauge = GAUGE.usual
    back_to_back: opt.BackToBack = FLANGE_BACK.usual

    def __post_init__(self) -> None:
        RADIUS.require("nominal_radius", self.radius)  # two curvatures use it for damage only

    @property
    def lengths(self) -> dict[str, Any]:
        """The lengths, by the names of `contact.geometry.wheelset.Pair`."""
        return {"nominal_radius": self.radius, "gauge": self.gauge, "flange_back": self.back_to_back}


@dataclass
class Wheels(Reading, _OnRails):
    """Wheels on rails, and how their profiles are read."""

    @property
    def names(self) -> tuple[str | None, ...]:
        """Names of the profiles."""
        return self.wheel, self.rail

    @property
    def profiles(self) -> tuple[profile.Profile, profile.Profile]:
        """The profiles of wheel and rail."""
        return self.load(self.wheel, "wheel"), self.load(self.rail, "rail")

    def pairs(self, *sides: str) -> tuple[Pair, ...]:
        """Return the wheel of each side on its rail."""
        both = self.profiles
        return tuple(Pair(*both, side=cast(Any, side), **self.lengths) for side in sides)


@dataclass
class PlaceOptions(Wheels):
    """A wheelset on its rails."""

    y: opt.Y = 0.0
    roll: opt.Roll = 0.0
    yaw: opt.Yaw = 0.0
    speed: opt.Speed = 20.0

    def position(self, side: opt.SideOption) -> Position:
        """Return the wheelset with its profiles."""
        if self.speed == 0.0:
            warn("speed = 0: the wheelset stands, so it has no creepage, and creep forces and damage are 0")
        sides = ("left", "right") if side is opt.SideOption.both else (side.value,)
        return Position(self.pairs(*sides), Pose(y=self.y, roll=self.roll, yaw=self.yaw), self.speed)


#: Options that do not apply to two given curvatures. Speed and radius do apply; its damage depends on them.
OF_A_POSITION = {entry.name for entry in fields(PlaceOptions)} - {"radius", "speed"} | {"side", "conformal"}


@dataclass
class Amount:
    """Load and creepage."""

    load: opt.Load = None
    penetration: opt.Penetration = None
    creepage: opt.Creep = None

    @property
    def given(self) -> Creepage | None:
        """The creepage of the options, instead of that of the rolling wheelset."""
        return None if self.creepage is None else Creepage(*self.creepage)

    def touches(self, case: Position | tuple[float, float], speed: float, options: dict[str, Any]) -> list[Touch]:
        """Return every patch of a position, or the one of two curvatures, solved."""
        if isinstance(case, Position):
            return solve_position(case, self.load, self.penetration, self.given, options)
        return [solve_hertzian(case, self.load, self.penetration, self.given, options | {"speed": speed})]


@dataclass
class Methods:
    """The methods that solve a contact."""

    normal: opt.Normal = DEFAULT_NORMAL
    tangential: opt.Tangential = DEFAULT_TANGENTIAL


@dataclass
class Output:
    """Where the results go. What cannot be written is refused before the computation."""

    as_json: opt.Json = False
    out: opt.Files = None

    def __post_init__(self) -> None:
        output.prepare(self.out)

    def deliver(self, content: Mapping[str, Any], **ways: Any) -> None:
        """Print the results and write them, as `contact.cli.output.deliver`."""
        output.deliver(content, as_json=self.as_json, out=self.out, **ways)

    def without_contact(self) -> None:
        """Leave out pictures and tables, of which there are none, and say so."""
        if self.out:
            typer.echo("no contact: no picture and no table is written", err=True)
            self.out = [path for path in self.out if path.suffix.lower() == ".json"]


def require_use(context: typer.Context) -> None:
    """Refuse options of the running command that do not apply together with --curvatures.

    Raises
    ------
    ContactError
        If a wheel, a rail or their position is given together with --curvatures.
    """
    if context.params["curvatures"] is not None and (idle := used(context)):
        raise ContactError(f"{', '.join(idle)}: --curvatures replaces wheel, rail and position")


def used(context: typer.Context, names: Collection[str] = OF_A_POSITION) -> list[str]:
    """Return those of the options, by default of wheel, rail and position, that were typed."""
    options = [option for option in context.command.params if option.name in names]
    sources = {option.opts[0]: context.get_parameter_source(str(option.name)) for option in options}
    return [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def material(pressure_limit: float, bodies: tuple[float, float, float, float] | None = None) -> Material:
    """Return the material of rail and wheel, or STEEL, with a pressure limit [Pa]."""
    return replace(STEEL if bodies is None else Material.from_pair(*bodies), pressure_limit=pressure_limit)


def force(longitudinal: float | None, lateral: float | None) -> tuple[float | None, float | None] | None:
    """Return the options --fx and --fy as an argument of `contact.solve`."""
    return None if longitudinal is None and lateral is None else (longitudinal, lateral)


def third_body(layer: tuple[float, float, float] | None) -> ThirdBody | None:
    """Return the option --layer as an argument of `contact.solve`."""
    return None if layer is None else ThirdBody(*layer)
