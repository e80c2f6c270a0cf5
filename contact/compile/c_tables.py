"""Constant arrays that the entries read. The builder puts them into the library. No kernel: this module may read files."""

from __future__ import annotations

import numpy as np

from contact.theory import force_table, kalker, strips

#: How many they are.
NUMBER = 4


def data() -> tuple[np.ndarray, ...]:
    """Return Kalker's coefficients, the influence of strips on the centre line, that off it, and the table of creep forces."""
    return kalker.published(), *strips.tables(), force_table.load()
