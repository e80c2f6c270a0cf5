"""Random but physical contact cases, and the worst margins of the post-conditions over them.

Every case is solved with `contact.forces`. Some are solved again with `contact.solve`, which also returns fields and
iterations.
"""

from __future__ import annotations

import functools
import itertools
import math
from typing import Any

import numpy as np

import contact
from contact.geometry import profile, wheelset
from contact.kernels.enumerations import NormalFamily, TangentialFamily
from contact.kernels.normal import analyn, by_approach, hertzian, strip_halfspace

#: Limit of the iterations of each normal method.
CAPS = dict.fromkeys(contact.methods().batched.normal, by_approach.MAX_ITERATIONS) | {
    "analyn": analyn._MAX_ITERATIONS,
    "hertz": hertzian._MAX_ITERATIONS,
    "strip_halfspace": strip_halfspace.MAX_ITERATIONS,
}
#: Family of a normal method → family of the tangential methods that a random case of a pair has with it, since Python compiles
#: the pair anew for every two. All two of them meet in the random cases of `WheelRailContact`.
PARTNERS = {
    NormalFamily.ANALYN: TangentialFamily.FASTRIP,
    NormalFamily.HERTZ: TangentialFamily.CREEP_FORCE,
    NormalFamily.STRIP_HALFSPACE: TangentialFamily.FASTRIP_MAPPED,
    NormalFamily.BY_APPROACH: TangentialFamily.FASTSIM,
}
Rng = np.random.Generator


@functools.cache
def pair() -> wheelset.Pair:
    """Return S1002 on 60E1, right side."""
    return wheelset.Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))


def from_pose(rng: Rng) -> contact.Separation:
    """Return a patch of S1002 on 60E1 at a random pose, including flange contact and yaw."""
    pose = wheelset.Pose(y=rng.uniform(-8e-3, 8e-3), roll=rng.uniform(-5e-3, 5e-3), yaw=rng.uniform(-15e-3, 15e-3))
    patches = pair().contacts(pose, load=10 ** rng.uniform(4, 5.3))
    return patches[rng.integers(len(patches))].separation


def worn(rng: Rng) -> contact.Separation:
    """Return a patch of new profiles with wear: waves of 6 to 40 mm length and up to 30 µm depth, shorter ones shallower."""
    new = from_pose(rng)
    g = new.g.copy()
    for _ in range(3):
        length = rng.uniform(6e-3, 40e-3)
        g += rng.uniform(0, 30e-6) * (length / 40e-3) * np.cos(2 * math.pi * (new.y / length + rng.uniform()))
    return contact.Separation(new.y, g, new.A, new.x_c)


