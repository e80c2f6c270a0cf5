"""After a step that a native FMU discards, fmpy ends its run."""

import fmpy
import numpy as np
import pytest

#: FMU → an input or a tunable parameter, a valid value, and one that it refuses.
REFUSED = {
    "WheelRailPair": ("pose.yaw", 0.0, 0.5),
    "Vehicle": ("speed", 15.0, 1000.0),
}


@pytest.mark.parametrize("name", REFUSED)
@pytest.mark.filterwarnings("ignore")
def test_fmpy_ends_the_run_at_the_time_of_the_refused_value(native, native_vehicles, name):
    """It asks whether the FMU is terminated. An FMU that said no would be asked to repeat the step for ever."""
    variable, good, bad = REFUSED[name]
    folder = native_vehicles if name == "Vehicle" else native.parent
    given = np.array([(0.0, good), (4.5e-3, good), (5e-3, bad), (1.0, bad)], dtype=[("time", float), (variable, float)])
    result = fmpy.simulate_fmu(
        str(folder / f"{name}.fmu"),
        stop_time=0.02,
        output_interval=1e-3,
        input=given,
        fmi_type="CoSimulation",
        timeout=60,
    )
    assert len(result) < 10
    assert 4e-3 < result["time"][-1] < 7e-3
