"""The HTML page of a run: scenario, time series, and damage of the profiles."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import partial
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from contact import plot
from contact.accumulation import Histogram
from contact.study.page import document, faint, html_of, picture
from contact.study.table import Table, number
from models.life.harvest import BODIES
from models.life.run import BALANCE, Run
from models.life.scenario import Scenario
from models.life.trust import TRUST, Trust
from models.wheelset.ports import INWARDS, SIDES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_WIDE, _NARROW = 9.0, 4.6  # [inch]


def page_of(run: Run) -> str:
    """Return the run as a self-contained HTML page."""
    scenario, d = run.scenario, run.scenario.declared
    about = [
        f"{d.length:g} m; damage of the first {d.recording.settling:g} m is not counted. Wheel {scenario.wheel.name}, rail "
        f"{scenario.rail.name}; {d.methods.normal} + {d.methods.tangential}; wheelset {d.wheelset.set!r}.",
        "Forces act on the wheel, y is to the right. The damage is computed with a separate contact plane for each patch, "
        "under the vertical loads of the coupled run. Only the track's alignment is irregular. Gauge, cross-level and "
        "vertical irregularities, and the vehicle above the wheelset, are not modelled.",
    ]
    return document(scenario.name, about, _parts(run))


def illustrated(draw: Callable[[], Figure], text: str) -> str:
    """Return a picture in HTML, in one size for wide and one for narrow pages. `text` describes it."""
    return picture(_resized(draw(), _WIDE), _resized(draw(), _NARROW), text)


def _resized(figure: Figure, width: float) -> Figure:
    height = figure.get_size_inches()[1]
    figure.set_size_inches(width, height)
    return figure


def warned(trust: Trust) -> Iterator[str]:
    """Yield the warnings as paragraphs in bold."""
    for sentence in trust.warnings:
        yield f"<p><strong>{escape(sentence)}</strong></p>"


def _parts(run: Run) -> Iterator[str]:
    trust = run.trust
    yield from warned(trust)
    yield html_of(_summary(run))
    yield html_of(trusted(trust))
    for heading, panels in _panels(run.series).items():
        yield f"<h2>{heading}</h2>"
        yield illustrated(partial(plot.time_histories, run.series["distance"], panels, xlabel="distance [m]"), heading)
    for body in BODIES:
        yield from damage_of(body, {side: run.harvest.histograms[side, body] for side in SIDES})
    yield "<h2>Energy</h2>"
    yield html_of(_energy(run))
    yield faint("; ".join(f"{name}: {what}" for name, what in BALANCE.items()) + ".")
    yield from declaration(run.scenario, run.scenario.step, run.steps)


def damage_of(body: str, histograms: dict[str, Histogram]) -> Iterator[str]:
    """Yield the damage of all wheels or all rails: a table and the wear over the profile. Nothing if one has not rolled."""
    if not all(h.distance > 0.0 for h in histograms.values()):
        return
    yield f"<h2>Damage of the {body}s</h2>"
    yield html_of(damaged(histograms))
    yield illustrated(
        partial(plot.wear, histograms, f"wear of the {body}s: the share of each in their mean"),
        f"Wear over the profile of the {body}s",
    )


def declaration(scenario: Scenario, step: float, steps: int) -> Iterator[str]:
    """Yield what the scenario declares, and the step [s] and the number of steps of its run."""
    yield "<h2>Declaration</h2>"
    for entry in fields(scenario.declared):
        yield faint(f"{entry.name}: {told(getattr(scenario.declared, entry.name))}")
    yield faint(f"fingerprint {scenario.fingerprint}, step {1e3 * step:.4g} ms, {steps} steps")


def _panels(s: dict[str, Any]) -> dict[str, dict[str, dict[str, Any]]]:
    def both(name: str, factor: float) -> dict[str, Any]:
        return {side: factor * s[f"{side}_{name}"] for side in SIDES}

    return {
        "Track": {
            "speed [m/s]": {"speed": s["speed"]},
            "curvature [1/km]": {"curvature": 1e3 * s["curvature"]},
            "alignment [mm]": {"alignment": 1e3 * s["alignment"]},
        },
        "Motion": {
            "y − alignment [mm]": {"wheelset": 1e3 * (s["lateral"] - s["alignment"])},
            "yaw [mrad]": {"wheelset": 1e3 * s["yaw"]},
            "contact angle [°]": {side: inwards * s[f"{side}_contact_angle"] for side, inwards in INWARDS.items()},
        },
        "Forces": {
            "lateral [kN]": both("lateral_force", 1e-3),
            "vertical [kN]": both("vertical_force", 1e-3),
            "T-gamma [N]": both("T_gamma", 1.0),
            "pressure [MPa]": both("max_pressure", 1e-6),
        },
    }


def _summary(run: Run) -> Table:
    s, wheels = run.series, [run.harvest.histograms[side, "wheel"] for side in SIDES]
    rows = [("samples", str(s["distance"].size))]
    if s["distance"].size:
        ratio = max(_quotient(s[f"{side}_lateral_force"], s[f"{side}_vertical_force"]) for side in SIDES)
        rows += [
            ("lateral displacement, greatest", f"{1e3 * np.abs(s['lateral'] - s['alignment']).max():.3g} mm"),
            ("lateral over vertical force, greatest", f"{ratio:.3g}"),
            ("pressure, greatest", f"{1e-6 * max(s[f'{side}_max_pressure'].max() for side in SIDES):.4g} MPa"),
            ("T-gamma, mean of a wheel", f"{np.mean([s[f'{side}_T_gamma'].mean() for side in SIDES]):.3g} N"),
        ]
    if all(h.distance > 0.0 for h in wheels):
        deepest = max(h.per("metre")["wear"].max() for h in wheels)
        rows.append(("wear of a wheel, deepest", f"{1e12 * deepest:.3g} µm per 1000 km"))
    return Table("The run in numbers", [("", ""), ("", "")], rows)


def _quotient(lateral: np.ndarray, vertical: np.ndarray) -> float:
    """Return the largest |Y/Q| of the samples in which the wheel carries a load; 0 if there are none."""
    loaded = vertical > 0.0
    return float(np.abs(lateral[loaded] / vertical[loaded]).max(initial=0.0))


def trusted(trust: Trust) -> Table:
    """Return the measures of trust as a table."""
    rows = [(TRUST[name][1], number(value)) for name, value in trust.as_dict().items()]
    return Table("How far to trust it", [("", ""), ("", "")], rows)


def damaged(both: dict[str, Histogram]) -> Table:
    """Return the damage of wheels or of rails, by name, as a table."""
    rows = []
    is_wheel = next(iter(both.values())).profile.kind == "wheel"
    for side, h in both.items():
        rolled = h.distance
        rows.append(
            (
                side,
                number(1e12 * h.volume / rolled),
                number(1e12 * h.per("metre")["wear"].max()),
                number(float(h["T_gamma"].sum()) / rolled),
                number(100.0 * h["stress_exceedance"].max() / rolled),
                number(100.0 * h["fatigue_exceedance"].max() / rolled),
                *(() if is_wheel else (number(1e6 * float(h.fatigue.max())),)),
            )
        )
    deepest = "nm/km" if is_wheel else "µm/10⁶ passes"
    return Table(
        "Per kilometre rolled",
        [
            ("", ""),
            ("worn", "mm³/km"),
            ("deepest", deepest),
            ("mean T-gamma", "N"),
            ("stress index > 0", "% of the distance"),
            ("surface fatigue > 0", "% of the distance"),
            *(() if is_wheel else (("Burstow, greatest", "per 10⁶ axles"),)),
        ],
        rows,
    )


def _energy(run: Run) -> Table:
    balance = run.balance
    return Table(
        "Energies of the whole run",
        [("", ""), ("", "J")],
        [(name, number(balance[name])) for name in BALANCE if name != "untrusted"],
    )


def told(value: object) -> str:
    """Return a declared value as text. Members with their default value are left out."""
    if isinstance(value, tuple):
        return "; ".join(map(told, value)) or "none"
    if not is_dataclass(value):
        return str(value)
    changed = [
        f"{entry.name} {told(member)}"
        for entry in fields(value)
        if (member := getattr(value, entry.name)) != _default(entry)
    ]
    return ", ".join(changed) or "default"


def _default(entry: Field[Any]) -> object:
    return entry.default_factory() if entry.default_factory is not MISSING else entry.default
