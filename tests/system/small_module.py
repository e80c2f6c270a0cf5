"""Compile a small module for all systems: FOLDER BEFORE. With BEFORE = 1 the process has compiled the same functions before."""

import math
import sys
from pathlib import Path

from fmu_src.native import emit

if __name__ == "__main__":
    emit.ensure_environment("tests.system.small_module")

import numpy as np
from numba import cfunc, types

from contact.kernels.block import vector
from fmu_src.native import objects
from fmu_src.native.memory import Doubles, compiled


@compiled
def energy(numbers):
    """Return a sum that needs a loop and libm."""
    total = 0.0
    for x in numbers:
        total += math.exp(-x) * x * x
    return total


def outputs(values, h, table):
    values[0] = energy(vector(table, 0, 4)[0]) + h
    return 0


if __name__ == "__main__":
    emit.make_no_machine_code()
    for _ in range(1 + int(sys.argv[2])):
        made = emit.Emission((np.arange(4.0),))
        made.add("outputs", cfunc(types.int64(Doubles, types.float64, Doubles))(outputs), "i64", ("ptr", "f64"))
    text = emit.data_as_ir(made.data)
    objects.write(made.module().as_bitcode(), made.names, [], text, {"kernels.c": made.names}, Path(sys.argv[1]))
