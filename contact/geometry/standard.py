"""Outlines of the standards as data: rails of EN 13674-1, wheels of EN 13715, wheels and rail A of EN 15302.

Lengths are in millimetres; right side, y to the field side, z down.

Sources (constants.md 12.2 and 14): 60E1, the tread and the flange of S1002, the EN 15302 wheels and rail, and the two arcs
of the EPS tread were seen in two sources or recomputed from reference tables. All other rails, 1/40 and the rest of EPS
were seen in only one transcription of the standard; their heads were checked against the widths of the catalogue. All EN
13715 wheels end with the slope 1:15 (the standard allows 6.7 to 15 %).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact.geometry.outline import Arc, Polynomial, Segment, Straight, Tabulated, chain, sloped, trough

Outline = tuple[Segment, ...]


@dataclass(frozen=True)
class Head:
    """Head of a rail: radii of the arcs from the crown outwards [mm], full widths of their joints [mm], slope of the flank."""

    radii: tuple[float, ...]
    widths: tuple[float, ...]
    flank: float
    aliases: tuple[str, ...] = ()

    def outline(self) -> Outline:
        return chain(self.radii, self.widths, self.flank)


#: EN 13674-1:2017. `60E1 UIC 519` has the tangent points of rail A of EN 15302 and of the Manchester benchmark's file.
RAILS = {
    "60E1": Head((300.0, 80.0, 13.0), (20.456, 52.053), 20.0, ("UIC60",)),
    "60E1 UIC 519": Head((300.0, 80.0, 13.0), (21.0, 51.976), 20.0, ("UIC519",)),
    "60E2": Head((200.0, 70.0, 16.0, 8.0), (23.778, 48.913, 70.774), 20.0),
    "56E1": Head((305.0, 80.0, 12.7), (11.787, 51.235), 20.0, ("BS113A",)),
    "55E1": Head((200.0, 60.0, 13.0), (27.946, 40.588), 20.0),
    "54E1": Head((300.0, 80.0, 13.0), (20.024, 49.727), 20.0, ("UIC54",)),
    "54E2": Head((300.0, 80.0, 13.0), (18.946, 46.310), 20.0),
    "54E3": Head((300.0, 80.0, 13.0), (15.267, 46.835), 17.2, ("S54",)),
    "54E4": Head((115.0, 16.5, 15.5, 7.64), (41.342, 62.980, 66.0), 17.2),
    "50E1": Head((200.0, 60.0, 13.0), (30.942, 43.838), 20.0),
    "50E2": Head((300.0, 80.0, 13.0), (20.456, 52.053), 20.0),
    "49E1": Head((300.0, 80.0, 13.0), (15.267, 46.835), 17.2, ("S49",)),
    "46E1": Head((300.0, 80.0, 13.0), (18.881, 43.881), math.inf, ("SBBI",)),
}

#: Rail A of EN 15302 (appendix I.7), drawn inclined 1:20, its origin 750 mm from the centre of the track.
RAIL_A: Outline = (
    Arc(-32.6340, -23.2401, 13.0, -19.63949, 15.899044),
    Arc(-23.2401, -7.8749, 80.0, -1.0825, 80.277908),
    Arc(-7.8749, 13.0989, 300.0, 17.5966, 299.48349),
    Arc(13.0989, 28.6709, 80.0, 14.29829, 79.508225),
    Arc(28.6709, 39.2705, 13.0, 26.33535, 13.598369),
)

# ---------------------------------------------------------------------------------------------------------------------
# Wheels of EN 13715 (UIC 510-2): a flange of variable height and thickness, and a tread. The part of the tread from the
# flange to 0.5 mm before the tape circle moves with the flange's thickness. A straight line joins it to the tape circle.

_S1002_ROOT = (
    *(-4.320221063e3, -1.038384026e3, -1.065501873e2, -6.051367875, -2.054332446e-1, -4.169739389e-3),
    *(-4.687195829e-5, -2.252755540e-7),
)
_S1002_TREAD = (
    *(0.0, -3.358537058e-2, 1.565681624e-3, -2.810427944e-5, 5.844240864e-8, -1.562379023e-8),
    *(5.309217349e-15, -5.957839843e-12, 2.646656573e-13),
)
_EPS_ROOT = (  # every 0.5 mm
    *(6.867, 6.466, 6.108, 5.788, 5.507, 5.262, 5.044, 4.832, 4.624, 4.421),
    *(4.222, 4.028, 3.838, 3.652, 3.471, 3.295, 3.122, 2.954, 2.790),
)
_E1, _D1 = -38.426669071, -35.0  # y of the end of the flange's straight line, and of the end of the root's arc R13
_T1 = -0.5


@dataclass(frozen=True)
class Tread:
    """Tread: segments on the flange side, the segment with the tape circle, segments on the field side (thickest flange)."""

    inner: Outline
    middle: Arc | Straight | Polynomial
    outer: Outline
    thickness: tuple[float, float] = (28.5, 32.5)  # allowed range of the flange's thickness [mm]

    def outline(self, height: float, thickness: float) -> Outline:
        """Return the wheel with a flange of this height and thickness [mm]."""
        moved = thickness - _THICKEST
        inner = tuple(segment.moved(moved) for segment in self.inner)
        middle: Outline = (self.middle,)
        if moved < 0.0:
            along = self.middle.between(self.middle.y0, _T1).moved(moved)
            y, z, _ = along.points()
            straight = Straight(float(y[-1]), float(z[-1]), 0.0, 0.0)
            middle = (along, straight, self.middle.between(0.0, self.middle.y1))
        return (*flange(height, moved), *inner, *middle, *self.outer)


_LOWEST, _THICKEST = 28.0, 32.5
_FLANGE_LINE = (-93.576667419, -2.747477419)  # constant [mm] and slope of the straight line at 70°


def flange(height: float, moved: float) -> Outline:
    """Return the flange from its inner side to the end of its straight line, with the active side moved by `moved` <= 0 [mm].

    The inner side is cut off where it is steeper than 70°. The outer arc R_F = 20 + 0.75 (h − 28) is tangent to the straight
    line and to the tip's R12, which determines its centre. At the heights 28, 30 and 32 the result has the coordinates
    tabulated in the standard. The tip of a thinner flange has an edge, because the standard moves only its outer R12.
    """
    up = height - _LOWEST
    tip, outer = 16.0 + up, 20.0 + 0.75 * up
    constant, slope = _FLANGE_LINE
    normal = math.hypot(1.0, slope)
    # the centre lies `outer` inside the straight, constant + slope y − z = outer normal, and outer − 12 from the tip's centre
    offset = constant - outer * normal - slope * 55.0 - tip  # z − tip = offset + slope (y + 55) along the parallel
    half = slope * offset / normal**2
    y = -half + math.sqrt(half**2 - (offset**2 - (outer - 12.0) ** 2) / normal**2)
    cy, cz = -55.0 + y, tip + offset + slope * y
    foot, touch = cy - outer * slope / normal, -55.0 - 12.0 * y / (outer - 12.0)
    edge = -55.0 + 0.5 * moved
    return (
        trough(-69.0, -62.764705882, 20.5, -49.5, 9.519259302 + up),
        trough(-62.764705882, edge, 12.0, -55.0, tip),
        trough(edge, touch + moved, 12.0, -55.0 + moved, tip),
        trough(touch + moved, foot + moved, outer, cy + moved, cz),
        sloped(foot + moved, _E1 + moved, constant - slope * moved, slope),
    )


TREADS = {
    "S1002": Tread(
        (
            Arc(_E1, _D1, 13.0, -26.210665, 16.446),
            Polynomial(_D1, -26.0, _S1002_ROOT),
        ),
        Polynomial(-26.0, 32.15796, _S1002_TREAD),
        (sloped(32.15796, 60.0, 1.364323640, -0.066666667),),
    ),
    "1/40": Tread(  # points of the cone 1:40, which the standard rounds to 0.001 mm
        (
            Arc(_E1, -32.696, 13.0, -26.210665, 16.446),
            Arc(-32.696, -15.64, 36.0, -14.74, 36.38),
        ),
        sloped(-15.64, 35.0, 0.0, -0.025),
        (sloped(35.0, 60.0, 35.0 * (1.0 / 15.0 - 0.025), -1.0 / 15.0),),
    ),
    "EPS": Tread(  # the table, in steps of 0.5 mm, meets R100 with a kink of 7°, at a place that no rail reaches
        (
            Arc(_E1, _D1, 13.0, -26.210665, 16.446),
            Tabulated(_D1, -26.0, _EPS_ROOT),
            Arc(-26.0, -17.587, 100.0, -6.5, 100.871),
        ),
        Arc(-17.587, 19.0, 330.0, 19.0, 329.453),
        (
            Straight(19.0, -0.547, 29.0, -0.547),
            sloped(29.0, 60.0, -0.547 + 29.0 / 15.0, -1.0 / 15.0),
        ),
        thickness=(32.5, 32.5),
    ),
}

# ---------------------------------------------------------------------------------------------------------------------
# Reference wheels of EN 15302:2021, appendix I.2 to I.6. Their last 5 mm are a chamfer of 45°.


def _flange_15302(z: tuple[float, float, float, float], joint: float, end: float) -> Outline:
    """Return the common flange. The fourth decimals differ from wheel to wheel."""
    return (
        trough(-69.0, -62.7647, 20.5, -49.5, z[0]),
        trough(-62.7647, -49.6625, 12.0, -55.0, z[1]),
        trough(-49.6625, joint, 20.0, -58.5583, z[2]),
        sloped(joint, end, z[3], -2.7475),
    )


_I_FLAT = math.sqrt(14375.0)

WHEELS_15302: dict[str, Outline] = {
    "A": (
        *_flange_15302((9.51926, 16.00065, 8.83556, -93.57685), -39.7645, -38.7372),
        Arc(-38.7372, -29.4591, 14.0, -25.5816, 17.64215),
        Arc(-29.4591, -10.8749, 96.76055, -2.6594, 97.16493),
        Arc(-10.8749, 18.4173, 345.0, 18.4173, 344.50806),
        Straight(18.4173, -0.49194, 30.0, -0.49194),
        sloped(30.0, 60.0, 1.50804, -1.0 / 15.0),
        sloped(60.0, 65.0, 57.50808, -1.0),
    ),
    "B": (
        *_flange_15302((9.5193, 16.0, 8.8349, -93.5767), -39.7640, -38.7879),
        Arc(-38.7879, -29.3505, 14.0, -25.6322, 17.7814),
        Arc(-29.3505, -0.4787, 120.0, 2.5204, 119.9745),
        sloped(-0.4787, 30.0, 0.0, -0.025),
        sloped(30.0, 60.0, 0.75, -0.05),
        sloped(60.0, 65.0, 57.75, -1.0),
    ),
    "C": (  # EPS type; new in the edition of 2021
        trough(-69.0, -59.5, 10.0, -59.5, 20.00006),
        trough(-59.5, -43.8048, 18.0, -60.4941, 12.02753),
        sloped(-43.8048, -41.0534, 11.96051 - 2.47508685 * 41.05339, -2.47508685),
        Arc(-41.0534, -32.3621, 13.0, -29.0, 16.830365),
        Arc(-32.3621, -17.587, 100.0, -6.5, 100.870534),
        Arc(-17.587, 19.0, 330.0, 19.0, 329.45258),
        Straight(19.0, -0.54742374, 29.0, -0.54742374),
        Straight(29.0, -0.54742374, 59.0, -3.54742374),
        sloped(59.0, 65.0, 55.45257626, -1.0),
    ),
    "H": (
        *_flange_15302((9.5193, 16.0, 8.8349, -93.5767), -39.7645, -38.7220),
        Arc(-38.7220, -28.3119, 14.0, -25.5663, 17.6003),
        sloped(-28.3119, -10.2297, -1.7902, -0.2),
        sloped(-10.2297, 30.0, 0.0, -0.025),
        sloped(30.0, 60.0, 1.251, -0.0667),
        sloped(60.0, 65.0, 57.249, -1.0),
    ),
    "I": (
        *_flange_15302((9.51929, 16.00054, 8.83545, -93.5767), -39.7640, -39.0486),
        Arc(-39.0486, -29.9231, 14.0, -25.8929, 18.49733),
        Arc(-29.9231, 5.0, 120.0, 5.0, _I_FLAT),
        Straight(5.0, _I_FLAT - 120.0, 30.0, _I_FLAT - 120.0),
        sloped(30.0, 60.0, 1.89679, -0.0667),
        sloped(60.0, 65.0, 57.89479, -1.0),
    ),
}
