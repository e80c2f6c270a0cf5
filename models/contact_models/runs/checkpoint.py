"""Checkpoints that survive a kill: arrays are written to a second file, which then replaces the first in one operation."""

from __future__ import annotations

import os
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError

#: Names of two entries beside the arrays. A damaged archive may list fewer arrays than it holds.
_FINGERPRINT, _NAMES = "fingerprint", "names of arrays"
#: What reading a damaged archive raises.
_DAMAGED = (
    *(OSError, ValueError, KeyError, EOFError, NotImplementedError, RuntimeError, SyntaxError, MemoryError),
    *(OverflowError, TypeError, zipfile.BadZipFile, struct.error, zlib.error, tokenize.TokenError),
)


def write(path: Path, fingerprint: str, arrays: Mapping[str, NDArray]) -> None:
    """Replace the content of `path` by `arrays`, completely or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f"{path.name}.{os.getpid()}.part")
    stored: dict[str, Any] = {
        _FINGERPRINT: np.array(fingerprint),
        _NAMES: np.array(sorted(arrays), dtype=str),
        **arrays,
    }  # Any, because savez has a bool keyword too
    with open(beside, "wb") as file:
        np.savez(file, **stored)
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, path)


def read(path: Path, fingerprint: str, fresh: bool = False) -> dict[str, NDArray] | None:
    """Return the arrays, or None if there is no such file. `fresh` removes the file.

    Raises
    ------
    ContactError
        If the file is not a checkpoint, or belongs to a run with other input, profiles or version of this package.
    """
    if fresh:
        path.unlink(missing_ok=True)
    if not path.exists():
        return None
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
        found = str(arrays.pop(_FINGERPRINT))
        if sorted(arrays.keys() - {_NAMES}) != arrays.pop(_NAMES).tolist():
            raise ValueError("arrays are missing")
    except _DAMAGED as error:
        raise ContactError(f"{path} is not a checkpoint: {error}; --fresh ignores it") from None
    if found != fingerprint:
        raise ContactError(f"{path} is the checkpoint of another run; --fresh ignores it, --out sets another folder")
    return arrays
