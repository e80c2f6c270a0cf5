"""Validation sets of FMUs, in the form of the FMI Cross-Check: written, read back by fmpy, run by fmpy and by a C host."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.util import read_csv, read_ref_opt_file
from script_host import Script

from contact.errors import ContactError
from contact_fmu import validation
from contact_fmu import validation_mirror as mirror
from contact_fmu.catalogue import models
from contact_fmu.check import compare, read
from contact_fmu.tables import open_vehicle
from contact_fmu.tables.wheel_rail_contact import POINTS
from contact_fmu.validation_cases import case
from contact_fmu.validation_momentum import momentum

MODELS = {model.table.name: model for model in models(POINTS)}
NAMES = ("WheelRailPair", "EllipticContact")


@pytest.fixture(scope="module")
def sets(native, tmp_path_factory):
    """Return the folder with the sets of native FMUs for co-simulation. Those for model exchange obey physics too."""
    folder = tmp_path_factory.mktemp("sets")
    for name in NAMES:
        validation.write(native.with_name(f"{name}.fmu"), MODELS[name].table, folder, exchange=True, force=False)
    return folder / "native" / "fmi2" / "cs"


@pytest.mark.parametrize("name", NAMES)
def test_fmpy_reads_a_set_by_the_rules_of_the_cross_check(native, sets, name):
    """The checks of fmpy.cross_check: valid options, all inputs, all outputs, nothing else."""
    place = sets / name
    description = fmpy.read_model_description(str(native.with_name(f"{name}.fmu")))
    read = description.modelVariables
    real = [v for v in read if v.type == "Real" and not v.name.startswith("accumulated") and "," not in v.name]
    options = read_ref_opt_file(place / f"{name}_ref.opt")
    inputs = read_csv(place / f"{name}_in.csv", [v.name for v in real if v.causality == "input"])
    reference = read_csv(place / f"{name}_ref.csv", [v.name for v in real if v.causality == "output"])
    assert options["StepSize"] == 0.01
    assert len(inputs) == len(reference) == 201
    assert reference["time"][-1] == options["StopTime"] == 2.0
    assert "fmu-check" in (place / "README.md").read_text()


def test_a_run_visits_tread_flange_two_patches_lift_off_and_full_slip(sets):
    reference = read_csv(sets / "WheelRailPair" / "WheelRailPair_ref.csv")
    assert {0.0, 1.0, 2.0} <= set(reference["patches.count_real"])
    assert {1.0, 2.0, 3.0} <= set(reference["status_real"])  # OK, no contact, saturated
    assert np.max(np.abs(reference["patch[1].angle"])) > 0.5
    assert validation.contradictions(MODELS["WheelRailPair"].table, columns_of(reference)) == []


def columns_of(rows) -> dict:
    return {name: np.array(rows[name]) for name in rows.dtype.names}


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("power.friction", lambda x: -x, "friction gives power"),
        ("total.energy", lambda x: x[::-1], "total.energy falls"),
        ("wheel.Q", lambda x: 1.01 * x, "Q is not the vertical force"),
        ("used_friction", lambda x: x + 0.1, "friction exceeds"),
        ("force.x", lambda x: x + 10.0, "without contact has a force"),
    ],
)
def test_an_answer_against_physics_is_not_written(sets, name, change, message):
    answer = columns_of(read_csv(sets / "WheelRailPair" / "WheelRailPair_ref.csv"))
    answer[name] = change(answer[name])
    assert any(message in one for one in validation.contradictions(MODELS["WheelRailPair"].table, answer))


def test_the_other_packaging_has_an_equal_set_which_is_overwritten_only_by_force(fmus, sets, tmp_path):
    given = fmus / "EllipticContact.fmu", MODELS["EllipticContact"].table, tmp_path
    (place,) = validation.write(*given, exchange=False, force=False)
    assert place == tmp_path / "python" / "fmi2" / "cs" / "EllipticContact"
    assert compare(place / "EllipticContact_ref.csv", sets / "EllipticContact").agrees
    with pytest.raises(ContactError, match="exists; --force overwrites it"):
        validation.write(*given, exchange=False, force=False)
    validation.write(*given, exchange=False, force=True)


def test_fmi_3_has_its_set(native, tmp_path):
    path = native.parent / "fmi3" / "EllipticContact.fmu"
    made = validation.write(path, MODELS["EllipticContact"].table, tmp_path, exchange=True, force=False)
    assert [(one.parents[1].name, one.parent.name) for one in made] == [("fmi3", "cs"), ("fmi3", "me")]


def test_a_c_host_gives_the_reference(native, sets, unzipped, tmp_path):
    """The host of `reference/native/host/script.c` sets all inputs, steps and prints all outputs."""
    path, place = native.with_name("EllipticContact.fmu"), sets / "EllipticContact"
    inputs, reference = (read_csv(place / f"EllipticContact_{end}.csv") for end in ("in", "ref"))
    references = {v.name: v.valueReference for v in fmpy.read_model_description(str(path)).modelVariables}
    outputs = reference.dtype.names[1:]
    lines = [f"s {references[n]} {float(inputs[n][0])!r}" for n in inputs.dtype.names[1:]] + ["i"]
    lines += [f"g {references[n]}" for n in outputs]
    for k in range(len(inputs) - 1):
        lines += [f"s {references[n]} {float(inputs[n][k])!r}" for n in inputs.dtype.names[1:]]
        lines += [f"d {float(inputs['time'][k])!r} 0.01", *(f"g {references[n]}" for n in outputs)]
    folder: Path = unzipped(path)
    host = Script("linux64", tmp_path)
    rows = host(folder, 1, "\n".join(lines) + "\n").reshape(-1, len(outputs))
    text = [";".join(("time", *(f"host.{name}" for name in outputs)))]
    text += [";".join(map(repr, map(float, (t, *row)))) for t, row in zip(inputs["time"], rows, strict=True)]
    (tmp_path / "result.csv").write_text("\n".join(text) + "\n")
    found = compare(tmp_path / "result.csv", place)
    assert found.agrees, found.lines


def test_every_fmu_with_inputs_has_a_case_within_its_ranges():
    for name, model in MODELS.items():
        given = case(model.table, vehicle=model.options.get("vehicle", ""))
        assert given.inputs, name
        scalars = {scalar.name: scalar for scalar in model.table.scalars}
        for row, values in given.inputs.items():
            for value in (values.min(), values.max()):
                scalars[row].check(float(value))


def test_a_vehicle_on_given_forces_gains_their_momentum(native_vehicles, tmp_path):
    path = native_vehicles / "OpenVehicle.fmu"
    table = open_vehicle.table("manchester")
    (place,) = validation.write(path, table, tmp_path, exchange=False, force=False, vehicle="manchester")
    assert "the momentum of all bodies grows by the forces and the weight" in (place / "README.md").read_text()
    given = case(table, vehicle="manchester")
    answer = columns_of(read_csv(place / "OpenVehicle_ref.csv"))
    assert momentum(path, "manchester", given, answer) == []
    for name, message in (("wheel[1].force.y", "momentum along y"), ("wheel[5].force.z", "momentum along z")):
        wrong = given._replace(inputs={**given.inputs, name: 1.001 * given.inputs[name] + 1.0})
        assert message in momentum(path, "manchester", wrong, answer)[0]


def test_the_law_of_momentum_does_not_hold_where_a_frame_holds_the_vehicle():
    """The springs of the included wheelset end in a body that stands still."""
    table = MODELS["Wheelset"].table
    assert momentum(Path("Wheelset.fmu"), "wheelset", case(table, vehicle="wheelset"), {}) is None


def test_in_fmi_3_a_vehicle_on_given_forces_is_driven_by_arrays(native_vehicles, tmp_path):
    """The answers are those of FMI 2.0, whose inputs are single numbers."""
    table, found = open_vehicle.table("manchester"), []
    for folder in (native_vehicles, native_vehicles / "fmi3"):
        (place,) = validation.write(
            folder / "OpenVehicle.fmu", table, tmp_path, exchange=False, force=False, vehicle="manchester"
        )
        found.append(place)
    two, three = found
    _, arrays = read(three / "OpenVehicle_arrays.csv")
    single = read_csv(two / "OpenVehicle_ref.csv")
    assert len(arrays) > 100
    for name, values in arrays.items():
        assert np.array_equal(values, single[name]), name
    assert np.ptp(arrays["body[4].yaw"]) > 1e-6
    _, driven = read(three / "OpenVehicle_in_arrays.csv")
    given = read_csv(two / "OpenVehicle_in.csv")
    assert len(driven) == 32  # forces along x, y, z and moments about z vary
    assert all(np.array_equal(values, given[name]) for name, values in driven.items())
    assert "OpenVehicle_in_arrays.csv" in (three / "README.md").read_text()


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("force.y", lambda x: x + 1e3),
        ("moment.z", lambda x: -x),
        ("patch[1].lateral", lambda x: x + 1e-4),
        ("patch[2].n", lambda x: 1.1 * x),
    ],
)
def test_an_answer_that_is_not_that_of_mirrored_inputs_is_not_written(sets, name, change):
    answer = columns_of(read_csv(sets / "WheelRailPair" / "WheelRailPair_ref.csv"))
    in_mirror = {one: mirror.factor(one) * values for one, values in answer.items()}
    assert mirror.unlike(answer, in_mirror, validation.tolerance) == []
    answer[name] = change(answer[name])
    (found,) = mirror.unlike(answer, in_mirror, validation.tolerance)
    assert found.startswith(f"{name} is not that of mirrored inputs")


def test_what_turns_round_in_a_mirror():
    assert mirror.factor("patch[2].fy") == mirror.factor("pose.yaw") == -1.0 == -mirror.factor("force.x")
    assert mirror.factor("creep_stiffness[1,3]") == -1.0 == -mirror.factor("creep_stiffness[2,3]")


def test_matrices_are_compared_where_a_tool_writes_them(sets, tmp_path):
    place = sets / "EllipticContact"
    reference, arrays = (place / f"EllipticContact_{end}.csv" for end in ("ref", "arrays"))
    found = compare(reference, place)
    assert found.agrees
    assert "not compared: 9 elements of arrays" in found.lines[-2]
    both = ["".join((one, ";", two.split(";", 1)[1])) for one, two in zip(
        reference.read_text().replace(",", ";").splitlines(), arrays.read_text().splitlines(), strict=True)]  # fmt: skip
    (tmp_path / "result.csv").write_text("\n".join(both))
    found = compare(tmp_path / "result.csv", place)
    assert found.agrees
    assert found.lines[-1].startswith("37 of 37 outputs agree")
    (tmp_path / "result.csv").write_text("\n".join(both).replace("creep_stiffness[1,1]", "creep_stiffness[9,9]"))
    (tmp_path / "result.csv").write_text((tmp_path / "result.csv").read_text().replace("[2,2]", "[1,1]", 1))
    assert any("creep_stiffness[1,1]" in line for line in compare(tmp_path / "result.csv", place).lines)
