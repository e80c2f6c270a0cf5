"""A wheelset in a curve: the steady motion in which rails, weight, inertia and guidance are in balance."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, ModelWarning, require_number
from contact.friction import Friction
from contact.geometry.profile import Profile
from contact.geometry.records import Pose, Velocity
from contact.geometry.wheelset import Pair
from contact.inputs.options import FLANGE_BACK, GAUGE, RADIUS
from contact.pair.solution import PairSolution
from contact.pair.wheel_rail import WheelRailPair
from contact.registry import DEFAULT_NORMAL, lookup
from contact.results import Status, doubt_answer

GRAVITY = 9.81  # [m/s²]
RAIL_DISTANCE = 1.5  # of the rails' centres, over which cant is measured [m]
_MOST = 200  # iterations
_TOLERANCE = 1e-5  # of the balance over the load of the axle
_LARGEST = np.array([2e-4, 2e-3, 1e-5, 2e-5, 0.0])  # steps of y, yaw, z, roll; that of the rotation is relative
_AROUND = 2e-3  # largest relative step of the rotation
_COLUMNS = ("pose.y", "pose.yaw", "pose.z", "pose.roll", "velocity.spin")


@dataclass(frozen=True, slots=True)
class Curving:
    """A wheelset that runs steadily through a curve to the right: the left wheel is the outer one.

    Attributes
    ----------
    y : lateral displacement [m], negative to the outside
    yaw : [rad], positive to the inside; 0 is the radial position
    roll : against the plane of the track [rad]
    z : height as `Pose.z` [m]
    spin : rotation about the axle [rad/s]
    lateral : force of the rails on the wheelset in the plane of the track, to the inside [N]
    steering : moment of the rails on the wheelset about z [N m]; the guidance holds it
    outer, inner : PairSolution
    """

    y: float
    yaw: float
    roll: float
    z: float
    spin: float
    lateral: float
    steering: float
    outer: PairSolution = field(repr=False)
    inner: PairSolution = field(repr=False)

    @property
    def guiding(self) -> float:
        """ΣY, the force of the wheelset on both rails to the outside [N]."""
        return self.outer.Y - self.inner.Y

    @property
    def trusted(self) -> bool:
        """Whether the solutions of both wheels can be trusted."""
        return max(self.outer.status, self.inner.status) <= Status.SATURATED


def in_curve(
    wheel: Profile,
    rail: Profile,
    radius: float,
    *,
    load: float,
    speed: float,
    cant: float = 0.0,
    yaw_stiffness: float = 0.0,
    lead: float = 0.0,
    height: float | None = None,
    friction: float | Friction = 0.3,
    nominal_radius: float = RADIUS.usual,
    gauge: float = GAUGE.usual,
    flange_back: float = FLANGE_BACK.usual,
    **options: Any,
) -> Curving:
    """Return the steady motion of a wheelset in a circular curve to the right.

    Its axle carries a part of a vehicle: weight and the inertia of going round act on it, in the plane of the track and across.
    The wheelset is free to move laterally; its guidance turns it by ``yaw_stiffness`` to the direction of a bogie. No torque
    drives or brakes it.

    Parameters
    ----------
    wheel, rail : contact.geometry.profile.Profile
        Both wheels and both rails are alike.
    radius : float
        Of the curve [m], 10 to 1e6.
    load : float
        Static load of each wheel on level track [N], 100 to 5e6.
    speed : float
        [m/s], 0.01 to 150.
    cant : float
        Height of the outer rail above the inner one [m], -0.3 to 0.3.
    yaw_stiffness : float
        Of the guidance about z [N m/rad], not negative; 0: a free wheelset, which steers itself.
    lead : float
        Distance of the axle ahead of its bogie's centre [m], -20 to 20; behind it is negative. The bogie lies along the track
        at its centre, so it holds a leading axle to the outside of the radial position by lead/radius.
    height : float, optional
        Of the centre of gravity of what the axle carries above the rails [m], 0 to 5; default: that of the axle. It loads the
        outer wheel.
    friction : float or Friction
    nominal_radius, gauge, flange_back : float
        As for `contact.geometry.wheelset.Pair` [m].
    **options
        Methods, material and resolution, as for `WheelRailPair`.

    Returns
    -------
    Curving

    Raises
    ------
    ContactError
        For numbers outside their range, or if no balance is found: as where a flange climbs.
    """
    curve = require_number("radius", radius, 10.0, 1e6)
    weight = 2.0 * require_number("load", load, 100.0, 5e6)
    V = require_number("speed", speed, 0.01, 150.0)
    tilt = math.asin(require_number("cant", cant, -0.3, 0.3) / RAIL_DISTANCE)
    stiffness = require_number("yaw_stiffness", yaw_stiffness, 0.0)
    held = -require_number("lead", lead, -20.0, 20.0) / curve
    arm = 0.0 if height is None else require_number("height", height, 0.0, 5.0) - nominal_radius
    centripetal = V * V / curve / GRAVITY
    lateral = weight * (centripetal * math.cos(tilt) - math.sin(tilt))
    down = weight * (math.cos(tilt) + centripetal * math.sin(tilt))
    sizes: dict[str, Any] = {"nominal_radius": nominal_radius, "gauge": gauge, "flange_back": flange_back}
    right = WheelRailPair(Pair(wheel, rail, side="right", **sizes), **options)
    left = WheelRailPair(Pair(wheel, rail, side="left", **sizes), **options)

    def balance(x: Array) -> tuple[Array, Array, tuple[PairSolution, PairSolution]]:
        """Return what is out of balance, its derivatives, and both solutions, for y, yaw, z, roll and spin."""
        pose = Pose(y=float(x[0]), yaw=float(x[1]), z=float(x[2]), roll=float(x[3]))
        velocity = Velocity(forward=V, yaw=V / curve, spin=float(x[4]))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelWarning)  # of places on the way
            both = [one.solve(pose, velocity, friction=friction, derivatives=True) for one in (right, left)]
        force, moment = (sum(getattr(s, name) for s in both) for name in ("force", "moment"))
        rows = np.zeros((6, 5))
        for s in both:
            if s.jacobian is not None:
                rows += s.jacobian.values[:6, [s.jacobian.columns.index(name) for name in _COLUMNS]]
        out = np.array(
            [
                force[1] - lateral,
                moment[2] - stiffness * (x[1] - held),
                force[2] + down,
                moment[0] - lateral * arm,
                moment[1],
            ]
        )
        slopes = rows[[1, 5, 2, 3, 4]]
        slopes[1, 1] -= stiffness
        return out, slopes, (both[0], both[1])

    start = right.solve(Pose(), Velocity(V), load=0.5 * down, friction=0.0)
    x = np.array([0.0, held if stiffness > 0.0 else 0.0, start.z, 0.0, -V / nominal_radius])
    left_over, slopes, both = balance(x)
    for _ in range(_MOST):
        if np.abs(left_over).max() < _TOLERANCE * weight:
            inner, outer = both
            limit = lookup("normal", options.get("normal", DEFAULT_NORMAL)).gap_limit
            doubt_answer(set(), limit, gap_error=max(inner.gap_error, outer.gap_error))
            return Curving(
                y=float(x[0]),
                yaw=float(x[1]),
                roll=float(x[3]),
                z=float(x[2]),
                spin=float(x[4]),
                lateral=float(both[0].force[1] + both[1].force[1]),
                steering=float(both[0].moment[2] + both[1].moment[2]),
                outer=outer,
                inner=inner,
            )
        step = np.linalg.lstsq(slopes, -left_over, rcond=None)[0]
        largest = _LARGEST.copy()
        largest[4] = _AROUND * abs(x[4])
        share = min(1.0, float((largest / np.maximum(np.abs(step), 1e-300)).min()))
        before = float(np.linalg.norm(left_over))
        for _ in range(6):
            found = balance(x + share * step)
            if float(np.linalg.norm(found[0])) < before:
                break
            share *= 0.5
        x = x + share * step
        left_over, slopes, both = found
    raise ContactError(
        f"radius = {radius:g}, speed = {speed:g}, cant = {cant:g}: no steady motion was found; {np.abs(left_over).max():.3g} N "
        "or N m are left. A flange may climb, or the wheelset slide: look at cant and friction"
    )
