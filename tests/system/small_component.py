"""Emit the objects of a small component, instead of a real one, which compiles for a minute: FOLDER [OTHERS …].

Before it, a component with the same functions and other data is emitted into each of the other folders.
"""

import math
import os
import sys
from pathlib import Path

from fmu_src.native.emit import ENVIRONMENT

if __name__ == "__main__" and any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
    os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | ENVIRONMENT)

import numpy as np

from contact.kernels.block import vector
from fmu_src.native.emit import emit
from fmu_src.native.kinds import SIGNATURES, Kernels
from fmu_src.native.memory import compiled


@compiled
def energy(numbers):
    """Return a sum that needs a loop and libm."""
    total = 0.0
    for x in numbers:
        total += math.exp(-x) * x * x
    return total


def entries():
    """Return functions for all `SIGNATURES`."""

    def count(values, given):
        return 3

    def work(values, work, given):
        return int(energy(vector(values, 0, 3)[0]) > 1.0)

    def outputs(values, work, h, given):
        values[0] = energy(vector(given.data[0], 0, 4)[0]) + h
        return 0

    def by_number(values, work, k, given):
        return k

    def difference(values, reference, given):
        return 1e-6

    special = {"model_outputs": outputs, "model_field": by_number, "model_difference": difference}
    special |= {"model_memory": count, "model_size": count}
    return {name: special.get(name, work) for name in SIGNATURES}


if __name__ == "__main__":
    own, *others = map(Path, sys.argv[1:])
    components = {folder: Kernels(kind="pair", entries=entries, data=lambda: (np.arange(5.0),)) for folder in others}
    emit({**components, own: Kernels(kind="pair", entries=entries, data=lambda: (np.arange(4.0),))})
