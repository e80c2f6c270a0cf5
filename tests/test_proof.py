"""Published cases agree within the bounds that docs/proof.md states."""

from pathlib import Path

import pytest

from reference import twin_disc

PAGE = Path(__file__).resolve().parents[1] / "docs" / "proof.md"


@pytest.mark.parametrize("row", twin_disc.rows())
def test_flash_temperature_of_twin_discs_is_a_tenth_to_a_fifth_above_the_published_one(row):
    _, _, published, ours = row
    assert 1.09 < ours / published < 1.21


@pytest.mark.parametrize("row", twin_disc.rows())
def test_the_page_has_the_temperature_that_is_computed(row):
    slip, heat, published, ours = row
    assert f"| {slip:g} | {heat:g} | {published:g} | {ours:.3g} |" in PAGE.read_text(encoding="utf-8")
