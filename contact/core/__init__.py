"""The compiled core: how functions are marked as kernels, where the library of all kernels is, and how Python calls it."""

from contact.core.calls import Packed, Shape, entry, pack
from contact.core.marks import COMPILING, arranging, chosen_by, group, inlined, kernel, shared

__all__ = [
    "COMPILING",
    "Packed",
    "Shape",
    "arranging",
    "chosen_by",
    "entry",
    "group",
    "inlined",
    "kernel",
    "pack",
    "shared",
]
