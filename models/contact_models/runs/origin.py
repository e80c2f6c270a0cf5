"""What a report says of where it comes from: version, date, and the hash of every file that was read."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from contact.study.table import Table


def hashed(paths: Iterable[Path]) -> tuple[tuple[str, str], ...]:
    """Return name and SHA-256 of every file among the paths, each once. Paths that are no files are names of the package."""
    found = {}
    for path in paths:
        if path.is_file():
            found[path.resolve()] = (path.name, hashlib.sha256(path.read_bytes()).hexdigest())
    return tuple(found.values())


def origin(files: Iterable[tuple[str, str]]) -> Table:
    """Return the table of a report that can be signed: who computed it, when, from what."""
    rows = [
        ("wheelrail-contact", version("wheelrail-contact")),
        ("date", f"{datetime.now(UTC):%Y-%m-%d} (UTC)"),
        *(dict.fromkeys((name, f"SHA-256 {digest}") for name, digest in files)),
    ]
    return Table("Origin", [("", ""), ("", "")], rows)
