"""The result of a wear run as an xarray dataset of its steps."""

from __future__ import annotations

import json
from collections.abc import Iterable
from importlib.metadata import version
from typing import Any

import numpy as np

from .part import Part
from .wear import COLUMNS, Life

FORMAT = "wheelrail-contact wear run 2"


def dataset(life: Life) -> Any:
    """Return an `xarray.Dataset` of dimensions, balances, conicity, profiles and fatigue over `mileage`.

    Variables of wheels begin with ``wheel_`` and have the dimension ``wheel``. Those of a rail begin with its name, like
    ``curve_right_``, since rails may differ in their points. The content depends only on the input.
    """
    import xarray

    variables: dict[str, Any] = {
        name: ("mileage", life[name], {"units": unit, "long_name": what})
        for name, (unit, what) in COLUMNS.items()
        if name != "mileage"
    }
    wheels = list(life.wheels.values())
    variables |= {
        f"wheel_{name}": (("mileage", "wheel"), np.array([wheel[name] for wheel in wheels]).T, told)
        for name, told in _told(wheels[0])
    }
    for name, unit in _POINTS.items():
        rows = np.array([[getattr(profile, name) for profile in wheel.profiles] for wheel in wheels])
        told = {"units": unit, "long_name": f"wheel profile, {name}"}
        variables[f"wheel_{name}"] = (("mileage", "wheel", "point"), rows.swapaxes(0, 1), told)
    variables["wheel_share"] = (
        ("wheel", "scenario", "point"),
        np.array([wheel.shares for wheel in wheels]),
        {"units": "m", "long_name": "depth worn off by each scenario, smoothed"},
    )
    for rail in life.rails.values():
        prefix = rail.name.replace(" ", "_")
        point = f"{prefix}_point"
        variables |= {f"{prefix}_{name}": ("mileage", rail[name], told) for name, told in _told(rail)}
        for name, unit in _POINTS.items():
            rows = np.array([getattr(profile, name) for profile in rail.profiles])
            told = {"units": unit, "long_name": f"rail profile, {name}"}
            variables[f"{prefix}_{name}"] = (("mileage", point), rows, told)
        variables[f"{prefix}_index"] = (point, rail.fatigue, {"units": "1", "long_name": "sum of Burstow's index"})
    conicities = np.array(life.conicities)
    variables["conicity"] = (
        ("mileage", "axle", "amplitude"),
        conicities[:, :, :-1],
        {"units": "1", "long_name": "equivalent conicity (EN 15302)"},
    )
    variables["nonlinearity"] = (
        ("mileage", "axle"),
        conicities[:, :, -1],
        {"units": "1/m", "long_name": "nonlinearity parameter: conicity at 4 mm less that at 2 mm, over 2 mm"},
    )
    coordinates = {
        "mileage": ("mileage", life["mileage"], {"units": "m"}),
        "amplitude": ("amplitude", np.array(life.plan.declared.amplitudes), {"units": "m"}),
    }
    attributes = {
        "format": FORMAT,
        "source": f"wheelrail-contact {version('wheelrail-contact')}",
        "name": life.plan.name,
        "set": repr(life.plan.declared),
        "scenarios": json.dumps([repr(each.declared) for each in life.plan.scenarios]),
        "wheels": json.dumps([wheel.name for wheel in wheels]),
        "axles": json.dumps(list(life.axles)),
        "rails": json.dumps([rail.name for rail in life.rails.values()]),
        "fingerprint": life.plan.fingerprint,
        "ended": life.ended,
        "warnings": " ".join(life.trust.warnings),
    }
    return xarray.Dataset(variables, coordinates, attributes)


#: Row of a profile → unit.
_POINTS = {"y": "m", "z": "m", "angle": "rad"}


def _told(part: Part) -> Iterable[tuple[str, dict[str, str]]]:
    return ((name, {"units": unit, "long_name": what}) for name, (unit, what) in part.columns.items())