def _support(rng: Rng, half: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return lateral positions, half curvature along x and contact locus of an artificial separation."""
    y = np.linspace(-half, half, int(rng.integers(41, 301)))
    A = 10 ** rng.uniform(-0.5, 0.5) * (1 + rng.uniform(-0.3, 0.3) * y / half)
    return y, A, rng.uniform(-0.05, 0.05) * y


def ellipse(rng: Rng) -> contact.Separation:
    """Return a separation of constant curvatures, a/b from about 0.1 to 10."""
    return contact.Separation.hertzian(10 ** rng.uniform(-0.5, 0.5), 10 ** rng.uniform(-1.3, 2))


def _cornered(
    rng: Rng, half: float, width: tuple[float, float], flat: tuple[float, float], corner: tuple[float, float]
) -> contact.Separation:
    """Return a gap with a small curvature within a width and a large one outside; curvatures are powers of ten."""
    y, A, x_c = _support(rng, half)
    w, B = rng.uniform(*width), 10 ** rng.uniform(*flat)
    return contact.Separation(y, B * y**2 + 10 ** rng.uniform(*corner) * np.maximum(np.abs(y) - w, 0) ** 2, A, x_c)


def near_conformal(rng: Rng) -> contact.Separation:
    """Return a gap whose curvature is small within a width and large outside."""
    return _cornered(rng, 25e-3, (3e-3, 15e-3), (-2, -0.5), (0, 1.5))


def nearly_flat(rng: Rng) -> contact.Separation:
    """Return a punch: a gap below one micrometre over some millimetres, then a corner."""
    return _cornered(rng, 20e-3, (1e-3, 10e-3), (-5, -2), (1, 2.5))


def two_lobed(rng: Rng) -> contact.Separation:
    """Return two parabolas side by side with a sharp or rounded ridge between them."""
    y, A, x_c = _support(rng, 30e-3)
    spacing, depth = rng.uniform(4e-3, 30e-3), 10 ** rng.uniform(-7, -4)
    one, other = (10 ** rng.uniform(-0.5, 1.5) * (y - s * spacing / 2) ** 2 for s in (-1, 1))
    other = other + depth
    sharpness = 10 ** rng.uniform(-6.5, -4.5)
    g = np.minimum(one, other) - sharpness * np.log1p(np.exp(-np.abs(one - other) / sharpness))
    return contact.Separation(y, g, A, x_c)


def asymmetric(rng: Rng) -> contact.Separation:
    """Return a curvature that jumps at or near the point of contact and grows on one side."""
    y, A, x_c = _support(rng, 20e-3)
    left, right = 10 ** rng.uniform(-1, 2, 2)
    g = np.where(y < 0, left, right) * y**2 + 10 ** rng.uniform(1, 3) * np.maximum(y - rng.uniform(0, 8e-3), 0) ** 3
    return contact.Separation(y, g, A, x_c)


def noisy(rng: Rng) -> contact.Separation:
    """Return one of the other separations with measurement noise of 2 µm on every sample."""
    clean = KINDS[list(KINDS)[rng.integers(len(KINDS) - 1)]](rng)
    return contact.Separation(clean.y, clean.g + rng.normal(0, 2e-6, clean.y.size), clean.A, clean.x_c)


KINDS = {
    "pose": from_pose,
    "worn": worn,
    "ellipse": ellipse,
    "near-conformal": near_conformal,
    "nearly flat": nearly_flat,
    "two-lobed": two_lobed,
    "asymmetric": asymmetric,
    "noisy": noisy,
}


def creepages(rng: Rng, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return n longitudinal, lateral and spin creepages: 1e-8 to 1, spin 1e-6 to 5 /m, both signs, one in ten exactly 0."""
    sign = rng.choice([-1.0, 0.0, 1.0], (3, n), p=[0.45, 0.1, 0.45])
    low, high = np.array([-8, -8, -6])[:, None], np.array([0, 0, math.log10(5)])[:, None]
    return tuple(sign * 10 ** rng.uniform(low, high, (3, n)))


def run(normal: str, tangential: str, n: int, seed: int, solved: int) -> dict[str, Any]:
    """Solve n random cases, `solved` of them again by `contact.solve`. Return counts of statuses and the worst margins."""
    rng = np.random.default_rng(seed)
    kinds = list(itertools.islice(itertools.cycle(KINDS), max(len(KINDS), n // 20)))
    separations = [KINDS[kind](rng) for kind in kinds]
    which = rng.integers(len(separations), size=n)
    creepage = creepages(rng, n)
    friction = rng.uniform(0.0, 0.8, n) * (rng.random(n) > 0.02)
    by_load = {"load": 10 ** rng.uniform(0, math.log10(250e3), n)}
    by_approach = {"approach": 10 ** rng.uniform(-8, -4, n) + np.array([separations[k].g.min() for k in which])}
    half = n // 2
    statuses, not_converged = np.zeros(max(contact.Status) + 1, dtype=int), np.zeros(len(KINDS), dtype=int)
    worst = {
        "finite": 0.0,
        "force": -1.0,
        "power": 0.0,
        "slip": 0.0,
        "load": 0.0,
        "sum": 0.0,
        "bound": -1.0,
        "work": 0.0,
    }
    iterations = 0
    for part, amount in ((slice(0, half), by_load), (slice(half, n), by_approach)):
        own = [separations[k] for k in which[part]]
        given = {name: values[part] for name, values in amount.items()}
        found = contact.forces(
            own,
            tuple(c[part] for c in creepage),
            friction=friction[part],
            normal=normal,
            tangential=tangential,
            **given,
        )
        columns = [getattr(found, name) for name in found.__slots__ if name != "jacobian"]
        worst["finite"] += sum(int((~np.isfinite(column)).sum()) for column in columns)
        statuses += np.bincount(found.status, minlength=statuses.size)
        np.add.at(not_converged, which[part][found.status == contact.Status.NOT_CONVERGED] % len(KINDS), 1)
        bound = friction[part] * found.N
        scale = np.where(bound > 0, bound, 1.0)
        excess = np.where(bound > 0, np.hypot(found.Fx, found.Fy) / scale - 1, np.hypot(found.Fx, found.Fy) - 1)
        worst["force"] = max(worst["force"], float(excess.max()))
        worst["power"] = min(worst["power"], float((found.power_per_metre / scale).min()))
        worst["slip"] = max(worst["slip"], float(found.slip_ratio.max()) - 1, float(-found.slip_ratio.min()))
        if "load" in given:
            worst["load"] = max(worst["load"], float(np.abs(found.N / given["load"] - 1).max()))
    for i in rng.choice(n, solved, replace=False):
        amount = by_load if i < half else by_approach
        given = {name: float(values[i]) for name, values in amount.items()}
        sol = contact.solve(
            separations[which[i]], contact.Creepage(*(float(c[i]) for c in creepage)), friction=float(friction[i]),
            normal=normal, tangential=tangential, throw=False, **given,
        )  # fmt: skip
        iterations = max(iterations, sol.iterations)
        if sol.N == 0.0:
            continue
        worst["sum"] = max(worst["sum"], abs(float((sol.p * sol.dA).sum()) / sol.N - 1))
        if not sol.has_fields:
            continue
        worst["finite"] += sum(int((~np.isfinite(f)).sum()) for f in (sol.x, sol.p, sol.qx, sol.qy, sol.sx, sol.sy))
        q, limit = np.hypot(sol.qx, sol.qy), sol.friction * sol.p
        if sol.friction > 0.0:
            worst["bound"] = max(worst["bound"], float((q - limit).max() / limit.max()))
            work = -(sol.qx * sol.sx + sol.qy * sol.sy)
            worst["work"] = min(
                worst["work"], float(work.min()) / (limit.max() * max(1e-12, np.abs(work).max() / limit.max()))
            )
    return {
        "cases": n,
        "solved": solved,
        "statuses": {s: int(statuses[s]) for s in contact.Status},
        "not converged": dict(zip(KINDS, not_converged.tolist(), strict=True)),
        "iterations": iterations,
        **worst,
    }


def method_pairs() -> list[tuple[str, str]]:
    """Return pairs of methods: every normal one with FaStrip, every tangential one with three normal ones (to save time)."""
    known = contact.methods().batched
    first = ((normal, "fastrip") for normal in known.normal)
    second = itertools.product(("analyn", "hertz", "strip_halfspace"), known.tangential)
    return list(dict.fromkeys((*first, *second)))
