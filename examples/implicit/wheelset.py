"""A wheelset with the contact inside the right-hand side, and its derivatives as the Jacobian of an implicit integrator.

python examples/implicit/wheelset.py [--seconds 0.5] [--out implicit.png]

A rigid wheelset S1002 on rails 60E1 (1:40) runs at constant speed over a lateral step of the track. It has springs and dampers
to a frame that does not move. The states are y, z, roll, yaw and their rates, and the spin. Four ways to integrate it are
compared (docs/use/implicit.md): SciPy's methods with the exact Jacobian and with their own differences, an implicit Runge-Kutta
method with fixed steps, and forces that are a step late, as between two programs.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from contact.arrays import Array
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import WheelRailPair

SPEED, RADIUS, LOAD, FRICTION = 20.0, 0.460, 160e3, 0.3
#: Mass [kg], and moments of inertia about the track [kg m²] and about the axle.
MASS, INERTIA, ABOUT_AXLE = 1800.0, 1000.0, 100.0
#: Springs and dampers to the frame: lateral, roll, yaw [N/m, N m/rad; per second].
SPRINGS, DAMPERS = np.array([2e6, 0.0, 4e6, 4e6]), np.array([2e4, 0.0, 2e4, 2e4])
#: The track moves sideways by this [m], over this length [m].
SHIFT, LENGTH = 4e-3, 2.0
#: Sizes of the states that count as 1 for tolerances.
UNITS = np.array([1e-3, 1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-2, 1e-2, 1e-1])

_POSE = ("pose.y", "pose.z", "pose.roll", "pose.yaw")
_RATES = ("velocity.y", "velocity.z", "velocity.roll", "velocity.yaw", "velocity.spin")


def _track(t: float) -> Irregularity:
    """Return where the rails are below the wheelset."""
    u = min(max(SPEED * t / LENGTH, 0.0), 1.0)
    return Irregularity(y=SHIFT * u * u * (3.0 - 2.0 * u), y_rate=SHIFT * 6.0 * u * (1.0 - u) * SPEED / LENGTH)


@dataclass
class Wheelset:
    """Right-hand side and Jacobian of the motion. Both come from the same solutions of the contacts."""

    pairs: list[WheelRailPair] = field(default_factory=list)
    calls: int = 0
    jacobians: int = 0

    def __post_init__(self) -> None:
        wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
        self.pairs = [WheelRailPair(Pair(wheel, rail, side=side, nominal_radius=RADIUS)) for side in ("left", "right")]
        self._columns: list[int] = []

    def start(self) -> Array:
        """Return the states of a centred wheelset, at rest against the track, under its load."""
        z = self.pairs[0].solve(Pose(), Velocity(SPEED), vertical=0.5 * LOAD, friction=FRICTION).z
        return np.array([0.0, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -SPEED / RADIUS])

    def _contacts(self, t: float, x: Array, derivatives: bool) -> tuple[Array, Array]:
        """Return the forces (Fx, Fy, Fz, Mx, My, Mz) of both rails, and their derivatives by the states."""
        pose, velocity = Pose(*x[:4]), Velocity(SPEED, *x[4:])
        forces, slopes = np.zeros(6), np.zeros((6, 9))
        for pair in self.pairs:
            found = pair.solve(pose, velocity, irregularity=_track(t), friction=FRICTION, derivatives=derivatives)
            forces += np.concatenate((found.force, found.moment))
            if found.jacobian is not None:
                columns = [found.jacobian.columns.index(name) for name in (*_POSE, *_RATES)]
                slopes += found.jacobian.values[:6, columns]
        return forces, slopes

    def forces(self, t: float, x: Array) -> Array:
        """Return the forces of both rails."""
        self.calls += 1
        return self._contacts(t, x, False)[0]

    def motion(self, x: Array, forces: Array) -> Array:
        """Return the rates of the states under these forces."""
        _, Fy, Fz, Mx, My, Mz = forces
        push = np.array([Fy, Fz + LOAD, Mx, Mz]) - SPRINGS * x[:4] - DAMPERS * x[4:8]
        about_axle = My - x[3] * forces[3] + x[2] * Mz
        return np.concatenate((x[4:8], push / [MASS, MASS, INERTIA, INERTIA], [about_axle / ABOUT_AXLE]))

    def rates(self, t: float, x: Array) -> Array:
        """Return dx/dt."""
        return self.motion(x, self.forces(t, x))

    def jacobian(self, t: float, x: Array) -> Array:
        """Return the derivatives of `rates` by the states."""
        self.jacobians += 1
        forces, slopes = self._contacts(t, x, True)
        of = np.zeros((9, 9))
        of[range(4), range(4, 8)] = 1.0
        of[4:8] = slopes[[1, 2, 3, 5]]
        of[range(4, 8), range(4)] -= SPRINGS
        of[range(4, 8), range(4, 8)] -= DAMPERS
        of[4:8] /= np.array([MASS, MASS, INERTIA, INERTIA])[:, None]
        of[8] = slopes[4] - x[3] * slopes[3] + x[2] * slopes[5]
        of[8, 3] -= forces[3]
        of[8, 2] += forces[5]
        of[8] /= ABOUT_AXLE
        return of


def fixed_steps(wheelset: Wheelset, seconds: float, h: float) -> Array:
    """Integrate with fixed steps by the L-stable two-stage SDIRK method of order 2 and Newton's method. Return y(t)."""
    gamma = 1.0 - 0.5 * np.sqrt(2.0)
    x, path = wheelset.start(), []
    for step in range(round(seconds / h)):
        t, slope = step * h, np.zeros(9)
        for stage, at in ((0, gamma), (1, 1.0)):
            base = x + h * (1.0 - gamma) * slope * stage
            new = base + h * gamma * slope
            inverse = np.linalg.inv(np.eye(9) - h * gamma * wheelset.jacobian(t + at * h, new))
            for _ in range(8):
                slope = wheelset.rates(t + at * h, new)
                change = inverse @ (base + h * gamma * slope - new)
                new = new + change
                if np.abs(change / UNITS).max() < 1e-5:
                    break
            slope = (new - base) / (h * gamma)
        x = new
        path.append(x[0])
        if not np.abs(x[:4]).max() < 0.1:
            break
    return np.array(path)


