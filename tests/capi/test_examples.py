"""The examples in C, Fortran and Octave run and agree."""

import os
import re
import shutil
import subprocess

import numpy as np
import pytest

from contact.compile.library import C_INTERFACE, flags
from contact.compile.objects import objects
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from contact_fmu.native import systems
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
    flags = ("-Wall", "-Wextra", INCLUDE, f"-L{built}", "-lwheelrail", "-lm", "-o", "main")
    run("gcc", EXAMPLES / "c/wheel_on_rail.c", *flags, cwd=folder, library=built)
    return forces(run("./main", cwd=folder, library=built))


def test_the_wheel_in_c_has_the_forces_that_the_page_tells(in_c):
    page = (ROOT / "docs/use/c_interface.md").read_text(encoding="utf-8")
    told = re.search(r"It prints the forces, (\S+), (\S+) and −(\S+) kN", page).groups()
    assert [round(1e-3 * abs(force), 1) for force in in_c] == [float(number) for number in told]


@pytest.fixture(scope="module")
def implicit(built, tmp_path_factory):
    """Return a function that runs the implicit wheelset with a step, and returns what it prints."""
    folder = tmp_path_factory.mktemp("implicit")
    source = EXAMPLES / "c/implicit_wheelset.c"
    flags = ("-O2", "-Wall", "-Wextra", INCLUDE, f"-L{built}", "-lwheelrail", "-lm", "-o", "main")
    run("gcc", source, *flags, cwd=folder, library=built)
    return lambda *arguments: run("./main", *arguments, cwd=folder, library=built)


def test_a_wheelset_with_the_contact_inside_is_stable_at_long_steps(implicit):
    ends = [float(re.search(r"y (\S+)", implicit(step, 0.2))[1]) for step in (2e-3, 1e-3, 2.5e-4)]
    assert abs(ends[2]) < 2.5e-3
    assert abs(ends[1] - ends[2]) < 5e-5
    assert abs(ends[0] - ends[2]) < 2e-4


def test_forces_that_are_a_step_late_are_not(implicit):
    assert "gone" in implicit(1e-3, 0.2, "late")


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
    options = ("-std=gnu11", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")
    kernels = systems.kernels()
    sources = (ROOT / "tests/capi/attack.c", *C_INTERFACE, systems.PROCESSOR, *objects(kernels, "linux64"))
    defined = ("-DWR_SEVERAL", *flags(kernels))
    run("gcc", *options, *defined, *sources, "-lm", "-o", "attack", cwd=tmp_path, library=built)
    assert "0 failures" in run("./attack", cwd=tmp_path, library=built)


@pytest.mark.parametrize("period", [0, 1000])
def test_the_host_in_real_time_replays_the_forces_of_python(built, tmp_path, period):
    """Both wheels of a centred wheelset, 40 steps, as fast as possible and at 1 kHz."""
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
    pair = WheelRailPair(Pair(wheel, rail))
    wanted = pair.solve(Pose(), Velocity(20.0, spin=-20.0 / 0.46), vertical=60e3, friction=0.3)
    motion = np.zeros((20, 2, 16))  # wr_motion: y, z, roll, yaw, vx, vy, vz, roll rate, yaw rate, spin, rail
    motion[:, :, 1], motion[:, :, 4], motion[:, :, 9] = wanted.z, 20.0, -20.0 / 0.46
    motion.tofile(tmp_path / "motion")
    for name, shape in (("wheel", wheel), ("rail", rail)):
        np.stack((shape.y, shape.z, shape.angle)).tofile(tmp_path / name)
    source = EXAMPLES / "c/real_time.c"
    build = ["gcc", "-Wall", "-Wextra", "-Werror", source, INCLUDE, f"-L{built}", "-lwheelrail", "-lm", "-o", "main"]
    run(*build, cwd=tmp_path, library=built)
    words = ["motion", "wheel", "rail", "answers", "times", 40, period, 40, "strip_halfspace", "fastrip_mapped", 20]
    told = run("./main", *words, cwd=tmp_path, library=built)
    assert re.match(r"\d+ misses", told)
    answers = np.fromfile(tmp_path / "answers").reshape(20, 2, 5)
    assert answers[:, 0, :3] == pytest.approx(np.tile(wanted.force, (20, 1)), rel=1e-4, abs=1.0)
    assert answers[:, 1, 1] == pytest.approx(-answers[:, 0, 1], rel=1e-4)  # the left wheel mirrors the right one
    assert (answers[:, :, 3] == 1).all()
    times = np.fromfile(tmp_path / "times", dtype=np.int64).reshape(40, 2)
    assert (times[:, 0] > 0).all()
