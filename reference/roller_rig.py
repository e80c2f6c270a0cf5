"""A wheel on a roller with measured profiles and an elastic layer: CONTACT's roller rig example, ours beside it.

Read in `testbank/dry_10mph_13750lbs.inp` and `.ref_out` and in the two profiles that they name, github eve70a/CONTACT
(Apache-2.0), commits 424e4e6, 4cc09ad and 6a9d48e: a rig with a roller of 800.1 mm and a wheel of 355.6 mm, dry.
Of the profiles only the points near the patch are kept.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import contact

#: y, z [mm] of the left roller in its file, z down; the file is the mirror image of the left side.
ROLLER = """-14.1589 .8243 -13.9095 .7974 -13.6601 .7705 -13.4067 .7431 -13.1549 .7157 -12.9283 .6910 -12.6567 .6616 -12.4327
.6376 -12.1573 .6087 -11.9037 .5827 -11.6527 .5577 -11.4077 .5341 -11.1580 .5111 -10.9004 .4889 -10.6494 .4689 -10.3995 .4505
-10.1529 .4339 -9.9070 .4187 -9.6490 .4039 -9.3972 .3903 -9.1465 .3774 -8.9157 .3659 -8.6424 .3525 -8.3999 .3404 -8.1370 .3271
-7.8844 .3139 -7.6478 .3010 -7.3779 .2860 -7.1401 .2725 -6.8794 .2578 -6.6252 .2435 -6.3721 .2293 -6.1250 .2156 -5.8759 .2019
-5.6184 .1879 -5.3877 .1756 -5.1167 .1616 -4.8714 .1494 -4.6298 .1380 -4.3628 .1261 -4.1426 .1169 -3.8601 .1059 -3.6177 .0971
-3.3591 .0883 -3.1094 .0802 -2.8528 .0722 -2.6095 .0649 -2.3516 .0572 -2.1056 .0498 -1.8477 .0418 -1.5985 .0337 -1.3900 .0265
-1.0898 .0157 -.8382 .0063 -.5959 -.0031 -.3371 -.0134"""
#: The same of the left wheel, from flange back.
WHEEL = """81.0978 -.1610 80.8396 -.1478 80.5826 -.1348 80.3270 -.1219 80.0755 -.1093 79.8316 -.0971 79.5991 -.0856 79.3219
-.0719 79.0742 -.0599 78.8172 -.0477 78.5645 -.0359 78.3106 -.0241 78.0592 -.0125 77.8035 -.0007 77.5458 .0108 77.3449 .0194
77.0348 .0316 76.7912 .0400 76.5333 .0478 76.2783 .0549 76.0231 .0617 75.7706 .0687 75.5085 .0764 75.2520 .0844 74.9999 .0930
74.7423 .1024 74.4862 .1124 74.2314 .1227 73.9762 .1333 73.7243 .1437 73.4699 .1540 73.2281 .1637 72.9676 .1740 72.7116 .1839
72.4651 .1935 72.2061 .2035 71.9519 .2134 71.6961 .2235 71.4397 .2339 71.1855 .2445 70.9295 .2555 70.6738 .2669 70.4149 .2787
70.1564 .2907 69.9151 .3019 69.6479 .3140 69.3961 .3249 69.1585 .3347 68.8895 .3451 68.6317 .3549 68.3786 .3644 68.1179 .3742
67.8661 .3836 67.6055 .3934 67.3515 .4031 67.0979 .4129"""
ROLLER_RADIUS, WHEEL_RADIUS, FRICTION, SPEED = 0.8001, 0.3556, 0.52, 4.469
#: Thickness [m] over shear modulus [Pa] of the layer; shear modulus of the steel.
LAYER = contact.ThirdBody(0.05e-3 / 8200e6)


class Rig(NamedTuple):
    """A yaw [rad] and what CONTACT prints for it, of the roller, in mm and N."""

    yaw: float
    roll: float  # of the wheelset [rad]; the flexible wheel leans by .016667 more
    roller_y: float  # contact point in the mirrored roller's coordinates [mm]
    wheel_y: float
    creepages: tuple[float, float, float]  # longitudinal, lateral [-], spin [1/mm]
    N: float
    Fx: float
    Fs: float
    Mn: float  # [N mm]
    approach: float  # [mm]
    largest: float  # pressure [MPa]


CASES = (
    Rig(0.0, 1.201e-4, 7.3611, -74.0187, (1.989e-4, 0.0, -2.242e-4), 67240.0, -1307.0, 2469.0, 10520.0, 0.08694, 2029.0),
    Rig(2e-3, 8.348e-5, 7.3094, -74.4317, (1.279e-4, 2.003e-3, -2.239e-4), 73980.0, -880.4, -9055.0, 27820.0, 0.09658, 2132.0),
    Rig(0.004, 4.957e-5, 7.2919, -74.8, (7.398e-5, 4.006e-3, -2.241e-4), 79350.0, -505.1, -19480.0, 36430.0, 0.1034, 2198.0),
)  # fmt: skip


def points(text: str) -> NDArray[np.float64]:
    """Return y to the right and z down [mm] of a profile, y rising."""
    y, z = np.array(text.split(), dtype=np.float64).reshape(-1, 2).T
    order = np.argsort(-y)
    return np.stack((-y[order], z[order]))


def separation(case: Rig) -> contact.Separation:
    """Return the gap of a case in the plane of its patch, from splines through the measured points."""
    from scipy.interpolate import CubicSpline

    y = np.linspace(-6.5, 6.5, 131)
    roller, wheel = CubicSpline(*points(ROLLER)), CubicSpline(*points(WHEEL))
    gap = roller(case.roller_y + y) - wheel(case.wheel_y + y) - (case.roll + 0.016667) * y
    slope = float(roller(case.roller_y, 1))
    curvature = 0.5 / np.sqrt(1.0 + slope**2) * (1.0 / WHEEL_RADIUS + 1.0 / ROLLER_RADIUS)
    return contact.Separation(1e-3 * y, 1e-3 * (gap - gap.min()) / np.sqrt(1.0 + slope**2), np.full(y.size, curvature))


def solved(case: Rig, spacing: float = 0.4e-3) -> contact.Solution:
    """Return our element-wise half space with the layer, under CONTACT's normal force and at its creepages."""
    longitudinal, lateral, spin = case.creepages
    return contact.solve(
        separation(case), contact.Creepage(-longitudinal, -lateral, -1e3 * spin), load=case.N, friction=FRICTION, speed=SPEED,
        normal="halfspace", tangential="halfspace", layer=LAYER, spacing=spacing,
    )  # fmt: skip
