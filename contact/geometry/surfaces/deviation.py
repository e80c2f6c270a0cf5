"""Analytic deviations of a surface along its first coordinate: flats and polygons of wheels, waves of rails.

A deviation is added to the z of a surface: to the radius of a wheel over its angle, and, downwards, to the height of a rail
over the distance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_integer, require_number
from contact.inputs.options import RADIUS


class Deviation(Protocol):
    """Function of the angle of a wheel [rad] or of the distance along a rail [m]."""

    def at(self, u: Array) -> tuple[Array, Array]:
        """Return value [m] and slope [m/rad] or [-] at `u`."""


@dataclass(frozen=True)
class Polygon:
    """Out-of-roundness amplitude·sin(order·(angle + phase)) of a wheel, positive outwards.

    Parameters
    ----------
    order : int
        Number of periods around the wheel, 1 to 500.
    amplitude : float
        Half of the difference between the largest and the smallest radius [m], 0 to 0.01.
    phase : float
        [rad].
    """

    order: int
    amplitude: float
    phase: float = 0.0

    def __post_init__(self) -> None:
        require_integer("order", self.order, 1, 500)
        require_number("amplitude", self.amplitude, 0.0, 0.01)
        require_number("phase", self.phase)

    def at(self, u: Array) -> tuple[Array, Array]:
        """Return value [m] and slope [m/rad] at the angles `u`."""
        turned = self.order * (u + self.phase)
        return self.amplitude * np.sin(turned), self.amplitude * self.order * np.cos(turned)


@dataclass(frozen=True)
class Wave:
    """Corrugation amplitude·sin(2 pi (distance + shift)/length) of a rail, positive downwards; all in [m]."""

    length: float
    amplitude: float
    shift: float = 0.0

    def __post_init__(self) -> None:
        require_number("length", self.length, 1e-3)
        require_number("amplitude", self.amplitude, 0.0, 0.01)
        require_number("shift", self.shift)

    def at(self, u: Array) -> tuple[Array, Array]:
        """Return value [m] and slope [-] at the distances `u`."""
        k = 2.0 * math.pi / self.length
        return self.amplitude * np.sin(k * (u + self.shift)), self.amplitude * k * np.cos(k * (u + self.shift))


#: Depth of a flat, times its length squared over the radius. Both follow from the circle (chord: L²/8R; the haversine that
#: has the same curvature in its middle as a plane has L²/16R, recalled from the literature on worn flats).
_DEPTHS = {"chord": 1.0 / 8.0, "haversine": 1.0 / 16.0}


@dataclass(frozen=True)
class Flat:
    """One flat of a wheel.

    Parameters
    ----------
    length : float
        Length along the circumference [m], 1e-3 to 0.3.
    radius : float
        Nominal radius of the wheel [m].
    depth : float, optional
        Largest depth [m] of a haversine; default length²/(16 radius). A chord has the depth of its length.
    shape : {"haversine", "chord"}
        "haversine": a worn flat with rounded ends, -depth/2·(1 + cos(2 pi arc/length)). "chord": a fresh flat, which is a
        plane with sharp ends.
    angle : float
        Angle of its middle [rad].
    """

    length: float
    radius: float = RADIUS.usual
    depth: float | None = None
    shape: str = "haversine"
    angle: float = 0.0

    def __post_init__(self) -> None:
        require_number("length", self.length, 1e-3, 0.3)
        RADIUS.require("radius", self.radius)
        require_number("angle", self.angle)
        if self.shape not in _DEPTHS:
            raise ContactError(f"shape = {self.shape!r} is none of {', '.join(map(repr, _DEPTHS))}")
        if self.depth is None:
            object.__setattr__(self, "depth", _DEPTHS[self.shape] * self.length**2 / self.radius)
        elif self.shape == "chord":
            raise ContactError(f"depth = {self.depth!r}: the depth of a chord follows from its length")
        require_number("depth", self.depth, 0.0, 0.02, open_minimum=True)

    def at(self, u: Array) -> tuple[Array, Array]:
        """Return value [m] and slope [m/rad] at the angles `u`."""
        turned = np.mod(u - self.angle + math.pi, 2.0 * math.pi) - math.pi
        half = 0.5 * self.length / self.radius
        if self.shape == "chord":  # the arc's ends lie at asin(half), so that the chord has the length
            half = math.asin(half)
            within = np.abs(turned) < half
            near = np.where(within, turned, 0.0)
            plane = self.radius * math.cos(half) / np.cos(near)
            return np.where(within, plane - self.radius, 0.0), np.where(within, plane * np.tan(near), 0.0)
        within = np.abs(turned) < half
        k = math.pi / half
        depth = 0.5 * float(self.depth)  # type: ignore[arg-type]
        return (
            np.where(within, -depth * (1.0 + np.cos(k * turned)), 0.0),
            np.where(within, depth * k * np.sin(k * turned), 0.0),
        )


def out_of_round(
    radius: float,
    flat: float | None = None,
    flat_depth: float | None = None,
    polygon: tuple[float, float] | None = None,
) -> list[Deviation]:
    """Return flat and polygon of a wheel, as a command names them.

    Parameters
    ----------
    radius : float
        Nominal radius of the wheel [m].
    flat, flat_depth : float, optional
        Length of a haversine flat and its depth [m].
    polygon : (float, float), optional
        Order, and amplitude [m].

    Raises
    ------
    ContactError
        As `Flat` and `Polygon`, and for a depth without a flat.
    """
    if flat is None and flat_depth is not None:
        raise ContactError(f"flat_depth = {flat_depth:g} needs --flat")
    found: list[Deviation] = [] if flat is None else [Flat(flat, radius, flat_depth)]
    return found if polygon is None else [*found, Polygon(require_integer("order", polygon[0], 1, 500), polygon[1])]
