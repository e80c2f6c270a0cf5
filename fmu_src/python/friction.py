"""The surface that the rows `friction.…` describe."""

from contact.friction import LAWS, VELOCITIES, Friction
from fmu_src.python.values import Values


def friction(values: Values) -> Friction:
    """Friction of both contact FMUs."""
    return Friction(
        values["friction.coefficient"],
        values["friction.kinetic"],
        values["friction.half_speed"],
        LAWS[int(values["friction.law"]) - 1],
        *(values[f"friction.{name}"] for name in ("slope", "slope_far", "slope_rate")),
        VELOCITIES[int(values["friction.velocity"]) - 1],
        *(values[f"friction.{name}"] for name in ("gauge_factor", "border", "border_width", "k_A", "k_S")),
    )
