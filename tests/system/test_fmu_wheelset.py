"""The FMU `Wheelset` through the C interface of FMI: a vehicle that asks two pairs."""

import numpy as np
from fmu_instance import DISCARD, refused
from wheelset_case import inputs, trajectory

from contact_models.vehicle.coupling import ANSWER, QUESTION, OpenVehicle
from contact_models.vehicle.kernels.layout import Axis
from contact_models.wheelset.system import scenario, simulation

NAME = "Wheelset"


def reported(opened: OpenVehicle, whole) -> dict[str, float]:
    """Return the outputs of the FMU from the vehicle in Python."""
    asked = opened.ask()
    rows = {f"wheel[{w}].{name}": v for w, row in enumerate(asked, 1) for name, v in zip(QUESTION, row, strict=True)}
    rows |= {f"body[{i}].{axis.name.lower()}": row[axis] for i, row in enumerate(whole.state.q, 1) for axis in Axis}
    return {**rows, "distance": whole.distance}


def test_equals_the_vehicle_in_python_bit_by_bit(opened):
    fmu, whole = opened(NAME).initialize(), simulation(scenario())
    ours = OpenVehicle(whole)
    assert fmu.all("output") == reported(ours, whole)
    for k, row in enumerate(trajectory(fmu, 0)):
        answers = np.zeros((2, len(ANSWER)))
        for wheel in range(2):
            for column, name in enumerate(list(ANSWER)[:6]):
                answers[wheel, column] = inputs(k)[f"wheel[{wheel + 1}].{name}"]
        ours.move(answers, 1e-3)
        assert row == reported(ours, whole)
    assert row["body[2].y"] != fmu["initial.y[1]"]


def test_a_start_off_the_track_is_discarded_with_its_reason(opened):
    fmu = opened(NAME)
    fmu.update({"initial.distance": 2e4})
    refused(fmu.initialize, DISCARD)
    assert "initial.distance is not on it" in fmu.log[-1][1]


def test_its_outputs_connect_to_the_inputs_of_a_pair(opened):
    fmu, pair = opened(NAME), opened("WheelRailPair")
    for name in QUESTION:
        ours, theirs = fmu.variables[f"wheel[1].{name}"], pair.variables[name]
        assert (ours.causality, theirs.causality, ours.unit) == ("output", "input", theirs.unit)
    for name in list(ANSWER)[:6]:
        ours, theirs = fmu.variables[f"wheel[1].{name}"], pair.variables[name]
        assert (ours.causality, theirs.causality, ours.unit) == ("input", "output", theirs.unit)
