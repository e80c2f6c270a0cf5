"""Whether what a scenario gives along the track lies where its run leads."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from contact.errors import ContactError, PlausibilityWarning, warn

if TYPE_CHECKING:
    from .scenario import Scenario


def require_series(scenario: Scenario, where: str) -> None:
    """Check that a measured track covers the way of all axles from the run's start to its end.

    Raises
    ------
    ContactError
        If it does not. The message begins with `where`, the name of the file, and has both intervals.
    """
    series = scenario.declared.track.series
    if series is None:
        return
    front = max(axle.at for axle in scenario.vehicle.wheelsets)
    try:
        series.require_covered(scenario.declared.length + max(front, 0.0))
        series.over(np.zeros(1))
    except ContactError as error:
        raise ContactError(f"{where}.track.measured: {error}") from None


def doubt(scenario: Scenario, where: str) -> None:
    """Warn of tables over distance or time, curves and slices to which the run does not come, and of gaps in a measured track.

    A table is constant before its first place and behind its last one. One with several places of which none is within the run
    is hardly meant so: its places may be those of a line.
    """
    for text in _unreached(scenario):
        warn(f"{where}.{text}", PlausibilityWarning)


def _unreached(scenario: Scenario) -> Iterator[str]:
    d = scenario.declared
    for name, given in (("speed", d.speed), ("track.friction", d.track.friction)):
        if given is not None and not isinstance(given, float):
            yield from _outside(name, given.at, d.length, "m")
    for k, torque in enumerate(d.torque):
        end, unit = (d.length, "m") if torque.over == "distance" else (_duration(scenario), "s")
        yield from _outside(f"torque[{k}]", torque.at, end, unit)
    for k, curve in enumerate(d.track.curves):
        if curve.start >= d.length:
            yield f"track.curves[{k}]: it starts at {curve.start:.9g} m, and the run ends at {d.length:.9g} m"
    for begin, end in d.track.series.gaps(d.length) if d.track.series else ():
        yield f"track.measured: no stations from {begin:.9g} to {end:.9g} m of the run, over which a curve is drawn"
    for section in scenario.sections:
        if section.begin >= d.length or section.end <= 0.0:
            yield (
                f"{section.name.partition('.toml.')[2] or section.name}: the slices lie from {section.begin:.9g} to "
                f"{section.end:.9g} m, and the run leads from 0 to {d.length:.9g} m"
            )


def _outside(name: str, at: tuple[float, ...], end: float, unit: str) -> Iterator[str]:
    if len(at) > 1 and (at[0] >= end or at[-1] <= 0.0):
        yield (
            f"{name}: its places, {at[0]:.9g} to {at[-1]:.9g} {unit}, are outside of the run from 0 to {end:.6g} {unit}, "
            "in which it is constant"
        )


def _duration(scenario: Scenario) -> float:
    """Return about how long the run takes [s]."""
    s = np.linspace(0.0, scenario.declared.length, 1001)
    return float(np.trapezoid([1.0 / scenario.speed(place) for place in s], s))
