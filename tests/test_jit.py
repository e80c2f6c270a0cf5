"""The cache of compiled kernels depends on their content."""

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from numba import float64, njit
from numba.core.errors import TypingError
from numba.core.types.functions import BaseFunction

import contact
from contact import _jit

PACKAGE = Path(contact.__file__).parent
CHILD = """
import contact, json, sys
from contact import _jit
from contact.kernels.hertz import local_factors
local_factors(1.0, 2.0)
stats = local_factors.stats
print(json.dumps([str(_jit.cache_directory(_jit._KERNELS)), sum(stats.cache_misses.values())]))
"""


@pytest.fixture
def checkout(tmp_path):
    """Return a copy of the package that a test may change."""
    shutil.copytree(PACKAGE, tmp_path / "one" / "contact", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path / "one"


def run(checkout, cache):
    """Use one kernel in a new process. Return its cache directory and the number of kernels compiled for it."""
    environment = {**os.environ, "PYTHONPATH": str(checkout), "NUMBA_CACHE_DIR": str(cache)}
    done = subprocess.run(
        [sys.executable, "-c", CHILD], capture_output=True, text=True, env=environment, cwd=checkout, check=True
    )
    return tuple(json.loads(done.stdout))


@pytest.mark.slow
def test_only_a_changed_kernel_compiles_anew(checkout, tmp_path):
    cache = tmp_path / "cache"
    first, misses = run(checkout, cache)
    assert misses > 0
    outside = checkout / "contact" / "errors.py"
    outside.write_text(outside.read_text() + "\n# another comment\n")
    for path in checkout.rglob("*.py"):  # as when switching branches
        os.utime(path)
    assert run(checkout, cache) == (first, 0)
    other = tmp_path / "two"
    shutil.copytree(checkout, other)
    assert run(other, cache) == (first, 0)
    kernel = checkout / "contact" / "kernels" / "hertz.py"
    kernel.write_text(kernel.read_text() + "\n# another comment\n")
    changed, misses = run(checkout, cache)
    assert changed != first
    assert misses > 0


def test_stale_caches_are_removed(tmp_path):
    names = [f"{_jit._PREFIX}{i:02d}" for i in range(_jit._MOST + 2)]
    for i, name in enumerate(names):
        (tmp_path / name).mkdir()
        os.utime(tmp_path / name, (2e9 + i, 2e9 + i))
    os.utime(tmp_path / names[-1], (0.0, 0.0))  # the newest name, but not used for a long time
    (tmp_path / "of another program").mkdir()
    _jit._remove_stale(tmp_path)
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {*names[1:-1], "of another program"}


@_jit.kernel
def _times(x, factor):
    return x * factor


@_jit.kernel
def _outer(x):
    return _times(x, 2) + _times(x, 3)


def test_a_kernel_that_a_kernel_calls_is_compiled_once_and_not_for_python():
    _outer.get_overload.__self__.compile((float64,))  # what kernels link is never read from the cache
    assert _times.signatures == []
    assert len(_times.get_overload.__self__.signatures) == 1, "a literal counts as its type"
    assert _outer(1.0) == 5.0
    assert _times(2.0, 4) == 8.0
    assert len(_times.signatures) == 1


@_jit.kernel
def _long(x, n):
    for _ in range(10):
        x = math.sin(n * x) + math.cos(x + n) * math.atan(x - n) + math.tanh(x * n) + math.log(1.0 + n * x * x)
    return x


@_jit.kernel
def _calls_with_two(x):
    return _long(x, 2) + _long(x + 1.0, 2)


@njit(error_model="numpy")
def _calls_with_three(x):
    return _long(x, 3)


def test_other_machine_code_does_not_call_what_a_kernel_keeps_for_itself():
    """In `_calls_with_two` LLVM makes a version of `_long` with n = 2. Its name must not hide the one of any n."""
    assert _calls_with_two(0.1) == pytest.approx(_long.py_func(0.1, 2) + _long.py_func(1.1, 2), rel=1e-9)
    assert _calls_with_three(0.1) == pytest.approx(_long.py_func(0.1, 3), rel=1e-9)


def _polynomial(x, coefficients):
    total = 0.0
    for i in range(coefficients.shape[0]):
        total = total * x + coefficients[i] if i > 1 else min(total, coefficients[i])
    return total


def test_remembered_types_give_the_machine_code_of_numba():
    dispatcher, of_numba = _jit.kernel(_polynomial), njit(**_jit._OPTIONS, **_jit._WHOLE)(_polynomial)
    arguments = (float64, float64[::1])
    code = []
    for one in (dispatcher, of_numba):
        text = one._compiler.compile(arguments, None).library.get_asm_str()  # nothing is read from the cache
        code.append(
            [line.split("#")[0] for line in text.splitlines() if line.startswith("\tv") or line.startswith("\tj")]
        )
    assert code[0] == code[1]
    assert len(code[0]) > 5


@_jit.kernel
def _wrong(x):
    return x + "a"


def test_numba_searches_as_before_after_a_kernel_is_compiled_or_refused():
    of_numba = BaseFunction.get_call_type
    for _ in range(2):
        with pytest.raises(TypingError, match="No implementation of function"):
            _wrong(1.0)
        assert BaseFunction.get_call_type is of_numba
