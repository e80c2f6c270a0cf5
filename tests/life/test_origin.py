"""A report says what it was computed from: version, date, hashes of all files, and the scenarios of a study."""

import hashlib
import re
from importlib.metadata import version

import numpy as np
import pytest

from contact_models.life import declared_set, wear_report
from contact_models.life.scale import Workers
from contact_models.life.wear import Life
from contact_models.runs import scenario
from contact_models.runs.origin import hashed, origin
from contact_models.vehicle import declared
from tests.life.short_set import written


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_every_file_of_a_scenario_has_its_hash(tmp_path):
    (tmp_path / "t.csv").write_text(
        "distance,alignment,vertical,cross_level,gauge\n" + "".join(f"{10 * s},0,0,0,0\n" for s in range(6)),
        encoding="utf-8",
    )
    path = tmp_path / "s.toml"
    path.write_text('name = "s"\nlength = 40.0\nspeed = 20.0\n[track]\nmeasured = "t.csv"\n', encoding="utf-8")
    vehicle = declared.find("wheelset")
    expected = {("s.toml", digest(path)), ("t.csv", digest(tmp_path / "t.csv")), ("wheelset.toml", digest(vehicle))}
    assert set(scenario.read(path).files) == expected


def test_the_table_has_version_date_and_hashes(tmp_path):
    (tmp_path / "a").write_text("a", encoding="utf-8")
    rows = dict(origin(hashed([tmp_path / "a", tmp_path / "a", tmp_path / "none"])).rows)
    assert rows["wheelrail-contact"] == version("wheelrail-contact")
    assert re.fullmatch(r"20\d\d-\d\d-\d\d \(UTC\)", rows["date"])
    assert rows["a"] == f"SHA-256 {digest(tmp_path / 'a')}"
    assert len(rows) == 3


@pytest.mark.slow
def test_a_study_tells_its_scenarios_and_the_wear_number_of_each_wheel(tmp_path, monkeypatch):
    monkeypatch.setattr(wear_report, "illustrated", lambda draw, text: "")
    path = written(tmp_path)
    life = Life(declared_set.read(path))
    with Workers() as pool:
        life.step(pool, go_on=True)
    page = wear_report.page_of(life)
    assert digest(path) in page
    for share in life.plan.declared.scenarios:
        assert digest(path.parent / share.file) in page
        assert share.file in page
    for wheel in life.wheels.values():
        assert wheel["T_gamma"][-1] > 0.0
    assert any("T-gamma" in name for name in wear_report._panels(life))
    assert np.isfinite(wear_report._of_steps(next(iter(life.wheels.values())))).all()
