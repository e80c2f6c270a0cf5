"""Runs of scenarios with a vehicle: interruption, damage, files, assessment."""

import dataclasses
import math

import numpy as np
import pytest

from contact.errors import ContactError
from contact.friction import Friction
from contact.geometry import profile
from contact_models.runs import checkpoint, kept, report, result, stability
from contact_models.runs.run import VehicleRun
from contact_models.runs.scenario import Methods, Recording
from contact_models.runs.scenario import read as read_scenario
from contact_models.runs.torque import Torque
from contact_models.vehicle import assess, drawing
from contact_models.vehicle.declared import SIDES, read
from contact_models.vehicle.kernels.layout import Axis
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from tests.notebooks import drawn, parsed, words
from tests.vehicle.parts import completed, scenario


@pytest.fixture(scope="module")
def whole() -> VehicleRun:
    return completed(VehicleRun(scenario()))


def test_torque_becomes_longitudinal_force_and_wear():
    """At rest the rails' force times the radius is the torque; the energy closes with the work of the torque."""
    traction = Torque(at=(2.0, 10.0), values=(0.0, 8000.0), axles=("wheelset",))
    found = {}
    for name, torque in (
        ("rolls", ()),
        ("driven", (traction,)),
        ("braked", (dataclasses.replace(traction, values=(0.0, -8e3)),)),
    ):
        found[name] = completed(VehicleRun(scenario(track=Track(), length=45.0, torque=torque)))
    forces = {}
    for name, run in found.items():
        both = sum(run.series[f"wheelset_{side}_longitudinal_force"] for side in SIDES)
        forces[name] = 0.46 * float(
            both[run.series["distance"] > 31.0].mean()
        )  # over two periods of the axle on its springs
        assert abs(run.balance["residual"]) < 2e-3 * run.balance["dissipated"]
        assert run.trust.creepage < 2e-3
    assert forces["driven"] == pytest.approx(8e3, rel=0.01)
    assert forces["braked"] == pytest.approx(-8e3, rel=0.01)
    assert abs(forces["rolls"]) < 20.0
    T_gamma = "wheelset_right_T_gamma"
    assert found["driven"].series[T_gamma][-1] > 5.0
    assert found["rolls"].series[T_gamma][-1] < 1e-3


def test_a_torque_over_time_and_beyond_friction_is_told():
    spins = Torque(at=(0.1, 0.2), values=(0.0, 40e3), over="time")
    run = completed(VehicleRun(scenario(track=Track(), length=10.0, torque=(spins,))))
    assert np.abs(run.series["wheelset_right_longitudinal_creepage"][run.series["time"] < 0.09]).max() < 1e-4
    assert run.trust.creepage > 0.1
    assert any("A wheel spins or slides" in sentence for sentence in run.trust.warnings)


def test_another_seed_gives_another_run(whole):
    other = completed(VehicleRun(scenario(seed=1)))
    assert not np.array_equal(other.series["wheelset_lateral"], whole.series["wheelset_lateral"])


def test_checkpoint_of_another_run_is_refused(whole, tmp_path):
    path = tmp_path / "checkpoint.npz"
    assert checkpoint.read(path, "x") is None
    checkpoint.write(path, whole.scenario.fingerprint, whole.save())
    with pytest.raises(ContactError, match="checkpoint of another run"):
        checkpoint.read(path, scenario(seed=1).fingerprint)
    path.write_bytes(path.read_bytes()[:1000])
    with pytest.raises(ContactError, match="not a checkpoint"):
        checkpoint.read(path, whole.scenario.fingerprint)


