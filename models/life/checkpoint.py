"""Arrays that survive a kill: written to a file beside, which then takes the name in one move."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError

_FINGERPRINT = "fingerprint"


def write(path: Path, fingerprint: str, arrays: Mapping[str, NDArray]) -> None:
    """Put `arrays` in the place of what is in `path`, all of them or none."""
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f"{path.name}.{os.getpid()}.part")
    stored: dict[str, Any] = {_FINGERPRINT: np.array(fingerprint), **arrays}  # savez has a keyword that is no array
    with open(beside, "wb") as file:
        np.savez(file, **stored)
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, path)


def read(path: Path, fingerprint: str) -> dict[str, NDArray] | None:
    """The arrays, or None when there is no such file.

    Raises
    ------
    ContactError
        If the file is no checkpoint, or that of another run: other input, profiles or version of this package.
    """
    if not path.exists():
        return None
    try:
        with np.load(path, allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
        found = str(arrays.pop(_FINGERPRINT))
    except (OSError, ValueError, KeyError, zipfile.BadZipFile) as error:
        raise ContactError(f"{path} is no checkpoint: {error}; --fresh starts anew") from None
    if found != fingerprint:
        raise ContactError(f"{path} is the checkpoint of another run; --fresh starts anew, --out takes another folder")
    return arrays
