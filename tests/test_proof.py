"""Published cases agree within the bounds that docs/check/proof.md states."""

from pathlib import Path

import pytest

from contact.material import Thermal
from reference import traction, twin_disc

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
    """The thermal constant is fitted to one rise of temperature, not to a force."""
    assert traction.forces(traction.FITTED)[law] == pytest.approx(traction.FORCES[law], rel=0.016)
    assert traction.forces(Thermal())[law] == pytest.approx(traction.FORCES[law], rel=0.06)


@pytest.mark.filterwarnings("ignore::contact.errors.PlausibilityWarning")
def test_one_thermal_constant_explains_all_rises_of_temperature():
    assert traction.rises(traction.FITTED) == pytest.approx(traction.RISES, rel=0.03)
    assert traction.rises(traction.FITTED)[1:] == pytest.approx(traction.RISES[1:], rel=0.003)
