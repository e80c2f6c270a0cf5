"""Write FMU files, which are zip archives."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo


def write(path: Path, files: Iterable[tuple[str, bytes]]) -> Path:
    """Write (name, content) pairs to an archive and return its path. The same files give the same bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        for name, content in sorted(files):
            entry = ZipInfo(name)  # its default date is 1980, so the bytes do not depend on the time of the build
            entry.compress_type = ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
    return path
