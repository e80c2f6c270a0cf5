"""A vehicle without contacts, coupled to eight native FMUs `WheelRailPair`: the proof that any multibody model can use them."""

from contextlib import ExitStack

import pytest

from contact_models.vehicle.simulation import ContactOptions
from examples.coupled_vehicle.coupled import coupled, difference, fmu_contacts, in_one_kernel

STEP, SAMPLES = 2e-4, 30


@pytest.mark.parametrize(
    ("options", "y", "force"),
    [
        (ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12, pace=1), 1e-12, 1e-6),
        (ContactOptions(pace=1), 1e-8, 20.0),  # the iteration of the normal problem ends at 1e-4
    ],
    ids=["analyn", "default"],
)
def test_eight_fmus_in_model_exchange_give_the_run_of_the_one_kernel(native, options, y, force):
    """In co-simulation they are those of coupled_vehicle.ssp (`test_fmu_vehicle.py`)."""
    fmu = native.with_name("WheelRailPair.fmu")
    whole = in_one_kernel(options, STEP, SAMPLES)
    with ExitStack() as stack:
        contacts = fmu_contacts(stack, fmu, options, exchange=True)
        found = difference(whole, coupled(contacts, options, STEP, SAMPLES))
    assert found[0] <= y
    assert found[1] <= force
