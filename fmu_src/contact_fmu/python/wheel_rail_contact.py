"""pythonfmu slave of the FMU `WheelRailContact`, which calls `contact.solve`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from pythonfmu.enums import Fmi2Status

import contact
from contact import Creepage, Material, Separation, Solution, Status
from contact.damage import evaluate
from ..differences import creepage_steps
from ..tables.wheel_rail_contact import FLATTEST, table
from .friction import friction
from .slave import TableSlave
from .values import Rows, SlaveValues

_METHODS = contact.methods().tangential
_CREEPAGES = ("creepage.longitudinal", "creepage.lateral", "creepage.spin")


class WheelRailContactSlave(TableSlave):
    """One wheel-rail contact in the plane of its separation. Forces act on the wheel."""

    lazy = ("creep_stiffness",)

    def __init__(self, points: int, guid: str, elliptic: bool = False, **kwargs: Any) -> None:
        super().__init__(table(points, elliptic), guid, **kwargs)

    def outputs(self, values: SlaveValues, step_size: float) -> Rows:
        """Solve for the present inputs, which are constant over the step."""
        solution = _solve(values, _creepage(values))
        if solution.status in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED) and solution.status != values["status"]:
            self.log(f"status {solution.status.name}: {solution.status.message}", Fmi2Status.warning)
        power = values["speed"] * solution.power_per_metre
        damage = evaluate(solution, values["wheel.radius"])
        depth, volume, stress, energy = 0.0, 0.0, 0.0, 0.0
        if damage.has_fields:
            depth, volume = damage.archard.depth_max, damage.archard.volume
            stress, energy = damage.stress_index.max, damage.energy_index.max
        return {
            "force.x": solution.Fx,
            "force.y": solution.Fy,
            "force.n": solution.N,
            "moment.z": solution.Mz,
            "approach": solution.approach,
            "pressure.max": solution.max_pressure,
            "patch.area": solution.area,
            "patch.length": solution.length,
            "patch.width": solution.width,
            "patch.count": solution.n_patches,
            "slip.ratio": solution.slip_ratio,
            "power.friction": power,
            "damage.T_gamma": damage.T_gamma,
            "damage.wear_rate_pearce_sherratt": damage.pearce_sherratt,
            "damage.index_burstow": damage.burstow,
            "damage.wear_rate_usfd": damage.usfd,
            "damage.archard_depth_max": depth,
            "damage.archard_volume": volume,
            "damage.fatigue_index_surface": damage.fatigue_index,
            "damage.stress_index_max": stress,
            "damage.energy_index_max": energy,
            "stiffness.normal": solution.normal_stiffness,
            "status": int(solution.status),
            "gap_error": solution.gap_error,
            "bend": solution.bend,
            "total.energy": values["total.energy"] + power * step_size,
            "total.worn_volume": values["total.worn_volume"] + values["speed"] * volume * step_size,
        }

    def on_demand(self, values: SlaveValues) -> Rows:
        """Return the derivatives of the forces by the creepages, to the side of larger values as the native FMU's."""
        at = np.array([values[name] for name in _CREEPAGES])
        here = np.array([values[name] for name in ("force.x", "force.y", "moment.z")])
        stiffness = np.zeros((3, 3))
        mu, G = values["friction.coefficient"], values["material.shear_modulus"]
        for j, step in enumerate(creepage_steps(mu, values["force.n"], G, values["patch.area"])):
            moved = at.copy()
            moved[j] += step
            stiffness[:, j] = (_resultants(_solve(values, Creepage(*moved))) - here) / (moved[j] - at[j])
        return {"creep_stiffness": stiffness.ravel().tolist()}


def _creepage(values: SlaveValues) -> Creepage:
    return Creepage(*(values[name] for name in _CREEPAGES))


def _solve(values: SlaveValues, creepage: Creepage) -> Solution:
    """Solve the contact that `values` describe, with the given creepage."""
    material = Material(
        values["material.shear_modulus"],
        values["material.poisson_ratio"],
        hardness=values["material.hardness"],
        shear_yield=values["material.shear_yield"],
        pressure_limit=values["material.pressure_limit"] or math.inf,
    )
    fields, curved = _METHODS[values.item("method.tangential")].fields, values.item("geometry.kind") == "Curvatures"
    conformal = not curved and values.item("geometry.surface") == "Conformal"
    load_driven = values.item("load.kind") == "NormalForce"
    return contact.solve(
        _separation(values, conformal),
        creepage,
        load=max(values["load.normal_force"], 0.0) if load_driven else None,
        approach=None if load_driven else values["load.approach"],
        friction=friction(values),
        material=material,
        speed=values["speed"],
        normal=values.item("method.normal"),
        tangential=values.item("method.tangential"),
        max_iterations=values["method.max_iterations"],
        n_strips=values["resolution.n_strips"],
        n_elements=values["resolution.n_elements"],
        conformal=conformal and fields,
        throw=False,
    )


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
