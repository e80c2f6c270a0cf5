"""Write FMU files, which are zip archives."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from tempfile import NamedTemporaryFile
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo


def write(path: Path, files: Iterable[tuple[str, bytes]]) -> Path:
    """Write (name, content) pairs to an archive and return its path. The same files give the same bytes.

    The archive is written beside `path` and then takes its place. If that fails, for example on a full disk, a file that was
    there before is unchanged.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    new = None
    try:
        with (
            NamedTemporaryFile(dir=path.parent, prefix=path.name, delete=False) as new,
            ZipFile(new, "w", ZIP_DEFLATED) as archive,
        ):
            for name, content in sorted(files):
                entry = ZipInfo(name)  # its default date is 1980, so the bytes do not depend on the time of the build
                entry.compress_type = ZIP_DEFLATED
                entry.external_attr = 0o644 << 16
                archive.writestr(entry, content)
        os.chmod(new.name, _mode(path))
        os.replace(new.name, path)
    except BaseException:
        if new is not None:
            Path(new.name).unlink(missing_ok=True)
        raise
    return path


def _mode(path: Path) -> int:
    """Return the permissions of a file, those of a new one if there is none."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
