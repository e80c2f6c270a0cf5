"""The library in front of pythonfmu's: it finds the resources anywhere, tells the host what Python says, and never ends it."""

import ctypes
import os
import re
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmu_instance import ERROR, OK, Instance, refused
from script_host import Script
from spellings import OF_WINDOWS, SPELLINGS

from contact.compile.linking import OF_WINDOWS as C_OF_WINDOWS
from contact.compile.linking import WITHOUT_MINGW, compiler, run
from contact_fmu.native.headers import HEADERS
from contact_fmu.python import entry

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
#: A library in place of pythonfmu's, which says the location that it got and makes no instance.
FAKE = """
#include "fmi2FunctionTypes.h"
#ifdef _WIN32
#define SHOWN __declspec(dllexport)
#else
#define SHOWN
#endif
#define NOT(name) SHOWN void fmi2##name(void) {}
SHOWN fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                          const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)type, (void)guid, (void)visible, (void)logging;
    functions->logger(functions->componentEnvironment, name, fmi2Error, "", resources);
    return 0;
}
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
    assert "undefined symbol" in message
    assert "neither" not in message
    assert "fmuType 0 is not co-simulation" in said(script("linux64"), library, resources, kind=0)[0]
    assert "slavemodule.txt cannot be read from /nowhere" in said(script("linux64"), library, "file:///nowhere")[0]


def test_a_windows_host_without_python_hears_what_is_missing(script, pair_folder, wine):
    library = pair_folder / "binaries" / "win64" / "WheelRailPair.dll"
    (message,) = said(script("win64"), library, (pair_folder / "resources").as_uri().replace("file:///", "file:///Z:/"))
    assert "pythonfmu-export.dll" in message
    assert "python3.dll on PATH" in message


@pytest.fixture(scope="module", params=["linux64", "win64"])
def location(request, script, tmp_path_factory):
    """Return a function that gives the location which pythonfmu gets for that of a host, on each platform."""
    platform = request.param
    if platform == "win64":
        request.getfixturevalue("wine")
    folder, host = tmp_path_factory.mktemp("fake"), script(platform)
    end = ".so" if platform == "linux64" else ".dll"
    functions = re.findall(r"DO\((\w+)\)", (Path(entry.__file__).parent / "c" / "entry.h").read_text())
    (folder / "fake.c").write_text(FAKE + "".join(f"NOT({name})\n" for name in set(functions) - {"Instantiate"}))
    options = ["-ldl"] if platform == "linux64" else WITHOUT_MINGW
    sources = [folder / "fake.c", *([C_OF_WINDOWS] if platform == "win64" else [])]
    objects = []
    for source in sources:
        objects.append(folder / f"{source.stem}.o")
        run(*compiler(platform), "-fPIC", "-w", f"-I{HEADERS}", "-c", source, "-o", objects[-1])
    run(*compiler(platform), "-shared", *objects, "-o", folder / f"pythonfmu-export{end}", *options)
    library = folder / f"entry{end}"
    library.write_bytes(entry.libraries()[platform])
    return lambda uris: said(host, library, *uris), platform


def of_host(folder: Path, platform: str) -> str:
    (folder / "resources").mkdir(parents=True, exist_ok=True)
    (folder / "resources" / "slavemodule.txt").write_text("a")
    uri = (folder / "resources").as_uri()
    return uri if platform == "linux64" else uri.replace("file:///", "file:///Z:/")


def test_a_plain_path_is_found_by_every_spelling(location, tmp_path):
    get, platform = location
    uri = of_host(tmp_path / "with blank", platform)
    expected = uri.replace("%20", " ")
    spellings = SPELLINGS | (OF_WINDOWS if platform == "win64" else {})
    given = get([spelling(uri) for spelling in spellings.values()])
    assert {name: one.rstrip("/").lower() for name, one in zip(spellings, given, strict=True)} == dict.fromkeys(
        spellings, expected.lower()
    )


def test_pythonfmu_gets_no_name_that_it_cannot_read(location, tmp_path):
    """On Linux it is a name in /proc, on Windows the short name of the folder, or the host hears why not."""
    get, platform = location
    names = [name for name in FOLDERS if platform == "linux64" or "?" not in name]  # no name on Windows
    for name, given in zip(names, get([of_host(tmp_path / name, platform) for name in names]), strict=True):
        assert re.fullmatch(r"file://[ -~]*|the FMU lies in .* Unzip it in a folder .*", given), (name, given)
        assert not given.startswith("file:") or "?20" not in given  # a logger gets ? for %


@pytest.fixture
def fmu(pair_folder):
    instance = Instance(pair_folder)
    yield instance
    instance.free()


def test_a_fixed_parameter_set_after_initialisation_is_an_error(fmu):
    fmu.initialize().step()
    before = fmu["wheel.radius"]
    refused(lambda: fmu.update({"wheel.radius": before + 0.1}), ERROR)
    assert fmu["wheel.radius"] == before
    assert fmu.log[-1][1] == "wheel.radius is not a variable for fmi2SetReal now"


def test_a_step_from_another_time_is_an_error_with_all_digits(fmu):
    fmu.initialize().step()
    refused(lambda: fmu.step(1.01e-3 + 1e-9), ERROR)
    assert "0.001010001" in fmu.log[-1][1]


def test_a_host_without_logging_hears_refusals_and_no_warning(pair_folder):
    description = fmpy.read_model_description(str(pair_folder))
    log: list = []
    instance = Instance(pair_folder, log)
    instance.fmu.fmi2SetDebugLogging(instance.fmu.component, 0, 0, None)
    instance.initialize()
    refused(lambda: instance.fmu.setReal([10**6], [0.0]), ERROR)
    assert not log
    instance.fmu.fmi2SetDebugLogging(instance.fmu.component, 1, 0, None)
    refused(lambda: instance.fmu.setReal([10**6], [0.0]), ERROR)
    assert len(log) == 1
    assert description.guid
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


def test_a_state_is_written_only_into_as_many_bytes_as_it_has(fmu):
    fmu.initialize().step()
    state, c = fmu.fmu.getFMUState(), ctypes.c_void_p(fmu.fmu.component)
    size = ctypes.c_size_t()
    fmu.fmu.fmi2SerializedFMUstateSize(fmu.fmu.component, state, size)
    room = (ctypes.c_char * (size.value + 100))()
    for wrong in (size.value - 1, size.value + 1, 0):
        assert fmu.fmu.dll.fmi2SerializeFMUstate(c, state, room, ctypes.c_size_t(wrong)) == ERROR
    assert fmu.fmu.dll.fmi2SerializeFMUstate(c, state, room, size) == OK
    fmu.fmu.freeFMUState(state)


def test_a_damaged_script_is_an_error_and_not_the_end(pair, tmp_path):
    """Python cannot import it."""
    folder = Path(fmpy.extract(str(pair), str(tmp_path / "x")))
    (script,) = (folder / "resources").glob("wheelrailpair_*.py")
    for n, text in enumerate(("class (", "raise ValueError('no')", "x = 1")):
        name = f"damaged_{n}"
        (folder / "resources" / f"{name}.py").write_text(text)
        (folder / "resources" / "slavemodule.txt").write_text(name)
        code = (
            "import sys; sys.path[:0] = [sys.argv[2]]\n"
            "from fmu_instance import Instance\n"
            "try: Instance(sys.argv[1])\n"
            "except Exception as error: print('refused', error)\n"
        )
        done = subprocess.run(
            [sys.executable, "-c", code, folder, Path(__file__).parent], capture_output=True, text=True
        )
        assert done.returncode == 0, (text, done.returncode, done.stderr[-500:])
        assert "refused" in done.stdout
    assert script.is_file()


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
