"""Write the results of studies to files. The ending of the name selects the format."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from contact.errors import ContactError

PICTURES = (".png", ".pdf", ".svg")


def csv_of(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return rows with the same names as CSV. None is an empty cell."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def require_ending(path: str | Path, endings: Sequence[str]) -> str:
    """Return the ending of the path in lower case. Raise a ContactError if it is not one of `endings`."""
    ending = Path(path).suffix.lower()
    if ending not in endings:
        raise ContactError(f"{path} cannot be written: a file ends in one of {', '.join(endings)}")
    return ending


def require_writable(path: str | Path, endings: Sequence[str]) -> str:
    """Return the same before a computation, and refuse what cannot be written."""
    ending, place = require_ending(path, endings), Path(path).absolute()
    if not place.parent.is_dir():
        raise ContactError(f"{path} cannot be written: there is no folder {str(Path(path).parent)!r}")
    if place.is_dir():
        raise ContactError(f"{path} cannot be written: it is a folder")
    _require_access(path, place if place.exists() else place.parent)
    return ending


def require_folder(path: str | Path) -> None:
    """Raise a ContactError, before a computation, for a path that is not and cannot become a folder for its files."""
    place = Path(path).absolute()
    nearest = next(each for each in (place, *place.parents) if each.exists())
    if not nearest.is_dir():
        raise ContactError(f"{path} cannot be written: {str(nearest)!r} is a file and no folder")
    _require_access(path, nearest)


def _require_access(path: str | Path, place: Path) -> None:
    if not os.access(place, os.W_OK):
        raise ContactError(f"{path} cannot be written: there is no permission to write {str(place)!r}")


def write(path: str | Path, texts: Mapping[str, Callable[[], str]], figure: Callable[[], Any] | None = None) -> None:
    """Write to `path` the text for its ending, from the function in `texts`, or the figure as a picture.

    Raises
    ------
    ContactError
        For any other ending, or if the file cannot be written.
    """
    ending = require_ending(path, [*texts, *(PICTURES if figure else ())])
    try:
        if ending in texts:
            Path(path).write_text(texts[ending](), encoding="utf-8", newline="")
        elif figure is not None:
            figure().savefig(path)
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror or error}") from None
