"""Damaged text files of every reader: what comes out is made of finite numbers, or a ContactError says what is wrong."""

import contextlib
import dataclasses
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import contact
from contact.cli import arguments, cases, options
from contact.geometry import profile
from contact.geometry.surfaces import RailSurface, WheelSurface
from contact_models.life import declared_set
from contact_models.runs import scenario
from contact_models.vehicle import declared as vehicle
from contact_models.vehicle import track
from contact_models.vehicle.measured import Measured
from tests import damaged

ROOT = Path(__file__).parents[1]
SCENARIOS = ROOT / "examples" / "scenarios"
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()


def _rows(shape: profile.Profile, form: str, y: float = 1e3, z: float = 1e3, shift: float = 0.0) -> str:
    """Return every fifth point in millimetres, one row each. `form` may have the fields y, z and -y as m."""
    points = zip(y * shape.y[::5] + shift, z * shape.z[::5], strict=True)
    return "\n".join(form.format(y=a, z=b, m=-a) for a, b in points) + "\n"


SIMPACK = """header.begin
  type = 1
header.end
spline.begin
  shift.y = 0
  mirror.y = 0
  units.len.f = 1000
  point.begin
{points}  point.end
spline.end
"""
#: Profiles by file name: the text, and options of the reader.
PROFILES: dict[str, tuple[str, dict[str, Any]]] = {
    "wheel.txt": (_rows(WHEEL, "{y:.6f} {z:.6f}"), {"kind": "wheel", "unit": "mm", "side": "right"}),
    "rail.csv": (_rows(RAIL, "{y:.6f},{z:.6f}"), {"kind": "rail", "unit": "mm", "side": "right"}),
    "wheel.prw": (SIMPACK.format(points=_rows(WHEEL, "{y:.6f} {z:.6f} 1.0")), {}),
    "rail.prr": (SIMPACK.format(points=_rows(RAIL, "{y:.6f} {z:.6f} 1.0")).replace("type = 1", "type = 0"), {}),
    "wheel.whl": ("MINIPROF 101\n1.0 2.0 (Sd)\n\n" + _rows(WHEEL, "{y:.6f} {z:.6f} 0.0"), {}),
    "rail.ban": ("XOffset=0.0\nColumnDef=X,Y,A,C\n\n" + _rows(RAIL, "{y:.6f} {z:.6f} 0.0 0.0", -1e3, -1e3), {}),
    "wheel.mpt": (
        "[FileInfo]\nVersion=1\n[ProfilePoints]\n" + _rows(WHEEL, "{y:.6f},{z:.6f},0.0") + "[Other]\n7 8\n",
        {"kind": "wheel"},
    ),
    "pair.whe": (
        "WHEELPROFILE\nS1002\nTREADDATUM EUROPEAN\nFLANGEBACK 1360\n"
        + _rows(WHEEL, "{m:.6f}, {z:.6f}, {y:.6f}, {z:.6f}", shift=750.0),
        {},
    ),
    "pair.rai": (
        "RAILPROFILE\nUIC60\nGAUGEPOINT EUROPEAN\nGAUGE 1435\n"
        + _rows(RAIL, "{m:.6f} {z:.6f} {y:.6f} {z:.6f}", z=-1e3, shift=750.0),
        {},
    ),
    "s1002.wheel": (_rows(WHEEL, "{m:.6f} {z:.6f}  # a comment"), {}),
    "60e1.rail": (_rows(RAIL, "{m:.6f} {z:.6f}"), {}),
}
Y = np.linspace(-30.0, 30.0, 61)
NOSE = """5.0 2.0
3
3 1 1
1
0.0 'slice_0.txt'
10.0 'slice_1.txt'
20.0 'slice_2.txt'
1
1
0.0 -1.0 0.0 1d3
10.0 0.0 30.3 1d3
20.0 0.0 30.3 1d3
"""
CASES = {
    "cases.toml": 'speed = 20.0\nload = 80e3\n[[case]]\nwheel = "S1002"\nrail = "60E1"\ny = 1e-3\n[[case]]\nload = 9e4\n',
    "cases.json": '[{"y": 0.001, "load": 80000.0, "creepage": [0.001, 0.0, 0.1]}]\n',
    "cases.csv": "y,load,speed\n0.001,80000.0,20.0\n0.002,90000.0,30.0\n",
}


def assert_finite(found: object) -> None:
    """Assert that no number in it is NaN, whatever it is made of. Limits may be infinite."""
    if isinstance(found, float):
        assert not math.isnan(found)
    elif isinstance(found, np.ndarray) and found.dtype.kind == "f":
        assert np.isfinite(found).all()
    elif isinstance(found, Mapping):
        assert_finite(list(found.values()))
    elif isinstance(found, Sequence) and not isinstance(found, str):
        for each in found:
            assert_finite(each)
    elif dataclasses.is_dataclass(found):
        assert_finite([getattr(found, field.name) for field in dataclasses.fields(found)])


