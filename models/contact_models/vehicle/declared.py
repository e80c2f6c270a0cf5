"""A vehicle as declared in a TOML file: bodies, wheelsets, springs, dampers and stops (docs/understand/vehicle.md)."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

from contact.errors import ContactError, require_number, suggestion
from contact.geometry.wheelset import Side
from contact.inputs.options import FLANGE_BACK, GAUGE, GAUGE_POINT, RADIUS
from contact.reading.text import toml
from ..toml import build

#: Folder of the vehicles that are included, one file each.
INCLUDED = Path(__file__).parent / "included"
_HELD = ("x", "y", "z", "roll", "pitch", "yaw")
#: Sides in the order of every array of wheels.
SIDES: tuple[Side, Side] = ("right", "left")
#: Factor that shows an angle of a side's contact frame [rad] in degrees, positive if the rail pushes to the track's centre.
INWARDS: dict[Side, float] = {"right": -math.degrees(1.0), "left": math.degrees(1.0)}


def _require_vector(name: str, values: tuple[float, ...], minimum: float) -> None:
    if len(values) != 3:
        raise ContactError(f"{name} = {values} has not three members")
    for k, value in enumerate(values):
        require_number(f"{name}[{k}]", value, minimum)


@dataclass(frozen=True, kw_only=True)
class Body:
    """A rigid body.

    Parameters
    ----------
    name : str
        Any name; springs and dampers refer to it.
    mass : float
        Mass [kg].
    inertia : tuple of float
        Moments of inertia about x, y and z through the centre of gravity [kg m²].
    at, height : float
        Place of its track frame ahead of the vehicle's reference, height of its centre of gravity above the rails [m].
    held : tuple of str
        Coordinates that stand still in the frame: x, y, z, roll, pitch, yaw. The speed is given to the body whose x is held.
    """

    name: str
    mass: float
    inertia: tuple[float, ...]
    at: float = 0.0
    height: float
    held: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require_number("mass", self.mass, 0.0, open_minimum=True)
        _require_vector("inertia", self.inertia, 1e-6)
        require_number("height", self.height, 0.0, 10.0)
        require_number("at", self.at, -50.0, 50.0)
        for name in self.held:
            if name not in _HELD:
                raise ContactError(f"held = {name!r} is none of {', '.join(_HELD)}")


@dataclass(frozen=True, kw_only=True)
class Wheelset:
    """A wheelset. Its height is its wheels' radius.

    Parameters
    ----------
    name, mass, inertia, at : as for `Body`
    torque : float
        Given torque about the axle, positive when it drives forward [N m].
    """

    name: str
    mass: float
    inertia: tuple[float, ...]
    at: float = 0.0
    torque: float = 0.0

    def __post_init__(self) -> None:
        require_number("mass", self.mass, 0.0, open_minimum=True)
        _require_vector("inertia", self.inertia, 1e-6)
        require_number("torque", self.torque, -1e6, 1e6)


@dataclass(frozen=True, kw_only=True)
class Joint:
    """Force elements of one kind between pairs of bodies.

    Parameters
    ----------
    between : tuple of pairs of names
        Bodies of each element. Its axes are fixed in the first one.
    at : tuple of float
        Place [m]: ahead of the first body's frame, to the right of the track's centre, height above the rails.
    mirrored : bool
        Whether there is an equal element on the left side.
    """

    between: tuple[tuple[str, ...], ...]
    at: tuple[float, ...]
    mirrored: bool = False

    def __post_init__(self) -> None:
        if len(self.at) != 3:
            raise ContactError(f"at = {self.at} has not three members")
        for pair in self.between:
            if len(pair) != 2:
                raise ContactError(f"between = {pair} does not name two bodies")


_J = TypeVar("_J", bound=Joint)


@dataclass(frozen=True, kw_only=True)
class Spring(Joint):
    """Springs and dampers side by side.

    Parameters
    ----------
    stiffness, damping : tuple of float
        Along x, y and z [N/m], [N s/m].
    turning : tuple of float
        Stiffness about x, y and z [N m/rad]; (k, 0, 0) is a roll bar.
    preload : float
        Vertical force on the first body, downwards, besides that of the weights of free bodies [N].
    """

    stiffness: tuple[float, ...] = (0.0, 0.0, 0.0)
    damping: tuple[float, ...] = (0.0, 0.0, 0.0)
    turning: tuple[float, ...] = (0.0, 0.0, 0.0)
    preload: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("stiffness", "damping", "turning"):
            _require_vector(name, getattr(self, name), 0.0)


@dataclass(frozen=True, kw_only=True)
class Damper(Joint):
    """Dampers in series with springs, as yaw dampers; an axis without stiffness carries nothing.

    Parameters
    ----------
    stiffness, damping : tuple of float
        Along x, y and z [N/m], [N s/m].
    """

    stiffness: tuple[float, ...]
    damping: tuple[float, ...]

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("stiffness", "damping"):
            _require_vector(name, getattr(self, name), 0.0)
        for k, c in zip(self.stiffness, self.damping, strict=True):
            if k > 0.0 and c <= 0.0:
                raise ContactError(f"damping = {self.damping} has no damper in series with a spring of {k:g} N/m")


@dataclass(frozen=True, kw_only=True)
class Stop(Joint):
    """Lateral bump stops: a force over the lateral deformation, the same to both sides.

    Parameters
    ----------
    deformation, force : tuple of float
        Increasing from (0, 0) [m], [N]. Beyond the last value the last slope goes on.
    """

    deformation: tuple[float, ...]
    force: tuple[float, ...]

    def __post_init__(self) -> None:
        super().__post_init__()
        n = len(self.deformation)
        if n < 2 or n != len(self.force) or self.deformation[0] != 0.0 or self.force[0] != 0.0:
            raise ContactError("deformation and force need equally many values, at least two, both from 0")
        for k in range(1, n):
            require_number(f"deformation[{k}]", self.deformation[k], self.deformation[k - 1], open_minimum=True)
            require_number(f"force[{k}]", self.force[k], self.force[k - 1])


@dataclass(frozen=True, kw_only=True)
class Rail:
    """The rail under each wheel: a mass on springs and dampers. It rests in equilibrium under the static load.

    Parameters
    ----------
    mass : float
        [kg]; 0 is a rigid track.
    lateral_stiffness, lateral_damping, vertical_stiffness, vertical_damping : float
        [N/m], [N s/m].
    """

    mass: float = 300.0
    lateral_stiffness: float = 43e6
    lateral_damping: float = 240e3
    vertical_stiffness: float = 75e6
    vertical_damping: float = 94e3

    def __post_init__(self) -> None:
        for entry in fields(self):
            require_number(entry.name, getattr(self, entry.name), 0.0)


@dataclass(frozen=True, kw_only=True)
class VehicleDeclaration:
    """A vehicle.

    Parameters
    ----------
    name, source : str
        Title, and where the numbers are from.
    radius, gauge, gauge_point, flange_back : float
        Nominal rolling radius, track gauge, depth below the top of the rail at which it is measured, distance of the backs
        of the flanges [m].
    bodies, wheelsets, springs, dampers, stops : tuple
        See the classes of this module. Wheelsets are numbered from the front.
    rail : Rail
    """

    name: str
    source: str = ""
    radius: float = RADIUS.usual
    gauge: float = GAUGE.usual
    gauge_point: float = GAUGE_POINT.usual
    flange_back: float = FLANGE_BACK.usual
    bodies: tuple[Body, ...] = ()
    wheelsets: tuple[Wheelset, ...]
    springs: tuple[Spring, ...] = ()
    dampers: tuple[Damper, ...] = ()
    stops: tuple[Stop, ...] = ()
    rail: Rail = Rail()

    def __post_init__(self) -> None:
        names = [*(body.name for body in self.bodies), *(axle.name for axle in self.wheelsets)]
        if len(set(names)) < len(names):
            raise ContactError(f"bodies and wheelsets share names: {', '.join(names)}")
        if not self.wheelsets:
            raise ContactError("wheelsets is empty; at least one is needed")
        joints: tuple[Joint, ...] = (*self.springs, *self.dampers, *self.stops)
        for joint in joints:
            for name in (each for pair in joint.between for each in pair):
                if name not in names:
                    raise ContactError(f"between = {name!r} is no body{suggestion(name, names)}")
        if not any("x" in body.held for body in self.bodies):
            raise ContactError("bodies: none of them has held = ['x'], so nothing keeps the speed")

    @property
    def sizes(self) -> dict[str, Any]:
        """Lengths of its wheels on their rails [m], by the names of `contact.geometry.wheelset.Pair`."""
        names = "gauge", "gauge_point", "flange_back"
        return {"nominal_radius": self.radius, **{name: getattr(self, name) for name in names}}

    def reprofiled(self, cut: float) -> VehicleDeclaration:
        """Return the vehicle with wheels whose radius is smaller by `cut` [m], on which all else stands lower. Masses stay."""

        def lower(joint: _J) -> _J:
            ahead, right, height = joint.at
            return replace(joint, at=(ahead, right, height - cut))

        return replace(
            self,
            radius=self.radius - cut,
            bodies=tuple(replace(body, height=body.height - cut) for body in self.bodies),
            springs=tuple(map(lower, self.springs)),
            dampers=tuple(map(lower, self.dampers)),
            stops=tuple(map(lower, self.stops)),
        )


def read(path: str | PathLike[str]) -> VehicleDeclaration:
    """Return the vehicle in a TOML file, or an included one by its name (`manchester`, `wheelset`).

    Raises
    ------
    ContactError
        If there is no such vehicle, or the file is not as this module says. The message names file, key and value.
    """
    place = find(path)
    return build(VehicleDeclaration, toml(place), place.name)


def find(path: str | PathLike[str]) -> Path:
    """Return the file of a vehicle, or that of an included one. Raise ContactError if there is none."""
    inside = INCLUDED / f"{path}.toml"
    place = inside if inside.is_file() else Path(path)
    if not place.is_file():
        known = sorted(each.stem for each in INCLUDED.glob("*.toml"))
        raise ContactError(f"vehicle = {str(path)!r} is neither a file nor one of {', '.join(known)}")
    return place
