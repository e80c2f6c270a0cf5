"""Figure of a wheelset on its rails with its contact points and contact patches."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contact.arrays import Array
from contact.errors import ContactError
from contact.plot.patches import Scale, patch
from contact.plot.style import FAINT, INK, LINES, MM, drawn
from contact.results import Solution

#: Notes on the profiles below their picture: letters to the inch, height of a line and of the space above [inch].
_LETTERS, _LINE, _GAP = 15.0, 0.15, 0.15

if TYPE_CHECKING:
    from contact.geometry.profile import Profile
    from contact.geometry.records import Patch


@dataclass(frozen=True)
class Wheel:
    """One wheel on its rail: profiles (right-side convention), and its patches with their solutions."""

    side: str
    wheel: Profile
    rail: Profile
    patches: Sequence[Patch]
    solutions: Sequence[Solution]

    def __post_init__(self) -> None:
        if self.side not in ("right", "left"):
            raise ContactError(f"side = {self.side!r} is neither 'right' nor 'left'")
        if len(self.patches) != len(self.solutions):
            raise ContactError(f"{len(self.patches)} patches have {len(self.solutions)} solutions")


def position(wheels: Sequence[Wheel], roll: float = 0.0) -> Figure:
    """Draw wheels on rails, seen from behind, and below them all contact patches as by `patch`.

    All normal forces on the wheels have the same scale. Each profile is shifted onto its first contact point. The positions
    are therefore accurate to a tenth of a millimetre, and the approach is not visible.

    Parameters
    ----------
    wheels : sequence of Wheel
        Wheels from left to right.
    roll : float
        Roll of the wheelset [rad], by which the wheels' profiles are rotated.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there is no wheel, or no wheel touches its rail.
    """
    solutions = [s for w in wheels for s in w.solutions]
    if not solutions:
        raise ContactError("wheels holds no contact patch; at least one is needed")
    titles = [
        f"{w.side} {k + 1}: {math.degrees(p.contact_angle):+.1f}°".replace("-", "−")
        for w in wheels
        for k, p in enumerate(w.patches)
    ]
    width, height = Scale(solutions).figure_size(len(solutions))
    width = max(width, 4.0 * len(wheels))
    notes = sorted(
        {f"{each.name or each.kind}: {each.note}" for w in wheels for each in (w.wheel, w.rail) if each.note}
    )
    lines = [line for note in notes for line in textwrap.wrap(note, round(_LETTERS * width))]
    above = 0.55 * width / len(wheels) + 0.3 + (_LINE * len(lines) + _GAP if lines else 0.0)
    with drawn(width, height + above) as figure:
        parts = figure.subfigures(2, 1, height_ratios=[above, height], squeeze=False)[:, 0]
        axes = parts[0].subplots(1, len(wheels), squeeze=False)[0]
        strongest = max(s.N for s in solutions)
        for ax, wheel in zip(axes, wheels, strict=True):
            _section(ax, wheel, roll, strongest)
        axes[0].set_ylabel("z [mm], down")
        if lines:
            parts[0].supxlabel("\n".join(lines), fontsize=8.0, color=FAINT)
    patch(solutions, titles, figure=parts[1])
    return figure


def _section(ax: Axes, wheel: Wheel, roll: float, strongest: float) -> None:
    """Draw both profiles in track coordinates around the railhead, contact points and normal forces."""
    mirror = 1.0 if wheel.side == "right" else -1.0
    ax.set(title=f"{wheel.side} wheel, from behind", xlabel="y [mm]", aspect="equal")
    if not wheel.patches:
        ax.text(0.5, 0.5, "no contact", ha="center", transform=ax.transAxes)
        return
    turned = wheel.wheel.rotated(mirror * roll)
    first = wheel.patches[0]
    cos, sin = math.cos(mirror * roll), math.sin(mirror * roll)
    on_wheel = (cos * first.on_wheel[0] - sin * first.on_wheel[1], sin * first.on_wheel[0] + cos * first.on_wheel[1])
    rail_y, rail_z = _placed(wheel.rail, first.on_rail, first.position, mirror)
    wheel_y, wheel_z = _placed(turned, on_wheel, first.position, mirror)
    middle = 0.5 * (rail_y.min() + rail_y.max())
    crown = rail_z.min()
    low, high = crown - 30.0, crown + 42.0
    ax.fill(np.r_[rail_y, rail_y[-1], rail_y[0]], np.r_[rail_z, high, high], color="#e4e7ea", lw=0.0)
    ax.fill(np.r_[wheel_y, wheel_y[-1], wheel_y[0]], np.r_[wheel_z, low, low], color="#eef1f4", lw=0.0)
    ax.plot(rail_y, rail_z, color=INK, lw=1.0)
    ax.plot(wheel_y, wheel_z, color=FAINT, lw=1.0)
    for k, (p, s) in enumerate(zip(wheel.patches, wheel.solutions, strict=True)):
        y, z = MM * p.position[1], MM * p.position[2]
        # the force on the wheel points against the z axis of the contact frame, (−sin γ, cos γ) in (y, z)
        length = 24.0 * p.share * s.N / strongest
        ax.annotate(
            "",
            (y + length * math.sin(p.angle), z - length * math.cos(p.angle)),
            (y, z),
            arrowprops={"arrowstyle": "-|>", "color": LINES[k], "lw": 1.6, "shrinkA": 0.0, "shrinkB": 0.0},
        )
        ax.plot(y, z, "o", color=LINES[k], ms=4.0)
        ax.annotate(
            str(k + 1), (y, z), (0.0, -12.0), textcoords="offset points", color=LINES[k], ha="center", weight="bold"
        )
    ax.set(xlim=(middle - 66.0, middle + 66.0), ylim=(high - 2.0, low + 2.0))


def _placed(
    profile: Profile, point: tuple[float, float], place: tuple[float, float, float], mirror: float
) -> tuple[Array, Array]:
    """Return the outline (y, z) in track coordinates [mm] of a right-side profile whose `point` lies at `place`."""
    return MM * (place[1] + mirror * (profile.y - point[0])), MM * (place[2] + profile.z - point[1])
