"""The native `WheelRailContact` as a whole, through the C interface of FMI, against the solver it was compiled from."""

import ctypes
import math
import re
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from contact_case import CREEPAGES, NAME, geometry, separation
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

import contact
from contact.damage import evaluate
from fmu_src.catalogue import models
from fmu_src.native.emit import CPUS
from fmu_src.native.packaging import compiler, kernels, run
from fmu_src.tables.wheel_rail_contact import table

ROOT = Path(__file__).parents[2]
OK, WARNING, DISCARD, ERROR = range(4)
METHODS = contact.methods()
OUTPUTS = (
    *("force.x", "force.y", "force.n", "moment.z", "approach", "pressure.max", "patch.area", "patch.length"),
    *("patch.width", "slip.ratio", "power.friction", "damage.T_gamma", "damage.wear_rate_pearce_sherratt"),
    *("damage.index_burstow", "damage.wear_rate_usfd", "damage.archard_depth_max", "damage.archard_volume"),
    *("damage.fatigue_index_surface", "damage.stress_index_max", "damage.energy_index_max", "stiffness.normal"),
)


def expected(s: contact.Solution, radius: float) -> np.ndarray:
    """OUTPUTS by the solver."""
    d = evaluate(s, radius)
    power = s.speed * s.power_per_metre
    return np.array(
        [
            *(s.Fx, s.Fy, s.N, s.Mz, s.approach, s.max_pressure, s.area, s.length, s.width, s.slip_ratio, power),
            *(d.T_gamma, d.pearce_sherratt, d.burstow, d.usfd, d.archard.depth_max, d.archard.volume),
            *(d.fatigue_index, d.stress_index.max, d.energy_index.max, s.normal_stiffness),
        ]
    )


def scales(s: contact.Solution, wanted: np.ndarray) -> np.ndarray:
    """What a difference of OUTPUTS is measured by: the value, but mu N of forces, mu N times 2 cm of the moment, 1 of slip."""
    scale = np.abs(wanted)
    scale[:2], scale[3], scale[9] = s.friction * s.N, s.friction * s.N * 0.02, 1.0
    return scale


def random_case(seed: int) -> tuple[dict[str, float], contact.Solution, float]:
    """Values of the FMU, the solver's answer to the same problem, and the wheel's radius."""
    rng = np.random.default_rng(seed)
    y0, dy = rng.uniform(-0.022, -0.018), rng.uniform(0.9e-3, 1.1e-3)
    y = y0 + dy * np.arange(41)
    centre, B, skew, wave = (
        rng.uniform(-8e-3, 8e-3),
        10 ** rng.uniform(-0.3, 1.7),
        rng.uniform(-20, 20),
        rng.uniform(-1, 1),
    )
    g = B * (y - centre) ** 2 * (1.0 + skew * (y - centre)) + 2e-6 * wave * np.cos(900.0 * y) + rng.uniform(-1e-5, 1e-5)
    A = rng.uniform(0.8, 1.6) + rng.uniform(-8.0, 8.0) * y
    curvatures, by_load = rng.random() < 0.2, rng.random() < 0.7
    load, approach = 10 ** rng.uniform(3.5, 5.2), rng.uniform(-2e-5, 2e-4)
    vx, vy = 10 ** rng.uniform(-5, -1.7, 2) * rng.choice([-1, 1], 2)
    spin = 10 ** rng.uniform(-3, 0.5) * rng.choice([-1, 1])
    G, nu, H, k = rng.uniform(70e9, 90e9), rng.uniform(0.0, 0.5), rng.uniform(2e9, 4e9), rng.uniform(2e8, 4e8)
    mu, speed, radius = rng.uniform(0.0, 0.6), rng.uniform(1.0, 80.0), rng.uniform(0.3, 0.6)
    normal, tangential = rng.integers(len(METHODS.normal)), rng.integers(len(METHODS.tangential))
    n_strips, n_elements = (int(n) for n in rng.integers(6, 40, 2))
    values = {
        "geometry.kind": 2 if curvatures else 1,
        "geometry.y0": y0,
        "geometry.dy": dy,
        **{f"geometry.g[{i}]": v for i, v in enumerate(g, 1)},
        **{f"geometry.A[{i}]": v for i, v in enumerate(A, 1)},
        "geometry.A0": A[20],
        "geometry.B0": B,
        "load.kind": 1 if by_load else 2,
        "load.normal_force": load,
        "load.approach": approach,
        **dict(zip(CREEPAGES, (vx, vy, spin), strict=True)),
        "material.shear_modulus": G,
        "material.poisson_ratio": nu,
        "material.hardness": H,
        "material.shear_yield": k,
        "friction.coefficient": mu,
        "speed": speed,
        "wheel.radius": radius,
        "method.normal": int(normal) + 1,
        "method.tangential": int(tangential) + 1,
        "resolution.n_strips": n_strips,
        "resolution.n_elements": n_elements,
    }
    solution = contact.solve(
        contact.Separation.hertzian(A[20], B) if curvatures else contact.Separation(y, g, A),
        contact.Creepage(vx, vy, spin),
        load=load if by_load else None,
        approach=None if by_load else approach,
        friction=mu,
        material=contact.Material(G, nu, hardness=H, shear_yield=k),
        speed=speed,
        normal=list(METHODS.normal)[normal],
        tangential=list(METHODS.tangential)[tangential],
        n_strips=n_strips,
        n_elements=n_elements,
        throw=False,
    )
    return values, solution, radius


