"""The native `WheelRailContact` of FMI 3.0. Its library is that of FMI 2.0; arrays are variables."""

import math
import re

import fmpy
import numpy as np
import pytest
from contact_case import NAME
from contact_case_fmi3 import arrays, pose
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave
from fmu_instance import DISCARD, ERROR, recovers, refused
from random_cases import random_case

import contact
from contact.inputs.options import N_STRIPS


@pytest.fixture
def fmu(open_native_fmi3):
    return pose(open_native_fmi3()).initialize(stop_time=1.0)


def scalars(values: dict) -> list:
    """Return every number of these variables in the order of names and indices."""
    return [number for name in sorted(values) for number in np.ravel(values[name]).tolist()]


def by_row(values: dict) -> dict:
    """Return the scalars x[1], x[2] … of FMI 2.0 as arrays."""
    rows = {}
    for name, value in values.items():
        rows.setdefault(name.split("[")[0], []).append(value)
    return rows


# ---------------------------------------------------------------- the file


def in_rows(result) -> dict[str, np.ndarray]:
    """Return the columns of a result by the names of FMI 3.0: all elements of an array are one row per time."""
    rows = {}
    for name in result.dtype.names:
        rows.setdefault(re.sub(r"\[[\d,]+\]", "", name), []).append(result[name].reshape(len(result), -1))
    return {name: np.hstack(columns) for name, columns in rows.items()}


def test_every_native_fmu_is_there_in_both_versions_with_the_same_results(native):
    two = {path.name: path for path in native.parent.glob("*.fmu")}
    three = {path.name: path for path in (native.parent / "fmi3").glob("*.fmu")}
    assert set(two) == set(three) >= {f"{NAME}.fmu"}
    for name, path in three.items():
        description = fmpy.read_model_description(str(path))
        kinds = {"CoSimulation": description.coSimulation, "ModelExchange": description.modelExchange}
        for kind in [kind for kind, is_there in kinds.items() if is_there]:
            options = {"fmi_type": kind, "stop_time": 0.01, "output_interval": 1e-3}
            if name == "WheelRailPair.fmu":
                options["start_values"] = {"accumulation.wear_law": 2, "pose.y": 2e-3}
            one, other = (in_rows(fmpy.simulate_fmu(str(file), **options)) for file in (two[name], path))
            common = set(one) & set(other)
            assert len(common) > 10, name
            assert [row for row in common if not np.array_equal(one[row], other[row])] == [], (name, kind)


# ---------------------------------------------------------------- the numbers


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_equals_fmi_2_bit_by_bit(open_native, open_native_fmi3, kind):
    two, three = open_native(kind), open_native_fmi3(kind)
    for seed in range(60):
        values = random_case(seed).values
        two.fmu.reset()
        three.fmu.reset()
        two.update(values)
        whole = arrays(values)
        three.configure(n_strips=whole.pop("resolution.n_strips"), n_elements=whole.pop("resolution.n_elements"))
        three.update(whole)
        two.initialize()
        three.initialize()
        for k in range(2):
            for fmu in (two, three):
                if kind == "CoSimulation":
                    fmu.step(k * 1e-3)
                else:
                    fmu.update({"creepage.lateral": 1e-3 * k})
        wanted, actual = two.all("output"), three.all("output")
        actual = {name: value for name, value in actual.items() if not name.startswith("field.")}
        assert scalars(actual) == scalars(by_row(wanted)), seed


def test_arrays_move_with_time_with_fmpy(native_fmi3):
    """fmpy accepts signals of one size in a run, here both arrays. The gap falls linearly at a prescribed approach."""
    y = -0.02 + 0.001 * np.arange(41)
    kinds = [("time", float), ("geometry.g", float, (41,)), ("geometry.A", float, (41,))]
    gaps, A = (y**2, y**2 - 4e-5), np.full(41, 1.0)
    signals = np.array([(0.0, gaps[0], A), (1e-2, gaps[1], A)], dtype=kinds)
    start = {"load.kind": 2, "load.approach": 5e-5}
    result = fmpy.simulate_fmu(
        str(native_fmi3),
        fmi_type="ModelExchange",
        stop_time=1e-2,
        output_interval=1e-3,
        start_values=start,
        input=signals,
        output=["force.n"],
    )
    wanted = [
        contact.solve(contact.Separation(y, gaps[0] - 4e-6 * k, A), contact.Creepage(0.0), approach=5e-5).N
        for k in range(11)
    ]
    np.testing.assert_allclose(result["force.n"], wanted, rtol=1e-9)


