"""Files as they come: encodings, separators, headings and false rows give the profile of the clean file, and are told."""

import warnings

import numpy as np
import pytest

from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry import profile
from contact.geometry.false_rows import false_rows
from tests.geometry.written import COLUMNS, RAIL, WHEEL

ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32", "latin-1")
#: What devices and spreadsheets write where nothing was seen; y and z are those of the row that is missing.
CODES = (
    "0 0", "0.000 0.000", "-999 -999", "9999 9999", "-99.9 -99.9", "nan nan", "{y} nan", "inf inf", "{y} -inf", "{y} -999",
    "{y} #N/A", "32767 32767", "1e30 1e30", "{y} 0", "- -", "1.#QNAN 1.#QNAN",
)  # fmt: skip
SEPARATORS = [(separator, ".") for separator in (" ", "\t", ";", ",", ", ", "|")]
SEPARATORS += [(separator, ",") for separator in (" ", "\t", ";", "; ", ", ")]
HEADS = (
    "", "y{0}z\n", "profile of a wheel, 2024-05-01 12:30:00\ny [mm]{0}z [mm]\n", "# y{0}z\n", "No. 17\n\n", "1.5.2024\n",
)  # fmt: skip


def written(path, rows, separator, comma, head="", encoding="utf-8", minus="-", quoted=False, end="\n"):
    """Write rows of cells, separated by blanks in `rows`."""
    lines = []
    for row in rows:
        cells = row.split(" ")
        if comma == ",":
            cells = [
                cell.replace(".", ",") if any(map(str.isdigit, cell)) and "#" not in cell else cell for cell in cells
            ]
        if quoted:
            cells = [f'"{cell}"' for cell in cells]
        lines.append(separator.join(cells))
    text = head.format(separator) + "\n".join(lines) + "\n"
    if encoding != "latin-1":
        text = text.replace("-", minus)
    path.write_bytes(text.replace("\n", end).encode(encoding))
    return path


def rows_of(shape, decimals=4):
    return [f"{1e3 * y:.{decimals}f} {1e3 * z:.{decimals}f}" for y, z in zip(shape.y, shape.z, strict=True)]


def assert_same(found, shape):
    """Assert that the points are those of the shape, but for single ones."""
    assert found.y.size >= 0.98 * shape.y.size
    assert np.ptp(found.y) == pytest.approx(np.ptp(shape.y), abs=4e-4)
    for y, z in zip(found.y, found.z, strict=True):
        assert np.hypot(shape.y - y, shape.z - z).min() < 2.6e-4, "a point beside the profile"


@pytest.mark.parametrize("seed", range(60))
def test_random_false_rows_at_random_places_in_random_writing_give_the_profile_of_the_clean_file(seed, tmp_path):
    rng = np.random.default_rng(seed)
    shape = (WHEEL, RAIL)[seed % 2]
    separator, comma = SEPARATORS[rng.integers(len(SEPARATORS))]
    rows, code = rows_of(shape), CODES[rng.integers(len(CODES))]
    for _ in range(rng.integers(1, 5)):
        place = int(rng.choice([0, len(rows), rng.integers(len(rows))]))
        y = rows[min(place, len(rows) - 1)].split(" ")[0]
        rows[place:place] = [code.format(y=y)] * int(rng.integers(1, 5))
    head = HEADS[rng.integers(len(HEADS))]
    minus = rng.choice(["-", "\N{MINUS SIGN}", "\N{EN DASH}"]) if "{" not in head else "-"
    path = written(
        tmp_path / "scan.csv", rows, separator, comma, head, rng.choice(ENCODINGS), minus, bool(rng.integers(2)),
        rng.choice(["\n", "\r\n", "\r"]),
    )  # fmt: skip
    options = {"kind": shape.kind, "unit": "mm", "side": "right", "repair": bool(rng.integers(2))}
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found = profile.read(path, **options)
    assert_same(found, shape)
    said = [str(warning.message) for warning in told if issubclass(warning.category, ProfileWarning)]
    assert not any("set unit" in line or "set side" in line or "scans" in line or "narrowed" in line for line in said)
    if code not in ("{y} 0", "0 0", "0.000 0.000"):  # these may lie on the profile
        assert any("false rows" in line and "left out" in line for line in said)


