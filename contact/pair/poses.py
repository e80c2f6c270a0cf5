"""`over_poses`: solve a wheel on its rail for arrays of poses, loads and creepages, on several threads."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, brief, broadcast, require_aligned, require_numbers
from contact.errors import ContactError
from contact.forces import cores
from contact.friction import Friction
from contact.geometry.posed import MAX_PENETRATION
from contact.geometry.wheelset import Pair
from contact.inputs.options import CREEPAGE, FRICTION, LOAD
from contact.inputs.plausibility import doubt_values
from contact.instance.case import set_surface
from contact.kernels.enumerations import Height
from contact.kernels.records import GIVEN, LARGEST_ANGLE, TOTAL
from contact.pair.wheel_rail import WheelRailPair
from contact.results import Status
from contact.results.later import arrays_of
from contact.view.tables import ArrayOfResults

_CHUNK = 64  # poses between two reports of progress


@dataclass(frozen=True, eq=False)
class PoseForces(ArrayOfResults):
    """Action of one rail on the wheelset at each pose. Arrays of the broadcast shape; names and units of `PairSolution`.

    `Fx`, `Fy`, `Fz` and `Mx`, `My`, `Mz` are the components of its `force` and `moment`. A pose without an answer, because the
    profiles do not overlap or no height carries the load, has NaN and the status OUT_OF_RANGE. In
    `to_dataframe` and `to_xarray` inputs name the axes along which they vary.
    """

    Fx: Array
    Fy: Array
    Fz: Array
    Mx: Array
    My: Array
    Mz: Array
    N: Array
    Q: Array
    Y: Array
    z: Array
    max_pressure: Array
    area: Array
    slip_area: Array
    power_per_metre: Array
    T_gamma: Array
    used_friction: Array
    gap_error: Array
    n_patches: NDArray[np.int64]
    status: NDArray[np.int64]

    __repr__ = brief


_FLOATS = [name for name in TOTAL.names or () if TOTAL[name].kind == "f"]


def over_poses(
    pair: WheelRailPair,
    *,
    y: ArrayLike = 0.0,
    z: ArrayLike = 0.0,
    roll: ArrayLike = 0.0,
    yaw: ArrayLike = 0.0,
    load: ArrayLike | None = None,
    penetration: ArrayLike | None = None,
    longitudinal: ArrayLike = 0.0,
    lateral: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
    speed: ArrayLike = 20.0,
    friction: ArrayLike | Friction = 0.3,
    threads: int | None = None,
    progress: Callable[[float, str], None] | None = None,
) -> PoseForces:
    """Return forces, patches and damage of one wheel on its rail for arrays of poses.

    The kernel is that of `WheelRailPair.solve`. Every pose is a cold start, so the results depend neither on the order of the
    poses nor on the number of threads.

    Parameters
    ----------
    pair : WheelRailPair
        Of profiles that are constant along the way. It is copied for each thread and does not change.
    y, z : array_like
        Lateral and vertical displacement of the wheelset [m], in track coordinates. z is ignored if a load or a
        penetration is given. All arrays broadcast.
    roll, yaw : array_like
        Roll and yaw [rad], within ±0.1.
    load, penetration : array_like
        Vertical load of the wheel [N], or depth below first touch [m]. Give one of them at most.
    longitudinal, lateral, spin : array_like
        Creepages of the wheelset [-], [-], [1/m], in addition to those of rolling at this pose: slip of the axle's rotation,
        1 + rotation·nominal radius/speed; lateral velocity over the speed; yaw rate over the speed. Positive longitudinal
        creepage brakes.
    speed : array_like
        Forward speed [m/s], positive.
    friction : array_like or contact.friction.Friction
        Coefficient of friction [-], or a friction law common to all poses.
    threads : int
        Number of threads; default all cores that the process may use. The kernels release the GIL.
    progress : callable
        Called with the share that is done, 0 to 1, and a description.

    Returns
    -------
    PoseForces

    Raises
    ------
    ContactError
        For input outside its range or shapes that do not broadcast.

    Warns
    -----
    PlausibilityWarning
        For poses, loads, speeds, creepages or friction that no wheelset has, once for each argument.
    """
    if not isinstance(pair, WheelRailPair) or not isinstance(pair.pair, Pair):
        raise ContactError(f"pair = {pair!r} is not a contact.pair.WheelRailPair of two profiles")
    if load is not None and penetration is not None:
        raise ContactError("load and penetration exclude each other")
    surface, coefficients = (friction, friction.static) if isinstance(friction, Friction) else (None, friction)
    mode, limited = Height.GIVEN, require_numbers("z", z)
    if load is not None:
        mode, limited = Height.LOAD, require_numbers("load", load, *LOAD.bounds)
        doubt_values("wheel load", limited)
    elif penetration is not None:
        mode, limited = Height.PENETRATION, require_numbers("penetration", penetration, 0.0, MAX_PENETRATION)
    columns = {
        "pose.y": require_numbers("y", y),
        "pose.roll": require_numbers("roll", roll, -LARGEST_ANGLE, LARGEST_ANGLE),
        "pose.yaw": require_numbers("yaw", yaw, -LARGEST_ANGLE, LARGEST_ANGLE),
        "creepage.longitudinal": require_numbers("longitudinal", longitudinal, *CREEPAGE.bounds),
        "creepage.lateral": require_numbers("lateral", lateral, *CREEPAGE.bounds),
        "creepage.spin": require_numbers("spin", spin, *CREEPAGE.bounds),
        "speed": require_numbers("speed", speed, np.finfo(float).tiny),
        "friction": require_numbers("friction", coefficients, *FRICTION.bounds),
    }
    for name, values in columns.items():
        doubt_values(name, values)
    height = {Height.GIVEN: "z", Height.LOAD: "load", Height.PENETRATION: "penetration"}[mode]
    require_aligned(
        y=y,
        z=z,
        roll=roll,
        yaw=yaw,
        load=load,
        penetration=penetration,
        longitudinal=longitudinal,
        lateral=lateral,
        spin=spin,
        speed=speed,
        friction=coefficients,
    )
    spread = broadcast({height: limited, **columns})
    shape = spread[0].shape
    amount, y_, roll_, yaw_, vx, vy, phi, V, mu = (np.ravel(values) for values in spread)
    given = np.zeros(amount.size, GIVEN)
    given["y"], given["roll"], given["yaw"] = y_, roll_, yaw_
    given["vx"], given["vy"], given["yaw_rate"] = V, V * vy, V * phi
    given["spin"] = (vx - 1.0) * V / pair.pair.nominal_radius
    if mode == Height.GIVEN:
        given["z"] = amount
    found = np.zeros(amount.size, TOTAL)
    count = min(threads or cores(), max(1, amount.size))
    done = np.zeros(count, np.int64)

    def work(thread: int) -> None:
        copied = pair.again()
        arrays, solve = copied.arrays, copied.solve_given
        set_surface(arrays.case, surface or Friction(0.0), 0.0)
        case = {name: arrays.case[name] for name in ("speed", "mu", "kinetic")}
        for k in range(thread, amount.size, count):
            case["speed"][0] = V[k]
            if surface is None:
                case["mu"][0] = case["kinetic"][0] = mu[k]
            copied.forget()
            if solve(mode, amount[k], given[k]) < 0:
                for name in _FLOATS:
                    found[name][k] = np.nan
                found["status"][k] = Status.OUT_OF_RANGE
            else:
                found[k] = arrays.total[0]
            done[thread] += 1
            if progress is not None and thread == 0 and done[0] % _CHUNK == 0:
                progress(float(done.sum()) / amount.size, f"{done.sum()} of {amount.size} poses")

    if count == 1:
        work(0)
    else:
        with ThreadPoolExecutor(count) as pool:
            list(pool.map(work, range(count)))
    inputs = {name.rpartition(".")[2]: values for name, values in columns.items()}
    return PoseForces(**arrays_of(PoseForces, found, shape))._with_inputs({**inputs, height: limited})
