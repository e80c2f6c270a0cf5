"""Parts of the HTML pages of runs and wear studies: trust, damage of the profiles, declaration, pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import partial
from html import escape
from typing import TYPE_CHECKING, Any

from contact import plot
from contact.accumulation import Histogram
from contact.study.page import faint, html_of, picture
from contact.study.table import Table, number
from .origin import origin
from .scenario import Scenario
from .trust import Trust

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_WIDE, _NARROW = 9.0, 4.6  # [inch]


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


def damage_of(body: str, histograms: dict[str, Histogram]) -> Iterator[str]:
    """Yield the damage of wheels or rails: a table and the wear over the profile. Nothing if there is none."""
    if not histograms or not all(h.distance > 0.0 for h in histograms.values()):
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
    yield html_of(origin(scenario.files))
    yield faint(f"fingerprint {scenario.fingerprint}, step {1e3 * step:.4g} ms, {steps} steps")


def trusted(trust: Trust) -> Table:
    """Return the measures of trust as a table."""
    return Table("How far to trust it", [("", ""), ("", "")], trust.told())


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
                number(1e9 * h.per("metre")["wear"].max()),
                number(float(h["T_gamma"].sum()) / rolled),
                number(100.0 * h["stress_exceedance"].max() / rolled),
                number(100.0 * h["fatigue_exceedance"].max() / rolled),
                *(() if is_wheel else (number(1e6 * float(h.fatigue.max())),)),
            )
        )
    deepest = "µm/km" if is_wheel else "µm/10³ passes"
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
