"""Tunable parameters: friction and material may change during a run, between steps or in event mode."""

import fmpy
import numpy as np
import pytest
from fmu_instance import ERROR, goes_on, refused
from thesis_case import THESIS

METHODS = {name: value for name, value in THESIS.items() if name.startswith("method.")}
CREEP = {"creepage.longitudinal": 2e-3, "creepage.lateral": -1e-3, **METHODS}
#: Other values than at the start, one of each group, so that all of them change the forces.
TUNED = {
    "friction.law": 3, "friction.kinetic": 0.1, "friction.half_speed": 0.01, "friction.hot_factor": 0.6,
    "thermal.conductivity": 20.0, "material.shear_modulus": 6e10, "material.poisson_ratio": 0.25,
    "material.pressure_limit": 8e8,
}  # fmt: skip
GROUPS = {"friction", "material", "thermal"}


def results(fmu) -> dict[str, float]:
    """Return all outputs but those that add up over time."""
    return {name: value for name, value in fmu.all("output").items() if not name.startswith("total.")}


def test_the_descriptions_name_friction_and_material(native):
    for path in (native, native.parent / "fmi3" / native.name, native.with_name("WheelRailPair.fmu")):
        variables = fmpy.read_model_description(str(path)).modelVariables
        tunable = {v.name for v in variables if v.variability == "tunable"}
        own = {v.name for v in variables if v.causality == "parameter" and v.name.split(".")[0] in GROUPS}
        assert tunable == own > TUNED.keys()


def test_a_step_after_tuning_is_that_of_an_fmu_with_these_parameters(open_native):
    """Bit for bit, in one step and in the next."""
    fmu, other = open_native(), open_native()
    fmu.update(CREEP)
    fmu.initialize().step()
    before = results(fmu)
    fmu.update(TUNED)
    other.update({**CREEP, **TUNED})
    other.initialize().step()
    for _ in range(2):
        fmu.step()
        assert results(fmu) == results(other)
    assert abs(results(fmu)["force.x"]) < 0.8 * abs(before["force.x"])


def test_what_belongs_to_the_last_step_stays_until_the_next(open_native):
    """Outputs that are computed when they are read too; `test_native_fields.py` has the fields."""
    fmu = open_native()
    fmu.update(CREEP)
    fmu.initialize().step()
    reading = fmu.all("output")
    fmu.update(TUNED)
    assert fmu.all("output") == reading
    fmu.step()
    assert fmu["force.x"] != reading["force.x"]


def test_fixed_parameters_cannot_be_tuned_nor_tunable_ones_in_continuous_time(open_native):
    fmu = open_native()
    fmu.initialize().step()
    refused(lambda: fmu.update({"wheel.radius": 0.4}), ERROR)
    fmu.update({"friction.kinetic": 0.2})
    exchange = open_native("ModelExchange")
    exchange.initialize()
    exchange.update({"friction.kinetic": 0.2})
    exchange.fmu.enterContinuousTimeMode()
    refused(lambda: exchange.update({"friction.kinetic": 0.3}), ERROR)
    assert exchange["friction.kinetic"] == 0.2


def test_a_state_between_tuning_and_the_step_is_restored(open_native):
    fmu = open_native()
    fmu.update(CREEP)
    fmu.initialize().step()
    fmu.update(TUNED)
    goes_on(fmu, open_native(), lambda one: (one.step(1e-3), one.all("output")))


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_fmpy_tunes_during_a_run(native, kind):
    """Friction falls to a third in the middle. In full slip the force does too, and the energy follows from the power."""
    signal = np.array([(0.0, 0.3), (0.5, 0.3), (0.5, 0.1), (1.0, 0.1)], [("time", float), ("friction.kinetic", float)])
    start = {"creepage.longitudinal": 0.05, "friction.law": 3, "friction.half_speed": 1e-3, **METHODS}
    found = fmpy.simulate_fmu(
        str(native), fmi_type=kind, stop_time=1.0, step_size=0.01, output_interval=0.01, input=signal,
        start_values=start, output=["force.x", "total.energy", "power.friction"],
    )  # fmt: skip
    early, late = (found[np.isclose(found["time"], time)][-1] for time in (0.4, 0.9))
    assert late["force.x"] / early["force.x"] == pytest.approx(1 / 3, rel=5e-3)
    energy = 0.5 * (early["power.friction"] + late["power.friction"])
    # co-simulation sees the change one communication step late
    assert found["total.energy"][-1] == pytest.approx(energy, rel=1e-6 if kind == "ModelExchange" else 0.02)