def survived(path: Path, read: Callable[[], object], number: int) -> None:
    """Read the file, then damaged copies in its place. Some of them must be refused."""
    good, refused = path.read_bytes(), 0
    assert_finite(read())
    for copy in damaged.of_text(good, number):
        path.write_bytes(copy)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", UserWarning)  # of doubtful values, which are not wrong
                found = read()
        except contact.ContactError:
            refused += 1
            continue
        assert_finite(found)
    path.write_bytes(good)
    assert refused > 0


@pytest.mark.slow
@pytest.mark.parametrize("name", PROFILES)
def test_a_damaged_profile(tmp_path, name):
    text, options = PROFILES[name]
    path = tmp_path / name
    path.write_text(text)
    survived(path, lambda: profile.read(path, **options), 25)


@pytest.mark.parametrize("name", PROFILES)
def test_a_profile_that_ends_in_its_first_rows_is_read_or_refused(tmp_path, name):
    text, options = PROFILES[name]
    path, content = tmp_path / name, text.encode()
    for end in range(200):
        path.write_bytes(content[:end])
        with warnings.catch_warnings(), contextlib.suppress(contact.ContactError):
            warnings.simplefilter("ignore", UserWarning)
            assert_finite(profile.read(path, **options))


@pytest.mark.slow
def test_a_damaged_profile_in_a_folder(tmp_path):
    text, options = PROFILES["wheel.txt"]
    for name in ("a.txt", "b.txt"):
        (tmp_path / name).write_text(text)
    survived(tmp_path / "b.txt", lambda: profile.read_folder(tmp_path, **options), 10)


def _slices(folder: Path) -> None:
    for k in range(4):
        rows = (f"{y:.9f} {1e-3 * y * y - 0.1 * k:.9f}\n" for y in Y)
        (folder / f"slice_{k}.txt").write_text("".join(rows))


@pytest.mark.slow
def test_damaged_files_of_slices_and_a_damaged_slice_in_a_file_and_in_a_folder(tmp_path):
    _slices(tmp_path)
    path = tmp_path / "wheel.slcw"
    path.write_text("0.0 0.0174532925\n4\n0 0 0\n2\n" + "".join(f"{10 * k} 'slice_{k}.txt'\n" for k in range(4)))
    survived(path, lambda: WheelSurface.read(path), 40)
    path.unlink()
    path = tmp_path / "nose.slcs"
    path.write_text(NOSE)
    survived(path, lambda: RailSurface.read(path), 40)
    survived(tmp_path / "slice_1.txt", lambda: RailSurface.read(path), 10)
    path.unlink()
    survived(tmp_path / "slice_1.txt", lambda: RailSurface.read(tmp_path, s=[0.0, 0.1, 0.2, 0.3]), 10)


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_a_damaged_file_of_cases(tmp_path, name):
    path = tmp_path / name
    path.write_text(CASES[name])
    given = vars(arguments.PlaceOptions()) | vars(arguments.Amount())
    given |= {"side": options.SideOption.right, "friction": 0.3, "curvatures": None}
    survived(path, lambda: cases.read(path, given), 20)


@pytest.mark.slow
@pytest.mark.parametrize("example", sorted(SCENARIOS.glob("*.toml")), ids=lambda path: path.stem)
def test_a_damaged_scenario(tmp_path, example):
    path = tmp_path / example.name
    path.write_bytes(example.read_bytes())
    if "set" in example.stem:
        for other in SCENARIOS.glob("*.toml"):
            (tmp_path / other.name).write_bytes(other.read_bytes())
        survived(path, lambda: declared_set.read(path), 15)
    else:
        survived(path, lambda: scenario.read(path), 15)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(path.stem for path in vehicle.INCLUDED.glob("*.toml")))
def test_a_damaged_vehicle(tmp_path, name):
    path = tmp_path / "mine.toml"
    path.write_bytes((vehicle.INCLUDED / f"{name}.toml").read_bytes())
    survived(path, lambda: vehicle.read(path), 20)


def test_a_damaged_series_of_measured_track(tmp_path):
    path = tmp_path / "track.csv"
    head = ",".join(("distance", *track.CHANNELS))
    rows = (",".join(f"{0.1 * k + c:g}" for c in range(1 + len(track.CHANNELS))) for k in range(20))
    path.write_text("\n".join((head, *rows)) + "\n")
    survived(path, lambda: Measured(file=str(path)).over(np.linspace(0.0, 1.5, 7)), 100)
