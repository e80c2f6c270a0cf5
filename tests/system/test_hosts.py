"""The native FMUs in hosts that nobody here wrote, by the scripts of `examples/hosts`. Each runs in a process of its own.

`HOSTS_PYTHON` names the interpreter in which the hosts are installed, if that is not the one of the tests:
``pip install casadi pathsim-fmi fmuloader ecospy tbb libcosimpy``.
"""

import os
import re
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest

import contact
from contact import Creepage, Separation
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from contact_fmu.tables.wheel_rail_contact import table
from contact_fmu.tables.wheel_rail_pair import table as pair_table
from contact_models.wheelset import master
from contact_models.wheelset.components import direct
from contact_models.wheelset.fmu import FmuComponent
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import CONTACT_PORTS, MOTION, SIDES, WHEELSET_PORTS

EXAMPLES = Path(__file__).parents[2] / "examples" / "hosts"
PYTHON = os.environ.get("HOSTS_PYTHON", sys.executable)
#: What the hosts have said, run by run.
LOG: list[str] = []


def run(host: str, script: str, *words: object) -> dict[str, list[float]]:
    """Run a script and return the numbers that it prints, by the words before them. Skip if `host` is not installed."""
    environment = os.environ | {"LD_LIBRARY_PATH": str(Path(PYTHON).parents[1] / "lib"), "PYTHONPATH": ""}
    found = subprocess.run([PYTHON, "-c", f"import {host}"], capture_output=True, text=True, env=environment)
    if found.returncode:
        pytest.skip(f"{host.upper()} IS NOT TESTED: {found.stderr.strip().splitlines()[-1]}")
    done = subprocess.run(
        [PYTHON, EXAMPLES / script, *map(str, words)], capture_output=True, text=True, env=environment, timeout=600
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    LOG.append(done.stdout + done.stderr)
    numbers: dict[str, list[float]] = {}
    for words_before, number in re.findall(r"^([\w./ ]+) (-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)$", done.stdout, re.MULTILINE):
        numbers.setdefault(words_before, []).append(float(number))
    return numbers


def solved(creepage: float = 1e-3, **options: str) -> contact.Solution:
    """Return the solution of the default parameters, in which one creepage is not 0."""
    start = {row.name: row.start for row in table().rows}
    y = [start["geometry.y0"] + start["geometry.dy"] * i for i in range(len(start["geometry.g"]))]
    separation = Separation(y, start["geometry.g"], start["geometry.A"])
    return contact.solve(separation, Creepage(creepage, 0.0, 0.0), load=start["load.normal_force"], **options)


def test_casadi_has_the_contact_as_a_function_with_its_jacobian(native, open_native):
    found = run("casadi", "casadi_sensitivity.py", native)
    assert found["force.x"] == [pytest.approx(solved().Fx, rel=1e-12)]
    fmu = open_native("ModelExchange")
    fmu.update({"creepage.longitudinal": 1e-3})
    fmu.initialize()
    references = [[fmu.variables[name].valueReference] for name in ("force.x", "creepage.longitudinal")]
    (slope,) = fmu.fmu.getDirectionalDerivative(*references, [1.0])
    assert found["slope"] == [pytest.approx(slope, rel=1e-9)]


def test_pathsim_steps_the_contact(native):
    """The force is that of the tenth step, which starts from the ninth."""
    assert run("pathsim_fmi", "pathsim_contact.py", native)["force.x"] == [pytest.approx(solved().Fx, rel=1e-4)]


def test_fmuloader_gives_the_same_digits(native):
    assert run("fmuloader", "fmuloader_contact.py", native)["force.x"] == [pytest.approx(solved().Fx, rel=1e-12)]


def test_fmuloader_gives_adjoint_derivatives_of_fmi_3(native):
    found = run("fmuloader", "fmuloader_contact.py", native.parent / "fmi3" / "WheelRailContact.fmu")
    assert found["force.x"] == [pytest.approx(solved().Fx, rel=1e-12)]
    assert found["adjoint"] == found["directional"]
    assert found["adjoint"][0] < -1e6


def test_libcosim_chooses_a_method_by_its_number(native):
    names = list(contact.methods().batched.tangential)
    for number in (1, 2):
        found = run("libcosimpy", "libcosim_contact.py", native, number)
        assert found["force.x"] == [pytest.approx(solved(tangential=names[number - 1]).Fx, rel=1e-4)]
        assert found["status"] == [contact.Status.OK]


def test_the_fmi_library_alone_steps_the_contact(native):
    """The FMI Library in C is the base of many tools. The wheel of libcosim exports its functions."""
    assert run("libcosimpy", "fmilib_contact.py", native)["force.x"] == [pytest.approx(solved().Fx, rel=1e-12)]
    assert "[FMILIB] Loading 'linux64' binary with 'default' platform types" in LOG[-1]


#: An input of the pair, its value, and an output that follows it.
GIVEN = ("pose.y", 2e-3, "force.y")


@pytest.fixture(scope="module")
def pair_force() -> float:
    """Return the lateral force on the right wheel of the default pair, 2 mm to the right at 20 m/s."""
    given = {row.name: row.start for row in pair_table().rows}
    velocity = Velocity(given["velocity.x"], spin=given["velocity.spin"])
    pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1 / 40)))
    solution = pair.solve(Pose(y=GIVEN[1]), velocity, load=given["load.normal_force"], friction=0.3)
    return float(solution.force[1])


