"""Every contact patch between one wheel of a wheelset and its rail.

Conventions (theory.md 9.4). Track frame: x forward, y to the right, z down, z = 0 on top of both rails. The wheelset's
centre lies at (0, pose.y, pose.z - nominal_radius); at pose = 0 both tape circles touch the plane z = 0. Roll is about x,
yaw about z, right-handed: positive yaw steers to the right, positive roll lowers the right wheel. Spin is the rotation about
the axle, negative when rolling forward. The contact frame is the track frame turned about x by the contact angle; its z axis
points from the wheel into the rail, so the angle on the right wheel's tread is negative and on the left wheel's positive.
Creepages are wheel minus rail over the forward speed: steering by a yaw angle psi gives the lateral creepage -psi/cos(angle),
a rolling radius r the longitudinal creepage 1 - r/r0, a contact angle the spin creepage sin(angle)/r0.

The left side is computed as the mirror image of the right, so both agree to the last bit.
"""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact import quadrature
from contact._layout import CASE_G, CASE_NU, MAX_PATCHES, N_CASE, N_RES, N_STRIP_ROWS
from contact.creepage import Creepage
from contact.errors import ContactError, require_number
from contact.geometry import layout
from contact.geometry.curve import hermite, least
from contact.geometry.profile import Profile
from contact.geometry.records import Irregularity, Patch, Pose, Velocity
from contact.geometry.settle import GIVEN_Z, LOAD, NO_OVERLAP, NOT_SETTLED, PENETRATION, first_touch, settle
from contact.material import STEEL, Material
from contact.normal.analyn import N_WORK_ROWS
from contact.separation import Separation
from contact.solve import N_STRIPS

__all__ = ["Irregularity", "Pair", "Patch", "Pose", "Velocity", "contacts"]

Array = NDArray[np.float64]
Side = Literal["right", "left"]

TAPE_FROM_FLANGE_BACK = 0.070  # [m] EN 13715: the tape circle lies 70 mm outside the back of the flange
#: Steeper parts of the profiles take no part in the search, whatever roll is allowed on top [rad].
STEEPEST = {"wheel": math.radians(80.0), "rail": math.radians(86.0)}
SAMPLES = 81
MAX_PENETRATION = 2e-3  # [m] a wheel under 10 MN; more is a slip of units


