"""A contact case for tests of FMUs."""

import numpy as np

import contact

NAME = "WheelRailContact"
CREEPAGES = {"creepage.longitudinal": 1.2e-3, "creepage.lateral": -0.8e-3, "creepage.spin": 0.25}


def separation() -> contact.Separation:
    """Return a separation of varying curvature in both directions, off the centre of its window."""
    y = -0.02 + 0.001 * np.arange(41)
    return contact.Separation(y, (y - 2e-3) ** 2 * (1.5 + 40.0 * y), 1.0 + 5.0 * y)


def geometry() -> dict[str, float]:
    s = separation()
    return {
        f"geometry.{row}[{i}]": value
        for row, column in (("g", s.g), ("A", s.A))
        for i, value in enumerate(column.tolist(), 1)
    }


def posed(fmu):
    """Set `separation` and CREEPAGES at 30 m/s in an instance and return it."""
    fmu.update({**geometry(), **CREEPAGES, "geometry.y0": -0.02, "geometry.dy": 0.001, "speed": 30.0})
    return fmu
