"""Simplified theory as CONTACT has it, on any pressure of a grid: FASTSIM (M = 2, 3) and the modified FaStrip (M = 5).

The displacement of an element is L times its traction over the slope k. L1, L2, L3 come from Kalker's coefficients of the
ellipse, that of Hertz or one of the area, length and width of the contact, and blend into one flexibility as the creepages
grow to three times those of full slip. The slope k falls with the creepage after Spiryagin (2013).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.inp.case import Case
from contact.inp.laws import LAWS
from contact.inp.reasons import refuse
from contact.inputs.material import Material
from contact.theory.kalker import piecewise

#: Position of the rigid slip ahead of an element's centre, over dx.
_OFFSET = 1.0 / 6.0
#: Creepages, over those of full slip, at which the flexibilities are one.
_ONE_FLEXIBILITY = 3.0


class Motion(NamedTuple):
    """Creepages of the rail against the wheel, and the speed [m/s]."""

    xi: float
    eta: float
    phi: float
    speed: float


class Ground(NamedTuple):
    """Given pressure on a grid, with the semi-axes of its ellipse [m]; None if they follow from the elements in contact."""

    x: Array
    y: Array
    dx: float
    dy: float
    p: Array
    axes: tuple[float, float] | None = None

    @property
    def load(self) -> float:
        """Normal force [N]."""
        return float(self.p.sum()) * self.dx * self.dy

    @property
    def ellipse(self) -> tuple[float, float]:
        """Semi-axes of the ellipse with the area of the elements in contact, and the ratio of their length to their width."""
        inside = self.p > 0.0
        area = float(inside.sum()) * self.dx * self.dy / math.pi
        columns, rows = np.flatnonzero(inside.any(axis=0)), np.flatnonzero(inside.any(axis=1))
        ratio = (columns[-1] - columns[0] + 1) * self.dx / ((rows[-1] - rows[0] + 1) * self.dy)
        return math.sqrt(area * ratio), math.sqrt(area / ratio)


class Traction(NamedTuple):
    """Traction on the rail [Pa] and slip over V, shape (2, ny, nx), elements that slip, and the coefficient of friction."""

    q: Array
    slip: Array
    slips: NDArray[np.bool_]
    friction: float


def traction(case: Case, ground: Ground, motion: Motion, bodies: Material, backwards: bool) -> Traction:
    """Return the traction of steady rolling by the theory of the case."""
    theory = case.digits["M"]
    friction = _friction(case, motion)
    if not friction > 0.0:
        raise refuse(
            case, "input", f"a coefficient of friction of {friction:g} at these creepages; allowed: more than 0"
        )
    L = flexibilities(case, ground, motion, bodies)
    k = _slope(case, ground, motion, bodies, friction)
    x, y, dx, p, phi = ground.x, ground.y, ground.dx, ground.p, motion.phi
    by_x, by_y = (1.0, 1.0) if theory == 2 else (L[0] / L[2], L[1] / L[2])
    ahead = -1.0 if backwards else 1.0
    q, slip, slips = np.zeros((2, *p.shape)), np.zeros((2, *p.shape)), np.zeros(p.shape, dtype=bool)
    last, soft = np.zeros((2, y.size)), np.array([[L[0]], [L[1]]]) / k
    for j in range(x.size) if backwards else range(x.size - 1, -1, -1):
        turn = motion.eta + phi * (x[j] + ahead * _OFFSET * dx) * by_y
        w = np.stack((motion.xi - phi * by_x * y, np.full(y.size, turn)))
        free, bound = last - dx * w / soft, friction * p[:, j]
        size = np.hypot(*free)
        slips[:, j] = (size > bound) & (bound > 0.0)
        now = free * np.where(size > bound, bound / np.where(size > bound, size, 1.0), 1.0)
        slip[:, :, j] = np.where(bound > 0.0, w + soft * (now - last) / dx, 0.0)
        q[:, :, j] = last = now
    found = Traction(q, slip, slips, friction)
    return _stripped(found, ground, motion, bodies) if theory == 5 else found


def flexibilities(case: Case, ground: Ground, motion: Motion, bodies: Material) -> tuple[float, float, float]:
    """Return L1, L2, L3 [m/Pa]."""
    if case.digits["M"] == 2:
        return (case["FLX"],) * 3
    a, b = ground.axes or ground.ellipse
    c11, c22, c23 = piecewise(bodies.poisson_ratio, a / b)
    G = bodies.shear_modulus
    L = np.array([8.0 * a / (3.0 * c11), 8.0 * a / (3.0 * c22), math.pi * a * math.sqrt(a / b) / (4.0 * c23)]) / G
    # CONTACT adds creepages and the spin per millimetre
    c = 1e3 * math.sqrt(a * b)
    full = 1e6 * _static(case) * ground.load / (c**2 * G) / np.array([c11, c22, c23 * c])
    given = np.array([motion.xi, motion.eta, 1e-3 * motion.phi])
    share = min(float(np.linalg.norm(given) / np.linalg.norm(full)) / _ONE_FLEXIBILITY, 1.0)
    work = np.array([motion.xi, motion.eta, motion.phi * (3.0 * math.pi * a / 32.0)]) ** 2
    if share == 0.0:
        return tuple(map(float, L))  # type: ignore[return-value]
    one = float(work.sum() / (work / L).sum())
    return tuple(map(float, (1.0 - share) * L + share * one))  # type: ignore[return-value]


def _slope(case: Case, ground: Ground, motion: Motion, bodies: Material, friction: float) -> float:
    """Return the slope K0 (ALFA + (1 - ALFA)/(1 + BETA ε)), with ε the creepage over that of linear theory at full slip."""
    least, fall = case["ALFAMF"], case["BETAMF"]
    a, b = ground.ellipse
    lateral = motion.eta + motion.phi * a
    lateral = motion.eta if abs(lateral) < abs(motion.eta) else lateral
    c11 = piecewise(bodies.poisson_ratio, a / b)[0]
    rise = bodies.shear_modulus * math.pi * a * b * case["K0_MF"] * c11 * math.hypot(motion.xi, lateral)
    return float(case["K0_MF"] * (least + (1.0 - least) / (1.0 + fall * rise / (4.0 * friction * ground.load))))


def _static(case: Case) -> float:
    """Return the static coefficient of friction."""
    kind = case["LAW"]
    if kind == 0:
        return float(case["FSTAT"])
    if kind not in LAWS:
        raise refuse(case, "simplified theory", f"L = {kind} with M = {case.digits['M']}")
    prefix = LAWS[kind][1]
    return float(case["FKIN"] + case[f"{prefix}1"] + case[f"{prefix}2"])


def _friction(case: Case, motion: Motion) -> float:
    """Return the coefficient of friction: with a law, that at the creepage of the whole."""
    if case["ROWS"] != 0:
        raise refuse(case, "simplified theory", f"V = {case['ROWS']} with M = {case.digits['M']}")
    kind, slip = case["LAW"], motion.speed * math.hypot(motion.xi, motion.eta)
    if kind == 0 or slip == 0.0:
        return _static(case)
    _static(case)  # refuses other laws
    prefix = LAWS[kind][1]

    def term(k: int) -> float:
        size = case[f"{prefix}{k}"]
        if size == 0.0:
            return 0.0
        if not case[f"SABSH{k}"] > 0.0:
            raise refuse(case, "input", f"SABSH{k} = 0 with a coefficient that is not 0")
        s = slip / case[f"SABSH{k}"]
        if kind == 2:
            return float(size * max(0.0, 1.0 - 0.5 * s))
        if kind == 3:
            return float(size / (1.0 + s**k))
        return float(size * 2.0**-s)

    return float(case["FKIN"]) + term(1) + term(2)


def _stripped(found: Traction, ground: Ground, motion: Motion, bodies: Material) -> Traction:
    """Return the traction of strip theory where its strips stick, elsewhere the bound along that of FASTSIM (Sichani 2016)."""
    a, b = ground.ellipse
    nu, G, mu = bodies.poisson_ratio, bodies.shear_modulus, found.friction
    top = 1.5 * ground.load / (math.pi * a * b)
    c11, c22, c23 = piecewise(nu, a / b)
    scale = -G / (2.0 * mu * top * math.pi**2)
    xi, eta = (4.0 * scale * (1.0 - nu) * c * v for c, v in ((c11, motion.xi), (c22, motion.eta)))
    phi = 3.0 * scale * math.pi * math.sqrt(a * b) * c23 * motion.phi
    x, inside = ground.x, ground.p > 0.0
    half = 0.5 * ground.dx * inside.sum(axis=1)
    across = xi - phi * ground.y / a
    # half the length of slip of a strip, in a form that holds for a spin of full slip and more too
    root = np.sqrt(np.maximum(eta**2 + (1.0 - phi**2) * across**2, 0.0))
    slid = (eta**2 + across**2) / np.maximum(root - eta * phi, 1e-20) * a / (1.0 - nu)
    slid = np.minimum(slid, half)
    along = eta + phi * slid / a
    size = np.sqrt(np.maximum(across**2 + along**2, 1e-20))
    kappa, lam = (across / size)[:, None], (along / size)[:, None]
    sticks = inside & (x > (2.0 * slid - half)[:, None])
    whole = np.sqrt(np.maximum(half[:, None] ** 2 - x**2, 0.0))
    inner = np.sqrt(np.maximum((half - slid)[:, None] ** 2 - (x - slid[:, None]) ** 2, 0.0))
    strip = mu * top / a * np.stack((kappa * (whole - inner), lam * whole - (lam - phi) * inner))
    size = np.hypot(*found.q)
    full = found.q * (mu * ground.p / np.where(size > 0.0, size, 1.0))
    return found._replace(q=np.where(sticks, strip, full), slips=inside & ~sticks)
