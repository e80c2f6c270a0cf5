"""Workers that need the same kernel at the same time compile it once."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CHILD = """
import sys, time
from pathlib import Path
import pytest
from contact.kernels.hertz import local_factors
from tests.compile_once import compile_once
folder, name = Path(sys.argv[1]), sys.argv[2]
compile_once(pytest.MonkeyPatch(), folder / "locks")
(folder / name).touch()
while not (folder / "go").exists():
    time.sleep(1e-3)
local_factors(1.0, 2.0)
print(sum(local_factors.stats.cache_misses.values()))
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no fcntl: there each worker compiles")
def test_one_of_two_processes_compiles(tmp_path):
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    children = [
        subprocess.Popen(
            [sys.executable, "-c", CHILD, tmp_path, name], stdout=subprocess.PIPE, text=True, env=environment, cwd=ROOT
        )
        for name in ("one", "other")
    ]
    while not all((tmp_path / name).exists() for name in ("one", "other")):
        assert all(child.poll() is None for child in children)
        time.sleep(1e-3)
    (tmp_path / "go").touch()
    assert sorted(int(child.communicate(timeout=300)[0]) for child in children) == [0, 1]
