"""Comparison of methods on cases, and look-up tables. No kernel imports this package."""

from contact.study.case import Case
from contact.study.compare import compare
from contact.study.comparison import Comparison
from contact.study.errors import Errors
from contact.study.pairs import REFERENCE, SELECTION, Pair, every_pair, pairs_of
from contact.study.row import Row

__all__ = [
    "REFERENCE",
    "SELECTION",
    "Case",
    "Comparison",
    "Errors",
    "Pair",
    "Row",
    "compare",
    "every_pair",
    "pairs_of",
]
