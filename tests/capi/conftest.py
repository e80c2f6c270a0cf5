"""Build the library once for all tests of the C interface. WHEELRAIL_BUILD names a folder with a finished one."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """Folder with libwheelrail.so, its objects and wheelrail_entries.h."""
    if shutil.which("gcc") is None:
        pytest.skip("gcc is missing")
    if "WHEELRAIL_BUILD" in os.environ:
        return Path(os.environ["WHEELRAIL_BUILD"])
    folder = tmp_path_factory.mktemp("wheelrail")
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    subprocess.run([sys.executable, "-m", "fmu_src.build_library", folder], check=True, env=environment, cwd=ROOT)
    return folder
