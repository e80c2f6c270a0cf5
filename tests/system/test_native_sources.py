"""The sources of a native FMU: C that any compiler makes the same FMU of, also for other processors."""

import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import fmpy
import numpy as np
import pytest

from fmu_src.native.linking import FROM_C, link, run
from reference.native import HOST

FLAGS = ("-std=c11", "-O1", "-ffp-contract=off", "-Wall", "-Wno-unused-parameter", "-fno-sanitize=undefined")
NAMES = ("EllipticContact", "WheelRailContact", "WheelRailPair", "Wheelset")


@pytest.fixture(scope="module")
def unzipped(native, tmp_path_factory):
    """Return a function that unzips an FMU once and returns its folder."""

    @cache
    def make(name: str) -> Path:
        return Path(fmpy.extract(str(native.with_name(f"{name}.fmu")), str(tmp_path_factory.mktemp(name))))

    return make


def _listed(folder: Path) -> list[Path]:
    """Return the source files that the model description names."""
    description = fmpy.read_model_description(str(folder))
    names = description.coSimulation.sourceFiles
    assert names == description.modelExchange.sourceFiles
    return [folder / "sources" / name for name in names]


def _embedded(folder: Path, target: str, *options: str) -> Path:
    """Compile the FMU's sources and a host to one program for a target of zig."""
    program = folder / f"embedded-{target}"
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", target]
    run(*zig, *FLAGS, *options, f"-I{folder / 'sources'}", *_listed(folder), HOST / "embedded.c", "-o", program, "-lm")
    return program


def _outputs(folder: Path) -> list[int]:
    description = fmpy.read_model_description(str(folder))
    return [v.valueReference for v in description.modelVariables if v.causality == "output" and v.type == "Real"]


def _said(folder: Path, program: Path, *before: str) -> np.ndarray:
    """Return all outputs after three steps."""
    words = [*before, program, (folder / "resources").as_uri(), *_outputs(folder)]
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


@pytest.mark.parametrize("name", NAMES)
def test_the_sources_give_the_numbers_of_the_library(unzipped, name):
    """Bit for bit: the same operations and the same C library."""
    folder = unzipped(name)
    expected = _of_library(folder)
    assert np.count_nonzero(expected) > 3
    np.testing.assert_array_equal(_said(folder, _embedded(folder, "x86_64-linux-gnu.2.17")), expected)


def test_on_64_bit_arm_the_sources_give_the_same_numbers(unzipped):
    """Run by qemu. Its C library, musl, differs from glibc in the last digit of exp, log and pow."""
    qemu = shutil.which("qemu-aarch64") or shutil.which("qemu-aarch64-static")
    if not qemu:
        pytest.skip("64-BIT ARM IS NOT TESTED: qemu is not installed (apt-get install qemu-user)")
    folder = unzipped("WheelRailContact")
    found, expected = _said(folder, _embedded(folder, "aarch64-linux-musl", "-static"), qemu), _of_library(folder)
    scale = np.maximum(np.abs(expected), 1e-9 * np.max(np.abs(expected)))
    assert np.max(np.abs(found - expected) / scale) < 1e-6


def test_fmi_3_lists_the_same_files(native_fmi3_folder, unzipped):
    description = fmpy.read_model_description(str(native_fmi3_folder))
    (files,) = description.buildConfigurations[0].sourceFileSets
    assert [native_fmi3_folder / "sources" / name for name in files.sourceFiles] == [
        native_fmi3_folder / "sources" / path.name for path in _listed(unzipped("WheelRailContact"))
    ]
    assert all((native_fmi3_folder / "sources" / name).exists() for name in files.sourceFiles)


@pytest.mark.parametrize("platform", FROM_C)
def test_the_option_arm_makes_a_library_from_the_same_sources(unzipped, tmp_path, platform):
    """It needs nothing but the C library, and has all functions of FMI."""
    folder = unzipped("EllipticContact")
    library = link(platform, "EllipticContact", sorted((folder / "sources").iterdir()), [], tmp_path)
    content = library.read_bytes()
    assert content[:4] in (b"\x7fELF", b"\xcf\xfa\xed\xfe")
    assert all(name in content for name in (b"fmi2DoStep", b"fmi3DoStep"))
