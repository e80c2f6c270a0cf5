"""Input files of CONTACT: read, run, write and compare them (docs/use/from_contact.md)."""

from contact.inp.case import Case
from contact.inp.printed import Printed, read_printed
from contact.inp.read import read
from contact.inp.reasons import REASONS
from contact.inp.results import PatchResult, Result, table
from contact.inp.run import solve
from contact.inp.write import write

__all__ = ["REASONS", "Case", "PatchResult", "Printed", "Result", "read", "read_printed", "solve", "table", "write"]
