"""Damaged and hostile files: every reader says what is wrong with a ContactError, and none takes them for good."""

import os
import zipfile
from dataclasses import dataclass

import numpy as np
import pytest
from typer.testing import CliRunner

import contact
from contact.accumulation import Histogram
from contact.cli import cases
from contact.geometry import profile
from contact.reading.text import toml
from contact_fmu import archive, profiles, resources
from contact_fmu.exchange import app
from contact_models import toml as declared
from contact_models.runs import checkpoint
from tests import damaged


def refused(read, path, copies: list[bytes], *arguments) -> None:
    """Assert that no copy is taken for good, and that each is refused with a ContactError."""
    for copy in copies:
        path.write_bytes(copy)
        with pytest.raises(contact.ContactError):
            read(path, *arguments)


@dataclass(frozen=True)
class Plain:
    length: float


@pytest.fixture
def histogram():
    return Histogram(profile.s1002(), width=1e-3, radius=0.46)


@pytest.mark.slow
def test_a_damaged_histogram_is_refused(histogram, tmp_path):
    pytest.importorskip("xarray", reason="HISTOGRAMS IN FILES ARE NOT TESTED: xarray is not installed")
    from contact.accumulation import files

    path = tmp_path / "histogram.nc"
    files.save(histogram, path)
    good = path.read_bytes()
    assert files.load(path).profile.name == histogram.profile.name
    # padding between the parts of the format may hold anything, so what is taken must be equal
    for copy in damaged.of_bytes(good, 300):
        path.write_bytes(copy)
        try:
            found = files.load(path)
        except contact.ContactError:
            continue
        assert files.to_xarray(found).attrs["checksum"] == files.to_xarray(histogram).attrs["checksum"]
    with pytest.raises(FileNotFoundError):
        files.load(tmp_path / "nothing.nc")


def test_a_checkpoint_that_lists_fewer_arrays_is_refused(tmp_path):
    """An archive whose list of files has lost an entry is still an archive."""
    path = tmp_path / "run.npz"
    checkpoint.write(path, "mine", {"rows": np.arange(30.0), "wheel": np.ones((4, 5))})
    with zipfile.ZipFile(path) as whole:
        kept = {name: whole.read(name) for name in whole.namelist() if name != "rows.npy"}
    with zipfile.ZipFile(path, "w") as less:
        for name, content in kept.items():
            less.writestr(name, content)
    with pytest.raises(contact.ContactError, match="arrays are missing"):
        checkpoint.read(path, "mine")


def test_integers_beyond_floats_are_refused(tmp_path):
    """float() raises OverflowError, which is no ValueError. TOML, JSON and Python have such integers."""
    large = 10**400
    path = tmp_path / "cases.json"
    path.write_text(f'[{{"load": {large}}}]')
    for wrong in (
        lambda: contact.Creepage(large),
        lambda: contact.Separation([0.0, large, 1.0], 0.0, 1.0),
        lambda: cases.read(path, {}),
        lambda: declared.build(Plain, {"length": large}, "wheel"),
    ):
        with pytest.raises(contact.ContactError):
            wrong()


def test_a_damaged_checkpoint_is_refused(tmp_path):
    path = tmp_path / "run.npz"
    checkpoint.write(path, "mine", {"rows": np.arange(30.0), "wheel": np.ones((4, 5))})
    good = path.read_bytes()
    refused(checkpoint.read, path, [good[:n] for n in range(0, len(good), 7)], "mine")
    for copy in damaged.of_bytes(good, 600):
        path.write_bytes(copy)
        try:
            found = checkpoint.read(path, "mine")
        except contact.ContactError:
            continue
        assert found is not None
        np.testing.assert_array_equal(found["rows"], np.arange(30.0))


def test_a_damaged_fmu_keeps_its_content_and_is_refused(tmp_path):
    path = tmp_path / "WheelRailPair.fmu"
    new = {"wheel": profile.s1002()}
    for copy in (b"", b"PK", b"no archive" * 100):
        path.write_bytes(copy)
        with pytest.raises(contact.ContactError, match="is not an FMU"):
            profiles.exchange(path, new)
        assert path.read_bytes() == copy
    archive.write(path, [("modelDescription.xml", b"<a/>"), ("resources/wheel.profile", bytes(5000))])
    good = bytearray(path.read_bytes())
    good[good.index(b"wheel.profile") + 20] ^= 0xFF  # inside the compressed bytes
    path.write_bytes(good)
    with pytest.raises(contact.ContactError, match="is not an FMU"):
        profiles.exchange(path, new)


