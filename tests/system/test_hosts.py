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
from contact_models.vehicle.coupling import ANSWER, OpenVehicle
from contact_models.vehicle.declared import SIDES
from contact_models.vehicle.kernels.layout import Axis
from contact_models.wheelset.fmu import Fmu, FmuVehicle, InFmu
from contact_models.wheelset.system import python_contacts, scenario, simulation

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
    # the FMI Library in C is the base of many tools; the wheel of libcosim exports its functions
    assert "fmilib" not in script or "[FMILIB] Loading 'linux64' binary with 'default' platform types" in LOG[-1]


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


STEP, STEPS = 2e-5, 60


def test_pathsim_steps_the_coupled_wheelset_as_our_own_master(native):
    """Bit for bit. PathSim steps block by block: the vehicle with the last forces, then each pair with its new motion."""
    lateral = run("pathsim_fmi", "pathsim_coupled.py", native.with_name("coupled.ssp"), STEP, STEPS)["lateral"]
    ours = []
    with ExitStack() as stack:
        vehicle = FmuVehicle(stack.enter_context(Fmu(native.with_name("Wheelset.fmu"))))
        pairs = [stack.enter_context(InFmu(native.with_name("WheelRailPair.fmu"), side)) for side in SIDES]
        answers = np.zeros((len(SIDES), len(ANSWER)))
        for _ in range(STEPS):
            vehicle.move(answers, STEP)
            asked = vehicle.ask()
            ours.append(float(asked[0, 0]))
            answers = np.array(
                [pair.answer(row, vehicle.time - STEP, STEP) for pair, row in zip(pairs, asked, strict=True)]
            )
    assert lateral == ours


def test_ecos_runs_the_coupled_wheelset(native):
    """As under our own Jacobi master. Ecos exchanges the outputs of initialisation in another order."""
    lateral = run("ecospy", "ecos_coupled.py", native.with_name("coupled.ssp"))["lateral"]
    given = scenario()
    whole, contacts = simulation(given), python_contacts(given)
    opened, ours = OpenVehicle(whole), []
    for _ in range(4):
        opened.run(contacts, STEP, 1000, parallel=True)
        ours.append(whole.state.q[whole.model.wheelsets[0], Axis.Y])
    assert lateral == pytest.approx(ours, rel=5e-4)
    assert np.ptp(ours) > 1e-4  # it moves
