"""pytest plugin, ``-p tests.traps``: a kernel that divides by zero or takes the root of a negative number ends the process.

Multibody programs in Fortran switch such traps on. They are on while a test runs, also in NumPy. The
library is built first, without traps. They stay off in tests marked `nan`, which give a kernel NaN on purpose.
"""

import ctypes
from collections.abc import Iterator

import pytest

INVALID, DIVISION_BY_ZERO = 1, 4  # of fenv.h on x86-64
_libm = ctypes.CDLL("libm.so.6")


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """Run a test with traps. pytest prints where a process ends."""
    if item.get_closest_marker("nan") is not None:
        yield
        return
    _libm.feclearexcept(INVALID | DIVISION_BY_ZERO)
    _libm.feenableexcept(INVALID | DIVISION_BY_ZERO)
    yield
    _libm.fedisableexcept(INVALID | DIVISION_BY_ZERO)
