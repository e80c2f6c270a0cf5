"""Options of a contact and of a pair: default and range of each, once for Python, the command line, C and FMUs."""

from __future__ import annotations

import math
from typing import NamedTuple

from contact.errors import require_integer, require_number
from contact.kernels.normal.strip_halfspace import MAX_ITERATIONS
from contact.kernels.records import MAX_PATCHES, SLOWEST


class Whole(NamedTuple):
    """Default and range of an integer."""

    usual: int
    least: int
    most: int

    def require(self, name: str, value: object) -> int:
        """Return `value` as an integer in the range, or raise a ContactError that names it."""
        return require_integer(name, value, self.least, self.most)


class Real(NamedTuple):
    """Default and range of a number. With `above` it is greater than `least`."""

    usual: float
    least: float
    most: float = math.inf
    above: bool = False

    def require(self, name: str, value: object) -> float:
        """Return `value` as a number in the range, or raise a ContactError that names it."""
        return require_number(name, value, self.least, self.most, open_minimum=self.above)


#: Strips per patch and elements per strip. With 20 the normal force on the patches of set D is .06 %, the largest pressure
#: .3 % off CONTACT's.
N_STRIPS, N_ELEMENTS = Whole(20, 4, 1000), Whole(20, 4, 1000)
#: Most iterations of interacting strips.
ITERATIONS = Whole(MAX_ITERATIONS, 1, 1000)
#: Radius of the tape circle, track gauge, distance of the backs of the flanges, depth of the gauge below the rail's top [m].
RADIUS, GAUGE, FLANGE_BACK = Real(0.46, 0.05, 2.0), Real(1.435, 0.1, 3.0), Real(1.36, 0.1, 3.0)
GAUGE_POINT = Real(0.014, 0.0, above=True)
#: Patches that are closer than this [m], and whose angles differ by less [rad], share one plane. Most planes.
COMBINE_DISTANCE, COMBINE_ANGLE = Real(8e-3, 0.0), Real(math.radians(10.0), 0.0)
MOST_PATCHES = Whole(MAX_PATCHES, 1, MAX_PATCHES)
#: Speed below which the creepages of a pair refer to it [m/s].
REFERENCE_SPEED = Real(SLOWEST, 1e-6, 10.0)
