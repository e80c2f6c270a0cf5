"""Why a case is refused. Nothing is approximated silently: what cannot run has one of these names."""

from __future__ import annotations

from contact.errors import ContactError
from contact.inp.case import Case

#: What a case needs and this package does not have.
REASONS: dict[str, str] = {
    "viscoelastic": "M = 1: viscoelastic bodies",
    "simplified theory": "M = 2, 5, 6, 7: variants of FASTSIM and FaStrip on the grid",
    "simplified bodies": "M = 3 without given or Hertz' pressure",
    "thin sheet": "B = 1: a thin sheet on the half space",
    "parabolic pressure": "B = 3 with the elastic half space",
    "line pressure": "B = 2, 3, 4, 5, 6 of module 3 beyond an ellipse or with M other than 0 or 3",
    "fast pressure": "B = 5, 6 of module 1 with friction on the grid",
    "bilinear": "C = 3: elements of bilinear traction",
    "angle": "C = 4: influence numbers with the angle of the surface",
    "numbers from a file": "C = 9: influence numbers from a file",
    "rigid slip of each element": "E = 2, 3, 9: rigid slip that is given for each element",
    "direction": "a rolling direction CHI other than 0 and 180 degrees",
    "step of rolling": "DQ other than DX in steady rolling with G = 2",
    "temperature": "L = 6 with friction that rises, or in module 1 with several rows",
    "factors": "IPLAN = 4: patches whose influence on each other is reduced",
    "hertz line": "IPOTCN = -4, -5, -6: line contact and SDEC",
    "pair in time": "T = 1, 2 on a wheel and a rail",
    "curved pair": "D = 4: a curved reference surface",
    "true slip": "D = 3: slip on the true surfaces",
    "friction along the profile": "V = 1, 2 with friction that varies within a patch",
    "force on the wheel": "F = 1 of module 1: FX_WS given",
    "elastic rail": "F = 3: a rail on springs with the half space",
    "roller": "C1 = 4, 5: a roller with the half space",
    "flexible wheel": "E = 4, 5: a flexible wheel with the half space",
    "layer on a pair": "M = 4 on a wheel and a rail",
    "law on a pair": "friction memory, two terms or temperature on a wheel and a rail",
    "smoothing": "ISMOOTH = 2, or a smoothing beyond 50 mm",
    "damping": "M2 = 2: damping",
    "curve": "CURV: a curved track",
    "unlike bodies in a pair": "unlike materials of wheel and rail",
    "strips": "this case has nothing that strips solve: --fast needs steady rolling of like elastic bodies",
    "memory": "the case needs more memory than allowed",
    "follows a refused case": "the case continues one that was refused",
    "input": "the library refuses the numbers of the case",
}


class RefusedError(ContactError):
    """A case cannot run; `reason` is a key of `REASONS`."""

    def __init__(self, reason: str, message: str) -> None:
        super().__init__(message)
        self.reason = reason


def refuse(case: Case, reason: str, more: str = "") -> RefusedError:
    """Return the error that refuses a case."""
    return RefusedError(reason, f"{case.place}: {REASONS[reason]}{': ' if more else ''}{more} is not solved here")
