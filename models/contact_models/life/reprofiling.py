"""When a wheel must be reprofiled, by which limit, and how much the lathe takes off."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from contact.arrays import Array
from contact.geometry.profile import Profile
from .flange import Flange
from .part import Wheel


def cut(worn: Profile, new: Profile) -> float:
    """Return the least reduction of the radius [m] at which the new profile lies within the worn wheel.

    The flange back stays where it is, so a worn flange is made thicker only by a smaller tread. No surface layer is taken off
    beyond that.
    """
    tip = int(np.argmax(np.where(new.y < 0.0, new.z, -np.inf)))
    needed = np.interp(worn.y[tip:], new.y[tip:], new.z[tip:]) - worn.z[tip:]
    return float(max(needed.max(), 0.0))


def forecast(wheel: Wheel, mileage: Array, limits: Flange) -> tuple[str, float] | None:
    """Return the limit that ends first, and the mileage [m] at which, by the trend of the last half of the steps.

    Parameters
    ----------
    wheel : Wheel
    mileage : ndarray
        At the end of each step since the wheel was new or restored [m].
    limits : Flange

    Returns
    -------
    (str, float), optional
        None if no dimension moves towards its limit, or there are fewer than two steps.
    """
    count = mileage.size
    if count < 3:
        return None
    late = slice(-max(count // 2, 2), None)
    found = []
    for name, limit in asdict(limits).items():
        column = "qR" if name == "qR" else f"flange_{name}"
        values = wheel[column][-count:]
        slope = float(np.polyfit(mileage[late], values[late], 1)[0])
        left = limit - float(values[-1])
        if slope * left > 0.0:
            found.append((float(mileage[-1]) + left / slope, name))
    if not found:
        return None
    at, name = min(found)
    return name, at