class Pair:
    """One wheel on one rail with everything prepared: what a model calls at each time step.

    Parameters
    ----------
    wheel, rail : Profile
        In the right-side convention, for either side.
    side : {"right", "left"}
    nominal_radius : float
        Radius of the tape circle [m], 0.05 to 2.
    gauge : float
        Distance of the rails' gauge points [m], 0.1 to 3.
    flange_back : float
        Distance between the backs of both flanges [m], 0.1 to 3.
    gauge_point : float
        Depth below the top of the rail at which the gauge is measured [m].
    combine_distance, combine_angle : float
        Lobes of interpenetration further apart than this [m] and differing in angle by more than this [rad] become
        separate patches with frames of their own; others share one plane.
    samples : int or array_like
        Number of samples of each separation, 5 to 2001, spread over the interpenetration and a margin; or their
        increasing positions in the contact plane [m], for a model whose separation lies on a fixed grid. There the gap
        opens at 45° beyond the ends of the profiles and of the patch's own range.
    material : Material
        For a search under a load.

    Attributes
    ----------
    patches, separations : ndarray
        What the last search found, in the rows of `contact.geometry.layout` (right side). Only one thread may search.

    Raises
    ------
    ContactError
        Profiles of the wrong kind, constants outside their range, no point of the rail at the gauge point's depth.
    """

    def __init__(
        self,
        wheel: Profile,
        rail: Profile,
        *,
        side: Side = "right",
        nominal_radius: float = 0.460,
        gauge: float = 1.435,
        flange_back: float = 1.360,
        gauge_point: float = 0.014,
        combine_distance: float = 8e-3,
        combine_angle: float = math.radians(20.0),
        samples: int | ArrayLike = SAMPLES,
        material: Material = STEEL,
    ) -> None:
        for name, given in (("wheel", wheel), ("rail", rail)):
            if not isinstance(given, Profile) or given.kind != name:
                raise ContactError(f"{name} = {given!r} is not a profile of a {name}")
        if side not in ("right", "left"):
            raise ContactError(f"side = {side!r} is neither 'right' nor 'left'")
        self.side: Side = side
        self._mirror = 1.0 if side == "right" else -1.0
        self.nominal_radius = require_number("nominal_radius", nominal_radius, 0.05, 2.0)
        self._rail_origin = _rail_origin(rail, require_number("gauge", gauge, 0.1, 3.0), gauge_point)
        self._grid, n = _grid(samples)
        sizes = (
            self.nominal_radius,
            0.5 * require_number("flange_back", flange_back, 0.1, 3.0) + TAPE_FROM_FLANGE_BACK,
            require_number("combine_distance", combine_distance, 0.0),
            require_number("combine_angle", combine_angle, 0.0),
        )
        self._motion = np.zeros(layout.N_MOTION)
        self._motion[layout.RADIUS :] = sizes
        wheel_curve, rail_curve = _facing(wheel), _facing(rail)
        n_wheel, n_rail = wheel_curve.shape[1], rail_curve.shape[1]
        line, placed = np.zeros((layout.N_LINE_ROWS, n_wheel)), np.zeros((3, n_rail))
        self.patches = np.zeros((MAX_PATCHES, layout.N_PATCH))
        self.separations = np.zeros((MAX_PATCHES, layout.N_SEP_ROWS, n))
        case = np.zeros(N_CASE)
        case[CASE_G], case[CASE_NU] = material.shear_modulus, material.poisson_ratio
        nodes, weights = quadrature.fejer(N_STRIPS)
        self._curves = wheel_curve, rail_curve, self._motion
        self._lines = line, placed
        self._work = (
            np.zeros((layout.MAX_LOBES, layout.N_LOBE)),
            np.zeros((layout.N_LINE_ROWS, n_wheel)),
            np.zeros((3, n_rail)),
            self.patches,
            self.separations,
            case,
            nodes,
            weights,
            np.zeros((N_WORK_ROWS, n)),
            np.zeros((N_STRIP_ROWS, MAX_PATCHES * N_STRIPS)),
            np.zeros(N_RES),
        )

    def locate(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        load: float | None = None,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> int:
        """Fill `patches` and `separations` without making objects; returns the number of patches. Else like `contacts`."""
        if load is not None and penetration is not None:
            raise ContactError(f"load = {load} and penetration = {penetration} exclude each other")
        mode, amount = GIVEN_Z, 0.0
        if load is not None:
            mode, amount = LOAD, require_number("load", load, 0.0)
        elif penetration is not None:
            mode, amount = PENETRATION, require_number("penetration", penetration, 0.0, MAX_PENETRATION)
        self._move(pose, velocity or _ROLLING, irregularity or _IDEAL)
        n = settle(mode, amount, *self._curves, self._grid, *self._lines, *self._work)
        if n == NO_OVERLAP:
            raise self._apart(pose)
        if n == NOT_SETTLED:
            raise ContactError(
                f"load = {load:g}: no z was found at which the {self.side} wheel carries it on this rail"
            )
        return int(n)

    def contacts(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        load: float | None = None,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> tuple[Patch, ...]:
        """Every patch, from the field side to the flange; see the function `contacts`."""
        n = self.locate(pose, velocity, load=load, penetration=penetration, irregularity=irregularity)
        return tuple(self._patch(k, load is not None) for k in range(n))

    def touch(self, pose: Pose, irregularity: Irregularity | None = None) -> float:
        """z [m] at which the rigid wheel just touches the rail, the other coordinates as in `pose`."""
        self._move(pose, _ROLLING, irregularity or _IDEAL)
        overlap, z = first_touch(*self._curves, *self._lines)
        if not overlap:
            raise self._apart(pose)
        return float(z)

    @property
    def z(self) -> float:
        """pose.z of the last search [m]: as given, or as found for a load or a penetration."""
        return float(self._motion[layout.POSE_Z])

    def _move(self, pose: Pose, velocity: Velocity, rail: Irregularity) -> None:
        """Take over the motion, mirrored to the right side."""
        m = self._mirror
        spin = -velocity.forward / self.nominal_radius if velocity.spin is None else velocity.spin
        self._motion[: layout.RADIUS] = (
            m * pose.y,
            pose.z,
            m * pose.roll,
            m * pose.yaw,
            velocity.forward,
            m * velocity.y,
            velocity.z,
            m * velocity.roll,
            m * velocity.yaw,
            spin,
            self._rail_origin[0] + m * rail.y,
            self._rail_origin[1] + rail.z,
            m * rail.roll,
            m * rail.y_rate,
            rail.z_rate,
            m * rail.roll_rate,
        )

    def _patch(self, k: int, loaded: bool) -> Patch:
        m, p = self._mirror, self.patches[k].tolist()
        y, g, A, x_c = self.separations[k] if m > 0.0 else self.separations[k][:, ::-1]
        edges = (p[layout.PATCH_FROM], p[layout.PATCH_TO])
        return Patch(
            separation=Separation(m * y, g, A, x_c),
            creepage=Creepage(p[layout.PATCH_VX], m * p[layout.PATCH_VY], m * p[layout.PATCH_PHI]),
            angle=m * p[layout.PATCH_ANGLE],
            position=(p[layout.PATCH_X], m * p[layout.PATCH_Y], p[layout.PATCH_Z]),
            on_rail=(p[layout.PATCH_RAIL_Y], p[layout.PATCH_RAIL_Z]),
            on_wheel=(p[layout.PATCH_WHEEL_Y], p[layout.PATCH_WHEEL_Z]),
            rolling_radius=p[layout.PATCH_RADIUS],
            approach=p[layout.PATCH_APPROACH],
            edges=edges if m > 0.0 else (-edges[1], -edges[0]),
            load=p[layout.PATCH_LOAD] if loaded else None,
        )

    def _apart(self, pose: Pose) -> ContactError:
        wheel, rail = self._curves[0][0] + self._motion[layout.TAPE], self._curves[1][0] + self._rail_origin[0]
        low, high = sorted((self._mirror * (rail[0] - wheel[-1]), self._mirror * (rail[-1] - wheel[0])))
        return ContactError(
            f"pose.y = {pose.y:g}: the {self.side} wheel and rail profiles do not overlap; "
            f"they do within about ]{low:g}, {high:g}["
        )


def contacts(
    wheel: Profile,
    rail: Profile,
    pose: Pose,
    velocity: Velocity | None = None,
    *,
    load: float | None = None,
    penetration: float | None = None,
    irregularity: Irregularity | None = None,
    **options: Any,
) -> tuple[Patch, ...]:
    """Every contact patch of one wheel-rail pair; an empty tuple when the wheel does not touch.

    A model that asks at every time step makes a `Pair` once and calls its method of the same name.

    Parameters
    ----------
    wheel, rail : Profile
    pose : Pose
        Of the wheelset in track coordinates; pose.z counts unless `load` or `penetration` is given.
    velocity : Velocity, optional
        Default: steady rolling at the nominal radius.
    load : float, optional
        Vertical force of this wheel on its rail [N]: z is found so that the normal forces of all patches (ANALYN, without
        friction) add up to it, sum of N cos(angle) = load.
    penetration : float, optional
        Depth below first touch [m], vertically.
    irregularity : Irregularity, optional
        Displacement of this rail.
    **options
        As for `Pair`: side, nominal_radius, gauge, flange_back, gauge_point, combine_distance, combine_angle, samples,
        material.

    Returns
    -------
    tuple of Patch
        From the field side to the flange.

    Raises
    ------
    ContactError
        For input outside its range, where the profiles do not lie above each other, and for a load that no z carries.
    """
    pair = Pair(wheel, rail, **options)
    return pair.contacts(pose, velocity, load=load, penetration=penetration, irregularity=irregularity)


_ROLLING, _IDEAL = Velocity(), Irregularity()


def _facing(profile: Profile) -> Array:
    """Rows y, z, dz/dy of the part around the tape circle or crown that is less steep than `STEEPEST` and has rising y."""
    fair = np.cos(profile.angle) > math.cos(STEEPEST[profile.kind])
    fair[:-1] &= np.diff(profile.y) > 0.0
    centre = int(np.argmin(np.abs(profile.y)) if profile.kind == "wheel" else np.argmin(profile.z))
    if not fair[centre]:
        raise ContactError(f"{profile!r} is steep at y = {profile.y[centre]:g} m; is its unit or its side wrong?")
    low = centre - int(np.argmin(np.append(fair[centre::-1], False))) + 1
    high = centre + int(np.argmin(np.append(fair[centre:], False)))
    part = slice(low, high)
    return np.stack((profile.y[part], profile.z[part], np.tan(profile.angle[part])))


def _rail_origin(rail: Profile, gauge: float, gauge_point: float) -> tuple[float, float]:
    """(y, z) of the origin of the right rail's profile: its top at z = 0, its gauge face at half the gauge."""
    highest = int(np.argmin(rail.z))
    top = float(rail.z[highest])
    for i in range(max(highest - 1, 0), min(highest + 1, rail.y.size - 1)):  # the crest lies between two points
        t, z = least(*rail.z[i : i + 2], *np.tan(rail.angle[i : i + 2]), rail.y[i + 1] - rail.y[i])
        top = min(top, z) if t > 0.0 else top
    require_number("gauge_point", gauge_point, 0.0, open_minimum=True)
    depth = rail.z[highest::-1] - top
    below = np.flatnonzero(depth >= gauge_point)
    if below.size == 0:
        raise ContactError(
            f"gauge_point = {gauge_point:g} is outside the allowed range ]0, {depth.max():g}]: "
            f"{rail!r} reaches no deeper on its gauge side"
        )
    i = highest - int(below[0])  # the gauge face is steep: y is interpolated over z there
    h = rail.z[i + 1] - rail.z[i]
    cot = 1.0 / np.tan(rail.angle[i : i + 2])
    y, _ = hermite(rail.y[i], rail.y[i + 1], cot[0], cot[1], h, (top + gauge_point - rail.z[i]) / h)
    return 0.5 * gauge - y, -top


def _grid(samples: int | ArrayLike) -> tuple[Array, int]:
    """Prescribed sample positions (or none) and the number of samples."""
    if isinstance(samples, int | np.integer):
        require_number("samples", samples, 5, 2001)
        return np.empty(0), int(samples)
    try:
        grid = np.array(samples, dtype=np.float64)
    except (TypeError, ValueError):
        raise ContactError(f"samples = {samples!r} is neither an integer nor an array of positions [m]") from None
    if grid.ndim != 1 or grid.size < 5 or not np.isfinite(grid).all() or not (np.diff(grid) > 0.0).all():
        raise ContactError(f"samples of shape {grid.shape}: at least 5 finite, increasing positions [m] are needed")
    return grid, grid.size
