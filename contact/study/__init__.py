"""Comparison of methods: on single cases, on thousands of cases, and on benchmarks of the literature.

No kernel imports this package. Import `contact.study.statistics` and `contact.study.manchester` explicitly, because their
import takes time.
"""

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
