"""Files and folders of slices."""

import numpy as np
import pytest

from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry.surfaces import RailSurface, WheelSurface

Y = np.linspace(-30.0, 30.0, 61)


def columns(path, y, z):
    path.write_text("".join(f"{a:.9f} {b:.9f}\n" for a, b in zip(y, z, strict=True)))


@pytest.fixture
def crossing(tmp_path):
    """Write three slices, of which the first has no part left of y = 0."""
    (tmp_path / "parts").mkdir()
    for k in range(3):
        y = Y[Y >= 0.0] if k == 0 else Y
        columns(tmp_path / "parts" / f"slice_{k}.txt", y, 1e-3 * y**2 - 0.1 * k)
    path = tmp_path / "nose.slcs"
    path.write_text(
        "% a nose\n"
        " 5.0  2.0     % offset and scale\n"
        " 3            % slices\n"
        " 3  1  1      % features, kinks, accelerations\n"
        " 1            % interpolating\n"
        " 0.0 'parts/slice_0.txt'\n"
        "10.0 'parts\\slice_1.txt'   ! a separator of Windows\n"
        "20.0 'parts/slice_2.txt'\n"
        " 1            % kink after part 1\n"
        " 1            % acceleration after part 1\n"
        " 0.0  -1.0   0.0 1d3\n"
        "10.0   0.0  30.3\n       1d3\n"
        "20.0   0.0  30.3 1d3\n"
    )
    return path


def test_a_file_of_slices_gives_positions_features_and_points(crossing):
    rail = RailSurface.read(crossing, spacing=1e-3)
    assert rail.sheet.u == pytest.approx([0.010, 0.030, 0.050])
    assert rail.name == "nose"
    before, after = rail.curves(np.array([0.010])), rail.curves(np.array([0.030]))
    assert before[0][np.isfinite(before[0])].min() == pytest.approx(0.0, abs=1e-4)
    assert after[0, 0, [0, -1]] == pytest.approx([-0.03, 0.03])
    assert after[1, 0] == pytest.approx(1e-3 * (1e3 * after[0, 0]) ** 2 * 1e-3 - 1e-4, abs=2e-7)


def test_options_replace_what_the_file_says(crossing):
    rail = RailSurface.read(crossing, name="mine", mirror_z=True)
    assert rail.name == "mine"
    assert rail.curves(np.array([0.03]))[1, 0, 0] == pytest.approx(-0.9e-3 + 1e-4, abs=1e-6)


def test_a_folder_is_read_in_the_order_of_its_numbers(tmp_path):
    for k in (0, 2, 10):
        columns(tmp_path / f"section_{k}.txt", Y, 0.1 * k + 0.0 * Y)
    rail = RailSurface.read(tmp_path, s=[0.0, 0.1, 0.2])
    assert rail.curves(np.array([0.0, 0.1, 0.2]))[1, :, 0] == pytest.approx([0.0, 0.2e-3, 1e-3])


def test_a_wheel_file_has_angles(tmp_path):
    for k in range(4):
        columns(tmp_path / f"w{k}.txt", Y, 0.05 * k + 0.0 * Y)
    path = tmp_path / "wheel.slcw"
    path.write_text("0.0 0.0174532925\n4\n0 0 0\n2\n0 'w0.txt'\n10 'w1.txt'\n20 'w2.txt'\n40 'w3.txt'\n")
    wheel = WheelSurface.read(path)
    assert wheel.sheet.u == pytest.approx(np.radians([0.0, 10.0, 20.0, 40.0]))
    assert wheel.sheet.period is None
    # an approximating spline of a line through uneven steps stays between its control points
    z = wheel.curves(np.radians([10.0]))[1, 0, 0]
    assert 0.0 < z < 1e-4


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            ("10.0 'parts\\slice_1.txt'", "-3.0 'parts\\slice_1.txt'"),
            "features 1 are of position 10, slice 1 lies at 4",
        ),
        (("slice_2.txt", "slice_9.txt"), "is missing"),
        ((" 1            % interpolating", " 3            % interpolating"), "method along the track"),
        ((" 3            % slices", " x            % slices"), "line 3: 'x' is not a number"),
        ((" 3            % slices", " 0            % slices"), "number of slices"),
        (("20.0   0.0  30.3 1d3\n", "20.0   0.0\n"), "ends before the features of slice 2"),
        (("20.0   0.0  30.3 1d3\n", "21.0   0.0  30.3 1d3\n"), "features 2 are of position 21"),
        (("20.0 'parts/slice_2.txt'", "20.0"), "line 8: position and 'file name' of slice 2"),
        (("5.0  2.0", "5.0"), "offset and scale needed"),
    ],
)
def test_bad_files_are_refused_by_line(crossing, change, message):
    text = crossing.read_text()
    assert change[0] in text
    crossing.write_text(text.replace(*change))
    with pytest.raises(ContactError, match=message):
        RailSurface.read(crossing)


def test_more_or_fewer_slices_than_the_file_says_are_told(crossing):
    text = crossing.read_text().partition(" 1            % kink")[0].replace(" 3  1  1 ", " 0  0  0 ")
    crossing.write_text(text.replace(" 3            % slices", " 2            % slices"))
    with pytest.warns(
        ProfileWarning, match=r"line 8: .*slice_2.txt'\" comes after the 2 slices of the file and is not read"
    ):
        assert len(RailSurface.read(crossing).sheet.u) == 2
    crossing.write_text(text.replace(" 3            % slices", " 4            % slices"))
    with pytest.raises(ContactError, match="the file ends where it needs slice 3 of 4"):
        RailSurface.read(crossing)


def test_wrong_arguments_are_refused_by_name(crossing, tmp_path):
    with pytest.raises(ContactError, match="s = None"):
        RailSurface.read(crossing.parent / "parts")
    with pytest.raises(ContactError, match="holds the positions"):
        RailSurface.read(crossing, s=[0.0])
    with pytest.raises(ContactError, match="unit = 'ell'"):
        RailSurface.read(crossing, unit="ell")
    with pytest.raises(ContactError, match="is missing"):
        WheelSurface.read(tmp_path / "absent.slcw")
