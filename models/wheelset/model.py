"""The wheelset as a simulator: forces in, geometry, creepages and loads out (readme.md)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, require_number
from contact.geometry import layout as patch_rows
from contact.geometry.wheelset import Pair, Pose
from models.wheelset import dynamics
from models.wheelset.parameters import WheelsetParameters
from models.wheelset.ports import CREEPAGE, CURVATURE, GAP, LOAD, POINTS, SIDES

Array = NDArray[np.float64]

#: Least approach that a contact frame is laid out for [m]; an unloaded wheel still has a place where it would touch.
LEAST_APPROACH = 5e-6
_ROLL_RANGE = 0.1  # [rad] lifts a wheel by 75 mm
_ROLL_TOLERANCE = 1e-13  # [m] difference of the two wheels' heights

# Everything that the model remembers lies in one vector, so that saving it is copying it.
_LAYOUT = {
    "clock": (1,),
    "state": (dynamics.N_STATE,),
    "energy": (dynamics.N_ENERGY,),
    "height": (2,),  # vertical [m], roll [rad]
    "irregularity": (2,),  # of the centre line: lateral [m], slope [-]
    "forces": (2, 3),
    "approach": (2,),
    "frames": (2, 4),
    "loads": (2,),
    "resultants": (5,),
    "problems": (2, LOAD + 1),
}


class WheelsetModel:
    """One wheelset on straight track whose contact forces come from outside.

    Between two calls of `step` the model is at one instant and all outputs belong to it. `side` is "right" or "left".

    Parameters
    ----------
    parameters : WheelsetParameters

    Raises
    ------
    ContactError
        When the wheels do not find their rails at the initial position.
    """

    def __init__(self, parameters: WheelsetParameters | None = None) -> None:
        self.parameters = p = parameters or WheelsetParameters()
        self._memory = np.zeros(sum(math.prod(shape) for shape in _LAYOUT.values()))
        ends = np.cumsum([math.prod(shape) for shape in _LAYOUT.values()])
        parts = np.split(self._memory, ends[:-1])
        views = {name: part.reshape(shape) for (name, shape), part in zip(_LAYOUT.items(), parts, strict=True)}
        self._clock, self._state, self._energy = views["clock"], views["state"], views["energy"]
        self._height, self._irregularity = views["height"], views["irregularity"]
        self._forces, self._approach, self._frames = views["forces"], views["approach"], views["frames"]
        self._loads, self._resultants, self._problems = views["loads"], views["resultants"], views["problems"]

        self._constants = np.empty(dynamics.N_CONSTANTS)
        for index, value in (
            (dynamics.MASS, p.mass),
            (dynamics.YAW_INERTIA, p.yaw_inertia),
            (dynamics.SPIN_INERTIA, p.spin_inertia),
            (dynamics.LATERAL_STIFFNESS, p.lateral_stiffness),
            (dynamics.YAW_STIFFNESS, p.yaw_stiffness),
            (dynamics.LATERAL_DAMPING, p.lateral_damping),
            (dynamics.YAW_DAMPING, p.yaw_damping),
            (dynamics.AXLE_LOAD, p.axle_load),
            (dynamics.SPEED, p.speed),
        ):
            self._constants[index] = value
        samples = p.window_start + p.window_step * np.arange(POINTS)
        self._pairs = tuple(
            Pair(
                p.wheel,
                p.rail,
                side=side,
                nominal_radius=p.radius,
                gauge=p.gauge,
                gauge_point=p.gauge_point,
                flange_back=p.flange_back,
                combine_distance=1.0,  # all lobes of a wheel share one plane
                samples=samples if side == "right" else -samples[::-1],
            )
            for side in SIDES
        )
        self._axle = np.array([0.0, 1.0, 0.0])
        self._state[: dynamics.SPIN] = p.lateral, p.yaw, p.lateral_velocity, p.yaw_rate
        self._approach[:] = p.approach
        self._meet_rails()
        y, z = self._frames[:, dynamics.Y], self._frames[:, dynamics.Z]
        rolling_radius = float((self._axle[1] * z - self._axle[2] * y).mean())
        self._state[dynamics.SPIN] = p.speed / rolling_radius
        self._balance()
        self._report()

    # inputs

    def set_forces(self, side: str, Fx: float, Fy: float, Mz: float, approach: float) -> None:
        """Forces [N] and moment [N m] of a contact on the wheel, in its contact frame, and its approach [m]; held."""
        i = SIDES.index(side)
        forces = [require_number(f"{side}.{name}", v) for name, v in zip(("Fx", "Fy", "Mz"), (Fx, Fy, Mz), strict=True)]
        self._approach[i] = require_number(f"{side}.approach", approach)
        self._forces[i] = forces

    def set_irregularity(self, lateral: float, slope: float) -> None:
        """Lateral position [m] of the track's centre line below the wheelset, and its slope dy/dx [-]."""
        self._irregularity[:] = (
            require_number("irregularity.lateral", lateral),
            require_number("irregularity.slope", slope),
        )

    # motion

    def step(self, h: float) -> None:
        """Advance by `h` [s] with the forces held.

        Raises
        ------
        ContactError
            `h` not positive, or a wheel left its rail; the model is then where it was.
        """
        before = self._memory.copy()
        substeps = self.parameters.substeps
        dt = require_number("h", h, 0.0, open_minimum=True) / substeps
        try:
            self._balance()
            for _ in range(substeps):
                self._advance(dt)
            self._report()
        except ContactError:
            self._memory[:] = before
            raise

    def rates(self) -> Array:
        """Time derivatives of (lateral, yaw, lateral_velocity, yaw_rate, spin) under the forces set last."""
        p, (y, yaw, v, w, _) = self.parameters, self._state
        self._balance()
        Q = self._resultants
        return np.array(
            [
                v,
                w,
                (Q[0] - p.lateral_stiffness * y - p.lateral_damping * v) / p.mass,
                (Q[1] - p.yaw_stiffness * yaw - p.yaw_damping * w) / p.yaw_inertia,
                Q[2] / p.spin_inertia,
            ]
        )

    def _advance(self, dt: float) -> None:
        """One step of the Strang splitting: kick, drift, kick (8)."""
        dynamics.kick(self._state, self._constants, self._resultants, 0.5 * dt, self._energy)
        dynamics.drift(self._state, dt)
        self._clock[0] += dt
        self._irregularity[0] += self._irregularity[1] * self.parameters.speed * dt
        before, moment = self._height.copy(), self._resultants[4]
        self._meet_rails()
        self._balance()
        fall, roll = self._height - before
        roll_work = 0.5 * (moment + self._resultants[4]) * roll
        self._energy[dynamics.INTERFACE] += self.parameters.axle_load * fall - roll_work
        self._energy[dynamics.DRIVE] -= roll_work
        dynamics.kick(self._state, self._constants, self._resultants, 0.5 * dt, self._energy)

    def _meet_rails(self) -> None:
        """Roll, height and contact frames at the present position."""
        y, yaw = self._state[:2] - self._irregularity
        roll, z = self._settle(float(y), float(yaw), float(self._height[1]))
        self._height[:] = z, roll
        self._axle[:] = -math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)
        pose = Pose(float(y), z, roll, float(yaw))
        for i, pair in enumerate(self._pairs):
            m = 1.0 - 2.0 * i  # the left side is the mirror image of the right
            if pair.locate(pose) == 0:
                raise ContactError(f"the {SIDES[i]} wheel finds no contact at y = {y:g} m, yaw = {yaw:g} rad")
            patch, separation = pair.patches[0], pair.separations[0]
            frame = self._frames[i]
            frame[dynamics.Y] = m * patch[patch_rows.PATCH_Y] - y
            frame[dynamics.Z] = patch[patch_rows.PATCH_Z] - (z - self.parameters.radius)
            frame[dynamics.ANGLE] = m * patch[patch_rows.PATCH_ANGLE]
            frame[dynamics.X] = dynamics.locus(frame, self._axle)
            order = slice(None, None, int(m))
            self._problems[i, GAP] = separation[patch_rows.SEP_G, order]
            self._problems[i, CURVATURE] = separation[patch_rows.SEP_A, order]

    def _settle(self, y: float, yaw: float, roll: float) -> tuple[float, float]:
        """Roll [rad] at which both wheels sink into their rails by the approach at one height, and that height [m] (1).

        The difference of heights falls with roll while tan δ < 2 b0/r0 (73°), so a secant is kept in a bracket.
        """
        right, left = self._pairs
        sink_right, sink_left = np.maximum(self._approach, LEAST_APPROACH).tolist()
        low, high = roll - _ROLL_RANGE, roll + _ROLL_RANGE
        slope = -2.0 * abs(self._frames[0, dynamics.Y] or 0.75)
        last: tuple[float, float] | None = None
        for _ in range(60):
            pose = Pose(y, 0.0, roll, yaw)
            z_right, z_left = right.touch(pose) + sink_right, left.touch(pose) + sink_left
            f = z_right - z_left
            if abs(f) <= _ROLL_TOLERANCE or high - low <= _ROLL_TOLERANCE:
                return roll, 0.5 * (z_right + z_left)
            low, high = (roll, high) if f > 0.0 else (low, roll)
            if last is not None and f != last[1]:
                slope = (f - last[1]) / (roll - last[0])
            last = roll, f
            roll -= f / slope
            if not low < roll < high:
                roll = 0.5 * (low + high)
        raise ContactError(f"no roll angle brings both wheels onto the rails at y = {y:g} m, yaw = {yaw:g} rad")

    def _balance(self) -> None:
        """Normal loads and generalised forces of the present frames and held creep forces."""
        dynamics.normal_loads(self._frames, self._forces, self.parameters.axle_load, self._loads)
        dynamics.resultants(self._frames, self._forces, self._loads, self._axle, self._resultants)

    def _report(self) -> None:
        """Creepages and loads of the present motion."""
        speed = self.parameters.speed
        relative = self._state.copy()
        relative[dynamics.LATERAL_VELOCITY] -= speed * self._irregularity[1]
        z_rate, roll_rate = dynamics.follow(self._frames, relative)
        for frame, problem, load in zip(self._frames, self._problems, self._loads, strict=True):
            dynamics.creepages(frame, relative, self._axle, z_rate, roll_rate, speed, problem[CREEPAGE])
            problem[LOAD] = load

    # outputs

    def problem(self, side: str) -> Array:
        """What the contact of one side has to solve, in the order of `ports.PROBLEM`."""
        return self._problems[SIDES.index(side)].copy()

    def frame(self, side: str) -> Array:
        """Contact origin x, y, z [m] relative to the wheelset's centre, and contact angle [rad]."""
        return self._frames[SIDES.index(side)].copy()

    def motion(self) -> Array:
        """In the order of `ports.MOTION`."""
        return np.concatenate((self._state, self._height))

    def energy(self) -> Array:
        """In the order of `ports.ENERGY`."""
        return np.append(self._energy, self.mechanical_energy)

    @property
    def time(self) -> float:
        """Time since start [s]."""
        return float(self._clock[0])

    @property
    def mechanical_energy(self) -> float:
        """Kinetic energy (without that of V), of the springs, and of the weight [J] (10)."""
        p, (y, yaw, v, w, spin) = self.parameters, self._state.tolist()
        kinetic = 0.5 * (p.mass * v**2 + p.yaw_inertia * w**2 + p.spin_inertia * spin**2)
        springs = 0.5 * (p.lateral_stiffness * y**2 + p.yaw_stiffness * yaw**2)
        return kinetic + springs - p.axle_load * float(self._height[0])

    def save(self) -> bytes:
        """All of the state, held inputs included."""
        return self._memory.tobytes()

    def restore(self, state: bytes) -> None:
        """Return to a state of `save`; what follows is repeated bit by bit."""
        saved = np.frombuffer(state)
        if saved.size != self._memory.size:
            raise ContactError(f"state has {len(state)} bytes; {self._memory.nbytes} are needed")
        self._memory[:] = saved
        _, roll = self._height
        yaw = self._state[dynamics.YAW] - self._irregularity[1]
        self._axle[:] = -math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)
