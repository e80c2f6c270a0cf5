"""The HTML page of a run with a vehicle: safety, forces, motion, damage and energies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import astuple
from functools import partial
from typing import Any

import numpy as np

from contact import plot
from contact.study.page import document, faint, html_of
from contact.study.table import Table, number
from ..vehicle import assess, drawing, en14363
from ..vehicle.declared import INWARDS, SIDES
from ..vehicle.ledgers import BODIES
from .parts import damage_of, declaration, illustrated, trusted, warned
from .run import BALANCE, VehicleRun
from .stability import CONICITY_AT, DECELERATION

#: Frequency up to which a rail as one mass is right [Hz].
RIGHT_BELOW = 150.0
_NOT_ASKED = "not found: contact run --critical-speed finds it, in a minute for a vehicle and then from its notes."
#: Ratio of the conicities at two amplitudes from which on the report warns.
UNEQUAL = 2.0


def page_of(run: VehicleRun, nonlinear: bool = False) -> str:
    """Return the run as a self-contained HTML page, with the nonlinear critical speed if it is asked for."""
    scenario, d = run.scenario, run.scenario.declared
    about = [
        f"{scenario.vehicle.name} over {d.length:g} m; damage of the first {d.recording.settling:g} m is not counted. Wheel "
        f"{scenario.wheel.name}, rail {scenario.rail.name}; {d.methods.normal} + {d.methods.tangential}.",
        "Y is the force of a wheel on its rail outwards, Q that downwards. Both, and T-gamma, "
        "are means between two samples. Each patch has its own plane.",
    ]
    return document(scenario.name, about, _parts(run, nonlinear))


def _parts(run: VehicleRun, nonlinear: bool) -> Iterator[str]:
    trust = run.trust
    yield from warned(trust)
    if run.series["distance"].size:
        yield html_of(_safety(run))
        friction = run.scenario.friction.static
        nadal = assess.nadal(assess.flange_angle(run.scenario.wheel), friction)
        yield faint(
            f"Low-passed at {assess.CUT_OFF:g} Hz; Y/Q and ΣY are means over {assess.WINDOW:g} m. Limits of Y/Q: "
            f"{assess.LARGEST_QUOTIENT:g}, Nadal's {nadal:.2f} at μ = {friction:g} (EN 14363; the limits "
            "are recalled, not verified)."
        )
        if sections := _sections(run):
            yield html_of(sections)
            yield faint(
                f"As in EN 14363:2016, which is recalled, not verified. Worst wheelset of each section; percentile "
                f"{en14363.LARGEST:g} % of ΣY and Y/Q (means over {assess.WINDOW:g} m every half metre) and of Q, medians of "
                "the outer wheel as quasi-static values, rms of ΣY over 100 m within 2 Hz of its strongest frequency from 1 to "
                "10 Hz. One run is one sample of each section; the standard asks for many and their statistics."
            )
        yield html_of(_wheels(run))
        for heading, panels in _panels(run).items():
            yield f"<h2>{heading}</h2>"
            yield faint(_EXPLAINED[heading])
            draw = partial(plot.time_histories, run.series["distance"], panels, xlabel="distance [m]")
            yield illustrated(draw, heading)
    yield from _vehicle(run, nonlinear)
    yield "<h2>Trust</h2>"
    yield html_of(trusted(trust))
    yield faint(run.step_error.sentence)
    if run.without_damage:
        yield faint(
            f"Without damage, as they are not round: {', '.join(' '.join(name) for name in run.without_damage)}."
        )
    if run.sections_without_damage:
        parts = (f"{side} rail, {begin:.2f} to {end:.2f} m" for side, begin, end in run.sections_without_damage)
        yield faint(f"Without damage, as the rail is given by slices: {'; '.join(parts)}.")
    histograms = run.damage()
    for body in BODIES:
        yield from damage_of(
            body, {f"{name}, {side}": h for (name, side, which), h in histograms.items() if which == body}
        )
    yield "<h2>Energy</h2>"
    rows = [(name, number(value), BALANCE[name]) for name, value in run.balance.items()]
    yield html_of(Table("Energies of the whole run", [("", ""), ("", "J"), ("", "")], rows))
    yield from declaration(run.scenario, run.step, run.steps)


def _vehicle(run: VehicleRun, nonlinear: bool = False) -> Iterator[str]:
    """Yield what runs: drawing, numbers, frequencies and stability."""
    vehicle = run.scenario.vehicle
    yield "<h2>Vehicle</h2>"
    yield faint(f"{vehicle.name}. {vehicle.source}")
    yield f'<div class="wide">{drawing.drawing(vehicle)}</div>'
    yield html_of(drawing.bodies(vehicle))
    yield html_of(drawing.elements(vehicle))
    rows = [(f"{mode.frequency:.3g} Hz", f"{100.0 * mode.damping:.3g} %", name) for name, mode in run.stability.modes()]
    yield html_of(
        Table("Modes at the slowest speed, up to 50 Hz", [("", ""), ("damping", ""), ("most moved", "")], rows)
    )
    at = [
        f"{value:.3g} at {1e3 * where:g} mm"
        for where, value in zip(CONICITY_AT, run.stability.conicities, strict=False)
    ]
    if at and max(run.stability.conicities) > UNEQUAL * min(run.stability.conicities):
        yield (
            f"<p><strong>The equivalent conicity depends on the amplitude: {' and '.join(at)}. The linear critical speed "
            "is that of small motions and says little of larger ones.</strong></p>"
        )
    yield faint(
        f"Equivalent conicity (EN 15302) {' and '.join(at) or 'not found'}. Linear critical speed "
        f"{_speed(run.stability.critical_speed)}: "
        "the least speed at which motions of .1 mm grow, from the eigenvalues of the run's own kernel on straight ideal "
        f"track, to 2 m/s. Nonlinear critical speed {_cycle(run) if nonlinear else _NOT_ASKED}"
    )
    yield faint(
        f"A rail is one mass under each wheel. Its receptance is right below {RIGHT_BELOW:g} Hz: peaks at joints, flats and "
        "corrugation beyond that are not."
    )


def _cycle(run: VehicleRun) -> str:
    """Return the nonlinear critical speed, and how it was found."""
    found = run.stability.limit_cycle
    how = (
        f"the speed at which the limit cycle ends when the speed falls by {DECELERATION:g} m/s² after a kick of 5 mm, with the "
        "same kernel and unworn profiles."
    )
    if found is None:
        return "not found: a wheel leaves its rail at speeds above the linear one."
    if found.critical == np.inf:
        return f"none up to {found.speed[0]:.0f} m/s: {how}"
    if found.critical <= found.speed[-1]:
        return f"below {found.speed[-1]:.0f} m/s: {how}"
    return f"{found.critical:.0f} m/s: {how}"


def _speed(speed: float) -> str:
    return f"{speed:.3g} m/s" if speed < np.inf else "none up to 150 m/s"


def _axles(run: VehicleRun) -> list[tuple[str, str]]:
    """Return name and prefix of the columns of all wheelsets."""
    names = [run.simulation.names[i] for i in run.simulation.model.wheelsets]
    return [(name, name.replace(" ", "_")) for name in names]


def _safety(run: VehicleRun) -> Table:
    s, rows = run.series, []
    loads = run.simulation.model.bodies["load"][run.simulation.model.wheelsets]
    for (name, prefix), load in zip(_axles(run), loads, strict=True):
        lateral, vertical = (np.array([s[f"{prefix}_{side}_{what}"] for side in SIDES]) for what in _FORCES)
        found = assess.safety(lateral, vertical, s["distance"], s["time"], float(load))
        rows.append(
            (
                name,
                f"{found.quotient:.3f}",
                f"{1e-3 * found.guiding:.1f}",
                f"{1e-3 * found.prudhomme:.1f}",
                f"{1e-3 * found.vertical:.1f}",
                f"{found.unloading:.3f}",
            )
        )
    return Table(
        "Safety, greatest values",
        [("", ""), ("Y/Q", ""), ("ΣY", "kN"), ("Prud'homme", "kN"), ("Q", "kN"), ("1 − Q/Q₀", "")],
        rows,
    )


def _sections(run: VehicleRun) -> Table | None:
    """Return the assessment by sections, or None if the track has none that the whole vehicle has run over."""
    s, scenario = run.series, run.scenario
    model = run.simulation.model
    behind = -float(model.bodies["place"][model.wheelsets].min())
    found = en14363.sections(
        scenario.declared.track, scenario.declared.recording.settling, float(s["distance"][-1]) - behind
    )
    rows = []
    for section in found:
        of = []
        for (_, prefix), i in zip(_axles(run), model.wheelsets, strict=True):
            lateral, vertical = (np.array([s[f"{prefix}_{side}_{what}"] for side in SIDES]) for what in _FORCES)
            place = s["distance"] + float(model.bodies[i]["place"])
            of.append(en14363.values(section, lateral, vertical, place, s["time"], float(model.bodies[i]["load"])))
        rows.append(_told(section.name, [max(column) for column in zip(*map(astuple, of), strict=True)]))
        radius = 1.0 / abs(section.curvature) if section.curvature else np.inf
        least = float(model.bodies["load"][model.wheelsets].min())
        rows.append(_told("limit", list(astuple(en14363.limits(least, radius)))))
    heads = [
        ("ΣY", "kN"),
        ("Y/Q", ""),
        ("Q", "kN"),
        ("Y quasi-static", "kN"),
        ("Q quasi-static", "kN"),
        ("rms ΣY", "kN"),
    ]
    return Table("Sections of EN 14363", [("", ""), *heads], rows) if rows else None


def _told(name: str, values: list[float]) -> tuple[str, ...]:
    """Return a row of the assessment: forces in kN, the quotient as it is."""
    told = [
        "" if np.isnan(value) else f"{value:.3f}" if k == 1 else f"{1e-3 * value:.1f}" for k, value in enumerate(values)
    ]
    return name, *told


#: What the panels under a heading show.
_EXPLAINED = {
    "Track": "Of the vehicle's reference: speed; curvature, positive to the right; cant, positive where the left rail is "
    "higher.",
    "Motion": "Lateral displacement (y) and yaw of the wheelsets against the ideal track, to the right and clockwise from "
    "above; lateral displacement of the first body; the lateral acceleration that is felt there in the plane of the track, to "
    "the right: what a passenger and an accelerometer on the floor feel, cant included.",
    "Forces": "Of each wheel on its rail: Y outwards, Q downwards; means between two samples, not filtered.",
    "Friction": "T-gamma: creep force times creepage, the energy that a wheel spends on each metre; contact angle of the patch "
    "with the largest normal force, positive if its rail pushes the wheel to the track's centre.",
}
_FORCES = ("lateral_force", "vertical_force")


def _wheels(run: VehicleRun) -> Table:
    s = run.series
    counted = s["distance"] >= run.scenario.declared.recording.settling
    rows = []
    for name, prefix in _axles(run):
        for side in SIDES:
            of = {what: s[f"{prefix}_{side}_{what}"][counted] for what in ("T_gamma", "dissipation", "max_pressure")}
            if counted.any():
                rows.append(
                    (
                        f"{name}, {side}",
                        number(float(of["T_gamma"].mean())),
                        number(float(of["T_gamma"].max())),
                        number(float(of["dissipation"].mean())),
                        number(1e-6 * float(of["max_pressure"].max())),
                    )
                )
    heads = [("wheel", ""), ("T-gamma, mean", "N"), ("greatest", "N"), ("dissipation, mean", "N"), ("pressure", "MPa")]
    return Table("Wheels", heads, rows)


def _panels(run: VehicleRun) -> dict[str, dict[str, dict[str, Any]]]:
    s, axles = run.series, _axles(run)

    def wheels(what: str, factor: float, side: str) -> dict[str, Any]:
        return {name: factor * s[f"{prefix}_{side}_{what}"] for name, prefix in axles}

    def both(label: str, what: str, factor: float) -> dict[str, dict[str, Any]]:
        return {f"{side} {label}": wheels(what, factor, side) for side in SIDES}

    body = run.simulation.names[0].replace(" ", "_")
    return {
        "Track": {
            "speed [m/s]": {"speed": s["speed"]},
            "curvature [1/km]": {"curvature": 1e3 * s["curvature"]},
            "cant [mrad]": {"cant": 1e3 * s["cant"]},
        },
        "Motion": {
            "y [mm]": {name: 1e3 * s[f"{prefix}_lateral"] for name, prefix in axles},
            "yaw [mrad]": {name: 1e3 * s[f"{prefix}_yaw"] for name, prefix in axles},
            f"{run.simulation.names[0]} y [mm]": {"lateral": 1e3 * s[f"{body}_lateral"]},
            "felt, lateral [m/s²]": {"lateral acceleration": s[f"{body}_lateral_acceleration"]},
        },
        "Forces": {**both("Y [kN]", "lateral_force", 1e-3), **both("Q [kN]", "vertical_force", 1e-3)},
        "Friction": {
            **both("T-gamma [N]", "T_gamma", 1.0),
            **{f"{side} angle [°]": wheels("contact_angle", inwards, side) for side, inwards in INWARDS.items()},
        },
    }
