"""Published cases agree within the bounds that docs/check/proof.md states."""

from pathlib import Path

import pytest

import contact
from contact.inputs.material import Thermal
from reference import roller_rig, traction, twin_disc

PAGE = Path(__file__).resolve().parents[1] / "docs" / "check" / "proof.md"


@pytest.mark.parametrize("row", twin_disc.rows())
def test_flash_temperature_of_twin_discs_is_a_tenth_to_a_fifth_above_the_published_one(row):
    _, _, published, ours = row
    assert 1.09 < ours / published < 1.21


@pytest.mark.parametrize("row", twin_disc.rows())
def test_the_page_has_the_temperature_that_is_computed(row):
    slip, heat, published, ours = row
    assert f"| {slip:g} | {heat:g} | {published:g} | {ours:.3g} |" in PAGE.read_text(encoding="utf-8")


@pytest.mark.filterwarnings("ignore::contact.errors.PlausibilityWarning")
@pytest.mark.parametrize("law", traction.FORCES)
def test_traction_of_a_locomotive_wheel_is_that_of_contact(law):
    """Its heat is CONTACT's, which is 11 % too much."""
    assert traction.forces(traction.FITTED)[law] == pytest.approx(traction.FORCES[law], rel=0.016)
    assert traction.forces(Thermal())[law] == pytest.approx(traction.FORCES[law], rel=0.06)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::contact.errors.PlausibilityWarning")
def test_contact_counts_the_heat_of_an_element_twice():
    """With its count and its elements all digits of its rises follow from the constants of its input; 11 % less without."""
    assert [float(f"{rise:.3g}") for rise in traction.counted_twice()][1:] == list(traction.RISES[1:])
    assert traction.counted_twice()[0] == pytest.approx(traction.RISES[0], abs=0.05)
    assert traction.rises(Thermal())[1:] == pytest.approx(traction.RISES[1:], rel=0.12)
    assert traction.rises(Thermal())[3] < 0.9 * traction.RISES[3]


@pytest.mark.slow
@pytest.mark.parametrize("case", roller_rig.CASES)
def test_a_roller_rig_with_measured_profiles_and_a_layer_has_the_forces_of_contact(case):
    pytest.importorskip("scipy")
    found = roller_rig.solved(case)
    bound = roller_rig.FRICTION * case.N
    assert [-found.Fx, -found.Fy] == pytest.approx([case.Fx, case.Fs], abs=1.2e-3 * bound)
    assert -1e3 * found.Mz == pytest.approx(case.Mn, rel=0.015)
    assert 1e3 * found.approach == pytest.approx(case.approach, rel=0.006)
    assert 1e-6 * found.max_pressure == pytest.approx(case.largest, rel=0.018)


def test_the_layer_of_the_roller_rig_is_felt():
    """Without it the force is not CONTACT's: the case tests the layer."""
    pytest.importorskip("scipy")
    case = roller_rig.CASES[1]
    longitudinal, lateral, spin = case.creepages
    bare = contact.solve(
        roller_rig.separation(case), contact.Creepage(-longitudinal, -lateral, -1e3 * spin), load=case.N,
        friction=roller_rig.FRICTION, normal="halfspace", tangential="halfspace", spacing=0.4e-3,
    )  # fmt: skip
    assert abs(-bare.Fy - case.Fs) > 0.02 * roller_rig.FRICTION * case.N


def test_the_summary_is_on_the_page():
    assert (PAGE.parent / "proof" / "summary.txt").read_text(encoding="utf-8") in PAGE.read_text(encoding="utf-8")
