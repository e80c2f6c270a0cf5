"""Histograms as self-contained NetCDF files with units, provenance, the profile and the constants of the models."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from importlib.metadata import version
from os import PathLike
from typing import Any

import numpy as np

from contact.accumulation.histogram import MAXIMA, SUMS, Histogram
from contact.damage import ArchardMap, Burstow, DamageParameters, PearceSherratt, Usfd
from contact.errors import ContactError, optional
from contact.geometry.profile import Profile
from contact.inputs.material import Material

FORMAT = "wheelrail-contact damage histogram 3"


def save(histogram: Histogram, path: str | PathLike[str]) -> None:
    """Write a histogram as NetCDF (version 3, by xarray and scipy), without loss of precision.

    Raises
    ------
    ImportError
        If xarray is not installed.
    """
    to_xarray(histogram).to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")


def to_xarray(histogram: Histogram) -> Any:
    """Return the histogram as an `xarray.Dataset`. The variables have the attributes `units` and `long_name`."""
    profile, h = histogram.profile, histogram
    units = {name: what[0] for name, what in (SUMS | MAXIMA).items()}
    if profile.kind == "rail":
        units["wear"] = "m2"
    variables = {name: ("bin", h[name], _described(units[name], what[1])) for name, what in (SUMS | MAXIMA).items()}
    points = {
        "profile_y": ("point", profile.y, _described("m", "lateral, to the field side")),
        "profile_z": ("point", profile.z, _described("m", "vertical, down")),
        "profile_angle": ("point", profile.angle, _described("rad", "of the tangent")),
    }
    coordinates = {
        "arc": ("bin", h.centres, _described("m", "arc length of the middle of the bin")),
        "edge": ("edge", h.edges, _described("m", "arc length of the edges of the bins")),
    }
    attributes = {
        "format": FORMAT,
        "source": f"wheelrail-contact {version('wheelrail-contact')}",
        "kind": profile.kind,
        "profile": profile.name,
        "width": h.width,
        "radius": h.radius,
        "distance": h.distance,
        "methods": json.dumps(sorted(h.methods)),
        "materials": json.dumps(sorted((asdict(material) for material in h.materials), key=str)),
        "parameters": json.dumps(asdict(h.parameters)),
    }
    made = _xarray().Dataset(variables | points, coordinates, attributes)
    made.attrs["checksum"] = _checksum(made)
    return made


def _checksum(stored: Any) -> str:
    """Return the SHA-256 of all numbers and attributes of a dataset, as text."""
    found = hashlib.sha256()
    for name in sorted(map(str, stored.variables)):
        array = np.ascontiguousarray(stored.variables[name].values, dtype="<f8")
        found.update(f"{name} {array.shape}".encode() + array.tobytes())
    for name in sorted(map(str, stored.attrs)):
        if name != "checksum":
            value = stored.attrs[name]
            found.update(f"{name} {value if isinstance(value, str) else float(value)!r}".encode())
    return found.hexdigest()


def load(path: str | PathLike[str]) -> Histogram:
    """Return the histogram from a file that `save` has written.

    Raises
    ------
    ContactError
        If the file contains something else or is damaged.
    ImportError
        If xarray is not installed.
    OSError
        If the file does not exist.
    """
    xarray = _xarray()
    with open(path, "rb"):
        pass  # a file that does not exist is told from a damaged one
    try:
        stored = xarray.load_dataset(path, engine="scipy")
    except Exception as error:  # noqa: BLE001 - a damaged header leads scipy to any error
        raise ContactError(f"path = {str(path)!r} is not a {FORMAT}, or it is damaged: {error}") from None
    if stored.attrs.get("format") != FORMAT:
        raise ContactError(f"path = {str(path)!r} is not a {FORMAT}")
    return from_xarray(stored)


def from_xarray(stored: Any) -> Histogram:
    """Return the histogram from an `xarray.Dataset` made by `to_xarray`.

    Raises
    ------
    ContactError
        If the dataset contains something else, or has been changed since `to_xarray`.
    """
    given = stored.attrs
    if given.get("format") != FORMAT:
        raise ContactError(f"format = {given.get('format')!r}: the dataset is not a {FORMAT}")
    try:
        checksum = _checksum(stored)
    except (TypeError, ValueError) as error:
        raise ContactError(f"the dataset is damaged: {error}") from None
    if checksum != given.get("checksum"):
        raise ContactError("the dataset is damaged, or was changed: its checksum is not that of its content")
    constants = json.loads(given["parameters"])
    for name, model in _MODELS.items():
        constants[name] = model(**constants[name])
    y, z, angle = (stored[f"profile_{name}"].values for name in ("y", "z", "angle"))
    histogram = Histogram(
        Profile(given["kind"], y, z, angle, given["profile"]),
        width=float(given["width"]),
        radius=float(given["radius"]),
        parameters=DamageParameters(**constants),
    )
    histogram.restore(
        {name: stored[name].values for name in SUMS | MAXIMA},
        float(given["distance"]),
        set(json.loads(given["methods"])),
        {Material(**material) for material in json.loads(given["materials"])},
    )
    return histogram


_MODELS: dict[str, Any] = {
    "pearce_sherratt": PearceSherratt,
    "burstow": Burstow,
    "usfd": Usfd,
    "archard": ArchardMap,
}


def _described(unit: str, meaning: str) -> dict[str, str]:
    return {"units": unit, "long_name": meaning}


def _xarray() -> Any:
    needed = "histograms in files need"
    optional("scipy.io", needed, "xarray")
    return optional("xarray", needed, "xarray")
