"""The example of accumulated wear: it runs, and wheel and rail lose the same volume."""

import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("xarray")

from contact.accumulation import load
from examples.wheelset_wear import wear


def test_wheel_and_rail_wear_alike_and_the_files_hold_it(tmp_path):
    run = wear.run(2e-3, 0.1)
    assert run.wheel.distance == pytest.approx(0.1 * wear.SPEED, rel=1e-12)
    assert run.wheel.volume > 0.0
    assert run.wheel.volume == pytest.approx(run.rail.volume, rel=1e-12), "Archard's coefficient is that of both bodies"
    wear.draw({"2 mm": run}, tmp_path)
    assert load(tmp_path / "wheel.nc").volume == run.wheel.volume
    assert {path.name for path in tmp_path.glob("*.png")} == {
        *("wear_wheel.png", "wear_rail.png", "worn_wheel.png", "worn_rail.png", "shakedown.png")
    }
