"""Units of the FMUs, as exponents of SI base units, and the units in which tools show them."""

from __future__ import annotations

import math

BASE_UNITS = ("kg", "m", "s", "rad", "K")

#: name → exponents in the order of BASE_UNITS. The radian is kept where it tells an angle from a plain number.
UNITS: dict[str, tuple[int, int, int, int, int]] = {
    "1": (0, 0, 0, 0, 0),
    "m": (0, 1, 0, 0, 0),
    "s": (0, 0, 1, 0, 0),
    "m2": (0, 2, 0, 0, 0),
    "m3": (0, 3, 0, 0, 0),
    "1/m": (0, -1, 0, 0, 0),
    "m/s": (0, 1, -1, 0, 0),
    "rad": (0, 0, 0, 1, 0),
    "m/s2": (0, 1, -2, 0, 0),
    "rad/s": (0, 0, -1, 1, 0),
    "rad/s2": (0, 0, -2, 1, 0),
    "rad/m": (0, -1, 0, 1, 0),
    "kg": (1, 0, 0, 0, 0),
    "kg.m2": (1, 2, 0, 0, 0),
    "N": (1, 1, -2, 0, 0),
    "N.m": (1, 2, -2, 0, 0),
    "N.m2": (1, 3, -2, 0, 0),
    "N/m": (1, 0, -2, 0, 0),
    "N.s/m": (1, 0, -1, 0, 0),
    "N.m/rad": (1, 2, -2, -1, 0),
    "N.m.s/rad": (1, 2, -1, -1, 0),
    "Pa": (1, -1, -2, 0, 0),
    "Pa.m": (1, 0, -2, 0, 0),
    "J": (1, 2, -2, 0, 0),
    "W": (1, 2, -3, 0, 0),
    "K": (0, 0, 0, 0, 1),
    "kg/m3": (1, -3, 0, 0, 0),
    "W/(m.K)": (1, 1, -3, 0, -1),
    "J/(kg.K)": (0, 2, -2, 0, -1),
    # per metre rolled
    "m/m": (0, 0, 0, 0, 0),
    "m2/m": (0, 1, 0, 0, 0),
    "m3/m": (0, 2, 0, 0, 0),
}

#: Unit → unit in which tools may show it, how many of these are one, and the range of nominal values for which it is handy.
_DISPLAYED = {
    "m": ("mm", 1e3, 0.0, 0.1),
    "m2": ("mm2", 1e6, 0.0, 1e-2),
    "N": ("kN", 1e-3, 1e4, math.inf),
    "Pa": ("MPa", 1e-6, 1e6, math.inf),
    "rad": ("deg", 180.0 / math.pi, 0.0, math.inf),
}
#: Unit → the unit shown and how many of these are one.
DISPLAY_UNITS = {name: (shown, factor) for name, (shown, factor, *_) in _DISPLAYED.items()}


def display_unit(unit: str, nominal: float | None) -> str | None:
    """Return the unit in which a variable of this nominal value is shown, None for its own."""
    if unit not in _DISPLAYED:
        return None
    shown, _, least, greatest = _DISPLAYED[unit]
    return shown if least <= (1.0 if nominal is None else nominal) <= greatest else None
