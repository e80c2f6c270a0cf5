"""Profiles and gaps of the reference sets G to N."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import contact
from contact.geometry.profile import Profile
from contact.geometry.wheelset import Pair
from contact.halfspace import Gap

BOTH = {"normal": "halfspace", "tangential": "halfspace"}


def pair_of(folder: Path) -> Pair:
    """Return S1002 on UIC60 with CONTACT's points."""
    points = np.load(folder / "profiles.npz")
    outlines = [1e-3 * points[name] for name in ("wheel_s1002_yz", "rail_uic60_yz")]
    outlines = [xy[np.append(True, np.hypot(*np.diff(xy, axis=0).T) > 1e-7)] for xy in outlines]
    wheel, rail = (Profile(kind, *xy.T) for kind, xy in zip(("wheel", "rail"), outlines, strict=True))
    return Pair(wheel, rail, gauge=1.435, flange_back=1.360, material=contact.STEEL)


def parabolas(a: float, b: float, p0: float, material: contact.Material, n: int) -> Gap:
    """Return the gap of Hertz's ellipse a × b with the pressure p0, on n × n elements over 1.05 of its axes."""
    s = (2.0 * np.arange(n) + 1.0) / n - 1.0
    x, y = 1.05 * a * s, 1.05 * b * s
    t = (np.arange(400_000) + 0.5) / 400_000
    u, weight = a * t / (1.0 - t), a / (1.0 - t) ** 2 / t.size
    scale, roots = p0 * a * b / material.contact_modulus, weight / np.sqrt((a**2 + u**2) * (b**2 + u**2))
    A, B = (scale * float((roots / (q**2 + u**2)).sum()) for q in (a, b))
    return Gap(x, y, A * x**2 + B * y[:, None] ** 2)
