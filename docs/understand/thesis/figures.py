"""What the pages on the thesis share: their cases, the reference, and how figures look.

The half space of this project, element by element (`contact.halfspace`), stands in the role of CONTACT.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib_inline.backend_inline import set_matplotlib_formats
from myst_nb import glue

import contact
from contact.geometry import profile, wheelset
from contact.halfspace.influence import integrals
from contact.plot.style import INK, LINES, style
from contact.theory import kalker
from contact.theory.hertz import local_factors

sys.path.insert(0, str(Path(__file__).parents[2]))
from contact.study.ellipse import ellipse as _ellipse

set_matplotlib_formats("svg")
_STYLE = style()
_STYLE.__enter__()  # for the life of the page

LOAD, C, MU = 52.36e3, 5e-3, 0.3  # N, √(ab), friction: the mean pressure of a wheel on a rail, p0 = 1000 MPa
CIRCLE = contact.Material(82e9, 0.25)  # Poisson's ratio of the thesis' circular cases
WHEEL_LOAD = 80e3
WHEEL, RAIL = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
REFERENCE = "halfspace"
#: A method has one colour on all pages; of those that meet in a figure no two have the same.
_COLOURS = {
    "fastsim": 0, "fastsim_one": 3, "fastsim_elliptic": 4, "fastrip": 1, "fastrip_mapped": 2,
    "strip_theory": 3, "carter": 4, "vermeulen_johnson": 4,
    "linear_saturated": 5, "shen_hedrick_elkins": 3, "polach": 4,
    "analyn": 1, "hertz": 0, "kik_piotrowski": 2, "kik_piotrowski_2008": 3, "stripes_ab": 4,
}  # fmt: skip


def ellipse(aspect: float = 1.0) -> contact.Separation:
    """The separation whose ellipse has a/b = `aspect` and √(ab) = C under LOAD."""
    return _ellipse(aspect, C, LOAD, CIRCLE)


def curvatures(aspect: float) -> tuple[float, float]:
    """A and B of that separation [1/m]."""
    separation = ellipse(aspect)
    return float(separation.A[0]), float(separation.g[-1] / separation.y[-1] ** 2)


def creepage(x: float = 0.0, y: float = 0.0, spin: float = 0.0, aspect: float = 1.0) -> contact.Creepage:
    """The creepage to which linear theory answers with forces -x, -y and, by spin, -spin, over mu N."""
    c11, c22, c23, _ = kalker.coefficients(kalker.table(CIRCLE.poisson_ratio), math.log(aspect))
    unit = MU * LOAD / (CIRCLE.shear_modulus * C**2)
    return contact.Creepage(x * unit / c11, y * unit / c22, spin * unit / (c23 * C))


def solve(rolling: contact.Creepage, tangential: str, aspect: float = 1.0, n: int = 48) -> contact.Solution:
    """One case on an ellipse under Hertz's pressure."""
    return contact.solve(
        ellipse(aspect), rolling, load=LOAD, friction=MU, material=CIRCLE, normal="hertz", tangential=tangential,
        n_strips=n, n_elements=n,
    )  # fmt: skip


def sweep(
    rolling: Sequence[contact.Creepage], methods: Sequence[str], aspect: float = 1.0, n: int = 40
) -> dict[str, np.ndarray]:
    """-Fx/(mu N), -Fy/(mu N), -Mz/(mu N c) of each method over a list of creepages, rows of an array."""
    scale = -np.array([[1.0], [1.0], [C]]) * MU * LOAD
    result = {}
    for method in methods:
        solved = [solve(creep, method, aspect, n) for creep in rolling]
        result[method] = np.array([[s.Fx, s.Fy, s.Mz] for s in solved]).T / scale
    return result


def real_patch(y: float, load: float = WHEEL_LOAD) -> wheelset.Patch:
    """The main contact of the right wheel, S1002 on 60E1 at 1:40, the wheelset displaced by `y` [m] to the right."""
    patches = wheelset.contacts(WHEEL, RAIL, wheelset.Pose(y=y), side="right", load=load)
    return max(patches, key=lambda patch: patch.load)


def note(name: str, value: float) -> None:
    """Keep a number for the text of the page."""
    glue(name, float(value), display=False)


