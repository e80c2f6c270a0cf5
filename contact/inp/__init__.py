"""Input files of CONTACT: read, run, write and compare them (docs/use/from_contact.md)."""

from contact.inp.case import Case
from contact.inp.printed import Printed, read_printed
from contact.inp.read import read
from contact.inp.write import write

__all__ = ["Case", "Printed", "read", "read_printed", "write"]
