"""Reading and writing of CONTACT's input files, after its format (docs/use/from_contact.md)."""

import math
import warnings

import pytest

from contact import ContactError, inp
from contact.errors import PlausibilityWarning
from contact.inp.controls import WORDS
from contact.inp.words import angle, integer, real, split
from tests import damaged
from tests.inp import files


def read(tmp_path, text, name="case.inp"):
    path = tmp_path / name
    path.write_text(text, encoding="latin-1")
    return inp.read(path)


def read_or_message(path):
    try:
        return "", inp.read(path)
    except ContactError as error:
        return str(error), []


def test_words_are_separated_by_blanks_commas_and_equal_signs_and_end_at_a_comment():
    assert split("  1, 2=3\t'a b%c=d'  % 4") == ["1", "2", "3", "'a b%c=d'"]


@pytest.mark.parametrize(
    ("text", "value"), [(".1-07", 1e-8), ("1d-3", 1e-3), ("-2.5D+3", -2500.0), ("35780.", 35780.0), (".82E+05", 82e3)]
)
def test_numbers_of_fortran_are_read(text, value):
    assert real(text) == pytest.approx(value, rel=1e-15)


def test_only_the_last_character_of_an_angle_is_its_unit():
    assert angle("90d") == math.pi / 2
    assert angle("-0.1r") == -0.1
    assert angle("90d0") == 90.0
    assert integer("000341") == 341
    assert integer("1.0") == 1


@pytest.mark.parametrize("word", ["nan", "inf", "1e999", "1e99999999", "x", "1.2.3", "--1"])
def test_what_is_no_number_is_refused(word):
    with pytest.raises(ValueError, match=word[:1]):
        real(word)


def test_values_are_in_si_and_carry_over(tmp_path):
    first, second = read(tmp_path, files.CONTACT)
    assert first["FN"] == second["FN"] == 82000.0
    assert first["CPHI"] == pytest.approx(0.2, rel=1e-15)
    assert first["VELOC"] == second["VELOC"] == 30.0
    assert first["GG1"] == 82e9
    assert first["UDB"] == pytest.approx((4.0, 0.0, 10.5, 0.0, 0.0, 0.0), rel=1e-15)
    assert (first["SPINXO"], second["SPINXO"], second["SPINYO"]) == (0.0, 1.5e-3, 2.5e-3)
    assert first.lines["FN"] == 7
    assert second.lines["FN"] == 20
    assert second.lines["GG1"] == 10
    assert "FN" in second.fresh
    assert "GG1" not in second.fresh


def test_a_pair_has_its_profiles_beside_the_file_and_angles_in_radians(tmp_path):
    left, right = read(tmp_path, files.PAIR)
    assert left["RFNAME"] == tmp_path / "profiles" / "rail.prr"
    assert (left.digits["C1"], right.digits["C1"]) == (0, 1)
    assert left["YAW"] == pytest.approx(-0.1 * math.pi / 180)
    assert right["PITCH"] == pytest.approx(-26 * math.pi / 180)
    assert right["NOMRADW"] == 0.46
    assert left["D_TURN"] == pytest.approx(12e-3)


def test_cases_of_one_module_line_follow_each_other_until_they_return(tmp_path):
    first, second = read(tmp_path, files.PAIR_WITH_ALL)
    assert (first.element, first.number, second.number) == (7, 1, 2)
    assert (first["FLIN1"], first["SABSH1"], first["ROWS"]) == ((0.05, 0.05), (0.1, 0.1), 1)
    assert first["ALPHA"] == pytest.approx((-math.pi / 9, math.pi / 36))
    assert first["KZRAIL"] == 1e6
    assert len(second["SUBS"]) == 3
    assert second["DXWHL"] == pytest.approx(1e-4)


@pytest.mark.parametrize("text", [files.CONTACT, files.PAIR, files.PAIR_WITH_ALL])
def test_what_is_written_is_read_back_as_it_was(tmp_path, text):
    cases = read(tmp_path, text)
    for folder in (tmp_path, tmp_path / "elsewhere"):
        folder.mkdir(exist_ok=True)
        inp.write(cases, folder / "again.inp")
        assert inp.read(folder / "again.inp") == cases


def test_a_single_case_is_written_with_all_that_it_keeps(tmp_path):
    _, second = read(tmp_path, files.CONTACT)
    inp.write(second, tmp_path / "one.inp")
    (one,) = inp.read(tmp_path / "one.inp")
    assert one.values == second.values
    inp.write(second.changed(CKSI=-0.004), tmp_path / "one.inp")
    assert inp.read(tmp_path / "one.inp")[0]["CKSI"] == -0.004


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("203100     P", "209100     P", 3, "T = 9 .TANG in 209100.; allowed: 0, 1, 2, 3"),
        ("203100     P", "9203100     P", 3, "too many digits"),
        (
            "203100     P",
            "# 203100     P",
            3,
            "PBTNFS = '#' is outside the allowed range, an integer; % begins a comment",
        ),
        ("022020     L", "122020     L", 4, "L = 1 keeps what no case before has given"),
        ("82000.  -.001", "82000.  nan", 7, "CKSI = 'nan' is outside the allowed range, a number"),
        ("0.300   0.300", "0.300   0.200", 8, "FKIN = 0.2 with L = 0"),
        ("0.28,0.28", "0.78,0.28", 10, r"POISS1 = 0.78 is outside the allowed range, a number in \[0, 0.5\]"),
        ("   1                                    IPOTCN", "  7", 11, "IPOTCN = 7 is outside the allowed range"),
        ("  20 12 ", "  0 12 ", 12, "MX = 0 is outside the allowed range"),
        (" 0 MODULE\n never read\n", "", 22, "the file ends where MODULE is expected"),
        (" 0 MODULE", " 11 MODULE", 22, "MODULE = 11 is outside the allowed range"),
    ],
)
def test_what_is_not_understood_is_an_error_with_its_line(tmp_path, old, new, line, message):
    assert old in files.CONTACT
    with pytest.raises(ContactError, match=message) as error:
        read(tmp_path, files.CONTACT.replace(old, new, 1))
    assert f"case.inp, line {line}: " in str(error.value)
    assert "\n" not in str(error.value)


