"""Damage accumulated over a profile: a `Histogram` of a wheel or a rail, the worn profile, and files.

This package is not part of the solver. Its input are patches and their solutions.
"""

from contact.accumulation.files import from_xarray, load, save, to_xarray
from contact.accumulation.histogram import MAXIMA, SUMS, Histogram
from contact.accumulation.section import Section
from contact.accumulation.shape import worn_profile

__all__ = ["MAXIMA", "SUMS", "Histogram", "Section", "from_xarray", "load", "save", "to_xarray", "worn_profile"]
