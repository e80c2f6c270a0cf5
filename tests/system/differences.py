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
