"""The sources of a native FMU: C that any compiler makes the same FMU of, also for other processors."""

import itertools
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import fmpy
import numpy as np
import pytest
from script_host import Script

from contact.compile import linking
from contact.compile.linking import run
from contact_fmu.native import systems
from contact_fmu.native.headers import HEADERS
from reference.native import HOST, compile_once

STRICT = ("-std=c11", "-Wall", "-Wextra", "-Werror")
#: Numbers are the same at every level. -O0 compiles kernels four times as fast as -O1.
FLAGS = (*STRICT, "-O0", "-ffp-contract=off", "-fno-sanitize=undefined")
LINUX, ARM = "x86_64-linux-gnu.2.17", "aarch64-linux-musl"
VEHICLES = ("Vehicle", "OpenVehicle")
NAMES = ("EllipticContact", "WheelRailContact", "WheelRailPair", "Wheelset", *VEHICLES)


@pytest.fixture(scope="module")
def unzipped(request, native, unzipped):
    """Return a function that gives the folder of an FMU by its name."""

    def folder(name: str) -> Path:
        place = request.getfixturevalue("native_vehicles") if name in VEHICLES else native.parent
        return unzipped(place / f"{name}.fmu")

    return folder


def _listed(folder: Path) -> list[Path]:
    """Return the source files that the model description names."""
    (build,) = fmpy.read_model_description(str(folder)).buildConfigurations
    (files,) = build.sourceFileSets
    return [folder / "sources" / name for name in files.sourceFiles]


def _objects(folder: Path, into: Path, target: str) -> list[Path]:
    """Compile the FMU's sources for a target of zig, with its name before the functions of FMI. Return the objects."""
    objects, options = [], [*FLAGS, f"-I{folder / 'sources'}"]
    into.mkdir()
    for path in _listed(folder):
        objects.append(into / f"{path.stem}.o")
        prefix = (
            []
            if path.stem.endswith(("_kernels", "_data"))
            else [f"-DFMI{v}_FUNCTION_PREFIX={into.name}_" for v in (2, 3)]
        )
        compile_once(_zig(target), (*options, *prefix, "-c", path), folder / "sources", objects[-1])
    return objects


def _zig(target: str) -> list[str]:
    return [sys.executable, "-m", "ziglang", "cc", "-target", target]


def _embedded(objects: dict[str, list[Path]], into: Path, target: str, *options: str) -> Path:
    """Link the objects of FMUs, by their names, and a host to one program for a target of zig."""
    listed = "".join(f"DO({name})" for name in objects)
    parts = [f"-I{HEADERS}", f"-DFMUS(DO)={listed}", *itertools.chain(*objects.values()), HOST / "embedded.c"]
    run(*_zig(target), *FLAGS, *options, *parts, "-o", into / "embedded", "-lm")
    return into / "embedded"


def _outputs(folder: Path) -> list[int]:
    description = fmpy.read_model_description(str(folder))
    return [v.valueReference for v in description.modelVariables if v.causality == "output" and v.type == "Real"]


def _said(folders: Sequence[Path], program: Path, *before: str) -> np.ndarray:
    """Return all outputs of the FMUs in a program after three steps."""
    words: list[object] = [*before, program]
    for folder in folders:
        outputs, guid = _outputs(folder), fmpy.read_model_description(str(folder)).guid
        words += [guid, (folder / "resources").as_uri(), len(outputs), *outputs]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return np.array([float.fromhex(line) for line in done.stdout.split()])


def _of_library(folder: Path) -> np.ndarray:
    """Return the same outputs of the library in the FMU."""
    description = fmpy.read_model_description(str(folder))
    fmu = fmpy.instantiate_fmu(str(folder), description, fmi_type="CoSimulation")
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    for i in range(3):
        fmu.doStep(1e-3 * i, 1e-3)
    values = np.array(fmu.getReal(_outputs(folder)))
    fmu.terminate()
    fmu.freeInstance()
    return values


@pytest.mark.parametrize("name", NAMES[2:])
def test_the_sources_give_the_numbers_of_the_library(unzipped, tmp_path, name):
    """Bit for bit: the same operations and the same C library. For the others see the two FMUs in one program."""
    if name in VEHICLES and "SOAK" not in os.environ:
        pytest.skip(f"THE SOURCES OF {name} ARE NOT COMPILED: minutes, run by make soak")
    folder = unzipped(name)
    expected = _of_library(folder)
    assert np.count_nonzero(expected) > 3
    objects = {name: _objects(folder, tmp_path / name, LINUX)}
    np.testing.assert_array_equal(_said([folder], _embedded(objects, tmp_path, LINUX)), expected)


@pytest.mark.parametrize("name", NAMES)
def test_gcc_has_no_remark_on_the_sources(unzipped, name):
    """They are strict C11. The other tests compile them with clang, without -pedantic, which a header of FMI does not pass."""
    if not shutil.which("gcc"):
        pytest.skip("GCC DOES NOT READ THE SOURCES: it is not installed (apt-get install gcc)")
    run("gcc", *STRICT, "-pedantic-errors", "-fsyntax-only", *_listed(unzipped(name)))


