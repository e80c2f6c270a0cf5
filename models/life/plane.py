"""The contact of one wheel in the one plane that the wheelset's model gives it: `DirectContact` without its overhead."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.kernels.layout import LoadKind
from contact import workspace
from contact.kernels.layout import N_CASE
from contact.friction import Friction, fill
from contact.kernels.pipeline import solve_case
from contact.registry import lookup
from models.life.scenario import Methods
from models.wheelset import ports
from models.wheelset.parameters import WheelsetParameters

Array = NDArray[np.float64]

#: What `PlaneContact.solve` answers, in this order [N], [N], [N m], [m], [Pa], [N], [-].
FX, FY, MZ, APPROACH, PRESSURE, POWER, STATUS = range(7)
_ANSWER = [RES_FX, RES_FY, RES_MZ, RES_APPROACH, RES_PMAX, RES_POWER, RES_STATUS]


class PlaneContact:
    """The solver for problems in the order of `models.wheelset.ports.PROBLEM`; no call starts from another one."""

    def __init__(self, p: WheelsetParameters, friction: Friction, methods: Methods) -> None:
        material = methods.material
        normal = lookup("normal", methods.normal, batched=True)
        tangential = lookup("tangential", methods.tangential, batched=True)
        self._own = workspace.allocate(
            normal,
            tangential,
            material.poisson_ratio,
            methods.strips,
            methods.elements,
            ports.POINTS,
            fields=False,
        )
        self._y = p.window_start + p.window_step * np.arange(ports.POINTS)
        self._locus = np.zeros(ports.POINTS)
        self._case = np.zeros(N_CASE)
        self._case.load_kind = LoadKind.LOAD
        self._case.G, self._case.nu = material.shear_modulus, material.poisson_ratio
        self._case.pressure_limit = material.pressure_limit
        self._case.normal, self._case.tangential = normal.id, tangential.id
        fill(self._case, friction, p.speed)

    def solve(self, problem: Array, speed: float) -> Array:
        """Forces and what else `FX` … `STATUS` name."""
        own, case = self._own, self._case
        own.space.memory[:] = 0.0
        case.amount, case.speed = problem[ports.LOAD], speed
        case[CASE_VX : CASE_PHI + 1] = problem[ports.CREEPAGE]
        solve_case(self._y, problem[ports.GAP], problem[ports.CURVATURE], self._locus, case, *own)
        return own.result[_ANSWER]