@pytest.mark.parametrize("text", ["x = " + "9" * 5000, "x = " + "[" * 20000, "x = \x00", "\xff"])
def test_toml_of_an_attacker_is_refused(tmp_path, text):
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="latin-1")
    for read in (toml, lambda path: cases.read(path, {})):
        with pytest.raises(contact.ContactError):
            read(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")
def test_a_named_pipe_is_no_profile(tmp_path):
    """Opening it to read would wait for a writer."""
    path = tmp_path / "rail.prr"
    os.mkfifo(path)
    with pytest.raises(contact.ContactError, match="is not a regular file"):
        profile.read(path)


def test_points_that_cannot_be_smoothed_are_refused(tmp_path):
    pytest.importorskip("scipy")
    from contact.geometry.smoothing import smoothed

    with pytest.raises(contact.ContactError, match="no spline was found"):
        smoothed(np.array([0.0, 1.0, 1.0, 2.0]), np.array([0.0, 1.0, 1.0, 2.0]), 0.0)


def test_a_file_that_cannot_be_written_leaves_the_old_one(tmp_path):
    """As on a full disk: the new archive is written beside the old one, which it replaces only when it is complete."""
    path = tmp_path / "user.fmu"
    archive.write(path, [("a", b"old")])
    before = path.read_bytes()

    def content():
        yield "a", b"new"
        yield "b", None  # writing this fails

    with pytest.raises(TypeError):
        archive.write(path, content())
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["user.fmu"]
    archive.write(path, [("a", b"new")])
    assert zipfile.ZipFile(path).read("a") == b"new"


def test_the_command_without_options_does_nothing_and_says_what_is_missing(tmp_path):
    path = tmp_path / "user.fmu"
    path.write_bytes(b"anything")
    done = CliRunner().invoke(app, ["profiles", str(path)])
    assert done.exit_code == 2
    assert "give --wheel, --rail or both" in done.stderr
    assert path.read_bytes() == b"anything"


def test_a_profile_of_more_points_than_the_fmu_reads_is_refused():
    y = np.linspace(-0.03, 0.03, resources.MOST_POINTS + 1)
    with pytest.raises(contact.ContactError, match="100001 points: an FMU reads at most 100000"):
        profiles.pack(profile.Profile("rail", y, 5.0 * y**2, 10.0 * y, "fine"))


def _maltreated(rng, shape):
    """Return the points of a profile [mm] after one of several accidents."""
    points = 1e3 * np.column_stack((shape.y, shape.z))
    return [
        lambda: rng.normal(size=(rng.integers(1, 300), 2)) * rng.choice([1e-6, 1.0, 50.0, 1e6]),
        lambda: points[rng.permutation(len(points))],
        lambda: points + rng.normal(size=points.shape) * rng.choice([1e-3, 0.1, 1.0, 10.0]),
        lambda: points[np.sort(rng.integers(0, len(points), rng.integers(2, 40)))],
        lambda: np.repeat(points, 3, axis=0),
        lambda: np.concatenate((points, points[::-1], points)),
        lambda: points * rng.choice([1.0, -1.0, 0.0], 2),
        lambda: points + rng.uniform(-200.0, 200.0, 2),
        lambda: np.round(points, rng.integers(0, 3)),
    ][rng.integers(9)]()


@pytest.mark.slow
def test_whatever_a_file_holds_a_profile_or_a_contact_error_comes_out(tmp_path):
    pytest.importorskip("scipy")
    path, read = tmp_path / "points.txt", 0
    for seed in range(120):
        rng = np.random.default_rng(seed)
        kind = ("wheel", "rail")[seed % 2]
        points = _maltreated(rng, profile.s1002() if kind == "wheel" else profile.rail_60e1())
        path.write_text("\n".join(f"{a:.6g} {b:.6g}" for a, b in points))
        options = {
            "side": rng.choice(profile.SIDES),
            "zero": rng.choice(profile.ZEROS),
            "repair": bool(rng.integers(2)),
        }
        options |= [{}, {"smoothing": 3e-6}, {"wavelength": 3e-3}][rng.integers(3)]
        try:
            found = profile.check(path, kind=kind, unit="mm", **options)
        except contact.ContactError:
            continue
        read += 1
        assert str(found)
    assert 30 < read < 120
