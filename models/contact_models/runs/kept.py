"""What belongs to a vehicle and its profiles, not to a run: computed once, kept in the cache folder by a hash of it."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

from contact.core.checkout import cache_folder
from contact.core.library import get_library
from contact.geometry.profile import Profile

FOLDER = "wheelrail-contact-vehicles"
_MOST = 500  # files


def kept(what: str, given: tuple[Any, ...], profiles: tuple[Profile, ...], compute: Callable[[], Any]) -> Any:
    """Return the result of `compute`, which JSON can hold, from the cache folder if it was computed before.

    Parameters
    ----------
    what : str
        Name of the result.
    given : tuple
        What it depends on, besides `profiles`: objects whose text says everything.
    profiles : tuple of Profile
    compute : callable

    A folder that cannot be written or a damaged file costs the time of computing, nothing else.
    """
    path = cache_folder() / FOLDER / f"{what}-{_hash(given, profiles)}.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        found = compute()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(f".{os.getpid()}")
        part.write_text(json.dumps(found), encoding="utf-8")
        part.replace(path)
        _remove_oldest(path.parent)
    except OSError:
        pass
    return found


def _hash(given: tuple[Any, ...], profiles: tuple[Profile, ...]) -> str:
    """Return a hash of what a result depends on, with the version of the package and the bytes of its code."""
    digest = hashlib.sha256(f"{version('wheelrail-contact')} {_code()} {given!r}".encode())
    for shape in profiles:
        for row in (shape.y, shape.z, shape.angle):
            digest.update(row.tobytes())
    return digest.hexdigest()[:32]


def _code() -> str:
    """Return what tells one state of the code from another: the compiled library, and the sources of the models."""
    library = get_library().stat()
    files = [
        (path.name, path.stat().st_size, path.stat().st_mtime_ns) for path in Path(__file__).parents[1].rglob("*.py")
    ]
    return f"{library.st_size} {library.st_mtime_ns} {sorted(files)}"


def _remove_oldest(folder: Path) -> None:
    """Keep the latest files."""
    files = sorted(folder.glob("*.json"), key=lambda path: path.stat().st_mtime)
    for path in files[:-_MOST]:
        path.unlink(missing_ok=True)
