"""Damage of a run on the profiles of both wheels and rails, with a separate contact plane for each patch."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

import contact
from contact.accumulation import MAXIMA, SUMS, Histogram
from contact.geometry.wheelset import Pair, Pose, Velocity
from models.life.scenario import Scenario
from models.wheelset.components import SolveOptions
from models.wheelset.ports import SIDES

Array = NDArray[np.float64]

BODIES = ("wheel", "rail")
#: Results for the patches of one side at one instant: [N], [N], [Pa], [-].
REPORT = ("T_gamma", "dissipation", "max_pressure", "patches")
_NAMES = (*SUMS, *MAXIMA)


class Harvest:
    """Histograms of damage of both wheels and both rails.

    The coupled run has one contact plane for each wheel. Here tread and flange have separate planes, under the vertical load
    of the run.

    Attributes
    ----------
    histograms : dict
        (side, body) → Histogram.
    energy : ndarray, shape (2,)
        Frictional energy of the right and the left wheel so far [J].
    """

    def __init__(self, scenario: Scenario) -> None:
        p, d = scenario.parameters, scenario.declared
        self._friction = scenario.friction
        self._options: SolveOptions = {
            "normal": d.methods.normal,
            "tangential": d.methods.tangential,
            "n_strips": d.methods.strips,
            "n_elements": d.methods.elements,
            "material": d.methods.material,
            "throw": False,
        }
        self._pairs = {
            side: Pair(
                p.wheel,
                p.rail,
                side=side,
                nominal_radius=p.radius,
                gauge=p.gauge,
                gauge_point=p.gauge_point,
                flange_back=p.flange_back,
            )
            for side in SIDES
        }
        self.histograms = {
            (side, body): Histogram(
                getattr(scenario, body), width=d.recording.bins, radius=p.radius, parameters=d.damage
            )
            for side in SIDES
            for body in BODIES
        }
        self.energy = np.zeros(len(SIDES))

    def add(self, pose: Pose, velocity: Velocity, speed: float, loads: Array, distance: float) -> Array:
        """Add the damage of rolling `distance` [m] in this pose relative to the track.

        Parameters
        ----------
        pose, velocity : Pose, Velocity
            Pose and velocity of the wheelset relative to the track.
        speed : float
            Speed of the wheelset [m/s].
        loads : ndarray, shape (2,)
            Vertical load of each wheel [N].
        distance : float
            Rolled distance [m].

        Returns
        -------
        ndarray, shape (2, len(REPORT))
            Results of each side, in the order of `REPORT`.
        """
        found = np.zeros((len(SIDES), len(REPORT)))
        for i, side in enumerate(SIDES):
            patches = self._pairs[side].contacts(pose, velocity, load=float(loads[i])) if loads[i] > 0.0 else ()
            solutions = [
                contact.solve(
                    patch.separation,
                    patch.creepage,
                    load=patch.load,
                    friction=self._friction,
                    speed=speed,
                    **self._options,
                )
                for patch in patches
            ]
            for body in BODIES:
                self.histograms[side, body].add(patches, solutions, distance=distance)
            shares = [patch.share for patch in patches]
            dissipation = math.fsum(w * s.power_per_metre for w, s in zip(shares, solutions, strict=True))
            self.energy[i] += dissipation * distance
            T_gamma = math.fsum(
                w * (abs(s.Fx * s.creepage.longitudinal) + abs(s.Fy * s.creepage.lateral))
                for w, s in zip(shares, solutions, strict=True)
            )
            found[i] = T_gamma, dissipation, max((s.max_pressure for s in solutions), default=0.0), len(solutions)
        return found

    def save(self) -> dict[str, Array]:
        """Return the accumulated damage as arrays."""
        saved = {"harvest.energy": self.energy.copy()}
        for (side, body), h in self.histograms.items():
            saved[f"harvest.{side}.{body}"] = np.stack([h[name] for name in _NAMES])
            saved[f"harvest.{side}.{body}.distance"] = np.array(h.distance)
            saved[f"harvest.{side}.{body}.methods"] = np.array(sorted(h.methods), dtype=str)
        return saved

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the arrays of `save`."""
        self.energy[:] = saved["harvest.energy"]
        for (side, body), h in self.histograms.items():
            values = dict(zip(_NAMES, saved[f"harvest.{side}.{body}"], strict=True))
            distance = float(saved[f"harvest.{side}.{body}.distance"])
            methods = set(saved[f"harvest.{side}.{body}.methods"].tolist())
            h.restore(values, distance, methods, {self._options["material"]} if methods else set())
