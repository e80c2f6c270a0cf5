"""Profiles and surfaces of a case of module 1, in the right-side form of this package."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Literal, cast

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, ProfileWarning, warn
from contact.geometry import formats, placing
from contact.geometry.records import Irregularity
from contact.geometry.shape import Profile
from contact.geometry.smoothing import filtered, penalised
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK, Pair, place_of_rail
from contact.inp.case import Case
from contact.inp.grid import material
from contact.inp.outline import Outline, Outlines, kinks
from contact.inp.reasons import RefusedError, refuse
from contact.kernels.records import LARGEST_RAIL_ROLL

_READERS = {".prr": formats.simpack, ".prw": formats.simpack, ".ban": formats.miniprof, ".whl": formats.miniprof}
_SLICES = (".slcs", ".slcw")
#: Distance of the longitudinal paths by which a profile that does not change is described [m].
_PATHS = 2.5e-4
#: Wavelengths that the filter takes [m].
_SHORTEST, _LONGEST = 1e-4, 0.05


def pair(case: Case) -> SurfacePair:
    """Return wheel and rail of a case, with the elements and distances of its grid."""
    wheel, rail = body(case, "W"), body(case, "R")
    if case["GAUGHT"] <= 0.0:
        y = case["RAILY0"]
        origin = mirror_of(case) * y, case["RAILZ0"]
    elif isinstance(rail, Profile):
        rail_y, rail_z = place_of_rail(rail, case["GAUGWD"], case["GAUGHT"])
        origin = rail_y, 0.0 if is_roller(case) else rail_z
    else:
        raise refuse(case, "input", "GAUGHT > 0 with slices of a rail; allowed: GAUGHT ≤ 0")
    if isinstance(wheel, Profile):
        wheel = WheelSurface([0.0], [_slice(wheel)], spacing=_PATHS, name=wheel.name)
    if is_roller(case):
        rail = RailSurface.roller(roller(case), case["NOMRADR"], spacing=_PATHS)
    elif isinstance(rail, Profile):
        rail = RailSurface([0.0], [_slice(_rolled(rail, case))], spacing=_PATHS, name=rail.name)
    return SurfacePair(
        cast(WheelSurface, wheel),
        cast(RailSurface, rail),
        side=side_of(case),
        nominal_radius=case["NOMRADW"],
        tape=0.5 * case["FBDIST"] - case["FBPOS"],
        rail_origin=origin,
        combine_distance=case["D_SEP"],
        spacing=(case["DX"], case["DS"]),
        material=material(case),
    )


def _slice(profile: Profile) -> Profile | Array:
    """Return a profile as a slice; one with kinks as points, of which the slice makes corners."""
    points = np.stack((profile.y, profile.z), axis=1)
    return points if kinks(points) else profile


def profiles(case: Case) -> Pair | None:
    """Return wheel and rail of a case as profiles, which strips search faster than surfaces; None where they are none."""
    if case["GAUGHT"] <= 0.0 or has_slices(case) or is_roller(case) or own_roll(case):
        return None
    return Pair(
        cast(Profile, body(case, "W")),
        cast(Profile, body(case, "R")),
        side=side_of(case),
        nominal_radius=case["NOMRADW"],
        gauge=case["GAUGWD"],
        gauge_point=case["GAUGHT"],
        flange_back=case["FBDIST"] - 2.0 * case["FBPOS"] - 2.0 * TAPE_FROM_FLANGE_BACK,
        combine_distance=case["D_SEP"],
        material=material(case),
    )


def outlines(case: Case) -> Outlines:
    """Return the outlines of wheel and rail."""
    wheel, rail = body(case, "W"), body(case, "R")
    return Outlines(
        Outline.of(wheel) if isinstance(wheel, Profile) else None,
        Outline.of(_rolled(rail, case)) if isinstance(rail, Profile) else None,
        case["NOMRADR"] if is_roller(case) else None,
    )


def key(case: Case) -> tuple[Any, ...]:
    """Return what the pair depends on: cases of equal key share it."""
    names = [
        *("FBDIST", "FBPOS", "NOMRADW", "GAUGHT", "GAUGWD", "RAILY0", "RAILZ0", "CANT", "NOMRADR", "D_SEP", "DX", "DS"),
        *("POISS1", "POISS2", "GG1", "GG2", "YTAPE"),
    ]
    of_profile = ("FNAME", "MIRRORY", "MIRRORZ", "SCALE", "SMOOTH", "ISMOOTH")
    sides = tuple(case.get(f"{side}{name}") for side in "RW" for name in of_profile)
    return (case.digits["C1"], own_roll(case), *(case.get(name) for name in names), *sides)


def side_of(case: Case) -> Literal["left", "right"]:
    """Return the side of the wheel."""
    return "right" if case.digits["C1"] in (1, 5) else "left"


def mirror_of(case: Case) -> float:
    """Return 1 for a right wheel, -1 for a left one."""
    return 1.0 if side_of(case) == "right" else -1.0


def is_roller(case: Case) -> bool:
    """Return whether the wheel stands on a roller."""
    return case.digits["C1"] in (4, 5)


def roller(case: Case) -> Profile:
    """Return the profile of a roller, in its right-side form."""
    found = body(case, "R")
    if not isinstance(found, Profile):
        raise refuse(case, "input", "slices of a roller; allowed: a profile")
    return _rolled(found, case)


def _rolled(profile: Profile, case: Case) -> Profile:
    return profile.rotated(own_roll(case)) if own_roll(case) else profile


def own_roll(case: Case) -> float:
    """Return the roll [rad] by which the rail's profile is turned for good, in its right-side form.

    That is the whole DROLLR of a roller, which is turned before it is a body of revolution, and of a rail one that is
    too large for an irregularity; else 0.
    """
    roll = float(case["DROLLR"])
    if not (is_roller(case) or abs(roll) > LARGEST_RAIL_ROLL):
        return 0.0
    return mirror_of(case) * roll


def turn_of_rail(case: Case) -> float:
    """Return the angle by which the rail's profile is turned from the file's, in its right-side form [rad]."""
    return own_roll(case) - float(0.0 if is_roller(case) else case.get("CANT", 0.0))


def irregularity(case: Case) -> Irregularity:
    """Return the rail's deviations, without a roll that its profile has for good."""
    found = Irregularity(case["DYRAIL"], case["DZRAIL"], 0.0, *(case[name] for name in ("VYRAIL", "VZRAIL", "VROLLR")))
    return found if own_roll(case) else replace(found, roll=case["DROLLR"])