@pytest.mark.parametrize("name", profile.names())
@pytest.mark.parametrize("every", [1, 3, 9])
def test_no_point_of_a_standard_profile_is_false(name, every):
    shape = profile.named(name)
    points = 1e3 * np.column_stack((shape.y, shape.z))[::every]
    for sign in ([1, 1], [-1, 1], [1, -1]):
        assert not false_rows(np.round(sign * points + [70.0, 0.0], 3)).any()


MINUS = ("-", "\N{MINUS SIGN}", "\N{EN DASH}", "\N{NON-BREAKING HYPHEN}")


@pytest.mark.parametrize("i", range(len(ENCODINGS)))
@pytest.mark.parametrize("j", range(len(SEPARATORS)))
def test_every_writing_gives_all_points(i, j, tmp_path):
    """Each encoding with each separator, and both with each sign for minus."""
    separator, comma = SEPARATORS[j]
    minus = MINUS[(i + j) % len(MINUS)]
    path = written(tmp_path / "wheel.csv", rows_of(WHEEL), separator, comma, "y{0}z\n", ENCODINGS[i], minus)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = profile.read(path, **COLUMNS)
    np.testing.assert_allclose(found.y, WHEEL.y, atol=1e-7)
    np.testing.assert_allclose(found.z, WHEEL.z, atol=1e-7)


def test_no_break_blanks_quotes_and_exponents_of_fortran_are_read(tmp_path):
    path = tmp_path / "wheel.csv"
    exponents = "\n".join(f"{1e3 * y:.8E} {1e3 * z:.8E}" for y, z in zip(WHEEL.y, WHEEL.z, strict=True)).replace(
        "E", "D"
    )
    for text in (
        "\n".join(rows_of(WHEEL)).replace(" ", "\N{NO-BREAK SPACE}"),
        "\n".join(f'"{row}"' for row in rows_of(WHEEL)),
        exponents,
        "\n".join(f"{row} ok" for row in rows_of(WHEEL)),
        "\n".join(f"{row}  # seen" for row in rows_of(WHEEL)),
    ):
        path.write_text(text, encoding="utf-8")
        assert profile.read(path, **COLUMNS).y.size == WHEEL.y.size


def test_a_column_that_counts_the_rows_is_told_and_passed_over(tmp_path):
    path = tmp_path / "wheel.csv"
    path.write_text("n;y;z\n" + "\n".join(f"{k};{row.replace(' ', ';')}" for k, row in enumerate(rows_of(WHEEL), 1)))
    with pytest.warns(ProfileWarning, match="first column counts the rows; y and z were read from columns 2 and 3"):
        assert profile.read(path, **COLUMNS).y.size == WHEEL.y.size
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert profile.read(path, columns=(2, 3), **COLUMNS).y.size == WHEEL.y.size


def test_a_second_profile_beside_the_first_is_told(tmp_path):
    path, angles = tmp_path / "wheel.csv", np.degrees(WHEEL.angle)
    rows = [row.replace(" ", ";") for row in rows_of(WHEEL)]
    worn = [f"{row.split(';')[0]};{float(row.split(';')[1]) + 0.5}" for row in rows]
    index = [str(k) for k in range(1, len(rows) + 1)]
    for columns, second in (
        ((rows, worn), (3, 4)),
        ((index, rows, worn), (4, 5)),
        ((rows, [row.split(";")[1] for row in worn]), (1, 3)),
        ((rows, [row if k < 400 else ";" for k, row in enumerate(worn)]), (3, 4)),
        ((["-999;-999", *rows], ["-999;-999", *worn]), (3, 4)),
    ):
        path.write_text("\n".join(";".join(row) for row in zip(*columns, strict=True)))
        with pytest.warns(
            ProfileWarning, match=rf"columns {second[0]} and {second[1]} may be .*columns=\({second[0]}, {second[1]}\)"
        ):
            assert profile.read(path, **COLUMNS).y.size == WHEEL.y.size
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "file: false rows")
            assert profile.read(path, columns=second, **COLUMNS).y.size > 390
    rail = profile.rail_60e1()
    for shape, angles in ((WHEEL, np.degrees(WHEEL.angle)), (rail, np.degrees(rail.angle))):
        more = [f"{angle:.4f};{k % 7}" for k, angle in enumerate(angles)]
        path.write_text(
            "\n".join(f"{row.replace(' ', ';')};{end}" for row, end in zip(rows_of(shape), more, strict=True))
        )
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            profile.read(path, kind=shape.kind, unit="mm", side="right")


