"""Why a case is refused. Nothing is approximated silently: what cannot run has one of these names."""

from __future__ import annotations

from contact.errors import ContactError
from contact.inp.case import Case

#: What a case needs and this package does not have.
REASONS: dict[str, str] = {
    "viscoelastic": "M = 1: viscoelastic bodies",
    "simplified theory": "M = 6, 7, or M = 2, 3, 5 beyond steady rolling under given creepages",
    "thin sheet": "B = 1: a thin sheet on the half space",
    "given pressure": "B = 4: SDEC",
    "bilinear": "C = 3: elements of bilinear traction",
    "angle": "C = 4: influence numbers with the angle of the surface",
    "numbers from a file": "C = 9: influence numbers from a file",
    "rigid slip of each element": "E = 2, 3, 9 by strips or with M = 2, 3, 5, or E = 2, 3 with T = 2",
    "direction": "a rolling direction CHI other than 0 and 180 degrees",
    "place of spin": "FACPHI other than 1/6, the part of a step at which spin counts: leave it out, or write .1667",
    "step of rolling": "DQ other than DX in steady rolling with G = 2",
    "temperature": "L = 6 by strips, or with unlike thermal constants",
    "factors": "IPLAN = 4: patches whose influence on each other is reduced",
    "hertz line": "IPOTCN = -4, -5, -6: line contact and SDEC",
    "friction along the profile": "V = 1 by strips",
    "force in a shift": "F = 1 of module 1, FX_WS given, with T = 1",
    "layer on strips": "M = 4 on a wheel and a rail by strips",
    "law on strips": "friction memory, two terms or constants by rows, by strips",
    "smoothing": "ISMOOTH = 2, or a smoothing beyond 50 mm",
    "damping": "M2 = 2: damping",
    "unlike bodies on strips": "unlike materials of wheel and rail by strips",
    "strips": "this case has nothing that strips solve: --fast needs steady rolling of like elastic bodies",
    "memory": "the case needs more memory than allowed",
    "follows a refused case": "the case continues one that was refused",
    "input": "the library refuses the numbers of the case",
}

#: Digits that are refused wherever they occur, by module, letter and value. C, D and L are those in force.
REFUSED: dict[int, dict[str, dict[int, str]]] = {
    3: {
        "B": {1: "thin sheet", 4: "given pressure"},
        "M": {1: "viscoelastic", 6: "simplified theory", 7: "simplified theory"},
        "C3": {3: "bilinear", 4: "angle", 9: "numbers from a file"},
    },
    1: {
        "B": {1: "thin sheet"},
        "M": {1: "viscoelastic"},
        "C3": {3: "bilinear", 4: "angle"},
    },
}
#: The same for the half space only: with `fast` strips take their place.
REFUSED_ON_GRID: dict[int, dict[str, dict[int, str]]] = {
    3: {},
    1: {
        "M": {6: "simplified theory", 7: "simplified theory"},
    },
}
_IN_FORCE = {"C3": "INFLUENCE", "L": "LAW", "D": "SEARCH"}


class RefusedError(ContactError):
    """A case cannot run; `reason` is a key of `REASONS`."""

    def __init__(self, reason: str, message: str) -> None:
        super().__init__(message)
        self.reason = reason


def refuse(case: Case, reason: str, more: str = "") -> RefusedError:
    """Return the error that refuses a case."""
    return RefusedError(reason, f"{case.place}: {more or reason} is not solved here ({REASONS[reason]})")


def require_digits(case: Case, fast: bool) -> None:
    """Raise a `RefusedError` for a digit that is refused wherever it occurs."""
    for table in (REFUSED,) if fast else (REFUSED, REFUSED_ON_GRID):
        for letter, values in table[case.module].items():
            value = case.digits[letter]
            if letter in _IN_FORCE:
                value = case.get(_IN_FORCE[letter], value)
            if value in values:
                raise refuse(case, values[value], f"{letter.rstrip('3')} = {value}")
