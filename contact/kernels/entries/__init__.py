"""What C calls: one short function for each entry of the library, over C types alone.

`ENTRIES` says for each entry its function, the type of its result and those of its arguments: ``i64``, ``f64`` and ``ptr``,
a pointer to float64. Every function has one more argument, `given`, with `given.data`, the pointers to `tables.data`.
The functions get valid arguments only: the files of `contact/c` check them.
"""

from __future__ import annotations

from contact.kernels.entries.layout import Entries


def all_entries() -> Entries:
    """Return the entries of all modules."""
    from contact.kernels.entries import pair, patch, stress, surfaces

    return {**patch.ENTRIES, **pair.ENTRIES, **surfaces.ENTRIES, **stress.ENTRIES}
