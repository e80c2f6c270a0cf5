"""Methods side by side: on single cases, on thousands, and on the benchmarks of the literature. No kernel imports this.

`contact.study.statistics` and `contact.study.manchester` are imported by those who want them: they take their time.
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
