"""Write FMU files, which are zip archives, and hash the files from which they are made."""

from __future__ import annotations

import hashlib
import os
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import NamedTemporaryFile
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile, ZipInfo

from contact.errors import ContactError

_CHECKOUT = Path(__file__).parents[2]


def digest(*paths: Path) -> str:
    """Return a hash of the content of files of the checkout."""
    content = hashlib.sha256()
    for path in sorted(paths):
        content.update(path.relative_to(_CHECKOUT).as_posix().encode() + b"\0" + path.read_bytes())
    return content.hexdigest()[:12]


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


def exchange(fmu: Path, new: Mapping[str, bytes], kind: str) -> None:
    """Replace files in an FMU. If this fails, the FMU is unchanged.

    Raises
    ------
    ContactError
        If it cannot be read, is no FMU, or lacks one of the files. The message says that it is not `kind`.
    """
    try:
        with ZipFile(fmu) as content:
            files = {name: content.read(name) for name in content.namelist()}
    except (BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError) as error:
        raise ContactError(f"{fmu} is not an FMU, or it is damaged: {error}") from None
    except OSError as error:
        raise ContactError(f"{fmu} cannot be read: {error.strerror}") from None
    if missing := new.keys() - files.keys():
        raise ContactError(f"{fmu} has no {', '.join(sorted(missing))}: it is not {kind}")
    write(fmu, {**files, **new}.items())


def _mode(path: Path) -> int:
    """Return the permissions of a file, those of a new one if there is none."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