def look(name: str) -> dict[str, object]:
    """How the line of a method is drawn; of a pair "normal + tangential" the normal one counts."""
    first = name.split()[0]
    if first in (REFERENCE, "half"):
        return {"color": INK, "lw": 2.6, "alpha": 0.55, "label": "half space"}
    return {"color": LINES[_COLOURS[first.rstrip(":")]], "lw": 1.5, "label": name}


def lines(ax: plt.Axes, x: np.ndarray, curves: Mapping[str, np.ndarray]) -> None:
    """Curves over one abscissa; the reference is broad and grey, below the others."""
    for name, values in curves.items():
        ax.plot(x, values, **look(name))
    ax.grid(visible=True)
    ax.margins(x=0.0)


def outline(ax: plt.Axes, solution: contact.Solution, **look: object) -> None:
    """The edge of a patch seen from above, in mm."""
    for k, (low, high) in enumerate(solution.patch_edges):
        own = solution.strips.patch == k
        y = 1e3 * np.r_[low, solution.strips.y[own], high]
        a, centre = np.pad(solution.strips.a[own], 1), np.pad(solution.strips.x_c[own], 1, mode="edge")
        label = look.pop("label", None) if k == 0 else None
        ax.plot(np.r_[y, y[::-1]], 1e3 * np.r_[centre + a, (centre - a)[::-1]], label=label, **look)
    ax.set(aspect="equal", xlabel="y [mm]", ylabel="x [mm], rolling ↑")
    ax.grid(visible=True)


def normalised(x: float, y: float, spin: float, traction: float) -> contact.Creepage:
    """Creepages in Kalker's normalisation, G = c = 1, where mu N is `traction`, on our circle."""
    unit = MU * LOAD / (CIRCLE.shear_modulus * C**2) / traction
    return contact.Creepage(x * unit, y * unit, spin * unit / C)


def shade(ax: plt.Axes, solution: contact.Solution) -> None:
    """Grey slip zones."""
    slips = (solution.p > 0.0) & ~solution.stick
    ax.contourf(1e3 * solution.y, 1e3 * solution.x, slips, levels=[0.5, 1.5], colors=["#c4c8cd"])


def arrows(ax: plt.Axes, solution: contact.Solution, every: int = 4) -> None:
    """Tractions of every so many elements."""
    part = slice(every // 2, None, every)
    y, x, qy, qx = (field[part, part] for field in (solution.y, solution.x, solution.qy, solution.qx))
    ax.quiver(1e3 * y, 1e3 * x, qy, qx, color=INK, pivot="mid", width=0.006)


def on_patch(patch: wheelset.Patch, normal: str, tangential: str = "fastrip", n: int = 60) -> contact.Solution:
    """A real patch under its load, in free rolling."""
    return contact.solve(
        patch.separation, patch.creepage, load=patch.load, friction=MU, normal=normal, tangential=tangential,
        n_strips=n, n_elements=n,
    )  # fmt: skip


def half_space(patch: wheelset.Patch, n: int = 72) -> contact.Solution:
    """The half space on that patch."""
    return on_patch(patch, REFERENCE, REFERENCE, n)


def displacement(solution: contact.Solution, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Normal displacement of the half space at points (x, y) under the pressure of a solution on a grid [m]."""
    own_x, own_y, p = solution.grid
    dx, dy = own_x[1] - own_x[0], own_y[1] - own_y[0]
    I1, I2, _ = integrals(x[:, None, None] - own_x, y[:, None, None] - own_y[:, None], dx, dy)
    return ((I1 + I2) * p).sum(axis=(1, 2)) / (np.pi * solution.material.contact_modulus)


def assumed_displacement(
    separation: contact.Separation, y: np.ndarray, a: np.ndarray, step: float = 1e-3
) -> np.ndarray:
    """ANALYN's displacement on the edge (a, y), alpha A a² + beta g (theory.md 3.1), with B over a fixed step [m]."""
    A, g, before, behind = (
        np.interp(y + shift, separation.y, values)
        for values, shift in ((separation.A, 0.0), (separation.g, 0.0), (separation.g, -step), (separation.g, step))
    )
    B = np.maximum(0.5 * (before - 2.0 * g + behind) / step**2, 0.1)
    alpha, beta = np.array([local_factors(*pair)[:2] for pair in zip(A, B, strict=True)]).T - 1.0
    return alpha * A * a**2 + beta * g
