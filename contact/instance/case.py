"""Fill the CASE records with what is common to all cases: methods, material and surface. No other module does this."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.errors import require_flag, require_kind
from contact.friction import Friction
from contact.inputs.material import Material
from contact.inputs.options import ITERATIONS
from contact.kernels.records import CASE
from contact.registry import Method

Cases = NDArray[np.void]


def cases(
    n: int,
    normal: Method,
    tangential: Method,
    material: Material,
    *,
    conformal: bool = False,
    max_iterations: int = ITERATIONS.usual,
) -> Cases:
    """Return `n` CASE records for these methods and this material. All other members are zero."""
    require_kind("material", material, Material)
    made = np.zeros(n, CASE)
    made["normal"], made["normal_family"] = normal.id, normal.family
    made["tangential"], made["tangential_family"] = tangential.id, tangential.family
    made["G"], made["nu"] = material.shear_modulus, material.poisson_ratio
    made["pressure_limit"] = material.pressure_limit
    made["conformal"], made["max_iterations"] = require_flag("conformal", conformal), max_iterations
    return made


#: Members of a CASE record from the coefficient of friction to the heating, which lie side by side: those of a surface.
_FIRST, _LAST = CASE.fields["mu"][1], CASE.fields["heating"][1] + 8  # type: ignore[index]
SURFACE = slice(_FIRST, _LAST)


def surface_bytes(friction: Friction) -> bytes:
    """Return what `set_surface` writes at `SURFACE` of a CASE record, to be written often."""
    made = np.zeros(1, CASE)
    set_surface(made, friction, 0.0)
    return made.tobytes()[SURFACE]


def set_surface(made: Cases, friction: Friction, speed: ArrayLike) -> None:
    """Write friction and rolling speed [m/s] into the case records `made`."""
    for name, value in friction.members().items():
        made[name] = value
    made["speed"] = speed
