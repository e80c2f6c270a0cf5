"""Measured track: it covers the run or is refused, stations of a line, direction of travel, millimetres."""

import warnings

import numpy as np
import pytest

from contact.errors import ContactError, PlausibilityWarning
from contact_models.runs import scenario
from contact_models.vehicle.measured import Measured
from contact_models.vehicle.track import Track

S = np.arange(0.0, 80.0, 0.25)
ROWS = np.column_stack((S, 2e-3 * np.sin(S / 3), 1e-3 * np.sin(S / 2), 1e-3 * np.cos(S / 4), 5e-4 * np.cos(S)))
HEAD = "distance,alignment,vertical,cross_level,gauge"


def written(folder, rows=ROWS, *, track="", more="", length=40.0, name="t.csv"):
    np.savetxt(folder / name, rows, delimiter=",", header=HEAD, comments="")
    path = folder / "s.toml"
    path.write_text(
        f'name = "s"\nlength = {length}\nspeed = 20.0\n{more}\n[track.measured]\nfile = "{name}"\n{track}\n',
        encoding="utf-8",
    )
    return path


def moved(begin, scale=(1.0, 1.0, 1.0, 1.0)):
    return ROWS * np.array([1.0, *scale]) + np.array([begin, 0, 0, 0, 0])


def over(folder, rows, **given):
    np.savetxt(folder / "o.csv", rows, delimiter=",", header=HEAD, comments="")
    return np.array(Measured(file=str(folder / "o.csv"), **given).over(np.arange(0.0, 40.0, 0.1)))


@pytest.mark.parametrize(
    ("begin", "track", "length", "said"),
    [
        (
            12000.0,
            "",
            40.0,
            r"the run leads from station 0 to 40 m .* stations 12000 to 12079.75 m; .* 12000 to 12039.75 m",
        ),
        (12000.0, "start = 12050.0", 40.0, "from station 12050 to 12090 m"),
        (0.0, "", 100.0, r"from station 0 to 100 m .* 0 to 79.75 m; at most 79.75 m can be run"),
        (
            12000.0,
            'start = 12010.0\ndirection = "falling"',
            40.0,
            r"12010 to 11970 m .* start may be 12040 to 12079.75 m",
        ),
    ],
)
def test_a_series_that_does_not_cover_the_run_is_refused_with_both_intervals(tmp_path, begin, track, length, said):
    with pytest.raises(ContactError, match=rf"s\.toml\.track\.measured: file = .*{said}"):
        scenario.read(written(tmp_path, moved(begin), track=track, length=length))


def test_the_front_axle_of_a_vehicle_must_be_on_the_series_too(tmp_path):
    with pytest.raises(ContactError, match=r"from station 0 to 84\.\d* m \(front axle\)"):
        scenario.read(written(tmp_path, more='vehicle = "manchester"', length=74.0))


def test_a_run_may_begin_at_any_station_of_a_line(tmp_path):
    scenario.read(written(tmp_path, moved(12000.0), track="start = 12020.0"))
    shifted = over(tmp_path, moved(12000.0), start=12000.0)
    np.testing.assert_allclose(shifted, over(tmp_path, ROWS), rtol=0.0, atol=1e-12)


