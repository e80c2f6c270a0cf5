"""The example of a holistic study: conditions for every case, and a complete grid."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("xarray")

from contact_models.life.scale import Workers
from examples.holistic_study import study


def test_small_study_is_whole_and_obeys_friction():
    with Workers() as pool:
        found = study.study(2, 3, pool)
    assert found.attrs["contacts"] == len(study.PAIRS) * 2 * study.LOADS.size * study.FRICTION.size * 9
    assert int(found["untrusted"].sum()) == 0
    assert (found["utilisation"] <= found["friction"] * (1.0 + 1e-9)).all()
    assert (found["T_gamma"].diff("friction") > 0.0).all()
    pressure = found["max_pressure"].transpose(..., "load", "friction").values
    assert np.ptp(pressure, axis=-1).max() == 0.0, "friction does not change the pressure"
    assert (np.diff(pressure, axis=-2) > 0.0).all()
    assert len(study.draw(found).axes) == 3