@pytest.fixture
def fmu(open_native):
    """In the case of `separation` and CREEPAGES, ready to step."""
    return posed(open_native()).initialize(stop_time=1.0)


def posed(fmu):
    fmu.update({**geometry(), **CREEPAGES, "geometry.y0": -0.02, "geometry.dy": 0.001, "speed": 30.0})
    return fmu


def refused(call, status: int) -> None:
    with pytest.raises(FMICallException) as caught:
        call()
    assert caught.value.status == status


def discarded(fmu, time=0.0, h=1e-3) -> str:
    """Step, see it discarded, return what the FMU says."""
    fmu.log.clear()
    refused(lambda: fmu.step(time, h), DISCARD)
    assert [status for status, _ in fmu.log] == [DISCARD]
    return fmu.log[0][1]


# ---------------------------------------------------------------- the file


def test_fmpy_finds_no_problem(native):
    assert validate_fmu(str(native)) == []


def test_the_library_needs_the_c_library_alone(native_folder):
    """Of others it asks for libm; what it offers are FMI's functions."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    symbols = subprocess.run(["nm", "-D", library], check=True, capture_output=True, text=True).stdout
    needed = set(re.findall(r" [Uw] (\w+)", symbols))
    weak = {"_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable", "__cxa_finalize", "__gmon_start__"}
    memory = {
        "bcmp",
        "calloc",
        "free",
        "malloc",
        "memcmp",
        "memcpy",
        "memmove",
        "memset",
        "strcmp",
        "strcpy",
        "strlen",
        "vsnprintf",
    }
    libm = {"acos", "asin", "asinh", "atan", "atan2", "atanh", "cos", "exp", "log", "pow", "sin", "sincos"}
    assert needed - weak <= memory | libm
    offered = set(re.findall(r" [A-TV-Z] (\w+)", symbols))
    assert all(name.startswith("fmi2") for name in offered)
    assert len(offered) == 44  # all functions of FMI 2.0
    dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    assert set(re.findall(r"NEEDED.*\[(.+)\]", dynamic)) <= {"libc.so.6", "libm.so.6"}


def test_nothing_of_the_library_can_be_written(native_folder):
    """Data and zeroed data hold what the C start-up code needs, no variable of ours."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    sections = subprocess.run(["readelf", "-SW", library], check=True, capture_output=True, text=True).stdout
    sizes = {name: int(size, 16) for name, size in re.findall(r"(\.data|\.bss)\s+\w+\s+\w+ \w+ (\w+)", sections)}
    assert all(size <= 16 for size in sizes.values()), sizes


def test_no_path_of_the_build_machine_is_in_the_file(native_folder):
    for library in (native_folder / "binaries").glob("*/*"):
        content = library.read_bytes()
        assert str(Path(contact.__file__).parent).encode() not in content
        assert b"numba" not in content