def a_step_late(wheelset: Wheelset, seconds: float, h: float) -> Array:
    """Integrate with the forces of the begin of the step, as two programs do. Return y(t), until wheels leave the rails.

    They have left where the wheelset is half a millimetre off its height; the rails are compressed by a tenth.
    """
    x, path = wheelset.start(), []
    height = x[1]
    for step in range(round(seconds / h)):
        rates = wheelset.rates(step * h, x)
        x[:4] += h * x[4:8] + 0.5 * h * h * rates[4:8]
        x[4:] += h * rates[4:]
        path.append(x[0])
        if not abs(x[1] - height) < 5e-4:
            break
    return np.array(path)


def by_scipy(wheelset: Wheelset, seconds: float, jac: Any, rtol: float, method: str = "Radau") -> Any:
    """Integrate by SciPy. Return its answer."""
    start = wheelset.start()
    times = np.linspace(0.0, seconds, 501)
    return solve_ivp(
        wheelset.rates,
        (0.0, seconds),
        start,
        method,
        t_eval=times,
        jac=jac,
        rtol=rtol,
        atol=rtol * UNITS,
        first_step=1e-4,
    )


def main(arguments: list[str] | None = None) -> None:
    """Print the table, and draw y(t)."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=0.5)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args(arguments)
    seconds, wheelset = options.seconds, Wheelset()
    fine = 1e-4
    reference = fixed_steps(wheelset, seconds, fine)
    at = np.arange(1, reference.size + 1) * fine
    drawn = {"reference": (at, reference)}

    def report(name: str, run: Any, times: Any) -> None:
        wheelset.calls = wheelset.jacobians = 0
        begun = time.perf_counter()
        try:
            found = run()
        except ContactError as error:  # a trial step puts the wheel beside or inside its rail
            print(f"{name:42} {wheelset.calls:7} {wheelset.jacobians:6}   fails: {error}")
            return
        spent = time.perf_counter() - begun
        t, y = times(found)
        whole = t.size and t[-1] > 0.99 * seconds
        error = np.abs(y - np.interp(t, at, reference)).max() if whole else np.nan
        outcome = f"{1e6 * error:8.1f} µm" if whole else f"  gone at {t[-1] * 1e3:.0f} ms"
        print(f"{name:42} {wheelset.calls:7} {wheelset.jacobians:6} {spent:7.2f} s {outcome}")
        drawn[name] = t, y

    print(f"{'':42} {'forces':>7} {'jac.':>6} {'time':>9} {'error of y':>11}")
    for method in ("Radau", "BDF"):
        for name, jac in (("the derivatives", wheelset.jacobian), ("its own differences", None)):
            report(
                f"{method}, {name}",
                lambda m=method, j=jac: by_scipy(wheelset, seconds, j, 1e-3, m),
                lambda f: (f.t, f.y[0]),
            )
    for h in (5e-4, 1e-3, 2e-3, 5e-3):
        report(
            f"fixed steps of {h * 1e3:g} ms",
            lambda h=h: fixed_steps(wheelset, seconds, h),
            lambda f, h=h: (np.arange(1, f.size + 1) * h, f),
        )
    for h in (2e-5, 5e-5, 1e-4, 1e-3):
        report(
            f"a step late, {h * 1e3:g} ms",
            lambda h=h: a_step_late(wheelset, seconds, h),
            lambda f, h=h: (np.arange(1, f.size + 1) * h, f),
        )
    if options.out:
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
        for name, (t, y) in drawn.items():
            if np.abs(y).max() < 0.02:
                axes.plot(1e3 * t, 1e3 * y, label=name, linewidth=3 if name == "reference" else 1)
        axes.set_xlabel("time [ms]")
        axes.set_ylabel("y [mm]")
        axes.legend(fontsize=7)
        figure.savefig(options.out, dpi=120)


if __name__ == "__main__":
    main()
