"""Time series of a run: what the columns mean, and a row of them."""

from __future__ import annotations

import numpy as np

from contact.arrays import Array
from ..vehicle.declared import SIDES
from ..vehicle.kernels.layout import Axis, Sum, TrackFrame, TrackRow
from ..vehicle.simulation import Simulation

#: Column of the time series → unit and meaning.
TRACK = {
    "distance": ("m", "distance of the vehicle's reference"),
    "time": ("s", "time"),
    "speed": ("m/s", "speed"),
    "curvature": ("1/m", "curvature of the track, positive to the right"),
    "cant": ("rad", "cant angle, positive where the left rail is higher"),
}
BODY = {
    "lateral": ("m", "lateral displacement in the frame of the ideal track"),
    "vertical": ("m", "vertical displacement downwards"),
    "roll": ("rad", "roll in the frame of the ideal track"),
    "yaw": ("rad", "yaw in that frame, clockwise seen from above"),
    "lateral_acceleration": ("m/s2", "lateral acceleration felt in the plane of the track; mean since the last sample"),
}
WHEEL = {
    "lateral_force": ("N", "Y, force of the wheel on the rail outwards; mean since the last sample"),
    "vertical_force": ("N", "Q, force of the wheel on the rail downwards; mean since the last sample"),
    "longitudinal_force": ("N", "force of the rail on the wheel forwards; mean since the last sample"),
    "T_gamma": ("N", "T-gamma of all patches; mean since the last sample"),
    "dissipation": ("N", "creep forces times creepages; mean since the last sample"),
    "contact_angle": ("rad", "contact angle of the patch with the largest normal force"),
    "longitudinal_creepage": ("1", "its longitudinal creepage"),
    "lateral_creepage": ("1", "its lateral creepage"),
    "max_pressure": ("Pa", "greatest pressure of all patches"),
    "patches": ("1", "number of patches"),
    "least_lateral_force": ("N", "least Y of all steps since the last sample"),
    "largest_lateral_force": ("N", "largest Y of all steps since the last sample"),
    "least_vertical_force": ("N", "least Q of all steps since the last sample"),
    "largest_vertical_force": ("N", "largest Q of all steps since the last sample"),
}


def columns(simulation: Simulation) -> dict[str, tuple[str, str]]:
    """Return column → unit and meaning. Blanks in names of bodies are underscores."""
    names = [name.replace(" ", "_") for name in simulation.names]
    bodies = {f"{name}_{what}": told for name in names for what, told in BODY.items()}
    axles = [names[i] for i in simulation.model.wheelsets]
    wheels = {f"{name}_{side}_{what}": told for name in axles for side in SIDES for what, told in WHEEL.items()}
    return TRACK | bodies | wheels


def sample(simulation: Simulation, before: Array, elapsed: float) -> list[float]:
    """Return a row in the order of `columns`: the present state, and means over the sums of its steps.

    Parameters
    ----------
    simulation : Simulation
    before : ndarray
        Velocities `state.u` at the last sample.
    elapsed : float
        Time since then [s].
    """
    state, frames = simulation.state, simulation.scratch.frames
    s = simulation.distance
    track = simulation.model.track
    track = track[:, np.searchsorted(track[TrackRow.PLACE], s, "right") - 1]
    row = [s, simulation.time, track[TrackRow.SPEED], track[TrackRow.CURVATURE], track[TrackRow.CANT]]
    rates = (state.u[:, Axis.Y] - before[:, Axis.Y]) / elapsed
    turning = frames[:, TrackFrame.RATE_Z] * state.u[:, Axis.X] - frames[:, TrackFrame.RATE_X] * state.u[:, Axis.Z]
    felt = rates + turning - 9.81 * frames[:, TrackFrame.SIN_CANT]
    for i, q in enumerate(state.q):
        row += [q[Axis.Y], q[Axis.Z], q[Axis.ROLL], q[Axis.YAW], felt[i]]
    sides = SIDES * len(simulation.model.wheelsets)
    for side, sums, wheel in zip(sides, state.sums, simulation.wheels, strict=True):
        lateral, *means = sums[Sum.LATERAL : Sum.LEAST_LATERAL] / sums[Sum.STEPS]
        least, largest, *vertical = sums[Sum.LEAST_LATERAL :]
        if side == "right":  # the sums are those of the force on the wheel to the right, Y is outwards on the rail
            lateral, least, largest = -lateral, -largest, -least
        row += [lateral, *means, wheel["angle"], wheel["creep_x"], wheel["creep_y"], wheel["pmax"], wheel["patches"]]
        row += [least, largest, *vertical]
    return row