# ---------------------------------------------------------------- the numbers


def test_equals_the_solver_on_random_cases(open_native):
    fmu = open_native()
    statuses = set()
    worst = 0.0
    for seed in range(300):
        values, solution, radius = random_case(seed)
        fmu.fmu.reset()
        fmu.update(values)
        fmu.initialize()
        fmu.step(0.0, 1e-3)
        actual, wanted = np.array([fmu[name] for name in OUTPUTS]), expected(solution, radius)
        scale = scales(solution, wanted)
        np.testing.assert_array_less(np.abs(actual - wanted), 1e-12 * scale + 1e-300, err_msg=f"seed {seed}")
        worst = max(worst, np.max(np.abs(actual - wanted) / (scale + 1e-300)))
        assert fmu["status"] == solution.status
        assert fmu["patch.count"] == solution.n_patches
        assert fmu["total.energy"] == pytest.approx(1e-3 * solution.speed * solution.power_per_metre, rel=1e-12)
        statuses.add(solution.status)
    assert statuses >= {contact.Status.OK, contact.Status.NO_CONTACT, contact.Status.SATURATED}
    print(f"greatest difference {worst:.1e}")


def test_equals_the_python_packaging(open_native, open_fmu):
    one, other = open_native(), open_fmu(NAME)
    for seed in (2, 3, 5, 7, 11, 13):
        values, _, _ = random_case(seed)
        for fmu in (one, other):
            fmu.fmu.reset()
            fmu.update(values)
            fmu.initialize()
            fmu.step(0.0, 1e-3)
            fmu.step(1e-3, 2e-3)
        if values["method.normal"] != list(METHODS.normal).index("strip_halfspace") + 1:  # this one starts warm
            actual, wanted = one.all("output"), other.all("output")
            stiffness = {name: wanted.pop(name) for name in list(wanted) if name.startswith("creep_stiffness")}
            assert {name: actual[name] for name in wanted} == pytest.approx(wanted, rel=1e-12, abs=1e-12)
            bound = max(map(abs, stiffness.values())) + 1.0
            assert {name: actual[name] for name in stiffness} == pytest.approx(stiffness, abs=1e-7 * bound)


def test_strips_that_interact_go_on_from_the_last_step(open_native):
    """The warm start changes the result within the method's tolerance, and an FMU state holds it."""
    fmu = posed(open_native())
    fmu.update({"method.normal": list(METHODS.normal).index("strip_halfspace") + 1})
    fmu.initialize()
    for k in range(3):
        fmu.update({"load.normal_force": 8e4 + 2e3 * k})
        fmu.step(k * 1e-3)
    cold = contact.solve(
        separation(), contact.Creepage(*CREEPAGES.values()), load=8.4e4, speed=30.0, normal="strip_halfspace"
    )
    assert fmu["force.x"] == pytest.approx(cold.Fx, rel=1e-3)
    assert fmu["force.x"] != cold.Fx
    state = fmu.fmu.getFMUstate()
    content = fmu.fmu.serializeFMUstate(state)
    fmu.step(3e-3)
    other = open_native()
    copy = other.fmu.deSerializeFMUstate(content)
    other.fmu.setFMUstate(copy)
    other.step(3e-3)
    assert other.all("output", "input", "parameter") == fmu.all("output", "input", "parameter")
    other.fmu.freeFMUstate(copy)
    fmu.fmu.freeFMUstate(state)


def test_creep_stiffness_belongs_to_the_last_step(fmu):
    fmu.step()
    first = fmu["creep_stiffness[1,1]"]
    fmu.update({"creepage.longitudinal": 5e-3})
    assert fmu["creep_stiffness[1,1]"] == first
    fmu.step(1e-3)
    assert abs(fmu["creep_stiffness[1,1]"]) < 0.9 * abs(first)


DERIVATIVES = [
    *((unknown, known) for known in CREEPAGES for unknown in ("force.x", "force.y", "moment.z")),
    *(("force.x", known) for known in ("load.normal_force", "friction.coefficient", "geometry.A[21]")),
    *((unknown, "load.normal_force") for unknown in ("force.y", "moment.z", "approach", "pressure.max", "patch.width")),
    ("power.friction", "speed"),
    ("pressure.max", "geometry.g[23]"),
]


