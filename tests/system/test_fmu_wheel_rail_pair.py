"""The FMU `WheelRailPair` in both packagings, through the C interface of FMI."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from differences import Tally, derivative, parts, quotient
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from fmu_instance import Instance
from fmu_instance_fmi3 import Instance3
from pair_case import MOTION, NAME, compare, expected, mirrored, random_case, solved
from thesis_case import THESIS

import contact
from contact.accumulation import MAXIMA, SUMS, Histogram
from contact.damage import WEAR_LAWS, DamageParameters
from contact.elastic_rail import ElasticRail
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from fmu_src.tables.wheel_rail_pair import BINS, BODIES

ROOT = Path(__file__).parents[2]
DISCARD = 2


@pytest.fixture(scope="module", params=["python", "native"])
def file(request) -> Path:
    """Return the FMU file of each packaging."""
    folder = request.getfixturevalue("fmus") if request.param == "python" else request.getfixturevalue("native").parent
    return folder / f"{NAME}.fmu"


@pytest.fixture
def open_pair(file, tmp_path):
    """Return a function that instantiates the FMU, each time from a new folder. All instances are freed at the end."""
    instances = []

    def open_pair(kind: str = "CoSimulation", path: Path = file) -> Instance:
        # pythonfmu 0.7.0 crashes at a path that must be encoded in a URI
        odd = "with blanks, ümläuts and 100 %" if file.parent.name == "native" else "plain"
        folder = tmp_path / f"{odd}{len(instances)}" / NAME
        instances.append(Instance(Path(fmpy.extract(str(path), str(folder))), kind=kind))
        return instances[-1]

    yield open_pair
    for instance in instances:
        instance.fmu.freeInstance()


@pytest.fixture
def fmu(open_pair):
    """Return an instance in MOTION under 80 kN, ready to step."""
    fmu = open_pair()
    fmu.update({**MOTION, **THESIS})
    return fmu.initialize(stop_time=1.0)


def discarded(fmu, time=0.0, h=1e-3) -> str:
    """Assert that a step is discarded, and return the message of the FMU."""
    fmu.log.clear()
    with pytest.raises(FMICallException) as caught:
        fmu.step(time, h)
    assert caught.value.status == DISCARD
    assert [status for status, _ in fmu.log] == [DISCARD]
    return fmu.log[0][1]


def test_fmpy_finds_no_problem(file):
    assert validate_fmu(str(file)) == []


def test_fmpy_finds_no_problem_in_fmi3(native_fmi3):
    assert validate_fmu(str(native_fmi3.with_name(f"{NAME}.fmu"))) == []


def test_equals_the_solver_on_random_cases(open_pair, request):
    fmu = open_pair()
    cases = 300 if "native" in request.node.name else 60
    statuses = {s.status for seed in range(cases) if (s := compare(fmu, seed))}
    assert statuses >= {contact.Status.OK, contact.Status.NO_CONTACT, contact.Status.SATURATED}


def test_left_is_the_mirror_image_of_right(fmu, open_pair):
    left = open_pair()
    left.update({**mirrored(MOTION), "side": 1, **THESIS})
    left.initialize()
    for instance in (fmu, left):
        instance.step()
    sign = {"force.x": 1, "force.y": -1, "force.z": 1, "moment.x": -1, "moment.y": 1, "moment.z": -1, "patch[1].y": -1}
    for name, factor in sign.items():
        assert left[name] == factor * fmu[name]
    assert left["patch[1].angle"] == -fmu["patch[1].angle"]
    assert left["total.energy"] == fmu["total.energy"] > 0.0


def test_a_rail_on_springs_is_in_balance_and_starts_from_its_last_deflection(open_pair):
    springs = {"rail.ky": 8e6, "rail.kz": 5e7, "rail.preload_y": 500.0, "load.kind": 3, "load.normal_force": 6e4}
    fmu, pair = open_pair(), WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1.0 / 40.0)))
    fmu.update(springs)
    fmu.initialize()
    rail = ElasticRail(8e6, 5e7, 500.0)
    for k, y in enumerate((5e-3, 6e-3, 6.5e-3)):
        fmu.update({"pose.y": y})
        fmu.step(1e-3 * k, 1e-3)
        wanted = pair.solve(Pose(y=y), Velocity(20.0, spin=-20.0 / 0.46), vertical=6e4, rail=rail)
        assert fmu["rail.deflection_y"] == pytest.approx(wanted.deflection[0], abs=1e-15)
        assert fmu["rail.deflection_z"] == pytest.approx(6e4 / 5e7, rel=1e-4)
        assert fmu["force.y"] == pytest.approx(wanted.force[1], rel=1e-12)
        assert 8e6 * fmu["rail.deflection_y"] == pytest.approx(500.0 - fmu["force.y"], abs=2.0)
    assert fmu["rail.deflection_y"] > 1e-4


def test_energy_is_the_power_times_the_time(fmu):
    energy = worn = 0.0
    for k in range(5):
        fmu.update({"pose.y": 1e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
        energy += 2e-3 * fmu["power.friction"]
        worn += 2e-3 * fmu["velocity.x"] * fmu["damage.archard_volume"]
    assert fmu["total.energy"] == pytest.approx(energy, rel=1e-12)
    assert fmu["total.worn_volume"] == pytest.approx(worn, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("pose.y", math.nan, "pose.y = nan is outside the allowed range ]-inf, inf["),
        ("pose.yaw", 0.2, "pose.yaw = 0.2 is outside the allowed range [-0.1, 0.1]"),
        ("velocity.x", -1.0, "velocity.x = -1 is outside the allowed range [0, inf["),
        ("irregularity.roll_rate", math.inf, "irregularity.roll_rate = inf is outside"),
        ("load.normal_force", -1e4, "load.normal_force = -10000 is outside the allowed range [-1000, inf["),
        ("pose.y", 1.0, "pose.y"),
        ("load.normal_force", 1e12, "load"),
    ],
)
def test_a_bad_input_is_discarded_by_name_and_the_instance_goes_on(fmu, name, value, says):
    fmu.step()
    before, good = fmu.all("output"), fmu[name]
    fmu.update({name: value})
    for _ in range(2):
        assert discarded(fmu, 1e-3).startswith(says)
    assert fmu.all("output") == before
    fmu.update({name: good})
    fmu.step(1e-3)
    assert fmu["force.y"] == before["force.y"]


def test_lift_off_is_a_valid_result(fmu):
    fmu.update({"load.normal_force": 0.0})
    fmu.step()
    outputs = fmu.all("output")
    assert outputs["status_real"] == contact.Status.NO_CONTACT
    left = ("status_real", "wheelset.z", "total.distance")
    assert not any(value for name, value in outputs.items() if name not in left)


def trajectory(fmu, start: int) -> list[dict[str, float]]:
    rows = []
    for k in range(start, start + 4):
        fmu.update({"pose.y": 6e-3 * math.sin(0.4 * k), "load.normal_force": 8e4 + 1e4 * math.cos(k)})
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows


def test_a_serialised_state_with_its_warm_start_continues_bit_by_bit(open_pair):
    fmu, other = open_pair(), open_pair()
    for instance in (fmu, other):
        instance.update(
            {**MOTION, "method.normal": list(contact.methods().batched.normal).index("strip_halfspace") + 1}
        )
        instance.initialize()
    trajectory(fmu, 0)
    state = fmu.fmu.getFMUstate()
    content = fmu.fmu.serializeFMUstate(state)
    wanted = trajectory(fmu, 4)
    fmu.fmu.setFMUstate(state)
    assert trajectory(fmu, 4) == wanted
    fmu.fmu.freeFMUstate(state)
    other.fmu.setFMUstate(other.fmu.deSerializeFMUstate(content))
    assert trajectory(other, 4) == wanted


ON = {"accumulation.wear_law": 2}


def bins(fmu, body: str, quantity: str) -> np.ndarray:
    """Return the bins of a quantity on one body."""
    return np.array(list(fmu.read(f"accumulated.{body}.{quantity}[{k + 1}]" for k in range(BINS)).values()))


def everything(fmu) -> np.ndarray:
    return np.array([bins(fmu, body, quantity) for body in BODIES for quantity in SUMS | MAXIMA])


def histograms(parameters: DamageParameters) -> dict[str, Histogram]:
    """Return the histograms of `rolled` by contact.accumulation."""
    wheel, rail = profile.s1002(), profile.rail_60e1(1 / 40)
    found = {body: Histogram(p, width=1e-3, parameters=parameters) for body, p in (("wheel", wheel), ("rail", rail))}
    pair, velocity = Pair(wheel, rail), Velocity(30.0, spin=-30.0 / 0.46 * 1.001)
    for k in range(4):
        patches = pair.contacts(Pose(y=2e-3 * k, yaw=4e-3), velocity, load=80e3)
        solutions = [
            contact.solve(p.separation, p.creepage, load=p.load, speed=30.0, throw=False, **contact.THESIS)
            for p in patches
        ]
        for histogram in found.values():
            histogram.add(patches, solutions, distance=30.0 * 2e-3)
    return found


def rolled(fmu, start: int = 0, steps: int = 4):
    for k in range(start, start + steps):
        fmu.update({"pose.y": 2e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
    return fmu


ROLLING = {"pose.yaw": 4e-3, "velocity.x": 30.0, "velocity.spin": -30.0 / 0.46 * 1.001, **THESIS}


@pytest.mark.parametrize("law", range(len(WEAR_LAWS)))
def test_accumulates_what_contact_accumulation_does(open_pair, law):
    fmu = open_pair()
    fmu.update({**ROLLING, "accumulation.wear_law": law + 2})
    rolled(fmu.initialize())
    for body, wanted in histograms(DamageParameters(wear_law=WEAR_LAWS[law])).items():
        edges = np.arange(-60, 40)
        at = np.searchsorted(np.round(wanted.edges[:-1] / 1e-3), edges)
        inside = (edges >= round(wanted.edges[0] / 1e-3)) & (at < wanted.centres.size)
        for quantity in SUMS | MAXIMA:
            theirs = np.where(inside, wanted[quantity][np.minimum(at, wanted.centres.size - 1)], 0.0)
            mine = bins(fmu, body, quantity)
            assert mine.sum() == pytest.approx(wanted[quantity].sum(), rel=1e-9), "nothing lies beyond the bins"
            np.testing.assert_allclose(mine, theirs, rtol=1e-9, atol=1e-12 * np.abs(theirs).max(), err_msg=quantity)


def test_bins_add_up_to_the_totals_and_grow_linearly(open_pair):
    fmu = open_pair()
    fmu.update({**ROLLING, **ON})
    fmu.initialize().step(0.0, 2e-3)
    once = everything(fmu)
    for k in range(1, 5):
        fmu.step(2e-3 * k, 2e-3)
    later, maxima = everything(fmu), np.flatnonzero([quantity in MAXIMA for _ in BODIES for quantity in SUMS | MAXIMA])
    np.testing.assert_allclose(np.delete(later, maxima, 0), 5.0 * np.delete(once, maxima, 0), rtol=1e-12)
    np.testing.assert_array_equal(later[maxima], once[maxima])
    assert fmu["total.distance"] == pytest.approx(30.0 * 0.01, rel=1e-12)
    for body in BODIES:
        assert bins(fmu, body, "volume").sum() == pytest.approx(fmu["total.worn_volume"], rel=1e-12)
        assert bins(fmu, body, "T_gamma").sum() == pytest.approx(fmu["total.T_gamma"], rel=1e-12)
    assert fmu["total.T_gamma"] > 0.0


def test_bins_are_part_of_the_state_and_a_discarded_step_leaves_them(open_pair):
    fmu, other = open_pair(), open_pair()
    fmu.update({**ROLLING, **ON})
    rolled(fmu.initialize(), steps=2)
    state, before = fmu.fmu.getFMUstate(), everything(fmu)
    content = fmu.fmu.serializeFMUstate(state)
    wanted = everything(rolled(fmu, 2, 2))
    assert (wanted > before).any()
    fmu.fmu.setFMUstate(state)
    np.testing.assert_array_equal(everything(fmu), before)
    good = fmu["pose.yaw"]
    fmu.update({"pose.yaw": 1.0})
    discarded(fmu, 4e-3, 2e-3)
    np.testing.assert_array_equal(everything(fmu), before)
    fmu.update({"pose.yaw": good})
    np.testing.assert_array_equal(everything(rolled(fmu, 2, 2)), wanted)
    fmu.fmu.freeFMUstate(state)
    other.fmu.setFMUstate(other.fmu.deSerializeFMUstate(content))
    np.testing.assert_array_equal(everything(other), before)
    np.testing.assert_array_equal(everything(rolled(other, 2, 2)), wanted)
    fmu.fmu.reset()
    fmu.update({**ROLLING, **ON})
    assert not everything(fmu.initialize()).any()


def test_bins_stay_zero_when_nothing_accumulates(fmu):
    fmu.step()
    assert not everything(fmu).any()
    assert fmu["total.T_gamma"] > 0.0


def exchanged(file: Path, folder: Path) -> tuple[Path, list[profile.Profile]]:
    """Return the FMU with a cone on a circular rail, from plain columns in millimetres, and the profiles as read."""
    options, read = [], []
    for kind, shape in (("wheel", profile.cone(0.05)), ("rail", profile.rail_arc(0.3))):
        path = folder / f"{kind}.txt"
        np.savetxt(path, 1e3 * np.stack((shape.y, shape.z), axis=1))
        options += [f"--{kind}", path]
        read.append(profile.read(path, kind=kind, unit="mm", side="right"))
    path = Path(shutil.copy(file, folder))
    command = [
        sys.executable,
        "-m",
        "fmu_src.profiles",
        path,
        *options,
        "--profile-unit",
        "mm",
        "--profile-side",
        "right",
    ]
    subprocess.run(command, check=True, cwd=ROOT)
    return path, read


def test_takes_a_users_own_profiles(file, open_pair, tmp_path):
    """They are replaced in the finished file, without a compiler."""
    path, profiles = exchanged(file, tmp_path)
    fmu = open_pair(path=path)
    values = {"pose.y": 1e-3, "velocity.x": 20.0, "velocity.spin": -20.0 / 0.46}
    fmu.update({**values, "track.gauge_point": 1e-3, "rail.inclination": 0.0})
    fmu.initialize().step()
    wanted = expected(solved(values, WheelRailPair(Pair(*profiles, gauge_point=1e-3))), 20.0)
    assert {name: fmu[name] for name in wanted} == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    assert fmu["patch[1].angle"] == pytest.approx(-math.atan(0.05), abs=1e-5)


@pytest.mark.parametrize("damage", ["a bit", "the end", "all"])
def test_a_damaged_profile_is_refused_when_instantiated(file, tmp_path, damage):
    folder = Path(fmpy.extract(str(file), str(tmp_path)))
    resource = folder / "resources" / "rail.profile"
    content = bytearray(resource.read_bytes())
    content[2000] ^= damage == "a bit"
    resource.write_bytes(content[:-9] if damage == "the end" else content)
    if damage == "all":
        resource.unlink()
    log = []
    with pytest.raises(Exception, match="instantiate"):
        Instance(folder, log)
    if file.parent.name == "native":  # pythonfmu prints what a constructor raises
        assert "resource rail.profile" in log[0][1]


# ---------------------------------------------------------------- only the native packaging


@pytest.fixture
def open_pair_fmi3(native_fmi3, tmp_path):
    """Return a function that instantiates the native FMU of FMI 3.0."""
    instances = []

    def open_pair_fmi3(kind: str = "CoSimulation") -> Instance3:
        folder = fmpy.extract(str(native_fmi3.with_name(f"{NAME}.fmu")), str(tmp_path / f"three{len(instances)}"))
        instances.append(Instance3(Path(folder), kind=kind))
        return instances[-1]

    yield open_pair_fmi3
    for instance in instances:
        instance.free()


@pytest.fixture
def native_pair(native, tmp_path):
    """Return a function that instantiates the native FMU."""
    instances = []

    def native_pair(kind: str = "CoSimulation", path: Path | None = None) -> Instance:
        path = path or native.with_name(f"{NAME}.fmu")
        instances.append(Instance(Path(fmpy.extract(str(path), str(tmp_path / str(len(instances))))), kind=kind))
        return instances[-1]

    yield native_pair
    for instance in instances:
        instance.fmu.freeInstance()


def test_both_packagings_go_on_alike_from_step_to_step(native_pair, open_fmu):
    """This uses interacting strips, which start from the last step."""
    one, other = native_pair(), open_fmu(NAME)
    for fmu in (one, other):
        fmu.update({**MOTION, "method.normal": list(contact.methods().normal).index("strip_halfspace") + 1})
        fmu.initialize()
    for mine, wanted in zip(trajectory(one, 0), trajectory(other, 0), strict=True):
        assert mine == pytest.approx(wanted, rel=1e-12, abs=1e-12)


def test_arrays_of_fmi3_are_the_bins(open_pair_fmi3, native_pair):
    two, three = native_pair(), open_pair_fmi3()
    for fmu in (two, three):
        fmu.update({**ROLLING, **ON})
        rolled(fmu.initialize())
    for body in BODIES:
        for quantity in SUMS | MAXIMA:
            array = three[f"accumulated.{body}.{quantity}"]
            assert array.shape == (BINS,)
            np.testing.assert_array_equal(array, bins(two, body, quantity))


def test_a_state_of_other_profiles_is_refused(native, native_pair, tmp_path):
    path, _ = exchanged(native.with_name(f"{NAME}.fmu"), tmp_path)
    one, other = native_pair(), native_pair(path=path)
    state = one.fmu.getFMUstate()
    copy = other.fmu.deSerializeFMUstate(one.fmu.serializeFMUstate(state))
    with pytest.raises(FMICallException):
        other.fmu.setFMUstate(copy)
    assert "other files in resources" in other.log[-1][1]
    other.fmu.freeFMUstate(copy)
    one.fmu.freeFMUstate(state)


WRENCH = ("force.x", "force.y", "force.z", "moment.x", "moment.y", "moment.z")


@pytest.mark.parametrize(
    ("known", "h"),
    [
        ("pose.y", 2e-8),
        ("pose.roll", 2e-8),
        ("pose.yaw", 2e-8),
        ("velocity.spin", 3e-6),
        ("velocity.yaw", 1e-7),
        ("load.normal_force", 3.0),
        ("friction.coefficient", 1e-6),
    ],
)
def test_directional_derivatives_are_those_of_the_outputs(native_pair, known, h):
    """Each component of the wrench is compared with central differences of other steps."""
    fmu = native_pair("ModelExchange")
    fmu.update({**MOTION, "pose.yaw": 1e-3})
    fmu.initialize()
    wanted = quotient(fmu, WRENCH, {known: 1.0}, h)
    np.testing.assert_allclose(derivative(fmu, WRENCH, {known: 1.0}), wanted, rtol=1e-4)
    assert wanted.all()


def test_derivatives_of_random_motions(native_pair):
    """They agree to 1e-4 of the slope of force and moment where these are smooth, for every continuous method.

    The quotients use wider and narrower steps than the FMU, so that they see every kink within its steps.
    """
    fmu, tally = native_pair("ModelExchange"), Tally()
    continuous = [method.continuous for method in contact.methods().batched.normal.values()]
    for seed in range(40):
        values, _ = random_case(seed)
        fmu.fmu.reset()
        fmu.update(values)
        load, mu = abs(fmu.initialize()["force.z"]), values["friction.coefficient"]
        if load == 0.0 or not continuous[values["method.normal"] - 1]:
            continue
        saturates = values["velocity.x"] * mu * load / (values["material.shear_modulus"] * fmu["patches.area"])
        steps = dict.fromkeys(("pose.y", "pose.roll", "pose.yaw", "irregularity.y", "irregularity.roll"), 1e-7)
        steps |= dict.fromkeys(("velocity.y", "velocity.roll", "velocity.yaw"), 1e-6 * saturates)
        steps |= {"velocity.spin": 1e-6 * saturates / values["wheel.radius"], "friction.coefficient": 1e-6 * mu}
        steps |= {"load.normal_force": 1e-4 * load} if values["load.kind"] == 1 else {"pose.z": 1e-8}
        for known, h in steps.items():
            quotients = [quotient(fmu, WRENCH, {known: 1.0}, share * h) for share in (3.0, 0.7)]
            scale = np.maximum(parts([(0, 1, 2), (3, 4, 5)], quotients[0]), 1e-9 * mu * load / h)
            tally.add((seed, known), derivative(fmu, WRENCH, {known: 1.0}), quotients, scale)
    print(f"{tally.smooth} smooth, {len(tally.rough)} not")
    assert not tally.wrong
    assert len(tally.rough) < 0.08 * tally.smooth


def test_extreme_inputs_give_finite_outputs_or_none(native_pair):
    fmu = native_pair().initialize()
    rng = np.random.default_rng(3)
    inputs = [name for name, v in fmu.variables.items() if v.causality == "input"]
    done = 0
    for _ in range(200):
        fmu.fmu.reset()
        fmu.update({"load.kind": int(rng.integers(1, 3)), "method.tangential": int(rng.integers(1, 4))})
        for name in rng.choice(inputs, rng.integers(1, 5)):
            fmu.update({name: 10.0 ** rng.choice([-300.0, -9.0, -2.0, 0.0, 9.0, 300.0]) * rng.uniform(-1.0, 1.0)})
        try:
            fmu.initialize()
            fmu.step()
        except FMICallException as error:
            if error.status != DISCARD:
                raise
            continue
        done += 1
        assert all(math.isfinite(value) for value in fmu.all("output").values())
    assert done > 20
