"""Published cases agree within the bounds that docs/proof.md states."""

import pytest

from benchmarks.proof import twin_disc
from benchmarks.proof.__main__ import DOCS, page


@pytest.mark.parametrize("row", twin_disc.rows())
def test_flash_temperature_of_twin_discs_is_up_to_a_fifth_above_the_published_one(row):
    _, _, published, ours = row
    assert 1.05 < ours / published < 1.2


def test_the_page_has_the_numbers_of_the_code():
    assert (DOCS / "proof.md").read_text(encoding="utf-8") == page()
