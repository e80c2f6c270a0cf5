"""The page's reader of profiles against the library's: every orientation, unit, separator, fault (issue 34, 1)."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from contact.geometry import inspection, profile
from contact.geometry.false_rows import false_rows
from explorer.bundle import rules

pytestmark = pytest.mark.skipif(not shutil.which("node"), reason="needs node")
SHAPES = {"wheel": profile.load("S1002", "wheel"), "rail": profile.load("60E1", "rail", inclination=0.0)}
INCH = 0.0254


def opened(path: Path, kind: str = "any") -> dict:
    """Return what the page makes of a file."""
    command = ["node", str(Path(__file__).with_name("profiles.js")), json.dumps(rules()), kind, str(path)]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def written(folder: Path, y, z, unit: float = 1e-3, between: str = " ", head: str = "", decimals: int = 9) -> Path:
    path = folder / "profile.txt"
    rows = (f"{a / unit:.{decimals}f}{between}{b / unit:.{decimals}f}" for a, b in zip(y, z, strict=True))
    path.write_text(head + "\n".join(rows) + "\n")
    return path


def points(found: dict) -> np.ndarray:
    """Return y, z and angle, shape (3, n)."""
    return np.array(found["numbers"][1:]).reshape(3, int(found["numbers"][0]))


@pytest.mark.parametrize("kind", ["wheel", "rail"])
@pytest.mark.parametrize("up", [1.0, -1.0])
@pytest.mark.parametrize("left", [1.0, -1.0])
@pytest.mark.parametrize("unit", [1e-3, 1.0, INCH])
def test_every_orientation_and_unit_gives_the_profile_of_the_library(kind, up, left, unit, tmp_path):
    shape = SHAPES[kind]
    found = opened(written(tmp_path, left * shape.y[:: int(left)], up * shape.z[:: int(left)], unit))
    assert found["kind"] == kind
    expected = profile.Profile(kind, shape.y, shape.z - (shape.z.min() if kind == "rail" else 0.0))
    if kind == "rail" and left < 0.0:  # a rail's head is symmetric but for what is below it
        expected = profile.Profile(kind, *points(found)[:2])
    got = points(found)
    np.testing.assert_allclose(got[0], expected.y, atol=2e-9)
    np.testing.assert_allclose(got[1], expected.z, atol=2e-9)
    np.testing.assert_allclose(got[2], expected.angle, atol=1e-4)
    said = " ".join(found["findings"])
    assert ("z pointed up" in said) == (up < 0.0)
    assert ("unit taken as" in said) == (unit != 1e-3)
    if kind == "wheel":
        assert ("y pointed to the inside" in said) == (left < 0.0)


@pytest.mark.parametrize(
    ("between", "head", "decimal"),
    [
        (";", "", "."),
        (",", "", "."),
        ("\t", "# made by hand\ny z\n", "."),
        (";", "Columns;2\n", ","),
        ("  ", "12 3\ntext\n", "."),
    ],
)
def test_separators_headers_and_decimal_commas(between, head, decimal, tmp_path):
    path = written(tmp_path, SHAPES["wheel"].y, SHAPES["wheel"].z, between=between, head=head)
    if decimal == ",":
        path.write_text(path.read_text().replace(".", ","))
    assert points(opened(path)).shape[1] == SHAPES["wheel"].y.size


def test_a_wheel_measured_from_the_back_of_its_flange_is_moved(tmp_path):
    shape = SHAPES["wheel"]
    found = opened(written(tmp_path, shape.y + 0.070, shape.z))
    np.testing.assert_allclose(points(found)[0], shape.y, atol=2e-9)
    assert any("moved by -70 mm across" in finding for finding in found["findings"])


def test_noise_is_told_and_smoothed(tmp_path):
    shape = SHAPES["rail"]
    rng = np.random.default_rng(3)
    noisy = shape.y + rng.normal(0.0, 1e-5, shape.y.size), shape.z + rng.normal(0.0, 1e-5, shape.z.size)
    found = opened(written(tmp_path, *noisy))
    assert any(finding.startswith("noise of ") for finding in found["findings"])
    y, _, angle = points(found)
    head = np.abs(y) < 0.025
    error = angle - np.interp(y, shape.y, shape.angle)
    unsmoothed = profile.Profile("rail", *noisy).angle - shape.angle
    assert np.sqrt(np.mean(error[head] ** 2)) < 0.15 * np.sqrt(np.mean(unsmoothed[np.abs(noisy[0]) < 0.025] ** 2))


def test_rows_of_nan_and_back_steps_and_scans_are_told(tmp_path):
    shape = SHAPES["wheel"]
    path = written(tmp_path, shape.y, shape.z)
    lines = path.read_text().splitlines()
    lines[50:50] = ["nan nan", "1.0 NaN"]
    path.write_text("\n".join(lines))
    assert "2 lines without two numbers left out" in opened(path)["findings"]
    there_and_back = np.concatenate((shape.y, shape.y[::-1])), np.concatenate((shape.z, shape.z[::-1]))
    found = opened(written(tmp_path, *there_and_back))
    assert any("comes back" in finding for finding in found["findings"])
    assert points(found).shape[1] in (shape.y.size, shape.y.size + 1)
    twice = np.tile(shape.y, 2), np.tile(shape.z, 2)
    assert any("2 times" in finding for finding in opened(written(tmp_path, *twice))["findings"])
    swapped = np.arange(shape.y.size)
    swapped[[100, 101]] = [101, 100]
    found = opened(written(tmp_path, shape.y[swapped], shape.z[swapped]))
    assert any("stepping back" in finding for finding in found["findings"])


@pytest.mark.parametrize(
    ("kind", "change", "said"),
    [
        ("rail", lambda y, z: (y, z), "the points have the shape of a wheel"),
        ("any", lambda y, z: (1e3 * y, 1e3 * z), "no unit of m, mm, cm, inch makes that"),
        ("any", lambda y, z: (y[:5], z[:5]), "at least ten rows"),
        ("any", lambda y, z: (np.random.default_rng(1).permutation(y), z), "not in order"),
        ("any", lambda y, z: (y[y > -0.02], 0.0 * z[y > -0.02]), "could be a wheel or a rail"),
    ],
)
def test_what_cannot_be_a_profile_is_refused_with_a_reason(kind, change, said, tmp_path):
    assert said in opened(written(tmp_path, *change(SHAPES["wheel"].y, SHAPES["wheel"].z)), kind)["error"]


def test_text_and_bytes_do_not_crash(tmp_path):
    path = tmp_path / "some.bin"
    for content in (
        b"",
        b"\x00\xff" * 500,
        b"wr-wheel" + b"\x7f" * 4,
        b"wr-wheel" + bytes(8) + (10**6).to_bytes(8, "little"),
        b"1e400 2\n" * 20,
    ):
        path.write_bytes(content)
        assert "error" in opened(path), content[:20]


@pytest.mark.parametrize("kind", ["wheel", "rail"])
@pytest.mark.parametrize("turn", [0.0, 2.0, 6.0, 7.0])
def test_a_turned_profile_is_told_as_the_library_tells_it(kind, turn, tmp_path):
    shape = SHAPES[kind].rotated(np.radians(turn))
    found = opened(written(tmp_path, shape.y, shape.z), kind)
    assert any(finding.startswith("turned?") for finding in found["findings"]) == (turn > 5.0)
    assert bool(inspection.turned(np.column_stack((shape.y, shape.z)), kind)) == (turn > 5.0)


def test_swapped_columns_and_what_has_no_head_are_told(tmp_path):
    wheel, said = SHAPES["wheel"], "are the columns y and z swapped"
    assert said in opened(written(tmp_path, wheel.z, wheel.y), "wheel")["error"]
    assert any(said in finding for finding in opened(written(tmp_path, wheel.z, wheel.y), "rail")["findings"])
    flat = opened(written(tmp_path, np.linspace(-0.035, 0.035, 80), np.zeros(80)), "rail")
    assert "no crown with sides that fall off: is this the head of a rail?" in flat["findings"]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize(
    "change", [("-", "\N{MINUS SIGN}"), (" ", "\N{NO-BREAK SPACE}"), ("\n", '  " seen\n'), ("\n", "\r")]
)
def test_text_is_read_as_the_library_reads_it(encoding, change, tmp_path):
    path = written(tmp_path, SHAPES["wheel"].y, SHAPES["wheel"].z)
    path.write_bytes(path.read_text().replace(*change).encode(encoding))
    assert points(opened(path)).shape[1] == SHAPES["wheel"].y.size


#: What devices write where nothing was seen, for y and z of the row that is missing.
CODES = ("0 0", "-999 -999", "9999 9999", "{y} -999", "32767 32767", "1e30 1e30", "{y} 0", "0 {z}")


@pytest.mark.parametrize("kind", ["wheel", "rail"])
@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("many", [1, 5, 25])
def test_false_rows_are_dropped_and_told_as_the_library_does(kind, code, many, tmp_path):
    shape, rng = SHAPES[kind], np.random.default_rng(many)
    path = written(tmp_path, shape.y, shape.z, decimals=5)
    lines = path.read_text().splitlines()
    away = np.flatnonzero((np.abs(shape.y) > 2e-3) & (np.abs(shape.z) > 2e-3))[
        3:-3
    ]  # a 0 there is no point of the profile
    for k in rng.choice(away, many, replace=False):
        y, z = lines[k].split()
        lines[k] = code.format(y=y, z=z)
    path.write_text("\n".join(lines))
    rows = np.array([line.split() for line in lines], float)
    dropped = int(false_rows(rows).sum())
    assert dropped >= 0.8 * many
    found = opened(path, kind)
    assert any(text.startswith(f"{dropped} of {len(lines)} rows are no points") for text in found["findings"]), found[
        "findings"
    ]
    assert not any("scan" in text for text in found["findings"])
    got = points(found)
    apart = np.abs(got[1] - np.interp(got[0], shape.y, shape.z - (shape.z.min() if kind == "rail" else 0.0)))
    assert np.median(apart) < 1e-6


def test_the_page_finds_the_same_false_rows_as_the_library_row_by_row(tmp_path):
    """Random codes, runs, ends, repeated points and several scans; also scans without a fault."""
    cases = []
    for seed in range(300):
        rng = np.random.default_rng(seed)
        shape = SHAPES[("wheel", "rail")[seed % 2]]
        rows = 1e3 * np.column_stack((shape.y, shape.z))[:: int(rng.integers(1, 5))].round(3)
        if seed % 7 == 0:
            rows = np.concatenate((rows, rows[:: (-1) ** seed]))
        for _ in range(int(rng.integers(0, 4))):
            begin, long = int(rng.integers(0, len(rows))), int(rng.integers(1, 12))
            wild = ([0.0, 0.0], [-999.0, -999.0], [1e30, 5.0], [np.nan, 0.0], rows[int(rng.integers(0, len(rows)))])
            code = np.array(wild[int(rng.integers(0, len(wild)))])
            rows[begin : begin + long] = np.where(np.isnan(code), rows[begin : begin + long], code)
        cases.append(rows)
    (tmp_path / "cases.json").write_text(json.dumps([rows.tolist() for rows in cases]))
    script = "const { falseRows } = require(process.argv[1]), cases = JSON.parse(require('fs').readFileSync(process.argv[2]));"
    script += "console.log(JSON.stringify(cases.map(falseRows)))"
    program = Path(__file__).parents[2] / "explorer" / "page" / "false_rows.js"
    command = ["node", "-e", script, str(program), str(tmp_path / "cases.json")]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    wanted = [false_rows(rows) for rows in cases]
    assert sum(one.any() for one in wanted) > 100
    assert [seed for seed, (one, other) in enumerate(zip(found, wanted, strict=True)) if one != other.tolist()] == []
