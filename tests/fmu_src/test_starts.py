"""The FMUs of a vehicle start as their scenario says."""

from dataclasses import fields
from pathlib import Path

import pytest

from contact.errors import ContactError
from contact.friction import Friction
from contact.inputs.material import Thermal
from contact_fmu import starts
from contact_fmu.catalogue import models, vehicles
from contact_fmu.tables import open_vehicle, vehicle
from contact_fmu.tables.wheel_rail_contact import POINTS
from contact_models.runs import scenario
from contact_models.runs.scenario import Methods

#: Every number of friction differs from its default.
FRICTION = {
    "static": 0.35, "kinetic": 0.2, "half_speed": 2.0, "law": "exponential", "slope": 0.8, "slope_far": 0.5,
    "slope_rate": 2.0, "velocity": "local", "gauge_factor": 0.5, "border": -0.01, "border_width": 0.004, "k_A": 0.9,
    "k_S": 0.7, "hot_factor": 0.6, "reference_temperature": 300.0, "temperature_range": 350.0,
    "background_temperature": 305.0,
}  # fmt: skip
THERMAL = {"conductivity": 45.0, "density": 7900.0, "heat_capacity": 470.0, "heat_share": 0.5}
METHODS = {"normal": "analyn", "tangential": "fastrip", "strips": 24, "elements": 16, "pressure_limit": 2e9, "pace": 2}
ROW = {
    "normal": "method.normal", "tangential": "method.tangential", "strips": "resolution.n_strips",
    "elements": "resolution.n_elements", "pressure_limit": "material.pressure_limit", "pace": "resolution.pace",
}  # fmt: skip
HEAD = 'name = "s"\nvehicle = "{}"\nlength = 100.0\nspeed = 20.0\n'


def toml(table: dict) -> str:
    return "".join(f"{key} = {value!r}\n".replace("'", '"') for key, value in table.items())


def built(tmp_path: Path, more: str = "", of: str = "manchester"):
    """Return the starts of both FMUs of a scenario, by the names of the rows."""
    path = tmp_path / "s.toml"
    path.write_text(HEAD.format(of) + more)
    found = vehicles(path, starts.profiles(scenario.read(path)))
    return [{row.name: row.start for row in model.table.rows} for model in found]


@pytest.mark.parametrize("of", ["manchester", "wheelset"])
def test_both_fmus_start_at_the_speed_and_friction_of_the_scenario(tmp_path, of):
    for rows in built(tmp_path, "friction = 0.35\n", of):
        assert (rows["speed"], rows["friction.coefficient"]) == (20.0, 0.35)


def test_what_a_scenario_can_set_of_the_vehicle_fmu_is_its_start(tmp_path):
    assert FRICTION.keys() == {one.name for one in fields(Friction)} - {"thermal"}
    assert THERMAL.keys() == {one.name for one in fields(Thermal)}
    assert METHODS.keys() == {one.name for one in fields(Methods)}
    friction = f"[friction]\n{toml(FRICTION)}[friction.thermal]\n{toml(THERMAL)}"
    rows, _ = built(tmp_path, f"{friction}[methods]\n{toml(METHODS)}[recording]\nstep = 3e-4\n")
    defaults = {row.name: row.start for row in vehicle.table("manchester").rows}
    for name, value in FRICTION.items():
        row = {"static": "friction.coefficient"}.get(name, f"friction.{name}")
        assert str(rows[row]).lower() == str(value), name
        assert rows[row] != defaults[row], name
    assert {name: rows[f"thermal.{name}"] for name in THERMAL} == THERMAL
    assert {name: rows[row] for name, row in ROW.items()} == METHODS
    assert rows["resolution.step"] == 3e-4


def test_what_a_scenario_does_not_set_keeps_its_start(tmp_path):
    rows, alone = built(tmp_path)
    of_scenario = {"speed", "friction.coefficient"}
    same = {row.name: row.start for row in vehicle.table("manchester").rows}
    assert {name for name in rows if rows[name] != same[name]} <= of_scenario
    same = {row.name: row.start for row in open_vehicle.table("manchester").rows}
    found = {name for name in alone if alone[name] != same[name]}
    at_first = {f"initial.{name}" for name in ("y", "z", "roll", "radius")}
    assert found == {"speed", "rail.origin_y", "rail.origin_z"} | at_first


def test_the_fmus_have_the_profiles_of_the_scenario(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(HEAD.format("manchester") + '[profiles]\nrail = "60E2"\n')
    given = starts.profiles(scenario.read(path))
    whole, _ = vehicles(path, given)
    plain, _ = vehicles(path)
    assert whole.resources["wheel.profile"] == plain.resources["wheel.profile"]
    assert whole.resources["rail.profile"] != plain.resources["rail.profile"]
    pair = next(model for model in models(POINTS, given) if model.declared == "pair")
    assert whole.resources["rail.profile"] == pair.resources["rail.profile"]  # the system of both is of one profile
    path.write_text(HEAD.format("manchester"))
    assert starts.profiles(scenario.read(path)) == {}


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ("[[torque]]\nat = [0.0]\nvalues = [100.0]\n", "no torques of axles"),
        ('[profiles]\nleft_rail = "54E1"\n', "one profile of both rails"),
    ],
)
def test_what_the_fmus_have_not_is_refused(tmp_path, more, message):
    with pytest.raises(ContactError, match=message):
        built(tmp_path, more)


def test_other_constants_of_damage_are_told(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(HEAD.format("manchester"))
    assert starts.left_out(scenario.read(path)) == []
    path.write_text(HEAD.format("manchester") + "[damage]\nrail_wear = 2.0\n")
    assert "damage" in starts.left_out(scenario.read(path))[0]
