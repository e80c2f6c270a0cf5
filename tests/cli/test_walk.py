"""What a newcomer's second walk stumbled over (issue 34, "Shown by")."""

import json
import math

import numpy as np
import pytest

from contact.errors import ProfileWarning
from contact.geometry import inspection, library, profile
from contact.geometry.inspection import misplaced

typer = pytest.importorskip("typer")

from contact.cli.output import in_options  # noqa: E402
from tests.command_line import call  # noqa: E402

WHEEL, RAIL = profile.s1002(), profile.rail_60e1(inclination=0.0)


def miniprof(path, y, z, unit=1e-3):
    rows = (f"{a / unit:.6f}\t{b / unit:.6f}" for a, b in zip(y, z, strict=True))
    path.write_text("\n".join(["[HEAD]", "ProgramName=MiniProf", *rows]) + "\n")
    return path


@pytest.mark.parametrize(("ending", "shape"), [("whl", WHEEL), ("ban", RAIL)])
@pytest.mark.parametrize("turn", [-6.0, 6.0, 7.0])
def test_a_profile_that_is_turned_is_named_with_the_angle_that_turns_it_back(tmp_path, ending, shape, turn):
    turned = shape.rotated(math.radians(turn))
    path = miniprof(tmp_path / f"turned.{ending}", turned.y, turned.z)
    (found,) = [finding for finding in profile.check(path).findings if finding.fault == "turned"]
    angle = float(found.cure.split("rotated(")[1].split(")")[0])
    back = math.radians(abs(turn) if ending == "ban" else -turn)  # the deeper side of a MiniProf rail is its gauge side
    assert angle == pytest.approx(back, abs=math.radians(2.0))
    shown = profile.load(str(path), shape.kind, rotation=angle)
    assert inspection.turned(np.column_stack((shown.y, shown.z)), shape.kind) == 0.0
    side = "0" if ending == "ban" else f"{angle:g}"
    said = call("check", path).stdout
    assert "turned: " in said
    assert f"--profile-rotation {side} {angle if ending == 'ban' else 0:g}" in said


def test_profiles_that_lie_as_they_should_are_not_called_turned():
    for name in library.names("wheel"):
        assert all(finding.fault != "turned" for finding in profile.check(profile.named(name)).findings), name
    for name in library.names("rail"):
        for inclination in (0.0, 1 / 20, 1 / 40) if library.has_inclination(name) else (None,):
            rail = profile.named(name, inclination=inclination)
            assert all(finding.fault != "turned" for finding in profile.check(rail).findings), name


@pytest.mark.parametrize(("ending", "shape"), [("whl", WHEEL), ("ban", RAIL)])
@pytest.mark.parametrize(("unit", "name"), [(0.0254, "inch"), (1e-2, "cm"), (1.0, "m")])
def test_a_wrong_unit_is_named_with_the_likeliest_first(tmp_path, ending, shape, unit, name):
    path = miniprof(tmp_path / f"wrong.{ending}", shape.y, shape.z, unit)
    said = call("check", path, code=2).stderr
    assert f"set --profile-unit to '{name}'" in " ".join(said.split())


@pytest.mark.parametrize(("ending", "shape"), [("whl", WHEEL), ("ban", RAIL)])
def test_swapped_columns_are_named(tmp_path, ending, shape):
    path = miniprof(tmp_path / f"swapped.{ending}", shape.z, shape.y)
    said = " ".join(call("check", path, code=2).stderr.split())
    assert "are its columns y and z swapped, or is it turned by 90°?" in said


def test_arrays_in_millimetres_are_still_told_their_unit():
    assert misplaced(np.column_stack((1e3 * WHEEL.y, 1e3 * WHEEL.z)), "wheel")[2] == "the unit is m"


def test_a_flat_lies_at_station_0(tmp_path):
    words = ("--flat", 0.05, "--from", -0.05, "--to", 0.05, "--points", 5, "--normal", "strip_halfspace")
    heights = np.array(json.loads(call("along", *words, "--json").stdout)["z"])
    assert np.argmax(heights) == 2
    assert heights[2] - heights[[0, 4]].max() > 1e-4


def test_breakpoints_in_millimetres_are_named_as_they_were_typed(tmp_path):
    result = call("lut", "--axis", "y=-3:3:5", "--out", tmp_path / "t.npz", code=2)
    assert "--axis y = -3: a flange touches at about 0.007 m; the unit is m" in result.stderr
    assert "pose.y" not in result.stderr
    assert "points = " not in result.stderr


def test_messages_of_the_command_line_name_no_argument_of_python():
    given = (
        "load = 8e4: the contact patch reaches the end of the given separation; extend y; y = [0, 1] m (throw=False "
    )
    said = in_options(f"{given}returns the solution with this status)", {})
    assert "throw=False" not in said
    assert "the contact patch reaches the end of a profile" in said


def test_reading_warns_of_a_turned_profile(tmp_path):
    turned = WHEEL.rotated(math.radians(5.0))
    with pytest.warns(
        ProfileWarning, match=r"turned: the tread falls by 3.0°.*rotated\(-0.0865\) turns the wheel back"
    ):
        profile.read(miniprof(tmp_path / "turned.whl", turned.y, turned.z))
