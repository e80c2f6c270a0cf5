"""Where this package lies, in a checkout or installed, and so where its licence is and where compiled kernels are kept."""

from __future__ import annotations

from importlib.metadata import distribution
from pathlib import Path

import contact
from contact._jit import cache_directory

_ROOT = Path(__file__).parents[1]
#: The repository's folder; None for an installed package.
CHECKOUT = _ROOT if (_ROOT / "build_fmu.py").is_file() and (_ROOT / "LICENSE").is_file() else None


def objects() -> Path:
    """Return the folder in which compiled kernels are kept from one build to the next."""
    if CHECKOUT:
        return CHECKOUT / "build" / "native"
    return cache_directory(Path(contact.__file__).parent / "kernels").parent / "wheelrail-contact" / "native"


def licence() -> str:
    """Return the licence's text."""
    if CHECKOUT:
        return (CHECKOUT / "LICENSE").read_text(encoding="utf-8")
    text = distribution("wheelrail-contact").read_text("licenses/LICENSE")
    if text is None:
        raise FileNotFoundError("the installed package wheelrail-contact holds no LICENSE")
    return text
