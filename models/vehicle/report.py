"""The HTML page of a run with a vehicle: safety, forces, motion, damage and energies."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from contact import plot
from contact.study.page import document, faint, html_of
from contact.study.table import Table, number
from models.life.report import damage_of, declaration, illustrated, trusted, warned
from models.vehicle import assess, drawing
from models.vehicle.ledgers import BODIES
from models.vehicle.run import BALANCE, CONICITY_AT, RIGHT_BELOW, VehicleRun
from models.vehicle.simulation import SIDES
from models.wheelset.ports import INWARDS

#: Ratio of the conicities at two amplitudes from which on the report warns.
UNEQUAL = 2.0


def page_of(run: VehicleRun) -> str:
    """Return the run as a self-contained HTML page."""
    scenario, d = run.scenario, run.scenario.declared
    about = [
        f"{scenario.vehicle.name} over {d.length:g} m; damage of the first {d.recording.settling:g} m is not counted. Wheel "
        f"{scenario.wheel.name}, rail {scenario.rail.name}; {d.methods.normal} + {d.methods.tangential}.",
        "Y is the force of the rail on the wheel to the right, Q that of the wheel on the rail downwards. Both, and T-gamma, "
        "are means between two samples. Each patch has its own plane.",
    ]
    return document(scenario.name, about, _parts(run))


def _parts(run: VehicleRun) -> Iterator[str]:
    trust = run.trust
    yield from warned(trust)
    if run.series["distance"].size:
        yield html_of(_safety(run))
        yield faint(
            f"Low-passed at {assess.CUT_OFF:g} Hz; Y/Q and ΣY are means over {assess.WINDOW:g} m (EN 14363; the limits are "
            "recalled, not verified)."
        )
        yield html_of(_wheels(run))
        for heading, panels in _panels(run).items():
            yield f"<h2>{heading}</h2>"
            draw = partial(plot.time_histories, run.series["distance"], panels, xlabel="distance [m]")
            yield illustrated(draw, heading)
    yield from _vehicle(run)
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


def _vehicle(run: VehicleRun) -> Iterator[str]:
    """Yield what runs: drawing, numbers, frequencies and stability."""
    vehicle = run.scenario.vehicle
    yield "<h2>Vehicle</h2>"
    yield faint(f"{vehicle.name}. {vehicle.source}")
    yield f'<div class="wide">{drawing.drawing(vehicle)}</div>'
    yield html_of(drawing.bodies(vehicle))
    yield html_of(drawing.elements(vehicle))
    rows = [(f"{mode.frequency:.3g} Hz", f"{100.0 * mode.damping:.3g} %", name) for name, mode in run.modes()]
    yield html_of(
        Table("Modes at the slowest speed, up to 50 Hz", [("", ""), ("damping", ""), ("most moved", "")], rows)
    )
    at = [f"{value:.3g} at {1e3 * where:g} mm" for where, value in zip(CONICITY_AT, run.conicities, strict=False)]
    if at and max(run.conicities) > UNEQUAL * min(run.conicities):
        yield (
            f"<p><strong>The equivalent conicity depends on the amplitude: {' and '.join(at)}. The linear critical speed "
            "is that of small motions and says little of larger ones.</strong></p>"
        )
    yield faint(
        f"Equivalent conicity (EN 15302) {' and '.join(at) or 'not found'}. Linear critical speed "
        f"{_speed(run.critical_speed)}: "
        "the least speed at which motions of .1 mm grow, from the eigenvalues of the run's own kernel on straight ideal "
        "track, to 2 m/s. Larger motions have another one (models.vehicle.hunting)."
    )
    yield faint(
        f"A rail is one mass under each wheel. Its receptance is right below {RIGHT_BELOW:g} Hz: peaks at joints, flats and "
        "corrugation beyond that are not."
    )


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
    friction = run.scenario.friction.static
    limit = assess.nadal(assess.flange_angle(run.scenario.wheel), friction)
    return Table(
        "Safety, greatest values",
        [
            ("", ""),
            ("Y/Q", f"limit {assess.LARGEST_QUOTIENT:g}, Nadal {limit:.2f} at μ {friction:g}"),
            ("ΣY", "kN"),
            ("Prud'homme", "kN"),
            ("Q", "kN"),
            ("1 − Q/Q₀", ""),
        ],
        rows,
    )


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
            "felt [m/s²]": {"lateral acceleration": s[f"{body}_lateral_acceleration"]},
        },
        "Forces": {**both("Y [kN]", "lateral_force", 1e-3), **both("Q [kN]", "vertical_force", 1e-3)},
        "Friction": {
            **both("T-gamma [N]", "T_gamma", 1.0),
            **{f"{side} angle [°]": wheels("contact_angle", inwards, side) for side, inwards in INWARDS.items()},
        },
    }