@pytest.mark.parametrize(
    ("host", "script", "words", "accuracy"),
    [
        ("casadi", "casadi_sensitivity.py", GIVEN, 1e-9),
        ("fmuloader", "fmuloader_contact.py", GIVEN, 1e-9),
        ("libcosimpy", "fmilib_contact.py", GIVEN, 1e-9),
        # the steps after the first start from the last solution of the strips, so they agree to its tolerance
        ("pathsim_fmi", "pathsim_contact.py", GIVEN, 2e-4),
        ("libcosimpy", "libcosim_contact.py", (0, *GIVEN), 2e-4),
        ("ecospy", "ecos_pair.py", GIVEN, 2e-4),
    ],
)
def test_the_pair_has_the_same_force_in_every_host(native, pair_force, host, script, words, accuracy):
    found = run(host, script, native.with_name("WheelRailPair.fmu"), *words)
    assert found["force.y"] == [pytest.approx(pair_force, rel=accuracy)]


def test_ecos_reads_fmi_3(native, pair_force):
    found = run("ecospy", "ecos_pair.py", native.parent / "fmi3" / "WheelRailPair.fmu", *GIVEN)
    assert found["force.y"] == [pytest.approx(pair_force, rel=2e-4)]


def test_the_page_of_hosts_names_scripts_and_tests_that_exist():
    """docs/use/fmu/hosts.md lists the tests of every class of wrong calls."""
    tests = Path(__file__).parent
    page = (tests.parents[1] / "docs" / "use" / "fmu" / "hosts.md").read_text(encoding="utf-8")
    defined = "".join(
        path.read_text(encoding="utf-8") for path in (*tests.glob("test_*.py"), *tests.parent.glob("test_*.py"))
    )
    named = re.findall(r"`([\w/.]+)`", page[page.index("| class |") :])
    assert len(named) > 15
    for name in named:
        if name.endswith(".py"):
            assert (tests / name).is_file() or (tests.parent / name).is_file(), name
        elif name != "threads":
            assert f"def test_{name}" in defined or f"_{name}" in defined, name
    scripts = (tests.parents[1] / "examples" / "hosts" / "readme.md").read_text(encoding="utf-8")
    for path in EXAMPLES.glob("*.py"):
        assert path.name in scripts


def test_cofmupy_couples_two_contacts(native):
    """The third step starts from the second, which started from the first."""
    assert run("cofmupy", "cofmupy_contact.py", native)["force.x"] == [pytest.approx(solved().Fx, rel=1e-4)]


STEP, STEPS = 2e-4, 60


def test_casadi_integrates_the_coupled_wheelset(native):
    """It integrates by Runge and Kutta. Our wheelset has the same motion with 1000 substeps: 3e-12 m were measured."""
    lateral = run("casadi", "casadi_coupled.py", native.with_name("coupled.ssp"), STEP, STEPS)["lateral"]
    p = WheelsetParameters(substeps=1000)
    wheelset, contacts = direct(p)
    ours = master.run(wheelset, contacts, speed=p.speed, step=STEP, duration=(STEPS + 1) * STEP)["lateral"][1:]
    assert np.ptp(lateral) > 1e-5  # it moves
    assert np.max(np.abs(lateral - ours)) < 2e-11


def test_pathsim_steps_the_coupled_wheelset_as_our_own_master(native):
    """Bit for bit. PathSim steps block by block: the wheelset with the last forces, then each contact with its new motion."""
    lateral = run("pathsim_fmi", "pathsim_coupled.py", native.with_name("coupled.ssp"), STEP, STEPS)["lateral"]
    p = WheelsetParameters()
    start = {"speed": p.speed, "wheel.radius": p.radius}
    ours = []
    with ExitStack() as stack:
        wheelset = stack.enter_context(FmuComponent(native.with_name("Wheelset.fmu"), WHEELSET_PORTS))
        contacts = [stack.enter_context(FmuComponent(native, CONTACT_PORTS, start)) for _ in SIDES]
        for k in range(STEPS):
            for side, contact in zip(SIDES, contacts, strict=True):
                wheelset.write(f"{side}.reaction", contact.read("reaction"))
            wheelset.step(k * STEP, STEP)
            for side, contact in zip(SIDES, contacts, strict=True):
                contact.write("problem", wheelset.read(f"{side}.problem"))
                contact.step(k * STEP, STEP)
            ours.append(float(wheelset.read("motion")[MOTION.index("lateral")]))
    assert lateral == ours


def test_ecos_runs_the_coupled_wheelset(native):
    """At 28 m/s the wheelset hunts with a growing amplitude of millimetres, as under our own Jacobi master."""
    lateral = run("ecospy", "ecos_coupled.py", native.with_name("coupled.ssp"))["lateral"]
    p, h = WheelsetParameters(), 5e-4
    wheelset, contacts = direct(p)
    history = master.run(wheelset, contacts, speed=p.speed, step=h, duration=3001 * h, scheme="jacobi")
    # Ecos exchanges the outputs of initialisation in another order; the difference grows with the hunting
    assert lateral[:3] == pytest.approx([history["lateral"][1000 * k] for k in (1, 2, 3)], rel=5e-4)
    assert 1e-3 < abs(lateral[3]) < 6e-3
