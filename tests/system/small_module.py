"""Compile a small module for all systems: FOLDER BEFORE. With BEFORE = 1 the process has compiled the same functions before."""

import math
import sys
from pathlib import Path

import numpy as np
from numba import cfunc, types

from contact.compile import emit, objects
from contact.compile.pointers import Doubles
from contact.core import arranging
from contact.kernels.block import vector


@arranging
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
