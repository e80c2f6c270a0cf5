"""What `values` say of methods, material and friction, for WheelRailContact and WheelRailPair."""

from __future__ import annotations

import math
from typing import Any

from contact import Material
from contact.friction import LAWS, VELOCITIES, Friction
from contact.inputs.material import Thermal
from ..tables.solver import FRICTION, THERMAL
from .values import SlaveValues


def methods(values: SlaveValues) -> dict[str, Any]:
    """Return methods, resolution and material as arguments of `contact.solve` and `WheelRailPair`."""
    strength = {
        name: values[f"material.{name}"] for name in ("shear_modulus", "poisson_ratio", "hardness", "shear_yield")
    }
    return {
        "material": Material(**strength, pressure_limit=values["material.pressure_limit"] or math.inf),
        "normal": values.item("method.normal"),
        "tangential": values.item("method.tangential"),
        "max_iterations": values["method.max_iterations"],
        "n_strips": values["resolution.n_strips"],
        "n_elements": values["resolution.n_elements"],
    }


def friction(values: SlaveValues) -> Friction:
    """Return the friction."""
    return Friction(
        static=values["friction.coefficient"],
        law=LAWS[int(values["friction.law"]) - 1],
        velocity=VELOCITIES[int(values["friction.velocity"]) - 1],
        thermal=Thermal(*(values[f"thermal.{name}"] for name in THERMAL)),
        **{name: values[f"friction.{name}"] for name in FRICTION},
    )
