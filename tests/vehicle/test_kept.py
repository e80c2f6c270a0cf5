"""What belongs to a vehicle is computed once and read from the cache folder after that, with the same bits."""

import math

import numpy as np
import pytest

from contact.geometry import profile
from contact_models.runs import kept, scenario, stability
from contact_models.runs.run import VehicleRun
from contact_models.vehicle import hunting

PROFILES = (profile.s1002(), profile.rail_60e1())


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "cache_folder", lambda: tmp_path / "cache")
    return tmp_path / "cache" / kept.FOLDER


def counted(results):
    """Return a function that gives one result after the other."""
    left = list(results)
    return lambda: left.pop(0)


def test_a_result_is_computed_once_for_each_input(folder):
    compute = counted([[1.0, math.inf], [2.0], [3.0], [4.0]])
    for _ in range(2):
        assert kept.kept("x", (1.0, "a"), PROFILES, compute) == [1.0, math.inf]
    assert kept.kept("x", (1.0, "b"), PROFILES, compute) == [2.0]
    assert kept.kept("y", (1.0, "a"), PROFILES, compute) == [3.0]
    assert kept.kept("x", (1.0, "a"), PROFILES[:1], compute) == [4.0]
    assert len(list(folder.glob("*.json"))) == 4


def test_a_damaged_file_is_computed_anew(folder):
    compute = counted([[1.5], [2.5]])
    kept.kept("x", (), PROFILES, compute)
    (file,) = folder.glob("*.json")
    file.write_text("[1.", encoding="utf-8")
    assert kept.kept("x", (), PROFILES, compute) == [2.5]


def test_a_folder_that_cannot_be_written_costs_time_only(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setattr(kept, "cache_folder", lambda: tmp_path / "file")
    assert kept.kept("x", (), PROFILES, counted([[1.0]])) == [1.0]


def test_only_the_latest_files_stay(folder, monkeypatch):
    monkeypatch.setattr(kept, "_MOST", 2)
    for k in range(4):
        kept.kept("x", (k,), PROFILES, lambda: 0.0)
    assert len(list(folder.glob("*.json"))) == 2


@pytest.mark.usefixtures("folder")
def test_a_second_run_of_a_vehicle_reads_both_critical_speeds(tmp_path, monkeypatch):
    calls = []
    file = tmp_path / "s.toml"
    methods = '[methods]\nnormal = "analyn"\ntangential = "fastrip"'
    file.write_text(f'name = "s"\nlength = 40.0\nspeed = 20.0\n{methods}\n', encoding="utf-8")

    def fallen(*args, **kwargs):
        calls.append(kwargs["step"])
        return hunting.Hunting(np.array([30.0, 20.1]), np.array([4e-3, 1e-4]), 25.3)

    monkeypatch.setattr(stability, "fall", fallen)
    monkeypatch.setattr(stability.linear, "critical_speed", lambda *a, **k: calls.append("linear") or 24.2)
    found = [VehicleRun(scenario.read(file)).stability for _ in range(2)]
    for one in found:
        assert (one.critical_speed, one.limit_cycle.critical) == (24.2, 25.3)
        assert one.limit_cycle.speed.tolist() == [30.0, 20.1]
    assert len(calls) == 2