def test_result_keeps_series_and_histograms(whole, tmp_path):
    xarray = pytest.importorskip("xarray")
    result.write(result.dataset(whole), tmp_path / "result.nc")
    stored = xarray.load_dataset(tmp_path / "result.nc", engine="scipy")
    assert set(whole.columns) <= set(stored.variables)
    assert (stored["wheelset_right_T_gamma"].values == whole.series["wheelset_right_T_gamma"]).all()
    assert stored["wheelset_lateral"].attrs["units"] == "m"
    assert stored.attrs["balance_dissipated"] == whole.balance["dissipated"]
    for key, histogram in whole.damage().items():
        found = result.histogram(stored, *key)
        assert (found["wear"] == histogram["wear"]).all()
        assert found.profile.kind == key[-1]
    with pytest.raises(ContactError, match="is not a wheelrail-contact run"):
        result.histogram(xarray.Dataset(), "wheelset", "right", "wheel")


def test_steel_that_flows_limits_the_pressure(whole):
    limit = 0.9 * max(whole.series[f"wheelset_{side}_max_pressure"].max() for side in SIDES)
    methods = dataclasses.replace(whole.scenario.declared.methods, pressure_limit=limit)
    soft = completed(VehicleRun(scenario(methods=methods)))
    assert max(soft.series[f"wheelset_{side}_max_pressure"].max() for side in SIDES) == pytest.approx(limit, rel=1e-6)
    (material,) = soft.damage()["wheelset", "right", "wheel"].materials
    assert material.pressure_limit == limit


def test_leaving_the_rails_is_reported_with_the_position():
    run = VehicleRun(scenario())
    run.advance()
    run.simulation.state.q[run.simulation.model.wheelsets[0], Axis.Y] = 0.2
    with pytest.raises(
        ContactError, match=r"short, 20 m/s: -?\d+\.\d\d m: the right wheel of wheelset has left its rail"
    ):
        run.advance()


def test_histograms_hold_the_damage_of_all_wheels(whole):
    for (_, _, body), histogram in whole.damage().items():
        assert histogram.distance == pytest.approx(5.0, abs=0.3)
        assert histogram["wear"].sum() > 0.0
        if body == "rail":  # depth times width is the volume lost over a length
            assert histogram["wear"].sum() * histogram.width == pytest.approx(histogram.volume, rel=1e-9)


@pytest.mark.usefixtures("undrawn")
def test_report_has_no_nan_and_names_the_limits(whole):
    text = report.page_of(whole)
    assert "Prud" in text
    assert "nan" not in text.split("<picture>")[0]
    assert "doctype" in text.lower()
    assert "contact run --critical-speed" in text  # not found unless asked for


def test_report_draws_the_vehicle_with_a_number_for_each_force_element(monkeypatch, tmp_path):
    monkeypatch.setattr(kept, "cache_folder", lambda: tmp_path)  # where the speed below is kept
    monkeypatch.setattr(stability.linear, "critical_speed", lambda *_, **__: 24.2)  # half a minute
    text = "".join(report._vehicle(VehicleRun(scenario(vehicle="manchester"))))
    for k, joint in enumerate(drawing.joints_of(read("manchester")), 1):
        assert f">{k}: {type(joint).__name__.lower()}<" in text
        assert text.count(f'font-weight="600">{k}</text>') == len(joint.between)
    assert "body, 32 t" in text
    assert "k 160, 160, 430 kN/m; c 0, 32, 20 kN s/m" in text
    assert "depends on the amplitude: 0.354 at 1 mm and 0.174 at 3 mm" in text
    assert "Linear critical speed 24" in text
    assert "body roll" in text


def test_a_step_above_stability_is_refused():
    with pytest.raises(ContactError, match=r"recording.step = 0.0015 s is too long at 10 m/s"):
        VehicleRun(scenario(speed=10.0, recording=Recording(settling=1.0, step=1.5e-3)))


def test_a_run_without_a_step_shortens_its_own_until_it_is_stable():
    """A light rail on the contact's spring needs a shorter step than the spin of the axles, which gives the estimate."""
    light = scenario()
    heavy = VehicleRun(light).step
    rail = dataclasses.replace(light.vehicle.rail, mass=15.0)
    run = VehicleRun(dataclasses.replace(light, vehicle=dataclasses.replace(light.vehicle, rail=rail)))
    assert run.step < 0.8 * heavy
    for _ in range(8):
        run.advance()
    assert np.abs(run.simulation.state.rails).max() < 0.1


