"""The commands `geometry`, `conicity` and `profiles`: rigid contact points and equivalent conicity of wheels on rails."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.console import Console

from contact.arrays import Array
from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import deliver, drawing, reported
from contact.cli.tables import show_table
from contact.errors import require_number
from contact.geometry import conicity as conicity_of
from contact.geometry import contact_points, equivalent_conicity, nonlinearity, profile, steering
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK

_SHOWN = 21  # lines of a printed table of contact points; files contain all lines
_CURVE = 121  # amplitudes of a drawn curve
_CURVES = (300.0, 600.0, 1000.0)  # radii [m] for the steering index
#: Heading, column and factor of the printed table. Files also contain the rolling radii.
_POINTS: Sequence[tuple[tuple[str, str], str, float]] = (
    (("y", "mm"), "y", 1e3),
    (("Δr", "mm"), "radius_difference", 1e3),
    (("Δγ", "°"), "angle_difference", np.degrees(1.0)),
    (("γ right", "°"), "right_angle", np.degrees(1.0)),
    (("left", "°"), "left_angle", np.degrees(1.0)),
    (("wheel y right", "mm"), "right_on_wheel", 1e3),
    (("left", "mm"), "left_on_wheel", 1e3),
    (("rail y right", "mm"), "right_on_rail", 1e3),
    (("left", "mm"), "left_on_rail", 1e3),
)


@dataclass
class WheelsetOptions(arguments.Wheels):
    """Both wheels on both rails."""

    left_wheel: opt.LeftWheel = None
    left_rail: opt.LeftRail = None
    left_radius: opt.LeftRadius = None
    roll: opt.Rolls = False

    @property
    def names(self) -> tuple[str | None, ...]:
        """Names of the profiles of both sides."""
        return *super().names, self.left_wheel, self.left_rail

    def both(self) -> dict[str, Any]:
        """Return the arguments of `contact_points` and `conicity`."""
        wheel, rail = self.profiles
        return {
            "wheel": wheel,
            "rail": rail,
            "left_wheel": None if self.left_wheel is None else self.load(self.left_wheel, "wheel"),
            "left_rail": None if self.left_rail is None else self.load(self.left_rail, "rail"),
            "left_radius": self.left_radius,
            **self.lengths,
            "roll": self.roll,
        }


@reported
def geometry(
    *,
    wheelset: WheelsetOptions,
    reach: opt.Reach = 0.01,
    step: opt.Step = 1e-4,
    output: arguments.Output,
) -> None:
    """Compute contact points of rigid wheels on rails: rolling radii and contact angles over the lateral displacement.

    Example:  contact geometry --wheel 1/40 --rail UIC60 --inclination 1/20 --max 8e-3 --out points.png
    """
    pair = wheelset.both()
    n = round(reach / require_number("step", step, 1e-6, reach))
    found = contact_points(**pair, y=np.linspace(-reach, reach, 2 * n + 1))
    columns = found.columns()
    output.deliver(
        columns,
        show=lambda console: _show_points(columns, _title(pair), console),
        rows=lambda: _rows(columns),
        figure=lambda: drawing().contact_points(found, pair["wheel"], pair["rail"]),
    )


@reported
def conicity(
    *,
    wheelset: WheelsetOptions,
    amplitude: opt.Amplitudes = None,
    curve_radius: opt.CurveRadius = None,
    output: arguments.Output,
) -> None:
    """Compute the equivalent conicity over the amplitude by EN 15302, Klingel's wavelength, and steering in curves.

    Example:  contact conicity --wheel s1002 --rail 60e2 --gauge 1.432 --out conicity.png
    """
    pair = wheelset.both()
    found = conicity_of(**pair, amplitudes=amplitude or None)
    base = wheelset.back_to_back + 2.0 * TAPE_FROM_FLANGE_BACK
    wave = found.wavelength(base, wheelset.radius)
    turned = steering(found.points, curve_radius or _CURVES, base=base, radius=wheelset.radius)
    bent = nonlinearity(found.points) if found.amplitude.max() >= 4e-3 else None
    columns = {"amplitude": found.amplitude, "conicity": found.conicity, "centre": found.centre, "wavelength": wave}

    def show(console: Console) -> None:
        rows = [
            [f"{1e3 * a:g}", f"{c:.3f}", f"{w:.2f}" if np.isfinite(w) else "-", f"{1e3 * y:.2f}"]
            for a, c, w, y in zip(found.amplitude, found.conicity, wave, found.centre, strict=True)
        ]
        headings = [(name, "") for name in ("amplitude [mm]", "tan γe", "wavelength [m]", "centre [mm]")]
        show_table(_title(pair), headings, rows, console)
        if bent is not None:
            console.print(f"nonlinearity parameter {1e-3 * bent:+.3f} 1/mm, from 2 to 4 mm", highlight=False)
        indices = ", ".join(f"{q:.2f} at {R:g} m" for q, R in zip(turned.index, turned.curve_radius, strict=True))
        console.print(
            f"radial steering index {indices}; the profiles steer down to {turned.smallest_radius:.0f} m "
            f"(Δr {1e3 * turned.available:.2f} mm at y = {1e3 * turned.at:.1f} mm)",
            highlight=False,
        )

    def figure() -> Any:
        curve = equivalent_conicity(found.points, np.linspace(5e-4, found.amplitude.max(), _CURVE))
        return drawing().conicity(curve, found, _title(pair))

    more = {"nonlinearity": bent, "steering": vars(turned)}
    output.deliver(columns | more, show=show, rows=lambda: _rows(columns), figure=figure)


@reported
def list_profiles(as_json: opt.Json = False) -> None:
    """List the standard profiles for --wheel and --rail."""
    rows = [
        {"name": name, "kind": kind, "aliases": [alias for alias, known in profile.ALIASES.items() if known == name]}
        for kind in ("wheel", "rail")
        for name in profile.names(kind)
    ]

    headings = [("name", ""), ("kind", ""), ("also called", "")]
    cells = [[str(row["name"]), str(row["kind"]), ", ".join(row["aliases"])] for row in rows]
    deliver({"profiles": rows}, show=lambda console: show_table("", headings, cells, console), as_json=as_json)


def _title(pair: Mapping[str, Any]) -> str:
    wheels, rails = (
        " and ".join(given.name for given in (pair[kind], pair[f"left_{kind}"]) if given) for kind in ("wheel", "rail")
    )
    return f"{wheels} on {rails}, gauge {1e3 * pair['gauge']:g} mm, back to back {1e3 * pair['flange_back']:g} mm"


def _rows(columns: Mapping[str, Array]) -> list[dict[str, Any]]:
    """Return the rows of a table. Infinite values become None, an empty cell."""
    lines = zip(*(values.tolist() for values in columns.values()), strict=True)
    return [dict(zip(columns, (v if np.isfinite(v) else None for v in line), strict=True)) for line in lines]


def _show_points(columns: Mapping[str, Array], title: str, console: Console) -> None:
    n = columns["y"].size
    rows = [
        [f"{factor * columns[name][k] + 0.0:.2f}" for _, name, factor in _POINTS]
        for k in np.unique(np.linspace(0, n - 1, min(n, _SHOWN)).round().astype(int))
    ]
    show_table(title, [heading for heading, _, _ in _POINTS], rows, console)