def test_on_64_bit_arm_the_sources_give_the_same_numbers(unzipped, tmp_path):
    """Run by qemu. Its C library, musl, differs from glibc in the last digit of exp, log and pow."""
    qemu = shutil.which("qemu-aarch64") or shutil.which("qemu-aarch64-static")
    if not qemu:
        pytest.skip("64-BIT ARM IS NOT TESTED: qemu is not installed (apt-get install qemu-user)")
    folder = unzipped("WheelRailContact")
    objects = {"WheelRailContact": _objects(folder, tmp_path / "WheelRailContact", ARM)}
    found, expected = _said([folder], _embedded(objects, tmp_path, ARM, "-static"), qemu), _of_library(folder)
    scale = np.maximum(np.abs(expected), 1e-9 * np.max(np.abs(expected)))
    assert np.max(np.abs(found - expected) / scale) < 1e-6


def test_two_fmus_link_into_one_program_and_give_their_numbers(unzipped, tmp_path):
    """All their names begin with the name of the FMU: none clashes, not even between two FMUs with the same kernels."""
    names = ("EllipticContact", "WheelRailContact")
    objects = {name: _objects(unzipped(name), tmp_path / name, LINUX) for name in names}
    for name, of_fmu in objects.items():
        said = subprocess.run(
            ["nm", "-g", "--defined-only", *of_fmu], check=True, capture_output=True, text=True
        ).stdout
        seen = {line.split()[2] for line in said.splitlines() if len(line.split()) == 3}
        assert {f"{name}_fmi2DoStep", f"{name}_fmi3DoStep"} <= seen
        assert {symbol for symbol in seen if not symbol.startswith(f"{name}_")} == set()
    found = _said([unzipped(name) for name in names], _embedded(objects, tmp_path, LINUX))
    np.testing.assert_array_equal(found, np.concatenate([_of_library(unzipped(name)) for name in names]))


def test_a_host_of_fmi_3_gets_the_prefix_and_may_cancel_it(native_fmi3_folder):
    """fmpy and others define FMI3_OVERRIDE_FUNCTION_PREFIX for a shared library."""
    (build,) = fmpy.read_model_description(str(native_fmi3_folder)).buildConfigurations
    (files,) = build.sourceFileSets
    (prefix,) = files.preprocessorDefinitions
    assert (prefix.name, prefix.value) == ("FMI3_FUNCTION_PREFIX", "WheelRailContact_")
    assert (native_fmi3_folder / "sources" / "fmi3Functions.h").read_text().count("FMI3_OVERRIDE_FUNCTION_PREFIX") >= 2


def test_fmi_3_lists_the_same_files(native_fmi3_folder, unzipped):
    names, others = (
        [path.name for path in _listed(folder)] for folder in (native_fmi3_folder, unzipped("WheelRailContact"))
    )
    assert names == others
    assert all(path.exists() for path in _listed(native_fmi3_folder))


@pytest.mark.skipif("SOAK" not in os.environ, reason="A VEHICLE UNDER WINDOWS IS NOT TESTED: minutes, run by make soak")
@pytest.mark.usefixtures("wine")
@pytest.mark.parametrize("name", VEHICLES)
def test_a_vehicle_has_the_same_numbers_under_wine(unzipped, tmp_path, name):
    """Ten steps in C, by the libraries for Linux and for Windows."""
    folder = unzipped(name)
    commands = "\n".join(["i", *(f"d {2e-4 * k!r} 2e-4" for k in range(10)), *(f"g {r}" for r in _outputs(folder))])
    linux, windows = (Script(p, tmp_path)(folder, 1, commands) for p in ("linux64", "win64"))
    assert np.count_nonzero(linux) > 50
    assert np.max(np.abs(windows - linux) / np.maximum(np.abs(linux), 1e-9)) < 1e-6


@pytest.mark.parametrize("system", systems.ARM)
def test_the_option_arm_makes_a_library_with_all_functions_of_fmi(system, tmp_path, monkeypatch):
    """It is compiled here at -O0, by LLVM's older selection of instructions: in a tenth of the time."""
    if "darwin" in system and "SOAK" not in os.environ:
        pytest.skip(
            "A LIBRARY FOR MACOS ON ARM IS NOT LINKED: that for x86-64 is, and one for Linux on ARM; run by make soak"
        )
    for name in ("FLAGS", "_VISIBLE"):
        slow = (flag for flag in getattr(linking, name) if flag != "-O2")
        monkeypatch.setattr(linking, name, (*slow, "-O0", "-mllvm", "-global-isel=0"))
    systems._link(systems.kernels(), tmp_path, (system,), print)
    content = (tmp_path / system / systems.SYSTEMS[system]).read_bytes()
    assert content[:4] in (b"\x7fELF", b"\xcf\xfa\xed\xfe")
    assert all(name in content for name in (b"fmi2DoStep", b"fmi3DoStep"))
