"""Threads that share the contacts of a vehicle."""

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Axis
from contact_models.vehicle.simulation import ContactOptions, Simulation
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from tests.vehicle.parts import FAST, PACED

ROUGH = Track(
    curves=(Curve(start=0.0, radius=300.0, length=1e3, transition=5.0),),
    alignment=Irregularities(spectrum="ERRI B176 low"),
)
STEP = 4e-4


def shared(threads: int, options: ContactOptions = FAST) -> Simulation:
    rows = lay(ROUGH, 60.0, lambda s: 15.0, (1,), 1.0)
    return Simulation(read("manchester"), rows, profile.s1002(), profile.rail_60e1(), 0.3, options, threads=threads)


@pytest.mark.parametrize("options", [FAST, PACED], ids=["every step", "paced"])
def test_no_bit_of_a_run_depends_on_the_number_of_threads(options):
    alone = shared(1, options)
    alone.advance(STEP, 1000)
    for threads in (2, 3, 8):
        together = shared(threads, options)
        for steps in (1, 0, 399, 600):  # they are called again and again
            together.advance(STEP, steps)
        for name, array in alone.kept.items():
            np.testing.assert_array_equal(together.kept[name], array, err_msg=name)
        np.testing.assert_array_equal(together.wheels, alone.wheels)


def test_a_wheel_that_leaves_its_rail_ends_all_threads_with_the_same_message():
    said = []
    for threads in (1, 2):
        run = shared(threads)
        run.advance(STEP, 10)
        run.state.q[run.model.wheelsets[1], Axis.Y] = 0.2
        with pytest.raises(ContactError, match="has left its rail") as error:
            run.advance(STEP, 10)
        said.append(str(error.value))
    assert said[0] == said[1]
