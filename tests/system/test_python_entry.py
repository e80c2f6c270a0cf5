"""The library of an FMU for hosts with Python: it finds the package that is installed, or says what is missing."""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmu_instance import ERROR, Instance, refused
from script_host import Script

FOLDERS = [
    "plain", "with blank", "Müller", "日本", "100%", "a+b", "it's", "no#1", "a%20b", "q?x", "ümläut %41 ✓", "&;$(x)",
]  # fmt: skip
#: A host in Python that unzips into each folder and does one step. What it prints last is where it died.
CHILD = """
import sys, fmpy
from fmpy.fmi2 import FMU2Slave
path, place, *names = sys.argv[1:]
description = fmpy.read_model_description(path)
for name in names:
    print(name, flush=True)
    folder = fmpy.extract(path, f"{place}/{name}")
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=description.modelName, instanceName="a")
    fmu.instantiate(), fmu.setupExperiment(startTime=0.0), fmu.enterInitializationMode(), fmu.exitInitializationMode()
    fmu.doStep(0.0, 1e-3)
    assert fmu.getReal([v.valueReference for v in description.modelVariables if v.name == "wheel.Q"])[0] > 1e4
    fmu.terminate(), fmu.reset(), fmu.freeInstance()
"""


@pytest.fixture(scope="module")
def pair(fmus) -> Path:
    return fmus / "WheelRailPair.fmu"


@pytest.fixture(scope="module")
def pair_folder(pair, tmp_path_factory) -> Path:
    return Path(fmpy.extract(str(pair), str(tmp_path_factory.mktemp("pair"))))


@pytest.mark.parametrize("locale", ["C.UTF-8", "C", "POSIX"])
def test_the_fmu_runs_below_every_name_of_a_folder(pair, tmp_path, locale):
    environment = os.environ | {"LC_ALL": locale}
    done = subprocess.run(
        [sys.executable, "-c", CHILD, pair, tmp_path, *FOLDERS], capture_output=True, text=True, env=environment
    )
    assert done.stdout.split("\n")[:-1] == FOLDERS, done.stderr[-2000:]
    assert done.returncode == 0, done.stderr[-2000:]


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    """Return a function that gives a C host of a platform."""
    return lambda platform: Script(platform, tmp_path_factory.mktemp(platform))


def said(script: Script, library: Path, *resources: str, kind: int = 1) -> list[str]:
    """Return what a C host without Python hears when it makes an instance at each place, which must fail without a crash."""
    words = [*script.before, script.program, library, "guid", kind, *resources]
    done = subprocess.run(
        list(map(str, words)), input="", capture_output=True, text=True, env=script.environment, timeout=120
    )
    assert done.returncode == 1, (done.returncode, done.stdout, done.stderr)
    return done.stdout.strip().split("\n")


def test_a_host_without_python_hears_what_is_missing(script, pair_folder):
    library = pair_folder / "binaries" / "linux64" / "WheelRailPair.so"
    resources = (pair_folder / "resources").as_uri()
    (message,) = said(script("linux64"), library, resources)
    assert "needs Python with the package wheelrail-contact" in message
    assert "fmuType 0 is not co-simulation" in said(script("linux64"), library, resources, kind=0)[0]


def test_a_windows_host_without_python_hears_what_is_missing(script, pair_folder, wine):
    library = pair_folder / "binaries" / "win64" / "WheelRailPair.dll"
    (message,) = said(script("win64"), library, (pair_folder / "resources").as_uri().replace("file:///", "file:///Z:/"))
    assert "python3.dll on PATH" in message


@pytest.fixture
def fmu(pair_folder):
    instance = Instance(pair_folder)
    yield instance
    instance.free()


def test_every_pointer_may_be_null(fmu):
    fmu.initialize()
    library, c = fmu.fmu.dll, ctypes.c_void_p(fmu.fmu.component)
    one = ctypes.c_size_t(1)
    for call in (verb + kind for verb in ("Get", "Set") for kind in ("Real", "Integer", "String", "Boolean")):
        assert library[f"fmi2{call}"](c, None, one, None) == ERROR
        assert library[f"fmi2{call}"](None, None, one, None) == ERROR
    for call in ("GetFMUstate", "SetFMUstate"):
        assert library[f"fmi2{call}"](c, None) == ERROR
    assert library["fmi2SerializedFMUstateSize"](c, None, None) == ERROR
    assert library["fmi2SerializeFMUstate"](c, None, None, one) == ERROR
    assert library["fmi2DeSerializeFMUstate"](c, None, one, None) == ERROR
    assert library["fmi2CancelStep"](c) == ERROR
    assert library["fmi2Instantiate"](None, 1, None, None, None, 0, 0) == 0
    library["fmi2FreeInstance"](None)
    fmu.step()


@pytest.mark.parametrize("packaging", ["python", "native"])
def test_a_time_in_single_precision_runs(fmus, native, tmp_path, packaging):
    path = (fmus if packaging == "python" else native.parent) / "EllipticContact.fmu"
    instance = Instance(Path(fmpy.extract(str(path), str(tmp_path))))
    instance.fmu.setupExperiment(startTime=100.0, stopTime=100.1)
    instance.fmu.enterInitializationMode(), instance.fmu.exitInitializationMode()
    for i in range(100):
        instance.fmu.doStep(float(np.float32(100.0 + 1e-3 * i)), 1e-3)
    refused(lambda: instance.fmu.doStep(float(np.float32(100.0 + 1e-3 * 99)), 1e-3), ERROR)
    refused(lambda: instance.fmu.doStep(100.1 + 6e-5, 1e-3), ERROR)
    instance.free()
