"""Warnings of runs and of wear studies: nothing wrong passes without a word."""

from dataclasses import replace

import pytest
import typer
from typer.testing import CliRunner

from contact.errors import ContactError
from contact_models.life import declared_set
from contact_models.life.declared_set import Steps
from contact_models.life.scale import Workers
from contact_models.life.wear import Life
from contact_models.runs import commands, report, result, scenario
from contact_models.runs.run import VehicleRun
from contact_models.runs.trust import TRUST, StepError, worst
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.kernels.wheels import count
from tests.life.short_set import written
from tests.life.trusts import BAD, GOOD
from tests.vehicle.parts import completed


def test_a_good_run_has_no_warning_and_a_bad_one_names_every_fault():
    assert GOOD.warnings == ()
    said = " ".join(BAD.warnings)
    for text in ("-49 %", "7 contacts", "2 times", "3 times", "1.2 times the linear critical speed"):
        assert text in said
    assert "end of 1 of its curves" in said


def test_seizure_and_wear_that_no_wheel_in_service_has_are_named_with_a_cure():
    said = replace(GOOD, seizure=0.34, deepest_rate=1.3e-7, wear_law="archard").warnings
    assert len(said) == 2
    for text in ("seizure at 34 %", "130 µm in a kilometre", "a millimetre in 7.69 km"):
        assert text in " ".join(said)
    assert all("Cures" in sentence and "usfd" in sentence for sentence in said)


def test_a_large_error_of_the_step_is_told_with_the_step_that_cures_it():
    assert StepError(0.01, -0.02, 40.0).sentence.endswith("over the first 40 m.")
    assert "set recording.step to 0.4 times the step" in StepError(-0.03, -0.05, 40.0).sentence


def test_a_law_is_not_advised_to_who_uses_it():
    (said,) = replace(GOOD, deepest_rate=1.3e-7, wear_law="usfd").warnings
    assert "wear_law" not in said
    assert "Archard" not in said
    assert "less friction" in said


def test_a_run_with_elastic_pressures_and_archards_law_tells_its_seizure(tmp_path):
    """Pressures of 60 kN on a conical wheel stay below .8 of the hardness; with a hardness of 1 GPa they do not."""
    path = written(tmp_path).parent / "straight.toml"
    shares = []
    for ratio in (0.8, 0.3):
        text = path.read_text(encoding="utf-8").split("[damage.archard]")[0]
        path.write_text(f"{text}[damage.archard]\nseizure_ratio = {ratio}\n", encoding="utf-8")
        run = completed(VehicleRun(scenario.read(path)))
        shares.append(run.trust.seizure)
    assert shares == [0.0, 1.0]


@pytest.mark.usefixtures("undrawn")
def test_a_run_that_is_shorter_than_its_curve_says_so(tmp_path):
    folder = written(tmp_path).parent
    straight, curve = (VehicleRun(scenario.read(folder / f"{name}.toml")) for name in ("straight", "curve"))
    assert (straight.trust.unfinished, curve.trust.unfinished) == (0.0, 1.0)
    (said,) = (text for text in curve.trust.warnings if "curves" in text)
    assert said in report.page_of(curve)


def test_the_worst_of_several_runs_keeps_the_largest_residual_and_adds_the_counts():
    both = worst([GOOD, BAD])
    assert (both.residual, both.lifted, both.speed_ratio) == (-0.49, 2.0, 1.2)


@pytest.fixture(scope="module")
def lossy(tmp_path_factory) -> VehicleRun:
    """A run whose books say that half of the energy is lost and a wheel has lifted."""
    run = completed(VehicleRun(scenario.read(written(tmp_path_factory.mktemp("lossy")).parent / "straight.toml")))
    books = run.simulation.state.books
    books[Book.RESIDUAL] = 0.5 * books[Book.DISSIPATED]
    books[Book.LIFTED] = 1
    for row in run._rows[::2]:
        for what in ("vertical_force", "lateral_force"):
            row[list(run.columns).index(f"wheelset_right_{what}")] = 0.0
    return run


@pytest.mark.usefixtures("undrawn")
def test_result_and_report_say_that_the_energy_does_not_close(lossy):
    stored = result.dataset(lossy).attrs
    assert abs(stored["trust_residual"]) > 0.02
    assert "does not close" in stored["warnings"]
    page = report.page_of(lossy)
    assert "The balance of energy does not close" in page
    assert "nan" not in page.split("<picture>")[0]


def test_a_wear_study_stops_where_the_energy_does_not_close_unless_told_to_go_on(tmp_path, monkeypatch):
    monkeypatch.setattr(VehicleRun, "trust", BAD)
    life = Life(declared_set.read(written(tmp_path)))
    with Workers() as pool:
        with pytest.raises(ContactError, match=r"step 1, straight: The balance of energy does not close: -49 %"):
            life.step(pool)
        assert life.mileage == 0.0
        life.step(pool, go_on=True)
    assert life["residual"][-1] == -0.49
    assert life["lifted"][-1] == 4.0
    assert "does not close" in life.trust.warnings[0]


def test_a_study_whose_steps_become_too_short_stops_with_the_reason():
    steps = Steps(distance=1e7, depth=5e-5)
    assert steps.length(4.9e-10, 1e9) == pytest.approx(1.02e5, rel=1e-3)
    with pytest.raises(ContactError, match=r"10000 km would wear off 5.1e\+03 µm .* allows 98 km, below 1 % of it"):
        steps.length(5.1e-10, 1e9)


def test_no_critical_speed_is_not_told_as_a_ratio_of_zero():
    """A hollow wheel is unstable at some amplitude, though no small motion grows up to 150 m/s."""
    told = dict(replace(GOOD, speed_ratio=0.0).told())
    assert told[TRUST["speed_ratio"].meaning].startswith("none up to 150 m/s")
    assert dict(GOOD.told())[TRUST["speed_ratio"].meaning] == "0.5000"


def test_ctrl_c_names_a_checkpoint_only_if_there_is_one(tmp_path, monkeypatch):
    app = typer.Typer(pretty_exceptions_enable=False)
    app.command()(commands.run)
    case = written(tmp_path).parent / "straight.toml"

    def interrupted(self: VehicleRun) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(VehicleRun, "advance", interrupted)
    ended = CliRunner().invoke(app, [str(case), "--out", str(tmp_path / "out")])
    assert ended.exit_code == 130
    assert "there is no checkpoint yet" in ended.output


def test_impacts_and_lifted_wheels_are_counted_when_they_begin(lossy):
    simulation = lossy.simulation
    books, wheels = simulation.state.books, simulation.wheels
    before = books[Book.IMPACTS], books[Book.LIFTED]
    for load in (1e5, 1.2e5, 1.3e5, 0.0, 0.0, 1.2e5):
        wheels["normal"][0] = load
        count(simulation.model, simulation.state, wheels, 2.0)
    assert (books[Book.IMPACTS] - before[0], books[Book.LIFTED] - before[1]) == (2.0, 1.0)
