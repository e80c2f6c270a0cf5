"""Damage that adds up over a profile: a `Histogram` of a wheel or a rail, the worn profile, files.

Nothing here is part of the solver: one patch and its solution come in, one histogram comes out.
"""

from contact.accumulation.files import from_xarray, load, save, to_xarray
from contact.accumulation.histogram import MAXIMA, SUMS, Histogram
from contact.accumulation.shape import worn_profile

__all__ = ["MAXIMA", "SUMS", "Histogram", "from_xarray", "load", "save", "to_xarray", "worn_profile"]