def test_towards_falling_stations_right_is_left(tmp_path):
    """The same place is passed at s and at start - s; alignment and cross-level change sign, slopes along s too."""
    there, back = over(tmp_path, ROWS), over(tmp_path, ROWS, start=39.9, direction="falling")
    signs = np.array([-1.0, 1.0, -1.0, 1.0])[:, None]
    inner = slice(0, -1)  # the last place is the file's first station, to rounding
    np.testing.assert_allclose(back[:, 0, inner], (signs * there[:, 0, ::-1])[:, inner], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(back[:, 1, inner], (-signs * there[:, 1, ::-1])[:, inner], rtol=0.0, atol=1e-12)


def test_rows_may_fall_in_the_file(tmp_path):
    np.testing.assert_array_equal(over(tmp_path, ROWS[::-1]), over(tmp_path, ROWS))


def test_millimetres_are_recognised_and_can_be_said(tmp_path):
    in_mm = moved(0.0, (1e3, 1e3, 1.5e3, 1e3))
    for given in ({}, {"unit": "mm"}):
        np.testing.assert_allclose(over(tmp_path, in_mm, **given), over(tmp_path, ROWS), rtol=0.0, atol=1e-12)
    with pytest.raises(ContactError, match=r"of up to 0\.\d+ can be metres or millimetres; set unit"):
        over(tmp_path, moved(0.0, (40.0, 1.0, 1.0, 1.0)))
    with pytest.raises(ContactError, match=r"alignment is up to 2 m, and 1 m are allowed; with unit = 'mm'"):
        over(tmp_path, in_mm, unit="m")


def test_a_gauge_in_place_of_its_deviation_is_named(tmp_path):
    with pytest.raises(ContactError, match=r"the mean of gauge is 1\.43\d+ m; give its deviation"):
        over(tmp_path, ROWS + np.array([0, 0, 0, 0, 1.435]))


def test_a_path_alone_is_a_series_from_station_0():
    assert Track(measured="t.csv").series == Measured(file="t.csv")


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("[speed]\nat = [12000.0, 12100.0]\nvalues = [20.0, 30.0]", "speed: its places, 12000 to 12100 m, are outside"),
        (
            "speed = 20.0\n[track.friction]\nat = [-50.0, -10.0]\nright = [1.0, 2.0]\nleft = [1.0, 1.0]",
            "track.friction: its places, -50 to -10 m, are outside of the run from 0 to 40 m",
        ),
        ("speed = 20.0\n[[torque]]\nat = [90.0, 95.0]\nvalues = [0.0, 1e3]", r"torque\[0\]: its places"),
        (
            'speed = 20.0\n[[torque]]\nover = "time"\nat = [3.0, 9.0]\nvalues = [0.0, 1e3]',
            r"torque\[0\]: its places, 3 to 9 s, are outside of the run from 0 to 2 s",
        ),
        (
            "speed = 20.0\n[[track.curves]]\nstart = 60.0\nradius = 500.0\nlength = 10.0",
            r"track.curves\[0\]: it starts at 60 m, and the run ends at 40 m",
        ),
    ],
)
def test_what_lies_outside_of_the_run_is_warned_of(tmp_path, more, said):
    path = tmp_path / "s.toml"
    path.write_text(f'name = "s"\nlength = 40.0\n{more}\n', encoding="utf-8")
    with pytest.warns(PlausibilityWarning, match=rf"s\.toml\.{said}"):
        scenario.read(path)


@pytest.mark.filterwarnings("error::contact.errors.PlausibilityWarning")
def test_tables_that_reach_into_the_run_and_single_places_are_not_warned_of(tmp_path):
    path = tmp_path / "s.toml"
    more = "[speed]\nat = [0.0, 20.0]\nvalues = [20.0, 30.0]\n[[torque]]\nat = [90.0]\nvalues = [1e3]\n"
    path.write_text(f'name = "s"\nlength = 40.0\n{more}', encoding="utf-8")
    scenario.read(path)


def test_columns_are_taken_by_their_headings(tmp_path):
    straight = over(tmp_path, ROWS)
    order = [3, 0, 2, 4, 1]
    names = [*(HEAD.split(",")[k] for k in order), "speed"]
    rows = np.column_stack((ROWS[:, order], np.full(len(ROWS), 20.0)))
    np.savetxt(tmp_path / "m.csv", rows, delimiter=",", header=",".join(names), comments="")
    mixed = np.array(Measured(file=str(tmp_path / "m.csv")).over(np.arange(0.0, 40.0, 0.1)))
    np.testing.assert_array_equal(mixed, straight)


def test_a_heading_over_another_column_is_refused(tmp_path):
    np.savetxt(tmp_path / "m.csv", ROWS, delimiter=",", header="km,vertical,alignment,cross_level,gauge", comments="")
    with pytest.raises(
        ContactError, match=r"'vertical' stands over column 2; name all of distance, alignment, vertical"
    ):
        Measured(file=str(tmp_path / "m.csv")).over(np.zeros(1))
    np.savetxt(tmp_path / "m.csv", ROWS, delimiter=",", header="km,Richtung,Höhe,Querhöhe,Spur", comments="")
    Measured(file=str(tmp_path / "m.csv")).over(np.zeros(1))


def test_missing_stations_within_the_run_are_told(tmp_path):
    kept = (S < 12.0) | (S > 17.0)
    path = written(tmp_path, ROWS[kept])
    with pytest.warns(PlausibilityWarning, match=r"track\.measured: no stations from 11\.75 to 17\.25 m of the run"):
        scenario.read(path)
    for within in ((S < 12.0) | (S > 13.0), (S < 50.0) | (S > 60.0)):  # a few stations, beyond the run
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            scenario.read(written(tmp_path, ROWS[within]))
