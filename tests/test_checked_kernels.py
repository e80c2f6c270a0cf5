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

def test_outer():
    assert outer(np.ones(3), {index}, {below}) > 0.0
"""


def run(folder: Path, index: int, below: float, *options: str, **settings: str) -> subprocess.CompletedProcess[str]:
    """Run a test that reads element `index` of three and divides it by `below`."""
    path = folder / "test_fault.py"
    path.write_text(KERNELS.format(index=index, below=below))
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "CONTACT_JIT": "1", **settings}
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", f"--rootdir={folder}", *options, path]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder, timeout=300)


@pytest.mark.slow
def test_the_bounds_check_sees_an_index_that_is_too_large(tmp_path):
    assert run(tmp_path, 2, 1.0, NUMBA_BOUNDSCHECK="1").returncode == 0
    found = run(tmp_path, 3, 1.0, NUMBA_BOUNDSCHECK="1")
    assert found.returncode == 1
    assert "IndexError: index is out of bounds" in found.stdout


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="feenableexcept is a function of glibc")
def test_a_division_by_zero_ends_a_process_with_traps(tmp_path):
    assert run(tmp_path, 2, 1.0, "-p", "tests.traps").returncode == 0
    assert run(tmp_path, 2, 0.0).returncode == 0  # infinite, and greater than zero
    found = run(tmp_path, 2, 0.0, "-p", "tests.traps")
    assert found.returncode < 0
    assert "Floating point exception" in found.stderr
