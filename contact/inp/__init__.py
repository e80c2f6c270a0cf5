"""Input files of CONTACT: read, run, write and compare them (docs/use/from_contact.md)."""

from contact.inp.case import Case
from contact.inp.compare import Difference, compare, worst_of
from contact.inp.elements import write_elements
from contact.inp.printed import Printed, read_printed
from contact.inp.read import read
from contact.inp.reasons import REASONS
from contact.inp.results import PatchResult, Result, table
from contact.inp.run import chains_of, refusals, solve
from contact.inp.write import write

__all__ = [
    "REASONS",
    "Case",
    "Difference",
    "PatchResult",
    "Printed",
    "Result",
    "chains_of",
    "compare",
    "read",
    "read_printed",
    "refusals",
    "solve",
    "table",
    "worst_of",
    "write",
    "write_elements",
]
