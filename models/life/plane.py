"""The contact of one wheel in a single plane, as the wheelset's model defines it: `DirectContact` for forces only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact import Creepage, Separation, Solver
from contact.friction import Friction
from contact.resultants import CaseForces
from models.life.scenario import Methods
from models.wheelset import ports
from models.wheelset.parameters import WheelsetParameters

Array = NDArray[np.float64]


class PlaneContact:
    """Solver for problems in the order of `models.wheelset.ports.PROBLEM`. Each call is a cold start."""

    def __init__(self, p: WheelsetParameters, friction: Friction, methods: Methods) -> None:
        self._solver = Solver(
            normal=methods.normal,
            tangential=methods.tangential,
            n_strips=methods.strips,
            n_elements=methods.elements,
            friction=friction,
            material=methods.material,
            speed=p.speed,
            n_samples=ports.POINTS,
        )
        y = p.window_start + p.window_step * np.arange(ports.POINTS)
        self._flat = Separation(y, np.zeros(ports.POINTS), 1.0)

    def solve(self, problem: Array, speed: float) -> CaseForces:
        """Return forces on the wheel and the other members of `contact.Forces` for one problem at `speed` [m/s]."""
        separation = self._flat.with_gap(problem[ports.GAP], problem[ports.CURVATURE])
        creepage = Creepage(*problem[ports.CREEPAGE].tolist())
        return self._solver.forces(separation, creepage, load=float(problem[ports.LOAD]), speed=speed)
