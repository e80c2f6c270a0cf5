"""A scenario: all input of a run, read from one TOML file."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from os import PathLike
from pathlib import Path
from typing import Any

from contact.damage import DamageParameters
from contact.damage.assessment import WearLaw
from contact.errors import ContactError, require_number
from contact.friction import Friction, as_friction
from contact.geometry import profile
from contact.geometry.profile import Kind, Profile
from contact.geometry.surfaces import WheelSurface
from contact.inputs.material import STEEL, Material
from contact.inputs.options import N_ELEMENTS, N_STRIPS
from contact.reading.text import toml
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.solver import require_resolution
from ..toml import build
from ..vehicle.declared import SIDES, VehicleDeclaration
from ..vehicle.declared import find as find_vehicle
from ..vehicle.declared import read as read_vehicle
from ..vehicle.kernels.between import LONGEST_PACE, PACE
from ..vehicle.sections import RailSection
from ..vehicle.track import Speed, Track, require_forwards
from . import reach
from .origin import hashed
from .slices import Rails
from .torque import Torque
from .uneven import Wheels

#: Law by which profiles wear if a scenario gives neither a law nor constants of Archard (docs/understand/wear.md, Wear laws).
WEAR_LAW: WearLaw = "usfd"


@dataclass(frozen=True, kw_only=True)
class Profiles:
    """Profiles of the right side: standard names, or files with paths relative to the scenario's file.

    Parameters
    ----------
    wheel, rail : name of a standard profile, or a file
    left_rail : the left rail, mirrored to the right side, where it differs from the right one
    inclination : of a rail, a number or "1/40"; of EN 13674-1 1/40 by default, in a file as it lies there
    wheel_rotation, rail_rotation : angles about x by which they are turned [rad], positive from the field side down
    unit, side, zero, scale, columns, rows, section, repair, smoothing, wavelength : for files, as for
        `contact.geometry.profile.read`
    """

    wheel: str = "S1002"
    rail: str = "60E1"
    left_rail: str | None = None
    inclination: float | str | None = None
    wheel_rotation: float = 0.0
    rail_rotation: float = 0.0
    unit: str | None = None
    side: str | None = None
    zero: str | float | None = None
    scale: float = 1.0
    columns: tuple[int, ...] | None = None
    rows: tuple[int, ...] | None = None
    section: int | str | None = None
    repair: bool = False
    smoothing: float | None = None
    wavelength: float | None = None

    def load(self, folder: Path) -> tuple[Profile, Profile]:
        """Return wheel and right rail. Paths of files are relative to `folder`."""
        return self._load(folder, self.wheel, "wheel"), self._load(folder, self.rail, "rail")

    def load_rails(self, folder: Path) -> tuple[Profile, ...]:
        """Return the right and the left rail, or nothing if they are the same."""
        if self.left_rail is None:
            return ()
        return self._load(folder, self.rail, "rail"), self._load(folder, self.left_rail, "rail")

    def _load(self, folder: Path, name: str, kind: Kind) -> Profile:
        names = ("wheel", "rail", "left_rail", "wheel_rotation", "rail_rotation")
        given: dict[str, Any] = {key: value for key, value in vars(self).items() if key not in names}
        every = [self._place(folder, each) for each in (self.wheel, self.rail, self.left_rail) if each]
        profile.require_file(every, given)
        given["rotation"] = self.wheel_rotation if kind == "wheel" else self.rail_rotation
        return profile.load(self._place(folder, name), kind, **given)

    @staticmethod
    def _place(folder: Path, name: str) -> str:
        is_file = (folder / name).is_file() or ("." in name and not profile.is_standard(name))
        return str(folder / name) if is_file else name


@dataclass(frozen=True, kw_only=True)
class Methods:
    """Contact methods.

    Parameters
    ----------
    normal, tangential : methods
    strips, elements : their resolution
    pressure_limit : of the material [Pa] (`contact.Material`)
    pace : steps of the vehicle from one solution of a contact to the next, at most (vehicle.md, 8); 1: every step is one
    """

    normal: str = DEFAULT_NORMAL
    tangential: str = DEFAULT_TANGENTIAL
    strips: int = N_STRIPS.usual
    elements: int = N_ELEMENTS.usual
    pressure_limit: float | None = None
    pace: int = PACE

    def __post_init__(self) -> None:
        _ = self.material
        lookup("normal", self.normal, batched=True)
        if not lookup("tangential", self.tangential, batched=True).fields:
            raise ContactError(f"tangential = {self.tangential!r} gives forces only; damage needs traction and slip")
        require_resolution(self.strips, self.elements)
        require_number("pace", self.pace, 1, LONGEST_PACE)

    @property
    def material(self) -> Material:
        """Steel with the pressure limit."""
        return STEEL if self.pressure_limit is None else replace(STEEL, pressure_limit=self.pressure_limit)


@dataclass(frozen=True, kw_only=True)
class Recording:
    """Resolution of a run and its results.

    Parameters
    ----------
    settling : distance at the start without damage, over which the irregularities grow from zero [m]
    spacing : distance between two samples of damage and time series [m], 0.01 to 10
    step : step of the vehicle [s], 1e-5 to 5e-3; default 0.7 of the stable step, at most 0.5 ms, with uneven wheels,
        slices or measured tracks with stations closer than 50 mm 0.1 ms (vehicle.md, 5)
    bins : width of the bins of damage along the profiles [m], 1e-4 to 5e-3
    """

    settling: float = 30.0
    spacing: float = 0.25
    step: float | None = None
    bins: float = 5e-4

    def __post_init__(self) -> None:
        require_number("settling", self.settling, 0.0)
        require_number("spacing", self.spacing, 0.01, 10.0)
        require_number("bins", self.bins, 1e-4, 5e-3)
        if self.step is not None:
            require_number("step", self.step, 1e-5, 5e-3)


@dataclass(frozen=True, kw_only=True)
class Declaration:
    """A scenario as declared in its file, in SI units.

    Parameters
    ----------
    name : name of the run, for titles
    length : distance to run [m], longer than recording.settling
    speed : a number [m/s], 0.1 to 150, or a `Speed`
    seed : seed of the random irregularities, not negative
    vehicle : file of a vehicle relative to the scenario's file, or one of the included ones: `manchester`, or `wheelset`, the
        default (vehicle.md)
    friction : coefficient of friction, 0.3 by default, or a table
    torque : torques on axles, traction and braking, a table each; several on one axle add
    track, profiles, wheels, rails, methods, recording : separate tables
    damage : a table; its wear_law is "usfd" by default, "archard" where constants of Archard's law are given
    """

    name: str
    length: float
    speed: float | Speed
    seed: int = 0
    vehicle: str = "wheelset"
    track: Track = field(default_factory=Track)
    friction: float | Friction = 0.3
    torque: tuple[Torque, ...] = ()
    profiles: Profiles = field(default_factory=Profiles)
    wheels: Wheels = field(default_factory=Wheels)
    rails: Rails = field(default_factory=Rails)
    methods: Methods = field(default_factory=Methods)
    damage: DamageParameters = field(default_factory=lambda: DamageParameters(wear_law=WEAR_LAW))
    recording: Recording = field(default_factory=Recording)

    def __post_init__(self) -> None:
        least = self.recording.settling + self.recording.spacing
        if self.length < least:
            raise ContactError(
                f"length = {self.length:g}: nothing would be counted. The first {self.recording.settling:g} m "
                f"(recording.settling) let the vehicle settle, and a sample takes {self.recording.spacing:g} m "
                f"(recording.spacing), so at least {least:g} m are needed, or a shorter settling"
            )
        require_number("length", self.length, maximum=1e6)
        require_number("seed", self.seed, 0)
        if isinstance(self.speed, float):
            require_forwards("speed", self.speed)
        as_friction(self.friction)  # checks a number


@dataclass(frozen=True)
class Scenario:
    """A declaration with its profiles and its vehicle, the input of a run.

    Attributes
    ----------
    declared : Declaration
    wheel, rail : Profile
        Unworn profiles of the right side. The left side is the mirror image.
    vehicle : VehicleDeclaration
    draw : tuple of int
        Number of the realisation of the irregularities, in addition to the seed. In a wear run it is the mileage step.
    every_wheel : tuple of Profile
        Profile of every wheel, in the order of `wheel_names`; empty if all are as `wheel`.
    both_rails : tuple of Profile
        Profiles of the right and the left rail; empty if both are as `rail`. Left profiles are mirrored to the right side.
    measured_wheels : tuple of WheelSurface
        Those of the declaration's `wheels.slices`.
    sections : tuple of RailSection
        Parts of the rails that are given by slices.
    files : tuple of (str, str)
        Name and SHA-256 of the files that were read.
    """

    declared: Declaration
    wheel: Profile
    rail: Profile
    vehicle: VehicleDeclaration
    draw: tuple[int, ...] = ()
    every_wheel: tuple[Profile, ...] = ()
    both_rails: tuple[Profile, ...] = ()
    measured_wheels: tuple[WheelSurface, ...] = ()
    sections: tuple[RailSection, ...] = ()
    files: tuple[tuple[str, str], ...] = field(default=(), compare=False)

    @property
    def wheel_names(self) -> tuple[tuple[str, str], ...]:
        """Wheelset and side of every wheel: axle by axle, the right one before the left one."""
        return tuple((axle.name, side) for axle in self.vehicle.wheelsets for side in SIDES)

    @property
    def wheels(self) -> tuple[Profile, ...]:
        """Profile of every wheel, in the order of `wheel_names`."""
        return self.every_wheel or (self.wheel,) * len(self.wheel_names)

    @property
    def uneven(self) -> dict[int, WheelSurface]:
        """Number of a wheel in `wheels` → its surface, for wheels with flats and polygons and measured ones."""
        return self.declared.wheels.surfaces(self.wheel_names, self.wheels, self.radius, self.measured_wheels)

    def require_profiles(self, where: str, what: str) -> None:
        """Check that wheels and rails are profiles, for what cannot have surfaces.

        Raises
        ------
        ContactError
            If they are not. The message begins with `where`, the name of the file, and says that `what` takes profiles only.
        """
        for table, surfaces in (("wheels", self.uneven), ("rails", self.sections)):
            if surfaces:
                raise ContactError(f"{where}.{table}: {what} no flats, polygons and slices; leave out this table")

    @property
    def rails(self) -> tuple[Profile, ...]:
        """Profiles of the right and the left rail."""
        return self.both_rails or (self.rail,) * len(SIDES)

    @property
    def name(self) -> str:
        return self.declared.name

    def speed(self, s: float) -> float:
        """Return the speed [m/s] at the distance `s` [m]."""
        given = self.declared.speed
        return given(s) if isinstance(given, Speed) else given

    @property
    def radius(self) -> float:
        """Nominal radius of the wheels [m]."""
        return self.vehicle.radius

    @property
    def fastest(self) -> float:
        """Greatest speed of the scenario [m/s]."""
        given = self.declared.speed
        return max(given.values) if isinstance(given, Speed) else given

    @property
    def slowest(self) -> float:
        """Least speed of the scenario [m/s]."""
        given = self.declared.speed
        return min(given.values) if isinstance(given, Speed) else given

    @property
    def friction(self) -> Friction:
        return as_friction(self.declared.friction)

    def worn(self, wheels: tuple[Profile, ...], rails: tuple[Profile, ...], draw: int) -> Scenario:
        """Return this scenario with other wheels and rails, and another realisation of the irregularities."""
        return replace(self, every_wheel=wheels, both_rails=rails, draw=(draw,))

    def reprofiled(self, cut: float) -> Scenario:
        """Return this scenario with wheels whose nominal radius is smaller by `cut` [m]."""
        return replace(self, vehicle=self.vehicle.reprofiled(cut))

    def limited(self, pressure: float) -> Scenario:
        """Return this scenario with a pressure limit [Pa], if it has none of its own."""
        if self.declared.methods.pressure_limit is not None or math.isinf(pressure):
            return self
        methods = replace(self.declared.methods, pressure_limit=pressure)
        return replace(self, declared=replace(self.declared, methods=methods))

    @property
    def fingerprint(self) -> str:
        """Hash of the input. Runs with the same fingerprint have the same result."""
        digest = hashlib.sha256(
            f"{version('wheelrail-contact')} {self.declared!r} {self.vehicle!r} {self.draw!r}".encode()
        )
        if self.declared.track.series is not None:
            digest.update(Path(self.declared.track.series.file).read_bytes())
        for shape in (self.wheel, self.rail, *self.every_wheel, *self.both_rails):
            for row in (shape.y, shape.z, shape.angle):
                digest.update(row.tobytes())
        for surface in (*self.measured_wheels, *(section.surface for section in self.sections)):
            digest.update(surface.curves(surface.sheet.u).tobytes())
        return digest.hexdigest()[:32]


def read(path: str | PathLike[str]) -> Scenario:
    """Return the scenario in a TOML file.

    Raises
    ------
    ContactError
        If the file is not TOML, has unknown or missing keys, or values of the wrong type or outside their range. The message
        names file, key, value and allowed values.
    """
    return from_table(toml(path), Path(path))


def from_table(table: dict[str, Any], path: Path) -> Scenario:
    """Return the scenario from the tables of the file `path`."""
    damage = table.get("damage")
    if isinstance(damage, dict) and not damage.keys() & {"wear_law", "archard"}:
        table = table | {"damage": damage | {"wear_law": WEAR_LAW}}
    declared = build(Declaration, table, path.name)
    series = declared.track.series
    if series is not None:
        beside = path.parent / series.file
        if not beside.is_file():
            raise ContactError(f"{path.name}.track.measured = {series.file!r} is no file beside it")
        series = replace(series, file=str(beside))
        declared = replace(declared, track=replace(declared.track, measured=series))
    try:
        wheel, rail = declared.profiles.load(path.parent)
        rails = declared.profiles.load_rails(path.parent)
    except (ContactError, OSError) as error:
        raise ContactError(f"{path.name}.profiles: {error}") from None
    beside = path.parent / declared.vehicle
    vehicle = read_vehicle(beside if beside.is_file() else declared.vehicle)
    axles = [axle.name for axle in vehicle.wheelsets]
    declared.wheels.require_axles(axles, f"{path.name}.wheels")
    for k, torque in enumerate(declared.torque):
        torque.require_axles(axles, f"{path.name}.torque[{k}]")
    found = Scenario(
        declared,
        wheel,
        rail,
        vehicle,
        both_rails=rails,
        measured_wheels=declared.wheels.load(path.parent, f"{path.name}.wheels"),
        sections=declared.rails.load(path.parent, f"{path.name}.rails"),
        files=hashed(_paths(declared, path)),
    )
    reach.require_series(found, path.name)
    reach.doubt(found, path.name)
    return found


def _paths(declared: Declaration, path: Path) -> Iterator[Path]:
    """Yield the files of a scenario, and names of profiles that are none."""
    folder, profiles, series = path.parent, declared.profiles, declared.track.series
    yield path
    yield from (folder / name for name in (profiles.wheel, profiles.rail, profiles.left_rail) if name)
    if series is not None:
        yield Path(series.file)
    beside = folder / declared.vehicle
    yield beside if beside.is_file() else find_vehicle(declared.vehicle)
    for each in (*declared.rails.slices, *declared.wheels.slices):
        yield folder / each.file