@pytest.mark.parametrize("scale", [0.02, 0.5])
def test_directional_derivatives_are_those_of_the_solver(open_native, scale):
    """Against central differences of the fourth order of outputs in model exchange; in small and medium creepage."""
    fmu = posed(open_native("ModelExchange"))
    fmu.update({name: scale * value for name, value in CREEPAGES.items()})
    fmu.initialize()
    for unknown, known in DERIVATIVES:
        (slope,) = fmu.fmu.getDirectionalDerivative(
            [fmu.variables[unknown].valueReference], [fmu.variables[known].valueReference], [1.0]
        )
        at = fmu[known]
        h = 3e-10 if known == "geometry.g[23]" else 3e-6 * abs(at)
        found = []
        for k in (-2, -1, 1, 2):
            fmu.update({known: at + k * h})
            found.append(fmu[unknown])
        fmu.update({known: at})
        wanted = (found[0] - 8.0 * found[1] + 8.0 * found[2] - found[3]) / (12.0 * h)
        bound = 1e-4 * max(abs(wanted), 1e-3 * abs(fmu[unknown] / at))
        assert slope == pytest.approx(wanted, abs=bound), (unknown, known)


def test_a_directional_derivative_adds_up_what_its_seed_says(open_native):
    fmu = posed(open_native("ModelExchange")).initialize()
    knowns = [fmu.variables[name].valueReference for name in (*CREEPAGES, "load.normal_force")]
    unknowns = [fmu.variables[name].valueReference for name in ("force.x", "force.y")]
    seed = [2e-4, -1e-4, 0.05, 3e3]
    single = [fmu.fmu.getDirectionalDerivative(unknowns, [k], [s]) for k, s in zip(knowns, seed, strict=True)]
    np.testing.assert_allclose(fmu.fmu.getDirectionalDerivative(unknowns, knowns, seed), np.sum(single, 0), rtol=1e-4)


def test_a_derivative_at_the_end_of_a_range_is_one_sided(fmu):
    """Friction 0 is the least; there |F| grows with mu N."""
    fmu.update({"friction.coefficient": 0.0})
    (slope,) = fmu.fmu.getDirectionalDerivative(
        [fmu.variables["force.x"].valueReference], [fmu.variables["friction.coefficient"].valueReference], [1.0]
    )
    assert -8e4 <= slope < -1e4


# ---------------------------------------------------------------- behaviour that a user meets


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_simulates_with_fmpy(native, kind):
    signals = np.array([(0.0, 0.0), (0.01, 2e-3)], dtype=[("time", float), ("creepage.longitudinal", float)])
    result = fmpy.simulate_fmu(
        str(native),
        fmi_type=kind,
        stop_time=0.01,
        output_interval=1e-3,
        input=signals,
        output=["force.x", "total.energy"],
    )
    delay = 1 if kind == "CoSimulation" else 0
    y = -0.02 + 0.001 * np.arange(41)
    s = contact.solve(contact.Separation(y, y**2, 0.5 / 0.46), contact.Creepage(2e-4 * (10 - delay)), load=80e3)
    assert result["force.x"][-1] == pytest.approx(s.Fx, rel=1e-9)
    assert 0.0 < result["total.energy"][-1] < 0.01 * 20.0 * s.power_per_metre


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("geometry.g[7]", math.nan, "]-inf, inf["),
        ("geometry.A[41]", 0.0, "]0, inf["),
        ("creepage.spin", math.inf, "]-inf, inf["),
        ("load.normal_force", -1.0, "[0, inf["),
        ("friction.coefficient", math.nan, "[0, inf["),
        ("speed", 0.0, "]0, inf["),
    ],
)
def test_a_bad_input_is_discarded_by_name_and_the_instance_recovers(fmu, name, value, allowed):
    fmu.step()
    before, good = fmu.all("output"), fmu[name]
    fmu.update({name: value})
    for _ in range(3):
        assert discarded(fmu, 1e-3) == f"{name} = {value:g} is outside the allowed range {allowed}"
    assert fmu.all("output") == before
    fmu.update({name: good})
    fmu.step(1e-3)
    assert fmu["force.x"] == before["force.x"]
    assert fmu["total.energy"] == pytest.approx(2.0 * before["total.energy"], rel=1e-12)


