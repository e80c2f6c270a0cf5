"""Friction of an FMU from the rows `friction.…` and `thermal.…`."""

from contact.friction import LAWS, VELOCITIES, Friction
from contact.material import Thermal
from .values import SlaveValues

#: Names that rows `friction.…` share with members of `Friction`.
_NUMBERS = (
    *("kinetic", "half_speed", "slope", "slope_far", "slope_rate"),
    *("gauge_factor", "border", "border_width", "k_A", "k_S", "hot_factor", "reference_temperature"),
    *("temperature_range", "background_temperature"),
)
_THERMAL = ("conductivity", "density", "heat_capacity", "heat_share")


def friction(values: SlaveValues) -> Friction:
    """Return the friction of a contact FMU, for WheelRailContact and WheelRailPair."""
    return Friction(
        static=values["friction.coefficient"],
        law=LAWS[int(values["friction.law"]) - 1],
        velocity=VELOCITIES[int(values["friction.velocity"]) - 1],
        thermal=Thermal(*(values[f"thermal.{name}"] for name in _THERMAL)),
        **{name: values[f"friction.{name}"] for name in _NUMBERS},
    )