def has_slices(case: Case) -> bool:
    """Return whether the rail or the wheel changes along the way."""
    return any(case[f"{side}FNAME"].suffix.lower() in _SLICES for side in "RW")


def body(case: Case, side: str) -> Profile | RailSurface | WheelSurface:
    """Return the rail (`side` R) or the wheel (W)."""
    path: Path = case[f"{side}FNAME"]
    kind = "rail" if side == "R" else "wheel"
    slices = path.suffix.lower() in _SLICES
    mirror_y, mirror_z = case[f"{side}MIRRORY"] == 1, case[f"{side}MIRRORZ"]
    scale = case[f"{side}SCALE"]

    def smooth(points: Array) -> Array:
        return np.column_stack(_smoothed(case, side, points)[:2])

    try:
        if slices:
            if scale != 1.0:
                raise refuse(case, "input", f"SCALE = {scale:g} of slices; allowed: 1")
            options = {"mirror_y": mirror_y, "mirror_z": mirror_z == 1}
            options |= {"smooth": smooth} if case[f"{side}SMOOTH"] > 0.0 else {}
            if side == "R":
                if case.get("CANT", 0.0) != 0.0:
                    raise refuse(case, "input", "CANT of slices; allowed: 0")
                return RailSurface.read(path, **options)
            return WheelSurface.read(path, **options)
        points = _points(path, kind, scale, mirror_y, mirror_z)
    except RefusedError:
        raise
    except ContactError as error:
        message = f"{case.place}, {side}FNAME in line {case.lines[f'{side}FNAME']}: {error}"
        raise RefusedError("input", message) from None
    y, z, angle = _smoothed(case, side, points)
    profile = Profile(kind, y, z, angle, path.stem)  # type: ignore[arg-type]
    if side == "R" and not is_roller(case) and case.get("CANT", 0.0) != 0.0:
        profile = profile.rotated(-case["CANT"])
    if side == "W" and case["YTAPE"] < 0.999:
        down = float(np.interp(case["YTAPE"], profile.y, profile.z))
        profile = Profile("wheel", profile.y, profile.z - down, profile.angle, path.stem)
    return profile


def _points(path: Path, kind: str, scale: float, mirror_y: bool, mirror_z: int) -> Array:
    """Return the points [m] from the gauge or flange side on, y to the field side and z down.

    `mirror_z` says that the file's z shall change its sign (1) or not (-1), or that its points tell (0).
    """
    reader = _READERS.get(path.suffix.lower(), formats.columns)
    content = reader(path, formats.Choice("right"))
    for finding in content.told:
        warn(f"{path.name}: {finding}", ProfileWarning)
    points = content.points * ((content.unit or 1e-3) * scale)
    if mirror_y:
        points = points * [-1.0, 1.0]
    if mirror_z == 1:
        points = points * [1.0, -1.0]
    known = mirror_z != 0 or content.downwards
    content = formats.Content(points, 1.0, True, known)
    return placing.placed(points, content, kind, path, "file")  # type: ignore[arg-type]


def _smoothed(case: Case, side: str, points: Array) -> tuple[Array, Array, Array | None]:
    """Return the points, smoothed as the file asks for: by λ [mm³] of a spline or by a wavelength [mm]."""
    amount = case[f"{side}SMOOTH"]
    y, z = points.T
    if amount <= 0.0:
        return y, z, None
    kind = case.get(f"{side}ISMOOTH") or 0
    if kind == 2:
        raise refuse(case, "smoothing", "ISMOOTH = 2")
    if kind == 0:
        return penalised(y, z, 1e-9 * amount)
    length = 1e-3 * amount
    if length < _SHORTEST:
        return y, z, None
    if length > _LONGEST:
        raise refuse(case, "smoothing", f"a wavelength of {length:g} m; allowed: up to {_LONGEST:g} m")
    return filtered(y, z, length)
