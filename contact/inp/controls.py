"""Control digits of CONTACT's input files, declared once: three words, the values allowed in each module and their meaning."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Digit:
    """One control digit: letter, CONTACT's name, and the meaning of every value allowed in module 1 and in module 3."""

    letter: str
    name: str
    module_1: Mapping[int, str]
    module_3: Mapping[int, str]

    def values(self, module: int) -> Mapping[int, str]:
        """Return the allowed values with their meaning."""
        return self.module_1 if module == 1 else self.module_3


def _digit(letter: str, name: str, module_1: dict[int, str], module_3: dict[int, str] | None = None) -> Digit:
    return Digit(letter, name, module_1, module_1 if module_3 is None else module_3)


_FRICTION_ROWS = {0: "one set of friction constants"}
_KEEP = {0: "keep", 1: "keep"}
_NORMAL = {0: "elastic half space"}
#: The three control words. The first letter of the first and third word may be left out.
WORDS: tuple[tuple[Digit, ...], ...] = (
    (
        _digit(
            "C1", "CONFIG", {0: "left wheel", 1: "right wheel", 4: "left, on a roller", 5: "right, on a roller"}, {}
        ),
        _digit(
            "P",
            "PVTIME",
            {0: "next step", 1: "next step, normal part", 2: "new start", 3: "the same step again"},
        ),
        _digit(
            "B",
            "BOUND",
            _NORMAL | {1: "thin sheet", 5: "KPEC", 6: "ANALYN"},
            _NORMAL | {1: "thin sheet", 2: "ellipsoid", 3: "paraboloid", 4: "SDEC", 5: "KPEC", 6: "ANALYN"},
        ),
        _digit("T", "TANG", {0: "no friction", 1: "shift", 2: "transient rolling", 3: "steady rolling"}),
        _digit("N", "NORM", {0: "Z_WS given", 1: "FZ given"}, {0: "PEN given", 1: "FN given"}),
        _digit(
            "F",
            "FORCE",
            {0: "velocities given", 1: "FX_WS given", 3: "rail on springs"},
            {0: "creepages given", 1: "FX given", 2: "FX and FY given"},
        ),
        _digit("S", "STRESS", {0: "none", 1: "old points", 2: "old points, new output", 3: "new points"}),
    ),
    (
        _digit(
            "V",
            "VARFRC",
            _FRICTION_ROWS | {1: "over the inclination", 2: "along the track"},
            _FRICTION_ROWS | {3: "for each row"},
        ),
        _digit(
            "L",
            "FRCLAW",
            {
                0: "Coulomb",
                1: "keep",
                2: "linear in slip velocity",
                3: "rational",
                4: "exponential",
                6: "linear in temperature",
            },
        ),
        _digit(
            "D",
            "DISCNS",
            _KEEP
            | {
                2: "contact locus, plane",
                3: "plane, slip on true surfaces",
                4: "curved surface",
                5: "grid search",
                6: "grid search, steep",
                7: "initial point",
                8: "locus, oblique",
                9: "grid search, oblique",
            },
            {0: "keep the grid", 1: "form it again", 2: "new grid"},
        ),
        _digit(
            "C3",
            "INFLCF",
            _KEEP | {2: "half space", 3: "half space, bilinear", 4: "with the angle of the surface"},
            _KEEP
            | {
                2: "half space",
                3: "half space, bilinear",
                4: "with the angle of the surface",
                9: "numbers from a file",
            },
        ),
        _digit(
            "M",
            "MATER",
            {
                0: "elastic",
                1: "viscoelastic",
                2: "FASTSIM, one flexibility",
                3: "FASTSIM, three flexibilities",
                4: "third body",
                5: "FaStrip",
                6: "FaStrip, first variant",
                7: "FaStrip, second variant",
            },
        ),
        _digit(
            "Z",
            "ZTRACK/RZNORM",
            {0: "keep", 1: "dimensions", 2: "deviations", 3: "dimensions, profile, deviations"},
            {0: "keep the gap", 1: "form it again", 2: "new gap"},
        ),
        _digit(
            "E",
            "EWHEEL/RZTANG",
            {
                0: "keep",
                1: "position",
                2: "and velocity",
                3: "and profile",
                4: "velocity, flexible wheel",
                5: "profile, flexible wheel",
            },
            {0: "none", 1: "keep", 2: "spin along x only", 3: "spin along y only", 9: "rigid slip of each element"},
        ),
    ),
    (
        _digit("X", "XFLOW", {0: "", 1: "levels of debugging follow"}),
        _digit("H", "HEAT", {0: "none", 1: "stored constants", 3: "new constants"}),
        _digit(
            "G",
            "GAUSEI",
            {
                0: "default solvers",
                1: "keep",
                2: "ConvexGS",
                3: "SteadyGS",
                4: "default, slip iteration",
                5: "GDsteady",
            },
        ),
        _digit("I", "IESTIM", {0: "no start", 1: "regularised", 2: "normal part", 3: "last solution"}),
        _digit("A", "MATFIL", {0: "none", 1: "elements in contact", 2: "all elements"}),
        _digit("O", "OUTPUT", dict.fromkeys(range(7), "")),
        _digit("W", "FLOW", dict.fromkeys(range(10), "")),
        _digit(
            "R",
            "RETURN",
            {
                0: "solve, next case",
                1: "solve, next module",
                2: "check, next case",
                3: "check, next module",
            },
        ),
    ),
)