def test_numbers_above_words_are_a_heading_that_is_told(tmp_path):
    path = tmp_path / "wheel.csv"
    path.write_text("12;11\n3;4\nprofile\n" + "\n".join(rows_of(WHEEL)).replace(" ", ";"))
    with pytest.warns(ProfileWarning, match=r"the numbers in line 1, 2, like '12;11', stand above the words in line 3"):
        assert profile.read(path, **COLUMNS).y.size == WHEEL.y.size


def _upwards(rows):
    """Return the rows with blanks between columns, and with z up, so that most of them have a minus sign there."""
    return [f"{y} -{z}".replace("--", "").replace(" -", ";-") for y, z in (row.split(";") for row in rows)]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda rows: ["1.234,5;2.345,6", *rows], r"line 1: '1\.234,5;2\.345,6' is not a point"),
        (lambda rows: [*rows[:50], "12.3mm;4.5mm", *rows[50:]], "line 51: '12.3mm;4.5mm' is not a point"),
        (lambda rows: [*rows[:50], "second part", *rows[50:]], "line 51: 'second part' is not a point"),
        (lambda rows: [row.replace("-", "~") for row in rows], "line 1: '~69.0000;15.8438' is not a point|~69"),
        (lambda rows: [f"{row.replace(';', 'mm;')}mm" for row in rows], "'-69.0000mm;15.8438mm'"),
        (lambda rows: [row.replace(";-", "-") for row in _upwards(rows)], "line 1: '-69.0000-15.8438' is not a point"),
        (
            lambda rows: [*(f"[{row}]" for row in rows[:200]), *rows[200:]],
            r"line 1: '\[-69\.0000;15\.8438\]' is not a point",
        ),
    ],
)
def test_a_line_with_digits_that_is_no_point_is_named_with_its_content(change, said, tmp_path):
    path = tmp_path / "wheel.csv"
    path.write_text("\n".join(change([row.replace(" ", ";") for row in rows_of(WHEEL)])))
    with pytest.raises(ContactError, match=said):
        profile.read(path, **COLUMNS)


@pytest.mark.parametrize("suffix", ["ban", "whl", "prr", "prw", "mpt", "wheel", "rail", "txt"])
@pytest.mark.parametrize("sign", ["!", "%", "#", '"'])
@pytest.mark.parametrize("dropped", [True, False])
def test_remarks_in_every_format(suffix, sign, dropped, tmp_path):
    shape = RAIL if suffix in ("ban", "prr", "rail", "txt") else WHEEL
    if suffix in ("wheel", "rail"):  # y points to the centre of the track
        shape = profile.Profile(shape.kind, -shape.y, shape.z)
    rows = rows_of(shape)
    kept = [*rows[:100], sign + rows[100], *rows[100:]]
    if not dropped:
        kept = [*rows[:100], f"{rows[100]}  {sign} zigzag", *rows[101:]]
    simpack = f"spline.begin\n units.len.f = 1000. {sign} a remark\n point.begin\n"
    heads = {"prr": simpack, "prw": simpack, "mpt": "[ProfilePoints]\n", "ban": "X=1\n\n", "whl": "X=1\n\n"}
    path = tmp_path / f"a.{suffix}"
    path.write_text(heads.get(suffix, "") + "\n".join(kept) + ("\n point.end\n" if suffix[:2] == "pr" else "\n"))
    options = {"unit": "mm", "side": "right"} if suffix == "txt" else {}
    assert profile.read(path, kind=shape.kind, **options).y.size == shape.y.size


def test_false_rows_of_one_scan_are_no_scans_of_their_own(tmp_path):
    """A gap in the middle of a scan is told as a gap; nothing of the profile is lost."""
    rows = rows_of(WHEEL)
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join([*rows[:150], *["-999 -999"] * 150, *rows[400:]]))
    for repair in (False, True):
        with pytest.warns(ProfileWarning, match="gap: no points over"):
            found = profile.read(path, repair=repair, **COLUMNS)
        assert found.y.size == len(rows) - 250


def test_what_repair_takes_from_the_width_is_told(tmp_path):
    """The scan with the most points is kept, here a finer one of the tread only."""
    y = np.arange(-0.03, 0.06, 1e-4)
    z = np.interp(y, WHEEL.y, WHEEL.z)
    path = tmp_path / "wheel.txt"
    rows = [*rows_of(WHEEL), *(f"{1e3 * a:.4f} {1e3 * b:.4f}" for a, b in zip(y, z, strict=True))]
    path.write_text("\n".join(rows))
    found = {finding.fault.value: str(finding) for finding in profile.check(path, repair=True, **COLUMNS).findings}
    assert "repair leaves 89.9 of 129 mm of the width, from y = -30 to 59.9 mm" in found["narrowed"]
    assert profile.read(path, rows=(1, WHEEL.y.size), **COLUMNS).y.size == WHEEL.y.size


