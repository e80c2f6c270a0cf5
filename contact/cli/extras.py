"""Find the extras of the package that are not installed, and what needs them."""

from __future__ import annotations

from importlib.util import find_spec

#: Extra → the modules that it installs, and what needs them.
EXTRAS = {
    "plot": (("matplotlib",), "pictures: patch, demo, run, wear, --out"),
    "xarray": (("xarray", "scipy"), "result files: run, wear"),
    "profiles": (("scipy",), "smoothing of measured profiles"),
    "scale": (("dask", "distributed"), "wear on several processes"),
    "fmu": (("fmpy",), "fmu --validation, demo without --python"),
    "native": (("ziglang", "fmpy"), "fmu for hosts without Python"),
}


def missing() -> dict[str, str]:
    """Return extra → what needs it, for every extra that is not installed."""
    return {extra: use for extra, (_, use) in EXTRAS.items() if absent_modules(extra)}


def absent_modules(extra: str) -> list[str]:
    """Return the modules of an extra that are not installed."""
    return [module for module in EXTRAS[extra][0] if _absent(module)]


def note() -> str:
    """Return a paragraph for the help that names the missing extras; empty if none is missing."""
    absent = missing()
    if not absent:
        return ""
    lines = [f"{extra} ({use})" for extra, use in absent.items()]
    return f"Not installed: {'; '.join(lines)}. Add one with  pip install 'wheelrail-contact[{next(iter(absent))}]'."


def _absent(module: str) -> bool:
    try:
        return find_spec(module) is None
    except ValueError:  # a module without a specification
        return False
