"""Every number in the text of the thesis that can be computed, ours beside it: docs/understand/thesis/agreement.md."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

import contact
import reference
from benchmarks.tables import table
from contact.damage import evaluate
from contact.geometry import profile, wheelset
from contact.study.ellipse import ellipse
from contact.theory import kalker
from reference import accuracy

C, LOAD, MU = 5e-3, reference.N_ELLIPSE, reference.MU
QUARTER = contact.Material(82e9, 0.25)


def on_ellipse(creepage: contact.Creepage, method: str, aspect: float = 1.0, n: int = 48) -> contact.Solution:
    """Return a case with √(ab) = 5 mm under Hertz's pressure."""
    return contact.solve(
        ellipse(aspect, C, LOAD, QUARTER), creepage, load=LOAD, friction=MU, material=QUARTER, normal="hertz",
        tangential=method, n_strips=n, n_elements=n,
    )  # fmt: skip


def rolling(x: float = 0.0, spin: float = 0.0, aspect: float = 1.0) -> contact.Creepage:
    """Return the creepage to which linear theory answers with these shares of friction times load."""
    c11, _, c23, _ = kalker.coefficients(kalker.table(0.25), math.log(aspect))
    unit = MU * LOAD / (QUARTER.shear_modulus * C**2)
    return contact.Creepage(x * unit / c11, spin=spin * unit / (c23 * C))


def vermeulen_johnson() -> str:
    """Return the excess of their slope on a circle."""
    creepage = rolling(1e-5)
    return f"{100 * (abs(on_ellipse(creepage, 'vermeulen_johnson').Fx) / (1e-5 * MU * LOAD) - 1):.0f} %"


def strip_theory(x: float, spin: float, aspect: float) -> str:
    """Return by how much the strip theory's force lies below the half space's at a tenth of saturation."""
    creepage = rolling(x, spin, aspect)
    force = {}
    for method in ("strip_theory", "halfspace"):
        solution = on_ellipse(creepage, method, aspect)
        force[method] = math.hypot(solution.Fx, solution.Fy)
    true, ours = force["halfspace"], force["strip_theory"]
    return (
        f"{100 * (true / ours - 1):.0f} % of strip theory's force, {100 * (1 - ours / true):.0f} % of the half space's"
    )


def worst(method: str, *curves: str) -> str:
    """Return the largest error on the ellipses of set A, a/b from .2 to 5."""
    errors = accuracy.errors_on_ellipses(method)["force"]
    return (
        f"{100 * max(e for e, row in zip(errors, reference.ellipses(), strict=True) if row['curve'] in curves):.0f} %"
    )


def large_spin() -> str:
    """Return the error of FASTSIM's lateral force at several spins on a circle."""
    found = []
    for spin in (2.0, 5.0, 10.0):
        force = {m: on_ellipse(rolling(spin=spin), m).Fy for m in ("fastsim", "halfspace")}
        found.append(f"{100 * (force['fastsim'] / force['halfspace'] - 1):.0f} % at {spin:g}")
    return ", ".join(found)


def bound() -> str:
    """Return the excess of FASTSIM's bound in the middle, and its mean size over the ellipse."""
    solution = on_ellipse(contact.Creepage(0.1), "fastsim", n=41)
    middle = np.hypot(solution.qx, solution.qy).max() / (MU * solution.max_pressure) - 1.0
    root = (np.arange(4000) + 0.5) / 4000
    return f"{100 * middle:.1f} %, mean {100 * 2 * (np.abs(4 / 3 * root - 1) * root).mean():.1f} %"


def figure_7_4() -> str:
    """Return length and width of the patches of virtual penetration over those of Hertz's ellipse."""
    separation = contact.Separation.hertzian(0.5 / 0.46, 0.5 * (1.0 / 0.08 - 1.0 / 0.2))
    sizes = {}
    for method in ("hertz", "linder", "kik_piotrowski", "stripes_a", "stripes_ab"):
        solution = contact.solve(
            separation, contact.Creepage(), approach=50e-6, normal=method, tangential="fastsim", n_strips=200
        )
        ((low, high),) = solution.patch_edges
        sizes[method] = float(solution.strips.a.max()), 0.5 * (high - low)
    a, b = sizes.pop("hertz")
    return "; ".join(f"{name} {own / a:.2f} × {wide / b:.2f}" for name, (own, wide) in sizes.items())


