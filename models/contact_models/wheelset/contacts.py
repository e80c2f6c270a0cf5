"""The contact of one wheel as a Python object, and what every contact reports (`.fmu.InFmu` is the FMU `WheelRailPair`)."""

from __future__ import annotations

from dataclasses import astuple

import numpy as np

from contact.arrays import Array
from contact.geometry.wheelset import Irregularity, Pose, Velocity
from contact.pair import WheelRailPair
from ..vehicle.kernels.layout import ELASTIC

#: What a contact reports besides its answer: of the patch with the largest normal force its angle [rad] and creepages
#: [-, -, 1/m]; frictional power [W], pressure [Pa], share of slip, wear number [N] and status of the whole.
REPORT = (
    *("angle", "creepage.longitudinal", "creepage.lateral", "creepage.spin"),
    *("power.friction", "pressure.max", "slip.ratio", "damage.T_gamma", "status"),
)
#: Of each patch, by the names of the FMU.
PATCH = ("n", "fx", "fy", "mz", "longitudinal", "lateral", "spin", "approach", "angle")


class ReportingContact:
    """A contact that keeps the report of its last answer."""

    report: Array = np.zeros(len(REPORT))

    def answer(self, question: Array, time: float, step: float) -> Array:
        """Return the answer, as `contact_models.vehicle.coupling.Contact`."""
        raise NotImplementedError

    def _answer(self, wrench: Array, patches: Array, whole: Array) -> Array:
        """Return the answer from the wrench, the values `PATCH` of each patch and those of the whole."""
        n, fx, fy, mz, longitudinal, lateral, spin, approach, angle = patches.T
        k = int(np.argmax(n)) if n.size else 0
        of_patch = (angle[k], longitudinal[k], lateral[k], spin[k]) if n.size else (0.0,) * 4
        self.report = np.array([*of_patch, *whole])
        dissipation = -float(np.sum(fx * longitudinal + fy * lateral + mz * spin))
        return np.array([*wrench, n.sum(), dissipation, ELASTIC * float(np.dot(n, approach))])


class InPython(ReportingContact):
    """A `contact.pair.WheelRailPair`."""

    def __init__(self, pair: WheelRailPair) -> None:
        self._pair = pair

    def answer(self, question: Array, time: float, step: float) -> Array:
        y, z, roll, yaw, *rest = question.tolist()
        velocity, irregularity, friction = Velocity(*rest[:6]), Irregularity(*rest[6:12]), rest[12]
        found = self._pair.solve(Pose(y, z, roll, yaw), velocity, irregularity=irregularity, friction=friction)
        rows = [(c.N, c.Fx, c.Fy, c.Mz, *astuple(c.creepage), c.approach, c.angle) for c in found.contacts]
        power = abs(rest[0]) * found.power_per_metre
        whole = (power, found.max_pressure, found.slip_ratio, found.damage.T_gamma, found.status)
        return self._answer(
            np.concatenate((found.force, found.moment)), np.array(rows).reshape(-1, len(PATCH)), np.array(whole)
        )