# ---------------------------------------------------------------- behaviour for users


def test_a_bad_input_is_discarded_by_name_and_the_instance_recovers(fmu):
    fmu.step()
    before = fmu.all("output")
    recovers(fmu, {"geometry.g": [*[0.0] * 6, math.nan, *[0.0] * 34]}, "geometry.g[7] = nan is not finite")
    recovers(fmu, {"speed": -1.0}, "speed = -1 is outside the allowed range [0, inf[")
    assert fmu["field.pressure"].tolist() == before["field.pressure"]


def test_a_step_says_that_it_was_done_to_its_end(fmu):
    assert fmu.step(0.0, 0.25) == (False, False, False, 0.25)
    assert fmu["time"] == 0.25


def test_resolution_is_set_only_in_configuration_mode(open_native_fmi3):
    fmu = open_native_fmi3()
    refused(lambda: fmu.update({"resolution.n_strips": 12}), ERROR)
    assert fmu.log == [(ERROR, "fmi3SetUInt64: only structural parameters are set, and only in configuration mode")]
    fmu.configure(n_strips=12, n_elements=20)
    fmu.initialize().step()
    assert fmu["field.pressure"].shape == (4, 12, 20)
    refused(lambda: fmu.update({"resolution.n_strips": 13}), ERROR)
    refused(fmu.fmu.enterConfigurationMode, ERROR)
    fmu.fmu.reset()
    assert fmu["resolution.n_strips"] == N_STRIPS.usual


def test_a_resolution_out_of_range_is_discarded_by_name(open_native_fmi3):
    fmu = open_native_fmi3().configure(n_strips=2_000_000_000)
    fmu.log.clear()
    refused(lambda: fmu.initialize(), DISCARD)
    assert fmu.log == [(DISCARD, "resolution.n_strips = 2e+09 is outside the allowed range [4, 1000]")]


def test_the_number_of_values_must_be_that_of_the_array(fmu):
    reference = [fmu.variables["geometry.g"].valueReference]
    for call in (lambda: fmu.fmu.setFloat64(reference, [0.0] * 40), lambda: fmu.fmu.getFloat64(reference, nValues=42)):
        fmu.log.clear()
        refused(call, ERROR)
        assert "values are given, but the variables have 41" in fmu.log[0][1]
    refused(
        lambda: fmu.fmu.getFloat64([reference[0] + 1]), ERROR
    )  # an element of the array: a variable only in FMI 2.0


def test_what_is_not_provided_is_refused(native_fmi3_folder):
    description = fmpy.read_model_description(str(native_fmi3_folder))
    said = []
    for options, why in (
        ({"eventModeUsed": True}, "event mode"),
        ({"requiredIntermediateVariables": [14]}, "intermediate"),
    ):
        slave = FMU3Slave(
            guid=description.guid, unzipDirectory=str(native_fmi3_folder), modelIdentifier=NAME, instanceName="instance"
        )
        with pytest.raises(Exception, match="Failed to instantiate"):
            slave.instantiate(logMessage=lambda *message: said.append(message[-1].decode()), **options)
        assert why in said[-1]


def test_starts_can_be_read_before_initialisation(open_native_fmi3, native_fmi3):
    """FMI 2.0 does not allow this. Calculated outputs have no value yet."""
    fmu = open_native_fmi3()
    for variable in fmpy.read_model_description(str(native_fmi3)).modelVariables:
        if variable.causality in ("parameter", "input", "structuralParameter"):
            assert np.ravel(fmu[variable.name]).tolist() == [float(word) for word in variable.start.split()]
    with pytest.raises(FMICallException):
        fmu["force.x"]
