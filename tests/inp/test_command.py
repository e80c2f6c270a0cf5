"""The command `contact inp`."""

import csv

import pytest

from tests.command_line import call
from tests.inp import files
from tests.inp.data import CARTER, PRINTED


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.inp"
    path.write_text(files.CONTACT)
    return path


def test_rows_are_written_with_contacts_names(case, tmp_path):
    out = tmp_path / "rows.csv"
    call("inp", case, "--out", out, "--signs", "contact", "--cases", "2")
    with out.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(row["case"], row["patch"]) for row in rows] == [("2", "0"), ("2", "1")]
    assert float(rows[1]["FN [N]"]) == pytest.approx(82000.0)
    assert float(rows[1]["CKSI"]) == pytest.approx(-0.002)


def test_tables_are_written_for_matlab_and_as_netcdf(case, tmp_path):
    io, xarray = pytest.importorskip("scipy.io"), pytest.importorskip("xarray")
    call("inp", case, "--out", tmp_path / "a.mat", "--out", tmp_path / "a.nc", "--signs", "contact", "--fast")
    read = io.loadmat(tmp_path / "a.mat")
    with xarray.open_dataset(tmp_path / "a.nc", engine="scipy") as found:
        assert found["FN"].values[1] == read["FN"].ravel()[1] == pytest.approx(82000.0)


def test_comparison_ends_with_one_above_the_tolerance(tmp_path):
    path, out = tmp_path / "carter.inp", tmp_path / "carter.out"
    path.write_text(CARTER)
    out.write_text(PRINTED.format(approach="6.492E-03"))
    assert "1 of 1 compared cases agree" in call("inp", path, "--compare", out).output
    out.write_text(PRINTED.format(approach="6.592E-03"))
    assert "0 of 1 compared cases agree" in call("inp", path, "--compare", out, code=1).output
    call("inp", path, "--compare", out, "--tolerance", "0.1")


def test_check_reads_and_tells_what_is_refused(case, tmp_path):
    case.write_text(files.CONTACT.replace("022020     L", "023020     L"))
    text = call("inp", case, "--check").output
    assert "2 cases are read" in text
    assert "refused (bilinear): 2 cases" in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--signs", "mine"), "--signs 'mine' is unknown"),
        (("--cases", "x"), "--cases 'x' is no range"),
        (("--cases", "9"), "has no case of the file; allowed: 1 to 2"),
        (("--out", "rows.txt"), "a file ends in one of .csv, .nc, .mat"),
        (("--contact-mat", "nowhere"), "is not a folder"),
        (("--compare", "nowhere.out"), "is missing"),
    ],
)
def test_wrong_options_end_in_one_line(case, words, message):
    text = call("inp", case, *words, code=2).output
    assert message in text
    assert len([line for line in text.strip().splitlines() if "MODULE 0 ends the file" not in line]) == 1


def test_a_step_runs_with_those_before_it(case, tmp_path):
    text = files.CONTACT.replace("  203100     P", "  201100     P").replace("  203100\n", "  001100\n")
    text = text.replace("   0.0     0.5   30d3                   CHI, DQ, VELOC\n", "")
    case.write_text(text)
    whole, part = tmp_path / "whole.csv", tmp_path / "part.csv"
    call("inp", case, "--out", whole)
    call("inp", case, "--out", part, "--cases", "2")
    assert whole.read_text().splitlines()[3:] == part.read_text().splitlines()[1:]


def test_a_refused_case_ends_with_three_and_its_reason(case):
    case.write_text(files.CONTACT.replace("022020     L", "023020     L"))
    result = call("inp", case, code=3)
    assert "refused (bilinear): 2 of 2 cases" in result.output
