"""What an FMU for hosts with Python asks the installed package (`c/entry.c`): where the functions of the native FMUs are."""

from __future__ import annotations

import ast
import os
from functools import cache
from pathlib import Path
from typing import Any

from contact import __version__
from ..native import components, systems
from ..native.component import Component
from ..native.table import NAME, content

#: File in resources/ that says what the model is: a function of `native.components`, its arguments, the guid of the FMU, and
#: the version of this package.
DECLARED = "model.txt"


def declared(name: str, options: dict[str, Any], guid: str) -> str:
    """Return the content of this file."""
    return repr((name, options, guid, __version__))


def library(folder: bytes) -> bytes:
    """Return the path of the library for an FMU with resources in a folder; or, after !, why there is none."""
    try:
        return os.fsencode(_library(Path(os.fsdecode(folder))))
    except Exception as error:  # noqa: BLE001 - the host gets a message
        return f"!{error}".encode()


def _library(folder: Path) -> Path:
    """Return the library.

    Raises
    ------
    RuntimeError
        If the FMU was built with another version of this package, or if its resources cannot be read.
    """
    try:
        text, given = (folder / DECLARED).read_text(encoding="utf-8"), (folder / NAME).read_bytes()
    except OSError as error:
        raise RuntimeError(f"resource {error.filename} cannot be read: {error.strerror}") from None
    name, _, _, *version = ast.literal_eval(text)  # at first without a version
    try:
        name, model = _model(text)
    except (AttributeError, TypeError, ValueError):  # of a model or an option that this version does not have
        model = b""
    if given != model:
        other = version[0] if version else "of an earlier version"
        raise RuntimeError(
            f"this FMU {name} was built with wheelrail-contact {other}, and what it says of its model is not what the "
            f"installed {__version__} says: install that version, or build the FMU anew"
        )
    return systems.of_this_machine()


@cache
def _model(text: str) -> tuple[str, bytes]:
    """Return the name of an FMU, and what the installed package writes into its file of the model."""
    function, options, guid, *_ = ast.literal_eval(text)
    component: Component = getattr(components, function)(**options)
    return component.table.name, content(component, guid)
