"""The result of a wear run as an HTML page."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any

import numpy as np

from contact import plot
from contact.study.page import document, faint, html_of
from contact.study.table import Table, number
from ..runs.origin import origin
from ..runs.parts import illustrated, told, warned
from ..vehicle.declared import SIDES
from .part import DENSITY, Part, displacement
from .wear import Life

_KM = 1e-3
_MM = 1e3
_MOST_ROWS = 12  # largest number of rows in the table of steps
_ALIKE = {
    "none": "Every wheel wears on its own.",
    "sides": "Both wheels of an axle wear alike, by their mean.",
    "all": "All wheels wear alike, by the mean over the wheels of the runs.",
}


def page_of(life: Life) -> str:
    """Return the wear run as a self-contained HTML page."""
    declared = life.plan.declared
    limit = declared.pressure_limit
    about = [
        f"{life.mileage * _KM:.0f} km in {len(life.rows) - 1} steps, ended by: {life.ended or 'nothing yet'}. "
        f"A step wears off at most {1e6 * declared.steps.depth:g} µm; its depth is smoothed over "
        f"{_MM * declared.steps.smoothing:g} mm.",
        f"{_ALIKE[declared.alike]} "
        + ("Rails wear by the traffic of their line. " if life.rails else "The rails do not wear. ")
        + f"The law is {life.plan.first.declared.damage.wear_law!r}, for dry steel; the amount of wear depends on its "
        "constants (docs/understand/damage.md), the shape less so. "
        + (f"Pressures are limited to {1e-6 * limit:g} MPa." if np.isfinite(limit) else "Pressures are elastic."),
    ]
    return document(life.plan.name, about, _parts(life))


def _parts(life: Life) -> Iterator[str]:
    yield from warned(life.trust)
    yield html_of(_steps(life))
    yield html_of(_wheels(life))
    yield from _reprofiling(life)
    yield from _worn(life, "wheels", list(life.wheels.values()))
    if life.rails:
        yield html_of(_rails(life))
        yield from _worn(life, "rails", list(life.rails.values()))
        yield "<h2>Rolling contact fatigue of the rails</h2>"
        yield illustrated(
            partial(_over_profile, list(life.rails.values()), "index [-]", lambda rail: rail.fatigue),
            "Sum of Burstow's index over the profiles of the rails",
        )
        yield faint(
            "Sum of Burstow's index of all passes whose creep force drives the wheel forward, without going below 0. At 1 a "
            "crack becomes visible. Wear does not remove what is summed, except by the negative branch of the index."
        )
    km = life["mileage"] * _KM
    if km.size > 1:
        yield "<h2>Over the mileage</h2>"
        yield illustrated(partial(plot.time_histories, km, _panels(life), xlabel="mileage [km]"), "Over the mileage")
    yield "<h2>Balance</h2>"
    yield html_of(_balance(life))
    yield html_of(_scenarios(life))
    yield html_of(origin(life.plan.files))
    yield faint(f"fingerprint {life.plan.fingerprint}")


def _worn(life: Life, what: str, parts: list[Any]) -> Iterator[str]:
    """Yield the depths of all wheels or rails, and the one that is worn most."""
    if len(parts) > 1:
        yield f"<h2>Depth worn off the {what}</h2>"
        draw = partial(_over_profile, parts, "depth [mm]", lambda part: _MM * displacement(part.new, part.last))
        yield illustrated(draw, f"Depth worn off over the profiles of the {what}")
    most: Part = max(parts, key=lambda part: float(displacement(part.new, part.last).max()))
    deepest = float(displacement(most.new, most.last).max())
    magnified = float(10.0 ** np.round(np.log10(3e-3 / deepest))) if deepest > 0.0 else 1.0
    yield f"<h2>Before and after: {most.name}</h2>"
    title = f"after {life.mileage * _KM:.0f} km"
    yield illustrated(
        partial(plot.worn_profile, most.new, most.last, magnified=magnified, title=title),
        f"{most.name} before and after",
    )
    depths = {s.file: depth for s, depth in zip(life.plan.declared.scenarios, most.shares, strict=True) if depth.any()}
    if depths:
        yield f"<h2>What the scenarios have worn off: {most.name}</h2>"
        yield illustrated(partial(plot.shares, most.new, depths), "Depth worn off over the profile, stacked")


def _by_side(parts: Iterable[Any], label: str, values: Callable[[Any], Any]) -> dict[str, dict[str, Any]]:
    """Return panels with the values of the right and of the left parts, or one panel if parts have no side."""
    panels: dict[str, dict[str, Any]] = {}
    for part in parts:
        *name, last = part.name.split()
        side = last if last in SIDES else ""
        panels.setdefault(f"{side} {label}".strip(), {})[" ".join(name) if side else part.name] = values(part)
    return panels


def _since_new(part: Part, column: str) -> Any:
    """Return the change of a dimension since the part was new [mm]."""
    return _MM * (part[column] - part[column][0])


def _of_steps(wheel: Part) -> Any:
    """Return the mean T-gamma of each step [N]; the first value is that of the first step, too."""
    mean = wheel["T_gamma"]
    return np.concatenate((mean[1:2], mean[1:]))


def _over_profile(parts: list[Any], label: str, values: Callable[[Any], Any]) -> Any:
    """Draw something over the profiles of parts, which may have different points."""
    y = np.linspace(max(p.new.y[0] for p in parts), min(p.new.y[-1] for p in parts), 400)
    panels = _by_side(parts, label, lambda part: np.interp(y, part.new.y, values(part)))
    return plot.time_histories(_MM * y, panels, xlabel="y [mm], to the field side")


def _panels(life: Life) -> dict[str, dict[str, Any]]:
    conicity, amplitudes = np.array(life.conicities), _MM * np.array(life.plan.declared.amplitudes)
    if len(life.axles) == 1:
        panels = {"conicity [-]": {f"{value:g} mm": conicity[:, 0, k] for k, value in enumerate(amplitudes)}}
    else:
        three = _three(life)
        lines = {axle: conicity[:, i, three] for i, axle in enumerate(life.axles)}
        panels = {f"conicity, {amplitudes[three]:g} mm": lines}
    panels["NP [1/mm]"] = {axle: 1e-3 * conicity[:, i, -1] for i, axle in enumerate(life.axles)}
    for label, column in (("Sh", "flange_height"), ("Sd", "flange_thickness"), ("qR", "qR")):
        panels |= _by_side(life.wheels.values(), f"{label} − {label}₀ [mm]", partial(_since_new, column=column))
    panels |= _by_side(life.wheels.values(), "T-gamma, mean [N]", _of_steps)
    panels["mass of a wheel [g]"] = {"mean": 1e3 * np.cumsum(life["mass"])}
    for label, column in (("rail, side [mm]", "side_depth"), ("rail, top [mm]", "top_depth")):
        panels |= _by_side(life.rails.values(), label, partial(_since_new, column=column))
    return panels


def _scenarios(life: Life) -> Table:
    """Return what the runs of a step are, and their shares of the mileage."""
    rows = []
    for share, weight, one in zip(life.plan.declared.scenarios, life.plan.weights, life.plan.scenarios, strict=True):
        speeds = f"{one.slowest:g}" if one.slowest == one.fastest else f"{one.slowest:g} to {one.fastest:g}"
        radii = ", ".join(f"{curve.radius:g} {curve.direction}" for curve in one.declared.track.curves) or "straight"
        rows.append(
            (
                share.file,
                f"{100.0 * weight:.1f}",
                told(one.declared.friction),
                speeds,
                f"{one.declared.length:g}",
                radii,
            )
        )
    heads = [("", ""), ("weight", "%"), ("friction", ""), ("speed", "m/s"), ("length", "m"), ("curves", "m")]
    return Table("Scenarios", heads, rows)


def _three(life: Life) -> int:
    """Return the number of the amplitude nearest to 3 mm."""
    return int(np.argmin(np.abs(np.array(life.plan.declared.amplitudes) - 3e-3)))


def _steps(life: Life) -> Table:
    count = len(life.rows)
    shown = sorted({round(k) for k in np.linspace(0, count - 1, min(count, _MOST_ROWS))})
    three = _three(life)
    wheels = list(life.wheels.values())

    def extreme(column: str, k: int, choose: Any) -> str:
        return f"{_MM * choose(wheel[column][k] for wheel in wheels):.3f}"

    rows = [
        (
            f"{life['mileage'][k] * _KM:.0f}",
            f"{1e6 * life['deepest'][k]:.1f}",
            f"{1e3 * max(_MM * wheel['tread_depth'][k] for wheel in wheels):.1f}",
            extreme("flange_height", k, max),
            extreme("flange_thickness", k, min),
            extreme("qR", k, min),
            _greatest(life.conicities[k][:, three]),
            _greatest(1e-3 * life.conicities[k][:, -1]),
        )
        for k in shown
    ]
    amplitude = f"{_MM * life.plan.declared.amplitudes[three]:g} mm"
    return Table(
        "Steps, worst of all wheels and axles",
        [
            ("mileage", "km"),
            ("deepest of the step", "µm"),
            ("worn at the tape circle", "µm"),
            ("Sh", "mm"),
            ("Sd", "mm"),
            ("qR", "mm"),
            (f"conicity at {amplitude}", ""),
            ("NP", "1/mm"),
        ],
        rows,
    )


def _greatest(values: Any) -> str:
    """Return the greatest of the values that exist; "none" if there are none."""
    known = values[np.isfinite(values)]
    return f"{known.max():.4f}" if known.size else "none"


def _wheels(life: Life) -> Table:
    rows = [
        (
            wheel.name,
            number(1e6 * float(displacement(wheel.new, wheel.last).max())),
            number(1e6 * float(wheel["tread_depth"][-1])),
            f"{_MM * wheel.flange.height:.3f}",
            f"{_MM * wheel.flange.thickness:.3f}",
            f"{_MM * wheel.flange.qR:.3f}",
            number(1e6 * float(wheel["area"].sum())),
            number(1e3 * float(wheel["mass"].sum())),
        )
        for wheel in life.wheels.values()
    ]
    heads = [("wheel", ""), ("deepest", "µm"), ("tape circle", "µm"), ("Sh", "mm"), ("Sd", "mm"), ("qR", "mm")]
    return Table("Wheels at the end", [*heads, ("worn off in all", "mm²"), ("mass", "g")], rows)


def _reprofiling(life: Life) -> Iterator[str]:
    """Yield what was cut, and when the next cut is due."""
    cuts = np.flatnonzero(life["cut"])
    if cuts.size:
        rows = [
            (f"{life['mileage'][k] * _KM:.0f}", f"{_MM * life['cut'][k]:.2f}", f"{2 * _MM * life['cut'][k]:.2f}")
            for k in cuts
        ]
        yield html_of(Table("Reprofiling", [("mileage", "km"), ("cut, radius", "mm"), ("diameter", "mm")], rows))
    due = f"Now all wheels would be restored by a cut of {_MM * life.cut:.2f} mm of the radius."
    if life.worn_out:
        due = f"{life.worn_out}. {due}"
    if life.forecast:
        name, limit, at = life.forecast
        due += f" By the trend of the last steps {name} reaches its limit of {limit} first, at {at * _KM:.0f} km."
    yield faint(due)


def _rails(life: Life) -> Table:
    rows = []
    for (line, _), rail in life.rails.items():
        million = 1e-6 * life.tonnes(line)
        area = float(rail["area"].sum())
        rows.append(
            (
                rail.name,
                number(million),
                number(1e-6 * float(rail["passes"].sum())),
                f"{_MM * rail['top_depth'][-1]:.3f}",
                f"{_MM * rail['side_depth'][-1]:.3f}",
                number(1e6 * area / million) if million > 0.0 else "",
                number(float(rail["fatigue"][-1])),
                number(float(rail["fatigue_rate"][-1])),
            )
        )
    heads = [
        ("rail", ""),
        ("traffic", "10⁶ t"),
        ("axles", "10⁶"),
        ("top", "mm"),
        ("side", "mm"),
        ("wear", "mm² per 10⁶ t"),
    ]
    return Table("Rails at the end", [*heads, ("RCF index", ""), ("last step, per 10⁶ axles", "")], rows)


def _balance(life: Life) -> Table:
    wheels, members = list(life.wheels.values()), list(life.members.values())
    count = sum(members)
    mass, energy = float(life["mass"].sum()), float(life["energy"].sum())

    def mean(column: str) -> float:
        return sum(n * float(wheel[column].sum()) for n, wheel in zip(members, wheels, strict=True)) / count

    area, smoothed = mean("area"), mean("area_smoothed")
    whole = 2.0 * np.pi * life.plan.first.radius * area
    rows = [
        ("cross-section worn off a wheel, before smoothing", number(1e6 * area), "mm²"),
        ("the same between the profiles, after smoothing", number(1e6 * smoothed), "mm²"),
        ("volume worn off a wheel", number(1e9 * mass / DENSITY), "mm³"),
        ("cross-section times the nominal circumference", number(1e9 * whole), "mm³"),
        ("mass worn off a wheel", number(1e3 * mass), "g"),
        ("frictional energy of a wheel", number(1e-6 * energy), "MJ"),
        ("mass for energy", number(1e9 * mass / energy) if energy > 0.0 else "", "µg/J"),
        *((what, told, "") for what, told in life.trust.told()),
    ]
    return Table("Energy and worn mass, mean of all wheels", [("", ""), ("value", ""), ("", "unit")], rows)
