"""Friction of an FMU from the rows `friction.…` and `thermal.…`."""

from contact.friction import LAWS, VELOCITIES, Friction
from contact.inputs.material import Thermal
from ..tables.solver import FRICTION, THERMAL
from .values import SlaveValues


def friction(values: SlaveValues) -> Friction:
    """Return the friction of a contact FMU, for WheelRailContact and WheelRailPair."""
    return Friction(
        static=values["friction.coefficient"],
        law=LAWS[int(values["friction.law"]) - 1],
        velocity=VELOCITIES[int(values["friction.velocity"]) - 1],
        thermal=Thermal(*(values[f"thermal.{name}"] for name in THERMAL)),
        **{name: values[f"friction.{name}"] for name in FRICTION},
    )
