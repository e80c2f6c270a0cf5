"""`make bounds` and `make traps` would see a fault, also one in a kernel that another kernel calls."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
KERNELS = """
import numpy as np
from contact.core import entry, kernel
from contact.kernels.arrays import Numbers

@kernel
def inner(a, i, below):
    return a[i] / below

@entry
def outer(a: Numbers, i: int, below: float) -> float:
    return 2.0 * inner(a, i, below)

def test_fine():
    assert outer(np.ones(3), 2, 1.0) == 2.0

def test_division():
    assert outer(np.ones(3), 2, 0.0) == np.inf

def test_index():
    outer(np.ones(3), 3, 1.0)
"""


def run(folder: Path, *options: str, **settings: str) -> subprocess.CompletedProcess[str]:
    """Run tests that read an element of three and divide it: the last one, the last one by zero, and one beyond."""
    path = folder / "test_fault.py"
    path.write_text(KERNELS)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "CONTACT_JIT": "1", **settings}
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", f"--rootdir={folder}", *options, path]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder, timeout=300)


@pytest.mark.slow
def test_the_bounds_check_sees_an_index_that_is_too_large(tmp_path):
    found = run(tmp_path, NUMBA_BOUNDSCHECK="1")
    assert "1 failed, 2 passed" in found.stdout
    assert "FAILED test_fault.py::test_index - IndexError: index is out of bounds" in found.stdout


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="feenableexcept is a function of glibc")
def test_a_division_by_zero_ends_a_process_with_traps(tmp_path):
    """Without traps it passes, as the test above shows."""
    found = run(tmp_path, "-p", "tests.traps")
    assert found.returncode < 0
    assert "Floating point exception" in found.stderr
    assert "in test_division" in found.stderr
