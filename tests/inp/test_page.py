"""The page "If you come from CONTACT" has the table of digits of the format."""

from pathlib import Path

from contact.inp.controls import WORDS
from contact.inp.digits import digit_table
from contact.inp.reasons import REASONS, REFUSED, REFUSED_ON_GRID

PAGE = Path(__file__).parents[2] / "docs" / "use" / "from_contact.md"


def test_the_page_has_the_table_of_digits_of_the_format():
    text = PAGE.read_text(encoding="utf-8")
    assert f"<!-- digits -->\n{digit_table()}<!-- end of digits -->" in text


def test_every_refused_digit_is_one_of_the_format_with_a_named_reason():
    digits = {digit.letter: digit for word in WORDS for digit in word}
    for table in (REFUSED, REFUSED_ON_GRID):
        for module, letters in table.items():
            for letter, values in letters.items():
                assert set(values) <= set(digits[letter].values(module))
                assert set(values.values()) <= set(REASONS)
