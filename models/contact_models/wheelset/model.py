"""The wheelset as a simulator: inputs are forces, outputs are geometry, creepages and loads (readme.md)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.core import pack
from contact.errors import ContactError, require_number
from contact.geometry.wheelset import Pair
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.records import GIVEN
from . import dynamics, motion
from .parameters import WheelsetParameters
from .ports import POINTS, SIDES


class WheelsetModel(OwnsArrays):
    """One wheelset with contact forces as inputs.

    All outputs belong to the instant after the last `step`. `side` is "right" or "left".

    Parameters
    ----------
    parameters : WheelsetParameters

    Raises
    ------
    ContactError
        If the wheels have no contact with the rails at the initial position.
    """

    def __init__(self, parameters: WheelsetParameters | None = None) -> None:
        self.parameters = p = parameters or WheelsetParameters()
        # All of the model's state lies in one vector, so saving the state is copying this vector.
        sizes = [math.prod(shape) for shape in motion.REMEMBERED.values()]
        self._memory = np.zeros(sum(sizes))
        parts = np.split(self._memory, np.cumsum(sizes)[:-1])
        remembered = {
            name: part.reshape(shape) for part, (name, shape) in zip(parts, motion.REMEMBERED.items(), strict=True)
        }
        samples = p.window_start + p.window_step * np.arange(POINTS)
        right, left = (
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
        self._wheelset = motion.Wheelset(
            constants=_constants(p),
            **remembered,
            given=np.zeros(1, GIVEN),
            right=right.space,
            left=left.space,
        )
        self._packed = pack(motion.Wheelset, self._wheelset)  # its words do not change
        self._require(
            motion.begin(self._packed, p.lateral, p.yaw, p.lateral_velocity, p.yaw_rate, p.approach), self._memory
        )

    def _kept(self) -> Any:
        return self._memory.copy()

    def _keep(self, kept: Any) -> None:
        self._memory[:] = kept

    # inputs

    @one_thread
    def set_forces(self, side: str, Fx: float, Fy: float, Mz: float, approach: float) -> None:
        """Set forces [N] and moment [N m] of a contact on the wheel, in its contact frame, and its approach [m].

        They are held until they are set again.
        """
        i = SIDES.index(side)
        forces = [require_number(f"{side}.{name}", v) for name, v in zip(("Fx", "Fy", "Mz"), (Fx, Fy, Mz), strict=True)]
        self._wheelset.approach[i] = require_number(f"{side}.approach", approach)
        self._wheelset.forces[i] = forces

    @one_thread
    def set_irregularity(self, lateral: float, slope: float) -> None:
        """Set the lateral position [m] of the track's centre line below the wheelset, and its slope dy/dx [-]."""
        self._wheelset.irregularity[:] = (
            require_number("irregularity.lateral", lateral),
            require_number("irregularity.slope", slope),
        )

    # motion

    @one_thread
    def step(self, h: float) -> None:
        """Advance by `h` [s] with the forces held.

        Raises
        ------
        ContactError
            If `h` is not positive or a wheel leaves its rail. The state is then unchanged.
        """
        require_number("h", h, 0.0, open_minimum=True)
        before = self._memory.copy()
        self._require(motion.step(self._packed, h, self.parameters.substeps), before)

    @one_thread
    def rates(self) -> Array:
        """Return the time derivatives of (lateral, yaw, lateral_velocity, yaw_rate, spin) under the present forces."""
        motion.balance(self._packed)
        motion.change(self._packed)
        return self._wheelset.rates.copy()

    def _require(self, failure: int, before: Array) -> None:
        """If there is a failure, restore the state `before` and raise a ContactError with the reason."""
        if failure:
            y, yaw = self._wheelset.state[:2] - self._wheelset.irregularity
            self._memory[:] = before
            raise ContactError(f"{motion.MESSAGES[failure]} at y = {y:g} m, yaw = {yaw:g} rad")

    # outputs

    @one_thread
    def problem(self, side: str) -> Array:
        """Return the inputs of the contact of one side, in the order of `ports.PROBLEM`."""
        return self._wheelset.problems[SIDES.index(side)].copy()

    @one_thread
    def frame(self, side: str) -> Array:
        """Return the contact origin x, y, z [m] relative to the wheelset's centre, and the contact angle [rad]."""
        return self._wheelset.frames[SIDES.index(side)].copy()

    @one_thread
    def motion(self) -> Array:
        """Return the motion in the order of `ports.MOTION`."""
        return np.concatenate((self._wheelset.state, self._wheelset.height))

    @one_thread
    def energy(self) -> Array:
        """Return the energies [J] in the order of `ports.ENERGY`."""
        return np.append(self._wheelset.energy, motion.mechanical_energy(self._packed))

    @one_thread
    def change(self) -> Array:
        """Return the rates of the last report in the order of `ports.CHANGE`."""
        return np.concatenate((self._wheelset.rates[dynamics.StateRow.LATERAL_VELOCITY :], self._wheelset.powers))

    @property
    @one_thread
    def mechanical_energy(self) -> float:
        """Kinetic energy without that of V, energy of the springs, and potential energy of the weight [J] (10)."""
        return motion.mechanical_energy(self._packed)

    @one_thread
    def save(self) -> bytes:
        """Return the whole state, including held inputs."""
        return self._memory.tobytes()

    @one_thread
    def restore(self, state: bytes) -> None:
        """Restore a state from `save`. The following results are repeated bit by bit."""
        saved = np.frombuffer(state)
        if saved.size != self._memory.size:
            raise ContactError(f"state has {len(state)} bytes; {self._memory.nbytes} are needed")
        self._memory[:] = saved


def _constants(p: WheelsetParameters) -> Array:
    """Return the constants as the array for the kernels of `dynamics`."""
    constants = np.zeros(dynamics.N_CONSTANTS)
    for index, value in (
        (dynamics.Constant.MASS, p.mass),
        (dynamics.Constant.YAW_INERTIA, p.yaw_inertia),
        (dynamics.Constant.SPIN_INERTIA, p.spin_inertia),
        (dynamics.Constant.LATERAL_STIFFNESS, p.lateral_stiffness),
        (dynamics.Constant.YAW_STIFFNESS, p.yaw_stiffness),
        (dynamics.Constant.LATERAL_DAMPING, p.lateral_damping),
        (dynamics.Constant.YAW_DAMPING, p.yaw_damping),
        (dynamics.Constant.AXLE_LOAD, p.axle_load),
        (dynamics.Constant.SPEED, p.speed),
        (dynamics.Constant.RADIUS, p.radius),
    ):
        constants[index] = value
    return constants
