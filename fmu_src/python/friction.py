"""The surface that the rows `friction.…` and `thermal.…` describe."""

from contact.friction import LAWS, VELOCITIES, Friction
from contact.material import Thermal
from fmu_src.python.values import Values

_BEHIND_VELOCITY = (
    *("gauge_factor", "border", "border_width", "k_A", "k_S", "hot_factor", "reference_temperature"),
    *("temperature_range", "background_temperature"),
)
_THERMAL = ("conductivity", "density", "heat_capacity", "heat_share")


def friction(values: Values) -> Friction:
    """Friction of both contact FMUs."""
    return Friction(
        values["friction.coefficient"],
        values["friction.kinetic"],
        values["friction.half_speed"],
        LAWS[int(values["friction.law"]) - 1],
        *(values[f"friction.{name}"] for name in ("slope", "slope_far", "slope_rate")),
        VELOCITIES[int(values["friction.velocity"]) - 1],
        *(values[f"friction.{name}"] for name in _BEHIND_VELOCITY),
        thermal=Thermal(*(values[f"thermal.{name}"] for name in _THERMAL)),
    )
