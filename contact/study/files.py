"""Write the results of studies to files. The ending of the name selects the format."""

from __future__ import annotations

import csv
import io
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
    """Return the same before a computation, and refuse a folder that does not exist."""
    ending = require_ending(path, endings)
    if not Path(path).absolute().parent.is_dir():
        raise ContactError(f"{path} cannot be written: there is no folder {str(Path(path).parent)!r}")
    return ending


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
