"""The FMU `WheelRailContact` through the C interface of FMI."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import pytest
from contact_case import NAME
from fmu_instance import ERROR, Instance

from contact_fmu.catalogue import models
from contact_fmu.python.packaging import (
    build,  # imported here, since an FMU that is loaded first brings its own pythonfmu
)

ROOT = Path(__file__).parents[2]


def test_the_build_is_reproducible(fmus, tmp_path):
    for model in models(41, accumulation=True):
        path = build(model, tmp_path)
        assert path.read_bytes() == (fmus / path.name).read_bytes()


def test_two_builds_and_two_versions_live_in_one_process(open_fmu, tmp_path):
    """If their scripts had the same name, pythonfmu would run the first for both."""
    command = [sys.executable, ROOT / "build_fmu.py", "--packaging", "python", "--out", tmp_path, "--points", "7"]
    subprocess.run(command, check=True, timeout=120, capture_output=True)
    fmpy.extract(str(tmp_path / "python" / f"{NAME}.fmu"), str(tmp_path / "seven"))
    large, small = open_fmu(NAME), Instance(tmp_path / "seven")
    for fmu in (large, small):
        fmu.initialize()
        fmu.step()
        assert fmu["force.n"] == pytest.approx(80e3)
    assert "geometry.g[41]" in large.variables
    assert "geometry.g[8]" not in small.variables
    small.fmu.freeInstance()


def test_an_fmu_of_another_version_is_refused_with_a_reason(fmus, tmp_path):
    fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path / "old"))
    (script,) = (tmp_path / "old" / "resources").glob("wheelrailcontact_*.py")
    old = script.with_name("wheelrailcontact_old.py")
    old.write_text(script.read_text().replace('guid="{', 'guid="{old-'))
    (tmp_path / "old" / "resources" / "slavemodule.txt").write_text(old.stem)
    log: list = []
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance(tmp_path / "old", log=log)
    assert "built with another version of wheelrail-contact" in log[0][1]


#: A host in Python that makes an instance by ctypes alone: valgrind takes a minute for numpy.
HOST = """
import ctypes, sys
logger = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 5)(lambda *words: None)
functions = (ctypes.c_void_p * 5)(ctypes.cast(logger, ctypes.c_void_p))
make = ctypes.CDLL(sys.argv[1]).fmi2Instantiate
make.restype = ctypes.c_void_p
print("instantiated" if make(b"a", 1, b"", sys.argv[2].encode(), functions, 0, 0) else "none")
"""
#: A slave that does at the end of a process what all do, without numpy.
SLAVE = """
from contact_fmu.python.ending import release_once
from pythonfmu.fmi2slave import Fmi2Slave
class Small(Fmi2Slave):
    def __init__(self, **given):
        super().__init__(**given)
        release_once(self.resources)
    def do_step(self, current_time, step_size):
        return True
"""


def test_a_process_ends_without_touching_freed_memory(fmus, tmp_path):
    """pythonfmu's library wrote into a freed block at the end, and now and then glibc ended the process with an error."""
    if not shutil.which("valgrind"):
        pytest.skip("THE END OF A PROCESS IS NOT CHECKED: valgrind is not installed (apt-get install valgrind)")
    folder, log = Path(fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path / "fmu"))), tmp_path / "log"
    (folder / "resources" / "small.py").write_text(SLAVE)
    (folder / "resources" / "slavemodule.txt").write_text("small")
    words = [
        sys.executable,
        "-c",
        HOST,
        folder / "binaries" / "linux64" / f"{NAME}.so",
        (folder / "resources").as_uri(),
    ]
    done = subprocess.run(
        ["valgrind", f"--log-file={log}", *words],
        check=False,
        capture_output=True,
        text=True,
        timeout=600,
        env=os.environ | {"PYTHONMALLOC": "malloc"},
    )
    assert (done.returncode, done.stdout.strip()) == (0, "instantiated"), done.stderr[-2000:]
    assert "finalizePythonInterpreter" not in log.read_text()


def test_without_the_package_no_instance_is_made_and_the_reason_is_logged(fmus, tmp_path):
    """An exception at this point would end a host that is not in Python."""
    folder = Path(fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path)))
    (script,) = (folder / "resources").glob("wheelrailcontact_*.py")
    alone = script.with_name("wheelrailcontact_alone.py")
    alone.write_text(script.read_text().replace("from contact_fmu.python", "from contact_of_nobody"))
    (folder / "resources" / "slavemodule.txt").write_text(alone.stem)
    log: list = []
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance(folder, log=log)
    assert log[0][0] == ERROR
    assert log[0][1].startswith(f"the FMU {NAME} needs the package wheelrail-contact")
