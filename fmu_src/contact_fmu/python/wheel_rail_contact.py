"""pythonfmu slave of the FMU `WheelRailContact`, which calls `contact.Solver`."""

from __future__ import annotations

from typing import Any

import numpy as np
from pythonfmu.enums import Fmi2Status

import contact
from contact import Creepage, Separation, Solution, Solver, Status
from contact.damage.assessment import assess
from contact.results.solution import RENAMED
from ..differences import creepage_steps
from ..tables.wheel_rail_contact import FLATTEST, table
from .model import ModelSlave
from .surface import friction, methods
from .values import Rows, SlaveValues

_METHODS = contact.methods().tangential
_CREEPAGES = ("creepage.longitudinal", "creepage.lateral", "creepage.spin")


class WheelRailContactSlave(ModelSlave):
    """One wheel-rail contact in the plane of its separation. Forces act on the wheel."""

    lazy = ("creep_stiffness",)

    def __init__(self, points: int, guid: str, elliptic: bool = False, **kwargs: Any) -> None:
        super().__init__(table(points, elliptic), guid, **kwargs)

    def outputs(self, values: SlaveValues, step_size: float) -> Rows:
        """Solve for the present inputs, which are constant over the step."""
        solution = self._solve(values, _creepage(values))
        if solution.status in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED) and solution.status != values["status"]:
            self.log(f"status {solution.status.name}: {solution.status.message}", Fmi2Status.warning)
        damage = assess(solution, values["wheel.radius"]).damage
        rows: dict[str, Any] = {
            **self.copied("result", lambda name: getattr(solution, RENAMED.get(name, name))),
            **self.copied("damage", lambda name: float(damage[name])),
            "status": int(solution.status),
            "slip.ratio": solution.slip_ratio,
            "power.friction": values["speed"] * solution.power_per_metre,
        }
        return {**rows, **self.integrals(values, rows, step_size)}

    def on_demand(self, values: SlaveValues) -> Rows:
        """Return the derivatives of the forces by the creepages, to the side of larger values as the native FMU's."""
        at = np.array([values[name] for name in _CREEPAGES])
        here = np.array([values[name] for name in ("force.x", "force.y", "moment.z")])
        stiffness = np.zeros((3, 3))
        mu, G = values["friction.coefficient"], values["material.shear_modulus"]
        for j, step in enumerate(creepage_steps(mu, values["force.n"], G, values["patch.area"])):
            moved = at.copy()
            moved[j] += step
            stiffness[:, j] = (_resultants(self._solve(values, Creepage(*moved))) - here) / (moved[j] - at[j])
        return {"creep_stiffness": stiffness.ravel().tolist()}

    def _solve(self, values: SlaveValues, creepage: Creepage) -> Solution:
        """Solve the contact that `values` describe, with the given creepage."""
        solver: Solver = self.made(values, _solver)
        load_driven = values.item("load.kind") == "NormalForce"
        return solver.solve(
            _separation(values, _is_conformal(values)),
            creepage,
            load=max(values["load.normal_force"], 0.0) if load_driven else None,
            approach=None if load_driven else values["load.approach"],
            friction=friction(values),
            speed=values["speed"],
            throw=False,
        )


def _solver(values: SlaveValues, old: Solver | None) -> Solver:
    fields = _METHODS[values.item("method.tangential")].fields
    return Solver(**methods(values), conformal=_is_conformal(values) and fields)


def _creepage(values: SlaveValues) -> Creepage:
    return Creepage(*(values[name] for name in _CREEPAGES))


def _is_conformal(values: SlaveValues) -> bool:
    return values.item("geometry.kind") != "Curvatures" and values.item("geometry.surface") == "Conformal"


def _separation(values: SlaveValues, conformal: bool) -> Separation:
    if values.item("geometry.kind") == "Curvatures":
        return Separation.hertzian(*(max(values[f"geometry.{name}"], FLATTEST) for name in ("A0", "B0")))
    g = values["geometry.g"]
    A = np.maximum(values["geometry.A"], FLATTEST)
    y = values["geometry.y0"] + values["geometry.dy"] * np.arange(len(g))
    if not conformal:
        return Separation(y, g, A)
    return Separation(y, g, A, tilt=values["geometry.tilt"], rolling=values["geometry.rolling"])


def _resultants(solution: Solution) -> np.ndarray:
    return np.array([solution.Fx, solution.Fy, solution.Mz])
