"""One reader of text: signals, series of a track, cases and TOML in every usual encoding; files without text are named."""

import io
import warnings
import zipfile

import numpy as np
import pytest

from contact import ContactError
from contact.cli import arguments, cases, options
from contact.geometry import profile
from contact.reading import text
from contact.reading.columns import table
from contact_models.vehicle.measured import Measured
from tests.geometry.written import COLUMNS

ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-be", "utf-32")


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("minus", ["-", "\N{MINUS SIGN}"])
@pytest.mark.parametrize(
    ("separator", "comma"), [(",", "."), (";", ","), ("\t", ","), ("\t", "."), (" ", "."), ("; ", ".")]
)
def test_a_table_of_signals_in_every_writing(encoding, minus, separator, comma, tmp_path):
    path = tmp_path / "motion.csv"
    rows = np.column_stack((np.arange(20) * 0.25, -1e-3 * np.arange(20.0), np.linspace(-5.0, 5.0, 20)))
    lines = [separator.join(f"{value:.6f}" for value in row).replace(".", comma) for row in rows]
    content = separator.join(("time", "pose.y", "velocity.x")) + "\n" + "\n".join(lines).replace("-", minus) + "\n\n"
    path.write_bytes(content.encode(encoding))
    found = table(path)
    assert found.names == ["time", "pose.y", "velocity.x"]
    np.testing.assert_allclose(found.values, rows, atol=1e-6)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("a,b\n1,2\n3,x\n", r"line 3: b = 'x' is not a finite number"),
        ("a,b\n1,2\n3,nan\n", r"line 3: b = 'nan' is not a finite number"),
        ("a;b\n1,5;2\n3,5;\n", r"line 3: b = '' is not a finite number"),
        ("a,b\n1,2\n3,4,5\n", r"line 3: '3,4,5' has 3 values for 2 names"),
        ("# nothing\n\n", "holds no columns of numbers"),
        ("# a\ntime,y,y\n1,2,3\n", r"line 2: the name 'y' stands over 2 columns"),
    ],
)
def test_a_row_of_signals_that_is_not_understood_is_named_with_its_content(content, said, tmp_path):
    path = tmp_path / "motion.csv"
    path.write_text(content)
    with pytest.raises(ContactError, match=rf"motion\.csv'.*{said}"):
        table(path)


def test_a_series_of_a_track_has_decimal_commas_and_needs_no_heading(tmp_path):
    path = tmp_path / "track.csv"
    rows = [(0.25 * k, 1e-3 * k, 0.0, 0.0, 0.0) for k in range(9)]
    for head in ("distance;alignment;vertical;cross_level;gauge\n", ""):
        body = "\n".join(";".join(f"{value:.4f}" for value in row) for row in rows).replace(".", ",")
        path.write_text(head + body, encoding="utf-16")
        np.testing.assert_allclose(Measured(file=str(path))._rows, rows)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_toml_is_read_in_every_encoding_and_with_typographic_signs_outside_its_texts(encoding, tmp_path):
    path = tmp_path / "case.toml"
    path.write_bytes(
        'name = "a\N{MINUS SIGN}b ü"\r\nx = \N{MINUS SIGN}1.5 # \N{MINUS SIGN}\r\n[a]\r\ny\N{NO-BREAK SPACE}= 2'.encode(
            encoding
        )
    )
    assert text.toml(path) == {"name": "a\N{MINUS SIGN}b ü", "x": -1.5, "a": {"y": 2}}
    path.write_bytes('x = "ü"'.encode("latin-1"))
    assert text.toml(path) == {"x": "ü"}
    path.write_text("x = 1\ny = one\n")
    with pytest.raises(ContactError, match=r"case\.toml is not TOML: .*line 2"):
        text.toml(path)


def test_cases_have_semicolons_and_decimal_commas(tmp_path):
    path = tmp_path / "cases.csv"
    path.write_text("y;load;creepage\n0,001;80000;0,001 0 0,1\n\N{MINUS SIGN}0,002;9e4;\n", encoding="utf-16")
    given = vars(arguments.PlaceOptions()) | vars(arguments.Amount())
    given |= {"side": options.SideOption.right, "friction": 0.3, "curvatures": None}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = cases.read(path, given)
        path.write_text("y,load,creepage\n0.001,80000,0.001 0 0.1\n-0.002,9e4,\n")
        plain = cases.read(path, given)
    assert [(case.load, case.creepage) for case in found] == [(case.load, case.creepage) for case in plain]


@pytest.mark.parametrize(
    ("name", "content"),
    [("cases.csv", "y,load,load\n1e-3,8e4,9e4\n"), ("cases.json", '[{"y": 1e-3, "load": 8e4, "load": 9e4}]')],
)
def test_a_name_that_stands_twice_in_a_file_of_cases_is_refused(name, content, tmp_path):
    (tmp_path / name).write_text(content)
    with pytest.raises(ContactError, match="the name 'load' stands twice"):
        cases.read(tmp_path / name, {})


def _archive(name):
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w") as archive:
        archive.writestr(name, "x" * 100)
    return whole.getvalue()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "is empty"),
        (b" \n \n", "is empty"),
        (b"%PDF-1.4 ...", "is a PDF document"),
        (b"\x89PNG\r\n\x1a\n....", "is a picture"),
        (b"\xff\xd8\xff\xe0....", "is a picture"),
        (b"\x1f\x8b\x08....", r"is an archive \(gzip\).*unpack it"),
        (_archive("a.txt"), r"is an archive \(zip\).*unpack it"),
        (_archive("xl/workbook.xml"), "is an .xlsx workbook.*suffix"),
        (_archive("word/document.xml"), "is a .docx document"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1....", "is a file of an old office program"),
        (b"AC1027....", "is a DWG drawing"),
        (b"<!doctype html><html>", "is a web page"),
        (bytes(range(256)) * 4, "is a binary file"),
        (np.arange(9.0).tobytes(), "is a binary file"),
    ],
)
@pytest.mark.parametrize(
    "read",
    [
        lambda path: profile.read(path, **COLUMNS),
        lambda path: profile.read(path.rename(path.with_suffix(".whl"))),
        table,
        text.toml,
    ],
)
def test_a_file_without_text_is_named_by_what_it_is(content, said, read, tmp_path):
    path = tmp_path / "wheel.csv"
    path.write_bytes(content)
    with pytest.raises(ContactError, match=rf"wheel\.\w+' {said}"):
        read(path)