def energy_index() -> str:
    """Return the largest energy index over the half space's and its distance from it, free rolling in the middle."""
    rail = profile.rail_60e1(inclination=1 / 40)
    patch = wheelset.contacts(profile.s1002(), rail, wheelset.Pose(), side="right", load=80e3)[0]
    found = {}
    for normal, tangential in (("halfspace", "halfspace"), ("analyn", "fastrip"), ("hertz", "fastsim")):
        solution = contact.solve(
            patch.separation, patch.creepage, load=patch.load, normal=normal, tangential=tangential, n_strips=50,
            n_elements=50,
        )  # fmt: skip
        field = evaluate(solution).energy_index.field
        at = np.unravel_index(np.argmax(field), field.shape)
        found[normal] = field[at], np.array([solution.x[at], solution.y[at]])
    true, place = found.pop("halfspace")
    words = (f"{n} {v / true:.2f} of it, {1e3 * np.hypot(*(at - place)):.0f} mm away" for n, (v, at) in found.items())
    return "; ".join(words)


def opposing(method: str) -> str:
    """Return the largest error with lateral creepage against spin on circles of set A."""
    errors = accuracy.errors_on_ellipses(method)["force"]
    own = [
        e for e, r in zip(errors, reference.ellipses(), strict=True) if r["curve"] == "eta_spin_opp" and r["aob"] == 1
    ]
    return f"{100 * max(own):.1f} %"


def pressures() -> str:
    """Return the mean error of the pressure field on the real patches of set D, at CONTACT's load."""
    methods = ("analyn", "stripes_a", "stripes_ab", "kik_piotrowski", "linder")
    return ", ".join(f"{m} {100 * accuracy.errors_of_normal(m, True)['L2'].mean():.0f} %" for m in methods)


#: Where, what the thesis says (read in its text), how ours is computed, and our verdict.
CLAIMS: list[tuple[str, str, Callable[[], str], str]] = [
    ("4.2", "Johnson's slopes on a circle are about 20 % off Kalker's", vermeulen_johnson, "agrees"),
    (
        "4.4",
        "strip theory, longitudinal creepage, circle: 25 %",
        lambda: strip_theory(0.1, 0.0, 1.0),
        "agrees, of strip theory's force",
    ),
    (
        "4.4",
        "strip theory, pure spin, a/b = .2: up to 20 %",
        lambda: strip_theory(0.0, 0.1, 0.2),
        "agrees, of strip theory's force",
    ),
    (
        "4.4",
        "strip theory, pure spin, circle: 40 %",
        lambda: strip_theory(0.0, 0.1, 1.0),
        "agrees, of strip theory's force",
    ),
    (
        "4.6",
        "FASTSIM, pure creepage: about 10 %",
        lambda: worst("fastsim", "xi", "eta"),
        "ours is better: second order, three flexibilities",
    ),
    ("4.6", "FASTSIM, longitudinal creepage and spin: about 10 %", lambda: worst("fastsim", "xi_spin"), "agrees"),
    (
        "4.6",
        "FASTSIM, lateral creepage and spin: up to 20 %",
        lambda: worst("fastsim", "eta_spin_aid", "eta_spin_opp"),
        "agrees",
    ),
    ("4.6, Fig. 4.15", "FASTSIM, very large spin, circle: more than 25 %", large_spin, "agrees"),
    (
        "5.2, Fig. 5.2",
        "cubic saturation accurate for pure creepage",
        lambda: worst("shen_hedrick_elkins", "xi"),
        "agrees",
    ),
    ("5.2, Fig. 5.3", "and poor with spin", lambda: worst("shen_hedrick_elkins", "phi"), "agrees"),
    (
        "7.1, Fig. 7.4",
        "radii 200, 80 and 460 mm: the A correction is Hertz's ellipse, AB has its length and another width",
        figure_7_4,
        "agrees",
    ),
    (
        "7.2, Fig. 7.5",
        "FASTSIM in full slip: over 33 % too high at the contact point, 25 % in the mean",
        bound,
        "agrees; the mean is 26.4 % in closed form",
    ),
    ("9.1, 9.2", "ANALYN's pressure is closer to CONTACT than that of virtual penetration", pressures, "agrees"),
    (
        "9.4, Fig. 9.8",
        "lateral creepage against spin, circle: FaStrip's error is smaller than FASTSIM's",
        lambda: f"fastrip {opposing('fastrip')}, fastsim {opposing('fastsim')}",
        "agrees",
    ),
    (
        "9.5, Fig. 9.11",
        "Hertz + FASTSIM underestimates the energy index and misses its place",
        energy_index,
        "see the numbers",
    ),
]


#: The figures of the thesis, their subject as its captions say, and where we have it.


def claims() -> str:
    """Return the table of docs/understand/thesis/agreement.md."""
    rows = [[where, says, ours(), verdict] for where, says, ours, verdict in CLAIMS]
    return table(["section", "the thesis says", "ours", "verdict"], rows)


if __name__ == "__main__":
    for where, says, ours, _ in CLAIMS:
        print(where, "|", says, "|", ours(), flush=True)
