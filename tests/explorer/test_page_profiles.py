"""The page's reader of profiles against the library's: every orientation, unit, separator, fault (issue 34, 1)."""

from __future__ import annotations

import itertools
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


def opened(*paths: Path, kind: str = "any") -> list[dict]:
    """Return what the page makes of files, in one process."""
    command = ["node", str(Path(__file__).with_name("profiles.js")), json.dumps(rules()), kind, *map(str, paths)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def written(folder: Path, y, z, unit: float = 1e-3, between: str = " ", head: str = "", decimals: int = 9) -> Path:
    path = folder / f"profile {len(list(folder.iterdir()))}.txt"
    rows = (f"{a / unit:.{decimals}f}{between}{b / unit:.{decimals}f}" for a, b in zip(y, z, strict=True))
    path.write_text(head + "\n".join(rows) + "\n")
    return path


def points(found: dict) -> np.ndarray:
    """Return y, z and angle, shape (3, n)."""
    return np.array(found["numbers"][1:]).reshape(3, int(found["numbers"][0]))


@pytest.mark.parametrize("kind", ["wheel", "rail"])
def test_every_orientation_and_unit_gives_the_profile_of_the_library(kind, tmp_path):
    shape = SHAPES[kind]
    cases = [*itertools.product((1.0, -1.0), (1, -1), (1e-3, 1.0, INCH))]
    paths = [written(tmp_path, left * shape.y[::left], up * shape.z[::left], unit) for up, left, unit in cases]
    for (up, left, unit), found in zip(cases, opened(*paths), strict=True):
        assert found["kind"] == kind
        got = points(found)
        expected = profile.Profile(kind, shape.y, shape.z - (shape.z.min() if kind == "rail" else 0.0))
        if kind == "rail" and left < 0:  # a rail's head is symmetric but for what is below it
            expected = profile.Profile(kind, *got[:2])
        np.testing.assert_allclose(got[:2], [expected.y, expected.z], atol=2e-9)
        np.testing.assert_allclose(got[2], expected.angle, atol=1e-4)
        said = " ".join(found["findings"])
        assert ("z pointed up" in said) == (up < 0.0)
        assert ("unit taken as" in said) == (unit != 1e-3)
        assert ("y pointed to the inside" in said) == (left < 0) or kind == "rail"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_text_is_read_as_the_library_reads_it(encoding, tmp_path):
    """Separators and headings, and other signs; `wrong_files.py` has decimal commas and what cannot be a profile."""
    shape = SHAPES["wheel"]
    paths = [
        written(tmp_path, shape.y, shape.z, between=between, head=head)
        for between, head in ((";", ""), (",", ""), ("\t", "# made by hand\ny z\n"), ("  ", "12 3\ntext\n"))
    ]
    for change in (("-", "\N{MINUS SIGN}"), (" ", "\N{NO-BREAK SPACE}"), ("\n", '  " seen\n'), ("\n", "\r")):
        paths.append(written(tmp_path, shape.y, shape.z))
        paths[-1].write_bytes(paths[-1].read_text().replace(*change).encode(encoding))
    assert [points(found).shape[1] for found in opened(*paths)] == [shape.y.size] * len(paths)


def test_a_wheel_measured_from_the_back_of_its_flange_is_moved(tmp_path):
    shape = SHAPES["wheel"]
    (found,) = opened(written(tmp_path, shape.y + 0.070, shape.z))
    np.testing.assert_allclose(points(found)[0], shape.y, atol=2e-9)
    assert any("moved by -70 mm across" in finding for finding in found["findings"])


def test_noise_is_told_and_smoothed(tmp_path):
    shape = SHAPES["rail"]
    rng = np.random.default_rng(3)
    noisy = shape.y + rng.normal(0.0, 1e-5, shape.y.size), shape.z + rng.normal(0.0, 1e-5, shape.z.size)
    (found,) = opened(written(tmp_path, *noisy))
    assert any(finding.startswith("noise of ") for finding in found["findings"])
    y, _, angle = points(found)
    head = np.abs(y) < 0.025
    error = angle - np.interp(y, shape.y, shape.angle)
    unsmoothed = profile.Profile("rail", *noisy).angle - shape.angle
    assert np.sqrt(np.mean(error[head] ** 2)) < 0.15 * np.sqrt(np.mean(unsmoothed[np.abs(noisy[0]) < 0.025] ** 2))


def test_back_steps_and_what_has_the_shape_of_the_other_kind_are_told(tmp_path):
    shape = SHAPES["wheel"]
    swapped = np.arange(shape.y.size)
    swapped[[100, 101]] = [101, 100]
    (found,) = opened(written(tmp_path, shape.y[swapped], shape.z[swapped]))
    assert any("stepping back" in finding for finding in found["findings"])
    (found,) = opened(written(tmp_path, shape.y, shape.z), kind="rail")
    assert "the points have the shape of a wheel" in found["error"]


@pytest.mark.parametrize("kind", ["wheel", "rail"])
def test_a_turned_profile_is_told_as_the_library_tells_it(kind, tmp_path):
    turns = (0.0, 2.0, 6.0, 7.0)
    shapes = [SHAPES[kind].rotated(np.radians(turn)) for turn in turns]
    read = opened(*(written(tmp_path, shape.y, shape.z) for shape in shapes), kind=kind)
    for turn, shape, found in zip(turns, shapes, read, strict=True):
        assert any(finding.startswith("turned?") for finding in found["findings"]) == (turn > 5.0)
        assert bool(inspection.turned(np.column_stack((shape.y, shape.z)), kind)) == (turn > 5.0)


def test_a_narrow_head_is_not_called_turned(tmp_path):
    y, z = 0.75 * SHAPES["rail"].y, SHAPES["rail"].z
    lip = np.array([[-0.075, -0.065, -0.06, -0.04, -0.035], [0.005, 0.005, 0.02, 0.045, 0.04]])
    for points in ((y, z), np.column_stack((lip, (y, z)))):
        (found,) = opened(written(tmp_path, *points), kind="rail")
        assert not any(finding.startswith("turned?") for finding in found["findings"])
        assert inspection.turned(np.column_stack(points), "rail") == 0.0


def test_swapped_columns_and_what_has_no_head_are_told(tmp_path):
    swapped, said = written(tmp_path, SHAPES["wheel"].z, SHAPES["wheel"].y), "are the columns y and z swapped"
    flat = written(tmp_path, np.linspace(-0.035, 0.035, 80), np.zeros(80))
    assert said in opened(swapped, kind="wheel")[0]["error"]
    as_rail, no_head = opened(swapped, flat, kind="rail")
    assert any(said in finding for finding in as_rail["findings"])
    assert "no crown with sides that fall off: is this the head of a rail?" in no_head["findings"]


#: What devices write where nothing was seen, for y and z of the row that is missing.
CODES = ("0 0", "-999 -999", "9999 9999", "{y} -999", "32767 32767", "1e30 1e30", "{y} 0", "0 {z}")


@pytest.mark.parametrize("kind", ["wheel", "rail"])
def test_false_rows_are_dropped_and_told_as_the_library_does(kind, tmp_path):
    shape = SHAPES[kind]
    away = np.flatnonzero((np.abs(shape.y) > 2e-3) & (np.abs(shape.z) > 2e-3))[3:-3]  # a 0 there is no point of it
    paths, false = [], []
    for code, many in itertools.product(CODES, (1, 5, 25)):
        paths.append(written(tmp_path, shape.y, shape.z, decimals=5))
        lines = paths[-1].read_text().splitlines()
        for k in np.random.default_rng(many).choice(away, many, replace=False):
            y, z = lines[k].split()
            lines[k] = code.format(y=y, z=z)
        paths[-1].write_text("\n".join(lines))
        false.append(int(false_rows(np.array([line.split() for line in lines], float)).sum()))
        assert false[-1] >= 0.8 * many
    for found, dropped in zip(opened(*paths, kind=kind), false, strict=True):
        told = found["findings"]
        assert any(text.startswith(f"{dropped} of {shape.y.size} rows are no points") for text in told), told
        assert not any("scan" in text for text in told)
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
