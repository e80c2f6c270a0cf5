"""The library of an FMU for hosts with Python: it finds the package that is installed, or says what is missing."""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import fmpy
import pytest
from fmu_instance import DISCARD, ERROR, Instance, goes_on
from runs import RUNS
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


def conversation(fmu: Instance, other: Instance, name: str) -> list:
    """Return what an instance answers to every function of FMI 2.0, with its log. Its state goes on in the other one."""
    library, c, said = (
        fmu.fmu.dll,
        ctypes.c_void_p(fmu.fmu.component),
        [fmu.fmu.getVersion(), fmu.fmu.getTypesPlatform()],
    )
    values, (wrong, bad) = RUNS[name]
    output, known = (
        ctypes.c_uint(next(v.valueReference for v in fmu.variables.values() if v.causality == of and v.type == "Real"))
        for of in ("output", "input")
    )
    one, order, seed = ctypes.c_size_t(1), ctypes.c_int(1), ctypes.c_double(1.0)

    def call(function: str, *words) -> None:
        """Call with one more argument, into which the function may write a number or the address of a text."""
        value = (ctypes.c_char_p if function == "GetStringStatus" else ctypes.c_double)()
        status = library[f"fmi2{function}"](c, *words, ctypes.byref(value))
        said.append((function, status, value.value))

    def ask_for_status() -> None:
        for kind in range(4):
            for of in ("", "Real", "Integer", "Boolean", "String"):
                call(f"Get{of}Status", kind)

    def step(time: float, h: float = 1e-3) -> int:
        return library["fmi2DoStep"](c, ctypes.c_double(time), ctypes.c_double(h), 1)

    fmu.update(values)
    fmu.initialize(stop_time=1.0).step()
    everything = ("input", "output", "parameter")
    said.append(goes_on(fmu, other, lambda it: [(it.step(1e-3 * k), it.all(*everything)) for k in (1, 2)]))
    call("GetDirectionalDerivative", ctypes.byref(output), one, ctypes.byref(known), one, ctypes.byref(seed))
    for of in ("Real", "Integer", "Boolean", "String"):
        call(f"Get{of}", ctypes.byref(output), one)
        call(f"Set{of}", ctypes.byref(output), one)
    call("SetRealInputDerivatives", ctypes.byref(known), one, ctypes.byref(order))
    call("GetRealOutputDerivatives", ctypes.byref(output), one, ctypes.byref(order))
    said += [library["fmi2CancelStep"](c), step(2.0), step(3e-3, 2.0)]
    ask_for_status()
    fmu.update({wrong: bad})
    assert step(3e-3) == DISCARD
    ask_for_status()
    library["fmi2SetDebugLogging"](c, 0, ctypes.c_size_t(0), None)
    told = len(fmu.log)
    said.append(step(7.0))
    assert len(fmu.log) == told
    library["fmi2SetDebugLogging"](c, 1, ctypes.c_size_t(0), None)
    said += [library["fmi2Terminate"](c), step(3e-3), library["fmi2Reset"](c), fmu.initialize().all(*everything)]
    return [*said, *fmu.log]


@pytest.mark.parametrize("name", RUNS)
def test_every_function_answers_as_that_of_the_native_fmu(opened, open_fmu, name):
    """So what tests find of a native FMU holds for that of hosts with Python."""
    native = conversation(opened(name), opened(name), name)
    assert conversation(open_fmu(name), open_fmu(name), name) == native