def test_a_bad_parameter_is_discarded_by_name_before_the_first_step(open_native):
    fmu = open_native()
    fmu.update({"resolution.n_strips": 3})
    refused(fmu.initialize, DISCARD)
    assert fmu.log == [(DISCARD, "resolution.n_strips = 3 is outside the allowed range [4, 1000]")]
    fmu.update({"resolution.n_strips": 10})
    fmu.fmu.exitInitializationMode()
    fmu.step()


def test_a_step_that_is_none_is_an_error_and_changes_nothing(fmu):
    for time, h, text in (
        (0.0, 0.0, "= 0 is outside"),
        (0.0, math.nan, "= nan is outside"),
        (1.0, 1e-3, "stopTime = 1"),
    ):
        fmu.log.clear()
        refused(lambda time=time, h=h: fmu.step(time, h), ERROR)
        assert text in fmu.log[0][1]
    fmu.step(0.999, 1e-3)


def test_extreme_values_give_finite_outputs_or_none(open_native):
    """Whatever finite numbers come in: no crash, no hang, no NaN."""
    fmu = open_native().initialize()
    rng = np.random.default_rng(7)
    inputs = [v for v in fmu.variables.values() if v.causality == "input"]
    done = 0
    for _ in range(400):
        fmu.fmu.reset()
        fmu.update({"method.normal": int(rng.integers(1, 4)), "method.tangential": int(rng.integers(1, 4))})
        for variable in rng.choice(inputs, rng.integers(1, 8)):
            magnitude = 10.0 ** rng.choice([-300.0, -30.0, -9.0, 0.0, 9.0, 30.0, 300.0]) * rng.uniform(-1.0, 1.0)
            fmu.update({variable.name: abs(magnitude) if rng.random() < 0.8 else magnitude})
        try:
            fmu.initialize()
            fmu.step()
            done += 1
        except FMICallException as error:
            if error.status != DISCARD:
                raise
            continue
        assert all(math.isfinite(value) for value in fmu.all("output").values())
    assert done > 20


def test_lift_off_is_a_valid_result(fmu):
    fmu.update({"load.normal_force": 0.0})
    fmu.step()
    outputs = fmu.all("output")
    assert outputs["status"] == contact.Status.NO_CONTACT
    assert not any(value for name, value in outputs.items() if name not in ("status", "approach"))


def test_a_patch_beyond_the_separation_is_reported_once_as_a_warning(fmu):
    fmu.update({f"geometry.g[{i}]": 1e-9 * (i - 21) ** 2 for i in range(1, 42)})
    for k in range(3):
        fmu.step(k * 1e-3)
    assert [(status, message.split(":")[0]) for status, message in fmu.log] == [(WARNING, "status OUT_OF_RANGE")]


def trajectory(fmu, start: int) -> list[dict[str, float]]:
    rows = []
    for k in range(start, start + 5):
        fmu.update({"creepage.lateral": 1e-3 * math.sin(k), "load.normal_force": 8e4 + 1e4 * math.cos(k)})
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows


def test_a_restored_or_serialised_state_continues_bit_by_bit(fmu, open_native):
    trajectory(fmu, 0)
    state = fmu.fmu.getFMUstate()
    content = fmu.fmu.serializeFMUstate(state)
    values = fmu.all("input", "output", "parameter")
    wanted = trajectory(fmu, 5)
    fmu.fmu.setFMUstate(state)
    assert fmu.all("input", "output", "parameter") == values
    assert trajectory(fmu, 5) == wanted
    fmu.fmu.freeFMUstate(state)
    other = open_native()
    copy = other.fmu.deSerializeFMUstate(content)
    other.fmu.setFMUstate(copy)
    other.fmu.freeFMUstate(copy)
    assert trajectory(other, 5) == wanted


