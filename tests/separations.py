"""Separations for several tests, one for each kind of patch."""

import math
from functools import cache

import numpy as np

import contact
from contact.geometry import profile, wheelset
from reference import random_cases


def two_lobes(depth: float, spacing: float = 12e-3) -> contact.Separation:
    """Return two parabolas side by side with a ridge between them. The second is `depth` [m] higher."""
    y = np.linspace(-25e-3, 25e-3, 501)
    g = np.minimum(2.0 * (y + spacing / 2) ** 2, depth + 2.0 * (y - spacing / 2) ** 2)
    return contact.Separation(y, g, 1.0)


def real_patch(y, yaw=0.0):
    """Return the first patch of S1002 on 60E1, right side."""
    return random_cases.pair().contacts(wheelset.Pose(y=y, yaw=yaw), load=8e4)[0].separation


@cache
def _profiles(wheel: str, rail: str, slope: float) -> wheelset.Pair:
    return wheelset.Pair(profile.named(wheel), profile.named(rail, inclination=1 / slope))


def patch(y, yaw=0.0, roll=0.0, load=80.0, *, wheel="S1002", rail="60E1", slope=40):
    """Return separation and load [N] of the patch that carries most: y [mm], yaw and roll [mrad], load [kN], rail 1:`slope`."""
    pose = wheelset.Pose(y=1e-3 * y, yaw=1e-3 * yaw, roll=1e-3 * roll)
    patches = _profiles(wheel, rail, slope).contacts(pose, load=1e3 * load)
    largest = max(patches, key=lambda one: one.load)
    return largest.separation, largest.load


def turned(P, Q, angle, load=1e4):
    """Return a Hertz contact (half curvatures P, Q) turned in its plane: separation, exact answer, slope of the middles."""
    cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    axes = np.array([[cosine, -sine], [sine, cosine]])  # of P and Q
    (A, off), (_, other) = axes @ np.diag([P, Q]) @ axes.T
    exact = contact.hertz(P, Q, load=load)
    (xx, xy), (_, yy) = axes @ np.diag([exact.a**-2, exact.b**-2]) @ axes.T
    half_width = math.sqrt(xx / (xx * yy - xy * xy))
    y = np.linspace(-3.0 * half_width, 3.0 * half_width, 401)
    return contact.Separation(y, (other - off * off / A) * y**2, A, -off / A * y), exact, -xy / xx


def yawed():
    y = np.linspace(-20e-3, 20e-3, 161)
    return contact.Separation(y, 1.5 * y**2 + 40.0 * np.maximum(y, 0.0) ** 3, 1.1, x_c=0.04 * y)


#: Separation and load [N], made when they are asked for: `of_kind`. A method without `non_elliptic` also solves all of them, as
#: if they were elliptic.
KINDS = {
    "a/b = 0.2": lambda: (contact.Separation.hertzian(3.0, 0.3), 8e4),
    "a/b = 1": lambda: (contact.Separation.hertzian(1.0, 1.0), 8e4),
    "a/b = 5": lambda: (contact.Separation.hertzian(1.0, 12.0), 8e4),
    "tread": lambda: (real_patch(0.0), 8e4),
    "flange root": lambda: (real_patch(6e-3, 8e-3), 9e4),
    "two patches": lambda: (two_lobes(2e-6), 2e4),
    "yawed": lambda: (yawed(), 7e4),
    "tiny load": lambda: (real_patch(3e-3), 1e-3),
}


@cache
def of_kind(name: str) -> tuple[contact.Separation, float]:
    """Return a separation of `KINDS` and its load [N]."""
    return KINDS[name]()