def test_two_hundred_damaged_files_end_in_one_line_or_are_read(tmp_path):
    path, refused = tmp_path / "damaged.inp", 0
    for text in (files.CONTACT, files.PAIR, files.PAIR_WITH_ALL):
        for copy in damaged.of_text(text.encode(), 34):
            path.write_bytes(copy)
            message, cases = read_or_message(path)
            if message:
                refused += 1
                assert "\n" not in message
                assert str(path) in message
            else:
                inp.write(cases, path)
                assert inp.read(path) == cases
    assert refused > 100


def test_a_missing_file_is_an_error_of_one_line(tmp_path):
    with pytest.raises(ContactError, match="is missing"):
        inp.read(tmp_path / "none.inp")
    with pytest.raises(ContactError, match="is missing"):
        inp.read_printed(tmp_path / "none.out")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_files_of_every_editor_are_read_with_their_names(tmp_path, encoding):
    path = tmp_path / "case.inp"
    path.write_bytes(files.PAIR.replace("rail.prr", "Schläuche/Räd.prr").encode(encoding))
    case = inp.read(path)[0]
    assert case["RFNAME"] == tmp_path / "profiles" / "Schläuche" / "Räd.prr"
    inp.write(case, tmp_path / "again.inp")
    assert inp.read(tmp_path / "again.inp")[0]["RFNAME"] == case["RFNAME"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("82000.  -.001", "82000,0  -.001", "line 7: SPINXO without SPINYO is not read"),
        ("82000.  -.001", "82000,0  -0,001,0", "line 7: .2-03 behind SPINYO is not read"),
        ("0.300   0.300", "0.300   0.300  0.4", "line 8: 0.4 behind FKIN is not read"),
    ],
)
def test_numbers_behind_the_last_value_of_a_line_are_told(tmp_path, old, new, said):
    """CONTACT takes a decimal comma for a blank: all values behind it move by one, and the last is thrown away."""
    assert old in files.CONTACT
    with pytest.warns(PlausibilityWarning):
        case = read(tmp_path, files.CONTACT.replace(old, new, 1))[0]
    assert said in case.notes


@pytest.mark.parametrize(
    ("new", "said"),
    [
        ("82000,0  -.001 0.0", ["line 7: 82000,0 is read as 82000 and 0"]),
        ("82000  -0,001 0.0", ["line 7: -0,001 is read as -0 and 001"]),
        ("82000,-.001,0,0", []),
        ("82000, -.001", []),
    ],
)
def test_a_comma_inside_a_number_is_told(tmp_path, new, said):
    """Optional values at the line's end take what moves, so that nothing is left to be told."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PlausibilityWarning)
        case = read(tmp_path, files.CONTACT.replace("82000.  -.001", new, 1))[0]
    assert [note for note in case.notes if "is read as" in note] == said


def test_lines_behind_the_end_and_broken_integers_are_told(tmp_path):
    """A number that is read as 0 where a module is due ends the file: a repeated line has thrown away all cases behind it."""
    with pytest.warns(PlausibilityWarning, match="line 22: MODULE 0 ends the file; lines behind it are not read: 1"):
        read(tmp_path, files.CONTACT)
    with pytest.raises(ContactError, match=r"MODULE = '0\.28' is outside the allowed range, an integer"):
        read(tmp_path, files.CONTACT.replace(" 3  MODULE", " 0.28 MODULE", 1))


def test_every_digit_has_its_meaning_in_both_modules():
    for word in WORDS:
        for digit in word:
            assert set(digit.module_1) <= set(range(10))
            assert set(digit.module_3) <= set(range(10))
    assert sum(len(word) for word in WORDS) == 22


def test_printed_results_are_read_by_their_names(tmp_path):
    path = tmp_path / "case.out"
    path.write_text(
        """\
 Case     3

 KINEMATIC CONSTANTS
     CHI         DQ          VELOC     FX/FSTAT/FN    CETA        CPHI
     3.142      0.1000E-02   1000.     0.6250       0.000       0.000

 TOTAL FORCES, TORSIONAL MOMENT, ELASTIC ENERGY, FRICTIONAL POWER
     FN          FX          FY          MZ         ELAST.EN.   FRIC.POWER
     1.620E+04   1.234-100   ********    0.000   1.370E-02  -3.000E+00
     FN/G       CREEP X     FY/FSTAT/FN  APPROACH     PMAX
     0.4510     5.262E-04    0.000      -8.123E-03   1.031E+04
    NPOT   NCON   NADH  NSLIP  INORM  ITANG
     216    200     50    150      1      1
 Case     4
"""
    )
    first, second = inp.read_printed(path)
    values = first.patches[0].values
    assert (values["FN"], values["CKSI"], values["PMAX"], values["NSLIP"]) == (16200.0, 5.262e-4, 10310.0, 150.0)
    assert values["FX"] == 1.234e-100
    assert math.isnan(values["FY"])
    assert not second.printed