def test_points_that_coincide_after_a_repair_are_one(tmp_path):
    half = WHEEL.y > -0.02
    y = np.concatenate((WHEEL.y[~half], WHEEL.y[half][::-1][:250], WHEEL.y[half]))
    z = np.concatenate((WHEEL.z[~half], WHEEL.z[half][::-1][:250], WHEEL.z[half]))
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(f"{1e3 * a:.4f} {1e3 * b:.4f}" for a, b in zip(y, z, strict=True)))
    assert profile.check(path, repair=True, **COLUMNS).profile is not None


@pytest.mark.parametrize(
    "arrangement", [(300, 302, 410, 412), (300, 301), (250, 300, 302, 350, 410, 412), (400, 403, 405)]
)
@pytest.mark.parametrize("height", [1e-4, -1e-4, 5e-4])
def test_spikes_beside_each_other_are_spikes_and_no_kinks(arrangement, height, tmp_path):
    z = WHEEL.z.copy()
    for k, i in enumerate(arrangement):
        z[i] += height * (-1) ** k
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(f"{1e3 * a:.4f} {1e3 * b:.4f}" for a, b in zip(WHEEL.y, z, strict=True)))
    found = profile.check(path, **COLUMNS)
    assert [finding.fault.value for finding in found.findings] == ["spikes"]
    assert len(found.findings[0].at) == len(arrangement)
    mended = profile.check(path, repair=True, **COLUMNS)
    assert mended.findings == ()
    assert mended.profile.y.size == WHEEL.y.size - len(arrangement)


def test_after_smoothing_only_the_corners_that_are_left_are_told(tmp_path):
    z = WHEEL.z.copy()
    z[400:404] -= 5e-5
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(f"{1e3 * a:.4f} {1e3 * b:.4f}" for a, b in zip(WHEEL.y, z, strict=True)))
    assert [finding.fault.value for finding in profile.check(path, **COLUMNS).findings] == ["kinks"]
    pytest.importorskip("scipy")
    found = profile.check(path, wavelength=5e-3, **COLUMNS)
    assert found.findings == ()
    assert "smoothing rounded" in found.profile.note
    assert "corner left is" in found.profile.note


@pytest.mark.parametrize("seed", range(40))
def test_random_points_beside_a_noisy_scan_with_a_gap_are_false_and_no_others(seed):
    rng = np.random.default_rng(seed)
    shape = profile.named(profile.names()[seed % len(profile.names())])
    points = 1e3 * np.column_stack((shape.y, shape.z))[:: rng.integers(1, 4)]
    if rng.random() < 0.5:
        start = rng.integers(len(points) // 4, len(points) // 2)
        points = np.delete(points, slice(start, start + len(points) // 8), axis=0)
    points = points + rng.normal(size=points.shape) * rng.choice([0.0, 1e-3, 1e-2])
    rows, false = list(points), [False] * len(points)
    for _ in range(rng.integers(1, 5)):
        place = rng.integers(1, len(rows))
        rows.insert(place, rng.uniform(-150.0, 150.0, 2))
        false.insert(place, True)
    rows, false = np.array(rows), np.array(false)
    found = false_rows(rows)
    assert not (found & ~false).any()
    for point in rows[false & ~found]:
        assert np.hypot(*(points - point).T).min() < 12.0, "a point far from the profile was kept"


def test_a_column_that_is_constant_asks_for_the_columns(tmp_path):
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(f"0.0 {row}" for row in rows_of(WHEEL)))
    with pytest.raises(ContactError, match=r"all points have y = 0 m; which columns hold y and z\?"):
        profile.read(path, **COLUMNS)
    assert profile.read(path, columns=(2, 3), **COLUMNS).y.size == WHEEL.y.size


@pytest.mark.parametrize(("start", "end"), [(0, 60), (100, 140), (250, 290)])
def test_a_long_run_with_zero_heights_is_false(start, end, tmp_path):
    rows = rows_of(WHEEL)
    rows[start:end] = [f"{row.split(' ')[0]} 0" for row in rows[start:end]]
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(rows))
    with pytest.warns(ProfileWarning, match=f"false rows: {end - start} of 593"):
        assert profile.read(path, **COLUMNS).y.size == 593 - (end - start)