def test_nadals_limit():
    """A wheel climbs at 70° and μ = 0.36 from Y/Q = 1.20, without friction at 45° from 1."""
    assert assess.nadal(math.radians(70.0), 0.36) == pytest.approx(1.2003, abs=1e-4)
    assert assess.nadal(math.radians(45.0), 0.0) == pytest.approx(1.0)
    assert math.degrees(assess.flange_angle(profile.s1002())) == pytest.approx(70.0, abs=0.1)


def test_low_pass_has_3_db_at_its_cut_off_and_24_db_an_octave_beyond():
    time = np.arange(0.0, 4.0, 2e-3)
    middle = slice(500, 1500)
    for frequency, gain in ((20.0, 0.5**0.5), (1.0, 1.0), (80.0, 0.008)):
        out = assess.low_pass(np.sin(2.0 * np.pi * frequency * time), time)
        assert np.ptp(out[middle]) / 2.0 == pytest.approx(gain, abs=0.01)


def test_sliding_mean_of_a_straight_line_is_the_line_and_a_pulse_is_spread():
    s = np.arange(0.0, 20.0, 0.25)
    inner = slice(4, -4)
    assert assess.sliding_mean(3.0 * s, s)[inner] == pytest.approx(3.0 * s[inner])
    pulse = np.where(s == 10.0, 1.0, 0.0)
    assert assess.sliding_mean(pulse, s).max() == pytest.approx(0.25 / 2.0)


def test_guiding_force_of_both_wheels_is_below_prudhommes_limit():
    s = np.linspace(0.0, 50.0, 201)
    found = assess.safety(np.array([[2e4], [5e3]]) * np.ones((2, 201)), 5e4 * np.ones((2, 201)), s, s / 20.0, 5.5e4)
    assert (found.quotient, found.guiding) == pytest.approx((0.4, 1.5e4))
    assert found.prudhomme == pytest.approx(1e4 + 1.1e5 / 3.0)
    assert found.unloading == pytest.approx(1.0 - 5.0 / 5.5)


def test_friction_of_the_gauge_face_acts_on_the_part_of_the_profile_that_it_names():
    """Far beyond the profile the border leaves all of it, or nothing of it, to the factor."""

    def dissipated(friction) -> float:
        return completed(VehicleRun(scenario(length=3.0, friction=friction))).balance["dissipated"]

    everywhere, nowhere = (Friction(0.3, gauge_factor=0.5, border=side) for side in (1.0, -1.0))
    assert dissipated(everywhere) == pytest.approx(dissipated(0.15), rel=1e-9)
    assert dissipated(nowhere) == dissipated(0.3)


def test_rails_may_differ_and_are_mirrored(tmp_path):
    """With another rail on the right and the same on the left the vehicle moves the other way."""
    text = (
        'name = "s"\nlength = 8.0\nspeed = 20.0\nvehicle = "wheelset"\n'
        '[methods]\nnormal = "analyn"\ntangential = "fastrip"\nstrips = 20\nelements = 12\n'
        "[recording]\nsettling = 2.0\n[profiles]\n"
    )
    moved = []
    for rails in ('rail = "54E1"\nleft_rail = "60E1"', 'rail = "60E1"\nleft_rail = "54E1"'):
        (tmp_path / "s.toml").write_text(text + rails, encoding="utf-8")
        run = completed(VehicleRun(read_scenario(tmp_path / "s.toml")))
        moved.append(run.series["wheelset_lateral"])
        kinds = {key[1:]: histogram.profile.name for key, histogram in run.damage().items()}
        assert kinds["right", "rail"] != kinds["left", "rail"]
    assert np.abs(moved[0]).max() > 1e-6
    assert moved[0] == pytest.approx(-moved[1], abs=1e-9)


_HEAD = "distance,alignment,vertical,cross_level,gauge"


