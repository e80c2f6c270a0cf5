"""The zip file that an FMU is."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo


def write(path: Path, files: Iterable[tuple[str, bytes]]) -> Path:
    """Write an archive of (name, content) and return its path; the same files give the same bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        for name, content in sorted(files):
            entry = ZipInfo(name)  # dated 1980
            entry.compress_type = ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
    return path
