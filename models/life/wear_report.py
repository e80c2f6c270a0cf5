"""The result of a wear run as an xarray dataset of its steps and as an HTML page."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib.metadata import version
from typing import Any

import numpy as np

from contact import plot
from contact.study.page import document, faint, html_of
from contact.study.table import Table, number
from models.life.report import illustrated, warned
from models.life.trust import TRUST
from models.life.wear import COLUMNS, DENSITY, Life

FORMAT = "wheelrail-contact wear run 1"
_KM = 1e-3
_MOST_ROWS = 12  # largest number of rows in the table of steps


def dataset(life: Life) -> Any:
    """Return an `xarray.Dataset` of dimensions, balances, conicity and profiles over `mileage`.

    The content depends only on the input.
    """
    import xarray

    variables: dict[str, Any] = {
        name: ("mileage", life[name], {"units": unit, "long_name": what})
        for name, (unit, what) in COLUMNS.items()
        if name != "mileage"
    }
    for name, unit in (("y", "m"), ("z", "m"), ("angle", "rad")):
        rows = np.array([getattr(wheel, name) for wheel in life.wheels])
        variables[f"wheel_{name}"] = (
            ("mileage", "point"),
            rows,
            {"units": unit, "long_name": f"wheel profile, {name}"},
        )
    variables["conicity"] = (
        ("mileage", "amplitude"),
        np.array(life.conicities),
        {"units": "1", "long_name": "equivalent conicity (EN 15302)"},
    )
    variables["share"] = (
        ("scenario", "point"),
        life.shares,
        {"units": "m", "long_name": "depth worn off by each scenario, smoothed"},
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
        "fingerprint": life.plan.fingerprint,
        "ended": life.ended,
        "warnings": " ".join(life.trust.warnings),
    }
    return xarray.Dataset(variables, coordinates, attributes)


def page_of(life: Life) -> str:
    """Return the wear run as a self-contained HTML page."""
    steps = life.plan.declared.steps
    about = [
        f"{life.mileage * _KM:.0f} km in {len(life.wheels) - 1} steps, ended by: {life.ended or 'nothing yet'}. "
        f"A step wears off at most {1e6 * steps.depth:g} µm; its depth is smoothed over {1e3 * steps.smoothing:g} mm.",
        "All wheels have the same wear, the mean over the wheels of the runs. The rails do not wear. The law is Archard's "
        "with the KTH map for dry steel. The amount of wear depends on its constants (docs/theory.md), the shape less so.",
    ]
    return document(life.plan.name, about, _parts(life))


def _parts(life: Life) -> Iterator[str]:
    yield from warned(life.trust)
    yield html_of(_steps(life))
    before, after = life.plan.wheel, life.wheel
    deepest = float(np.hypot(after.y - before.y, after.z - before.z).max())
    magnified = float(10.0 ** np.round(np.log10(3e-3 / deepest))) if deepest > 0.0 else 1.0
    yield "<h2>Before and after</h2>"
    yield illustrated(
        lambda: plot.worn_profile(before, after, magnified=magnified, title=f"after {life.mileage * _KM:.0f} km"),
        "The wheel before and after",
    )
    depths = {share.file: depth for share, depth in zip(life.plan.declared.scenarios, life.shares, strict=True)}
    yield "<h2>What the scenarios have worn off</h2>"
    yield illustrated(lambda: plot.shares(before, depths), "Depth worn off over the profile, stacked")
    km = life["mileage"] * _KM
    if km.size > 1:
        yield "<h2>Over the mileage</h2>"
        yield illustrated(lambda: plot.time_histories(km, _panels(life), xlabel="mileage [km]"), "Over the mileage")
    yield "<h2>Balance</h2>"
    yield html_of(_balance(life))
    yield faint(f"fingerprint {life.plan.fingerprint}")


def _panels(life: Life) -> dict[str, dict[str, Any]]:
    conicity = np.array(life.conicities)
    return {
        "conicity [-]": {
            f"{1e3 * amplitude:g} mm": conicity[:, k] for k, amplitude in enumerate(life.plan.declared.amplitudes)
        },
        "Sh − Sh₀ [mm]": {"Sh": 1e3 * (life["flange_height"] - life["flange_height"][0])},
        "Sd − Sd₀ [mm]": {"Sd": 1e3 * (life["flange_thickness"] - life["flange_thickness"][0])},
        "qR − qR₀ [mm]": {"qR": 1e3 * (life["qR"] - life["qR"][0])},
        "mass worn off [g]": {"mass": 1e3 * np.cumsum(life["mass"])},
    }


def _steps(life: Life) -> Table:
    count = len(life.rows)
    shown = sorted({round(k) for k in np.linspace(0, count - 1, min(count, _MOST_ROWS))})
    three = int(np.argmin(np.abs(np.array(life.plan.declared.amplitudes) - 3e-3)))
    rows = [
        (
            f"{life['mileage'][k] * _KM:.0f}",
            f"{1e6 * life['deepest'][k]:.1f}",
            f"{1e6 * life['tread_depth'][k]:.1f}",
            f"{1e3 * life['flange_height'][k]:.3f}",
            f"{1e3 * life['flange_thickness'][k]:.3f}",
            f"{1e3 * life['qR'][k]:.3f}",
            f"{life.conicities[k][three]:.4f}",
        )
        for k in shown
    ]
    amplitude = f"{1e3 * life.plan.declared.amplitudes[three]:g} mm"
    return Table(
        "Steps",
        [
            ("mileage", "km"),
            ("deepest of the step", "µm"),
            ("worn at the tape circle", "µm"),
            ("Sh", "mm"),
            ("Sd", "mm"),
            ("qR", "mm"),
            (f"conicity at {amplitude}", ""),
        ],
        rows,
    )


def _balance(life: Life) -> Table:
    mass, energy = float(life["mass"].sum()), float(life["energy"].sum())
    area, smoothed = float(life["area"].sum()), float(life["area_smoothed"].sum())
    whole = 2.0 * np.pi * life.plan.scenarios[0].radius * area
    rows = [
        ("cross-section worn off, before smoothing", number(1e6 * area), "mm²"),
        ("the same between the profiles, after smoothing", number(1e6 * smoothed), "mm²"),
        ("volume worn off a wheel", number(1e9 * mass / DENSITY), "mm³"),
        ("cross-section times the nominal circumference", number(1e9 * whole), "mm³"),
        ("mass worn off a wheel", number(1e3 * mass), "g"),
        ("frictional energy of a wheel", number(1e-6 * energy), "MJ"),
        ("mass for energy", number(1e9 * mass / energy) if energy > 0.0 else "", "µg/J"),
        *((what, number(life.trust.as_dict()[name]), "") for name, (_, what) in TRUST.items()),
    ]
    return Table("Energy and worn mass", [("", ""), ("value", ""), ("", "unit")], rows)
