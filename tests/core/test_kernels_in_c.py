"""All kernels can become C for native FMUs. Who changes one sees it here, and not minutes later in the build of an FMU."""

import os
import re
import subprocess
import sys

import pytest

from contact.core import checkout, library
from contact_fmu.native import systems

#: Each kernel is compiled for this machine without a word: LLVM unrolls the loop, and knows how to turn the bits of a number.
REFUSED = """
import math
import numpy as np
from numba import cfunc, types
from contact.compile import emit, objects
from contact.compile.pointers import Doubles
from contact.core import arranging
@arranging
def of_tuple(x):
    total, factors = x, (x, 2.0 * x, 3.0)
    for i in range(6):
        total += factors[(5 * i * i + i) % 4]
MANY    return total
@arranging
def turned(n):
    return (n << 7) | ((n >> 57) & 127)
def first(values, x):
    values[0] = of_tuple(x) + of_tuple(x * x)
    return 0
def second(values, x):
    return turned(int(x))
emit.make_no_machine_code()
made = emit.Emission((np.arange(4.0),))
for function in (first, second):
    made.add(function.__name__, cfunc(types.int64(Doubles, types.float64))(function), "i64", ("ptr", "f64"))
module = made.module()
code = module.as_bitcode()
emit.refuse_the_rest(objects.optimised(module, objects.CPUS["v3"]))
for name in made.names:
    try:
        objects.in_c(objects.without_vectors(code, [name]), [name])
        print("accepted")
    except (RuntimeError, ValueError) as error:
        print(error)
""".replace("MANY", 40 * "    total = math.sin(total) + total * total\n")  # so many that LLVM leaves it a function


def test_every_kernel_can_be_written_as_c():
    """After a change of a kernel this takes minutes, but not after `make test`, which builds the libraries of all systems."""
    if library.INSTALLED.is_file():
        pytest.skip("an installed library was made of kernels in C")
    if (systems._compiled("systems") / "kernels.c").is_file():
        return
    from llvmlite import binding as llvm

    from contact.compile import objects

    folder = library.cached()
    if (folder / "can_be_c").is_file():
        return
    module = llvm.parse_assembly("")
    for path in folder.glob("*.bc"):
        module.link_in(llvm.parse_bitcode(path.read_bytes()))
    entries = [one.name for one in module.functions if not one.is_declaration and one.linkage is llvm.Linkage.external]
    entries = [name for name in entries if not name.startswith("_ZN")]  # which one object offers the other
    assert len(entries) > 100
    objects.in_c(objects.without_vectors(module.as_bitcode(), entries), entries)
    (folder / "can_be_c").touch()


def test_a_kernel_that_cannot_be_written_as_c_is_named():
    own = os.environ | checkout.ENVIRONMENT
    done = subprocess.run([sys.executable, "-c", REFUSED], capture_output=True, text=True, env=own, check=False)
    assert done.returncode == 0, done.stderr
    by_tuple, by_turn = done.stdout.splitlines()
    assert re.search(r"pickle.*stand in __main__\.of_tuple", by_tuple)
    assert re.search("cannot be written as C.*fsh", by_turn)
