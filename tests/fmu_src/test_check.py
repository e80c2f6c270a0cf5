"""`contact fmu-check`: what other tools write is read, compared, and what is not comparable is named."""

import numpy as np
import pytest

from contact.errors import ContactError
from contact_fmu.check import compare

TIME = np.arange(11) * 0.1
REFERENCE = {"force.x": np.sin(TIME) * 1e3, "patch[1].n": 8e4 + TIME, "moment.z": np.cos(TIME)}


@pytest.fixture
def folder(tmp_path):
    write(tmp_path / "M_ref.csv", TIME, REFERENCE)
    (tmp_path / "tolerances.csv").write_text("output,tolerance\nforce.x,1\npatch[1].n,80\nmoment.z,0.001\n")
    return tmp_path


def write(path, time, columns, separator=",", decimal=".", heading=None):
    names = heading or ["time", *columns]
    rows = [separator.join(f'"{name}"' if "," in name else name for name in names)]
    table = zip(time, *columns.values(), strict=True)
    rows += [separator.join(repr(float(x)).replace(".", decimal) for x in row) for row in table]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def test_the_reference_agrees_with_itself(folder):
    found = compare(folder / "M_ref.csv", folder)
    assert found.agrees
    assert found.lines == [f"3 of 3 outputs agree with {folder / 'M_ref.csv'}"]


@pytest.mark.parametrize(
    ("heading", "separator", "decimal"),
    [
        (["Time", "fmu.moment.z", "fmu.force.x", "fmu.patch[1].n"], ",", "."),
        (["time [s]", "moment.z [N.m]", "force.x [N]", "patch[1].n (N)"], ";", ","),
        (["t", "System:pair/moment.z", "System:pair/force.x", "System:pair/patch[1].n"], "\t", "."),
        (["time", "pair_moment_z", "pair_force_x", "pair_patch_1_n"], ",", "."),
    ],
)
def test_names_order_and_signs_of_other_tools_are_read(folder, heading, separator, decimal):
    columns = {name: REFERENCE[name] for name in ("moment.z", "force.x", "patch[1].n")}
    assert compare(write(folder / "r.csv", TIME, columns, separator, decimal, heading), folder).agrees


def test_a_difference_is_named_with_time_value_and_tolerance(folder):
    wrong = REFERENCE | {"moment.z": REFERENCE["moment.z"] + np.where(TIME > 0.55, 0.5, 0.0)}
    found = compare(write(folder / "r.csv", TIME, wrong), folder)
    assert not found.agrees
    assert found.lines[0].startswith("moment.z: 1.32534 at 0.6 s for 0.825336, tolerance 0.001")
    assert found.lines[-1].startswith("2 of 3 outputs agree")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda x: -x, "the sign is the other one"),
        (lambda x: np.roll(x, 1), "the same one step later"),
        (lambda x: np.roll(x, -1), "the same one step earlier"),
        (lambda x: x / 1e3, "another unit"),
    ],
)
def test_the_usual_mistakes_of_an_import_are_named(folder, change, words):
    found = compare(write(folder / "r.csv", TIME, REFERENCE | {"force.x": change(REFERENCE["force.x"])}), folder)
    assert words in found.lines[0]


def test_missing_columns_and_nan_are_named_and_not_compared(folder):
    columns = {"force.x": np.where(TIME > 0.25, np.nan, REFERENCE["force.x"]), "moment.z": REFERENCE["moment.z"]}
    found = compare(write(folder / "r.csv", TIME, columns), folder)
    assert not found.agrees
    assert found.lines[:2] == ["force.x: no number at 0.3 s; not compared", "missing: patch[1].n"]


def test_another_sampling_is_named_and_not_compared(folder):
    time = np.arange(5) * 0.25
    columns = {name: np.interp(time, TIME, values) for name, values in REFERENCE.items()}
    with pytest.raises(
        ContactError, match=r"has other times: 8 of 11 are missing.*reference one every 0\.1 s.*nothing was"
    ):
        compare(write(folder / "r.csv", time, columns), folder)


def test_a_finer_sampling_and_times_in_single_precision_are_compared(folder):
    time = np.float32(np.arange(101) * 0.01)
    columns = {name: np.interp(time, TIME, values) for name, values in REFERENCE.items()}
    assert compare(write(folder / "r.csv", time, columns), folder).agrees


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "has 0 lines"),
        ("a,b\n1,2\n3,4\n", "has no column time"),
        ("time,a\n1,2,3\n2,3\n", "line 2: 3 values under 2 names"),
        ("time,a\nx,2\n2,3\n", "a time is no number"),
        ("time,a\n1,2\n0,3\n", "the times do not increase"),
    ],
)
def test_a_file_that_is_no_result_is_refused(folder, text, message):
    (folder / "r.csv").write_text(text)
    with pytest.raises(ContactError, match=message):
        compare(folder / "r.csv", folder)


def test_two_columns_of_one_output_are_refused(folder):
    columns = {"a.force.x": TIME, "b.force.x": TIME, "moment.z": TIME, "patch[1].n": TIME}
    with pytest.raises(ContactError, match=r"force\.x may be a\.force\.x or b\.force\.x"):
        compare(write(folder / "r.csv", TIME, columns), folder)


def test_a_folder_without_a_set_is_refused(tmp_path):
    with pytest.raises(ContactError, match="is no validation set"):
        compare(write(tmp_path / "r.csv", TIME, REFERENCE), tmp_path)
