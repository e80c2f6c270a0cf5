"""Difference quotients of outputs in model exchange, to check directional derivatives."""

from collections.abc import Iterable, Mapping

import numpy as np
from fmu_instance import Instance


def derivative(fmu: Instance, unknowns: Iterable[str], direction: Mapping[str, float]) -> np.ndarray:
    """Return the FMU's derivative of each unknown along the direction (knowns with their seeds)."""
    references = ([fmu.variables[name].valueReference for name in names] for names in (unknowns, direction))
    return np.array(fmu.fmu.getDirectionalDerivative(*references, list(direction.values())))


def quotient(fmu: Instance, unknowns: Iterable[str], direction: Mapping[str, float], h: float) -> np.ndarray:
    """Return the same derivative by a central difference of fourth order with steps of h along the direction."""
    at, names, found = fmu.read(direction), list(unknowns), []
    for k in (-2, -1, 1, 2, 0):
        fmu.update({name: at[name] + k * h * seed for name, seed in direction.items()})
        found.append(np.array(list(fmu.read(names).values())) if k else np.nan)
    return (found[0] - 8.0 * found[1] + 8.0 * found[2] - found[3]) / (12.0 * h)


def parts(vectors: Iterable[Iterable[int]], slopes: np.ndarray) -> np.ndarray:
    """Return for each slope the norm of the vector to which it belongs. Differences are relative to it."""
    sizes = np.zeros_like(slopes)
    for vector in map(list, vectors):
        sizes[vector] = np.linalg.norm(slopes[vector])
    return sizes


class Tally:
    """Derivatives of many cases compared with quotients of two step sizes.

    If the two quotients agree to a quarter of TOLERANCE, the output is smooth and the derivative must agree with them.
    Otherwise a kink lies within a step (an element changes from stick to slip, a patch appears), and the case is not judged.
    """

    TOLERANCE = 1e-4

    def __init__(self) -> None:
        self.smooth, self.rough, self.wrong = 0, [], {}

    def add(self, what: object, slopes: np.ndarray, quotients: Iterable[np.ndarray], scale: np.ndarray) -> None:
        """Add one case. Differences are divided by `scale`."""
        wide, narrow = quotients
        if (np.abs(wide - narrow) > 0.25 * self.TOLERANCE * scale).any():
            self.rough.append(what)
            return
        self.smooth += 1
        error = np.minimum(np.abs(slopes - wide), np.abs(slopes - narrow)) / scale
        if not error.max() <= self.TOLERANCE:
            self.wrong[what] = f"{error.max():.1e}"