def test_a_measured_series_lies_beside_its_scenario_and_is_part_of_the_fingerprint(tmp_path):
    text = 'name = "s"\nlength = 40.0\nspeed = 20.0\nvehicle = "wheelset"\n[track]\nmeasured = "t.csv"\n'
    (tmp_path / "s.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ContactError, match="is no file beside it"):
        read_scenario(tmp_path / "s.toml")
    prints = []
    for value in (0, 1):
        (tmp_path / "t.csv").write_text(
            f"{_HEAD}\n" + "".join(f"{10 * s},{1e-3 * value},0,0,0\n" for s in range(5)), encoding="utf-8"
        )
        prints.append(read_scenario(tmp_path / "s.toml").fingerprint)
    assert prints[0] != prints[1]


def test_damage_does_not_depend_on_the_spacing_of_samples():
    """Before, one step in a quarter of a metre counted for all, and the worn volume was up to a fifth wrong."""

    def worn(spacing):
        run = completed(VehicleRun(scenario(length=12.0, recording=Recording(settling=1.0, spacing=spacing))))
        histograms = run.damage().values()
        distance = next(iter(histograms)).distance
        return run.energy / distance, sum(histogram.volume for histogram in histograms) / distance

    coarse, fine = worn(0.5), worn(0.05)
    assert coarse[0] == pytest.approx(fine[0], rel=0.02)
    assert coarse[1] == pytest.approx(fine[1], rel=0.02)


def test_damage_does_not_depend_on_the_pace():
    """A solution counts for the steps around it: .0037. Counted for those since the last solution, pace 4 lost .7 % here."""
    curve = Curve(start=10.0, radius=500.0, length=50.0, transition=10.0, cant=0.05)
    track = Track(curves=(curve,), alignment=Irregularities(spectrum="ERRI B176 high"))

    def worn(pace):
        run = completed(VehicleRun(scenario(length=80.0, track=track, methods=Methods(pace=pace))))
        return sum(histogram.volume for histogram in run.damage().values())

    assert worn(4) == pytest.approx(worn(1), rel=5e-3)


def test_means_lie_between_the_extremes_of_their_steps(whole):
    series = whole.series
    for force in ("lateral_force", "vertical_force"):
        least, mean, largest = (series[f"wheelset_right_{which}{force}"] for which in ("least_", "", "largest_"))
        assert np.all(least <= mean)
        assert np.all(mean <= largest)
        assert np.any(least < largest)


def test_the_error_of_the_step_is_that_of_halving_it(whole):
    error = whole.step_error
    half = completed(VehicleRun(scenario(recording=Recording(settling=1.0, spacing=0.25, step=0.5 * whole.step))))
    assert error.length == 6.0
    assert error.energy == pytest.approx(2.0 * (whole.energy / half.energy - 1.0), rel=1e-9)
    assert f"{100.0 * error.energy:+.2g} %" in error.sentence


def test_a_run_is_shown_with_its_largest_force_and_both_wheels(whole):
    text = words(whole._repr_html_())
    assert "short" in text
    largest = max(series.max() for name, series in whole.series.items() if name.endswith("largest_vertical_force"))
    assert f"{1e-3 * largest:.4g} kN, wheelset" in text
    lines = drawn(whole._repr_html_(), "polyline")
    assert len(lines) == 4  # Q and Y of both wheels
    assert all(np.ptp(line[:, 0]) == pytest.approx(260.0) for line in lines)


def test_a_run_is_shown_before_its_first_step():
    text = words(VehicleRun(scenario())._repr_html_())
    assert "of 6 m in 0 steps" in text


def test_a_simulation_shows_every_wheel(whole):
    shown = whole.simulation._repr_html_()
    for wheel in whole.simulation.wheels:
        assert f"{1e-3 * wheel['vertical']:.4g}" in words(shown)
    assert sum(element.tag.endswith("rect") for element in parsed(shown)) == 2


def test_lateral_forces_of_a_run_are_positive_outwards_on_both_wheels(whole):
    """Conical wheels push their rails outwards: the normal forces of both treads spread the track."""
    series = whole.series
    for side in ("right", "left"):
        assert series[f"wheelset_{side}_lateral_force"].mean() > 0.0
