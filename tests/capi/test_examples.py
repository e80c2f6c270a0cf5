"""The examples in C, Fortran and Octave run and agree."""

import os
import re
import shutil
import subprocess

import pytest

from tests.capi.library import ROOT

EXAMPLES, INCLUDE = ROOT / "examples", f"-I{ROOT / 'contact/include'}"


def need(*tools):
    for tool in tools:
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is missing")


def run(*command, cwd, library):
    environment = os.environ | {"LD_LIBRARY_PATH": str(library)}
    done = subprocess.run(list(map(str, command)), cwd=cwd, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def forces(text):
    return [float(re.search(rf"{name} (\S+)", text)[1]) for name in ("Fx", "Fy", "Fz")]


@pytest.fixture(scope="module")
def in_c(built, tmp_path_factory):
    folder = tmp_path_factory.mktemp("c")
    source = EXAMPLES / "c/wheel_on_rail.c"
    run(
        "gcc",
        "-Wall",
        "-Wextra",
        source,
        INCLUDE,
        f"-L{built}",
        "-lwheelrail",
        "-lm",
        "-o",
        "main",
        cwd=folder,
        library=built,
    )
    return forces(run("./main", cwd=folder, library=built))


def test_the_wheel_in_c_is_pushed_up_by_its_load(in_c):
    assert in_c[2] == pytest.approx(-80e3, rel=0.05)


def test_fortran_gets_the_forces_of_c(in_c, built, tmp_path):
    need("gfortran")
    run("gcc", "-c", EXAMPLES / "fortran/wheelrail_simple.c", INCLUDE, cwd=tmp_path, library=built)
    source = EXAMPLES / "fortran/wheel_on_rail.f90"
    run(
        "gfortran", source, "wheelrail_simple.o", f"-L{built}", "-lwheelrail", "-o", "main", cwd=tmp_path, library=built
    )
    assert forces(run("./main", cwd=tmp_path, library=built)) == pytest.approx(in_c, abs=2e-3)


def test_octave_gets_the_forces_of_c(in_c, built, tmp_path):
    need("mkoctfile", "octave")
    source = EXAMPLES / "octave/wheel_on_rail.c"
    run("mkoctfile", "--mex", INCLUDE, source, f"-L{built}", "-lwheelrail", cwd=tmp_path, library=built)
    shutil.copy(EXAMPLES / "octave/example.m", tmp_path)
    assert forces(run("octave", "--no-gui", "-q", "example.m", cwd=tmp_path, library=built)) == pytest.approx(
        in_c, abs=2e-3
    )


def test_an_attacking_host_is_refused_everywhere(built, tmp_path):
    flags = ("-std=gnu11", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")
    sources = (ROOT / "tests/capi/attack.c", ROOT / "contact/c/wheelrail.c", *sorted(built.glob("*.o")))
    run("gcc", *flags, INCLUDE, f"-I{built}", *sources, "-lm", "-o", "attack", cwd=tmp_path, library=built)
    assert "0 failures" in run("./attack", cwd=tmp_path, library=built)
