"""Locate this package, in a checkout or installed, its licence and the folder of its compiled kernels."""

from __future__ import annotations

from importlib.metadata import distribution
from pathlib import Path

_ROOT = Path(__file__).parents[2]
#: Folder of the repository, or None for an installed package.
CHECKOUT = _ROOT if (_ROOT / "build_fmu.py").is_file() and (_ROOT / "LICENSE").is_file() else None


def licence() -> str:
    """Return the text of the licence."""
    if CHECKOUT:
        return (CHECKOUT / "LICENSE").read_text(encoding="utf-8")
    text = distribution("wheelrail-contact").read_text("licenses/LICENSE")
    if text is None:
        raise FileNotFoundError("the installed package wheelrail-contact holds no LICENSE")
    return text
