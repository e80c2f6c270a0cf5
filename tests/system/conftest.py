"""FMUs as a user gets them: built by the command, driven by fmpy."""

import subprocess
import sys
from pathlib import Path

import fmpy
import pytest
from fmu_instance import Instance

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def fmus(tmp_path_factory) -> Path:
    """Folder with the FMUs that `python build_fmu.py` makes."""
    folder = tmp_path_factory.mktemp("fmus")
    subprocess.run([sys.executable, ROOT / "build_fmu.py", "--out", folder], check=True, cwd=folder, timeout=120)
    return folder


@pytest.fixture
def open_fmu(fmus, tmp_path):
    """Instantiate an FMU of this name; all are freed at the end."""
    instances = []

    def open_fmu(name: str, folder: str = "") -> Instance:
        directory = tmp_path / folder / f"{name}-{len(instances)}"
        fmpy.extract(str(fmus / f"{name}.fmu"), str(directory))
        instances.append(Instance(directory))
        return instances[-1]

    yield open_fmu
    for instance in instances:
        instance.fmu.freeInstance()
