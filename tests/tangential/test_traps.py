"""Functions of the laws that give only forces, with floating-point traps: no creepage, no friction, both."""

import ctypes
import os
import sys

import pytest

from contact.kernels.tangential.linear import capped, smoothed

INVALID, DIVISION_BY_ZERO, OVERFLOW = 1, 4, 8  # of fenv.h on x86-64


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="feenableexcept is a function of glibc")
@pytest.mark.parametrize("bounded", [capped, smoothed])
@pytest.mark.parametrize(("force", "limit"), [(0.0, 2e4), (1e4, 2e4), (3e4, 2e4), (9e4, 2e4), (0.0, 0.0), (1e4, 0.0)])
def test_a_bounded_force_divides_by_nothing_that_is_zero(bounded, force, limit):
    """The compiler may divide before it chooses between the results."""
    factor, _ = bounded(force, limit)
    assert factor * force <= limit
    child = os.fork()
    if child == 0:
        libm = ctypes.CDLL("libm.so.6")
        libm.feenableexcept(INVALID | DIVISION_BY_ZERO | OVERFLOW)
        bounded(force, limit)
        libm.fedisableexcept(INVALID | DIVISION_BY_ZERO | OVERFLOW)
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