def test_damaged_bytes_are_no_state(fmu):
    state = fmu.fmu.getFMUstate()
    content = bytearray(fmu.fmu.serializeFMUstate(state))
    fmu.fmu.freeFMUstate(state)
    rng = np.random.default_rng(1)
    for _ in range(200):
        damaged = bytearray(content)
        damaged[rng.integers(len(damaged))] ^= 1 << rng.integers(8)
        refused(lambda damaged=damaged: fmu.fmu.deSerializeFMUstate(bytes(damaged)), ERROR)
    for size in (0, 1, 100, len(content) - 1):
        refused(lambda size=size: fmu.fmu.deSerializeFMUstate(bytes(content[:size])), ERROR)
        refused(lambda size=size: fmu.fmu.deSerializeFMUstate(rng.bytes(size)), ERROR)
    fmu.step()


def test_reset_restores_every_start(fmu, open_native):
    wanted = open_native().initialize().all("input", "output", "parameter")
    trajectory(fmu, 0)
    fmu.fmu.reset()
    fmu.initialize()
    assert fmu.all("input", "output", "parameter") == wanted


def test_model_exchange_has_no_delay_and_counts_energy_by_the_trapezoidal_rule(open_native):
    fmu = posed(open_native("ModelExchange")).initialize()
    fmu.fmu.newDiscreteStates()
    fmu.fmu.enterContinuousTimeMode()
    powers, energy = [fmu["power.friction"]], 0.0
    for k in range(1, 4):
        fmu.fmu.setTime(2e-3 * k)
        fmu.update({"creepage.longitudinal": 1e-3 * k})
        powers.append(fmu["power.friction"])
        fmu.fmu.completedIntegratorStep()
        energy += 1e-3 * (powers[-2] + powers[-1])
        assert fmu["total.energy"] == pytest.approx(energy, rel=1e-12)
    assert len(set(powers)) > 2


def test_runs_in_libcosim(native):
    """An independent XML parser and host."""
    host = subprocess.run(
        [sys.executable, Path(__file__).with_name("cosim_host.py"), native],
        check=True,
        capture_output=True,
        text=True,
        timeout=120,
    )
    rows = [line.split()[1:] for line in host.stdout.splitlines() if line.startswith("result")]
    y = -0.02 + 0.001 * np.arange(41)
    for load, row in zip((80e3, 50e3), rows, strict=True):
        s = contact.solve(contact.Separation(y, y**2, 0.5 / 0.46), contact.Creepage(1e-3), load=load)
        assert [float.fromhex(number) for number in row[:2]] == pytest.approx([s.N, s.Fx], rel=1e-12)


def test_kernels_for_every_processor_agree_bit_by_bit(native, tmp_path):
    """The wrapper chooses by what the processor can; here both run."""
    objects = kernels(models(41)[0], ROOT / "build" / "native", print)["linux64"]  # cached when the FMU was built
    calls = "".join(
        f"long model_size_{cpu}(double *); long model_prepare_{cpu}(double *, double *);"
        f"long model_outputs_{cpu}(double *, double *, double); long size_{cpu}(double *v) {{ return model_size_{cpu}(v); }}"
        f"void solve_{cpu}(double *v, double *w) {{ model_prepare_{cpu}(v, w); model_outputs_{cpu}(v, w, 0.0); }}\n"
        for cpu in CPUS
    )
    (tmp_path / "calls.c").write_text(calls)
    library = tmp_path / "both.so"
    run(*compiler("linux64"), "-shared", "-fPIC", tmp_path / "calls.c", *objects, "-o", library, "-lm")
    both = ctypes.CDLL(str(library))
    description = table(41)
    pointer = np.ctypeslib.ndpointer(np.float64)
    for seed in range(100):
        values = np.array([float(s.first) for s in description.scalars])
        for name, value in random_case(seed)[0].items():
            values[[s.name for s in description.scalars].index(name)] = value
        answers = []
        for cpu in CPUS:
            v, size, solve = values.copy(), getattr(both, f"size_{cpu}"), getattr(both, f"solve_{cpu}")
            size.argtypes, size.restype, solve.argtypes, solve.restype = [pointer], ctypes.c_long, [pointer] * 2, None
            work = np.zeros(size(v))
            solve(v, work)
            answers.append(v)
        np.testing.assert_array_equal(*answers)
        assert not np.array_equal(answers[0], values)
