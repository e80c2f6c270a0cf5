"""Unlike materials: influence numbers, CONTACT's forces, Bentall and Johnson's free rolling, symmetries, errors."""

import math

import numpy as np
import pytest

import contact
from contact.halfspace import Gap
from contact.halfspace.unlike import Coupling, integrals

BOTH = {"normal": "halfspace", "tangential": "halfspace"}
STEEL, ALUMINIUM = (2.0 * 82e9 * 1.28, 0.28), (2.0 * 23e9 * 1.31, 0.31)  # E [Pa], nu
#: Set J, CONTACT 25.1: rail, wheel, creepage of the rail, force on the rail [N], largest pressure [MPa], its centroid [mm].
CIRCLES = [
    (STEEL, ALUMINIUM, 0.0, 1723.3441, 607.60958, 0.022611981),
    (ALUMINIUM, STEEL, 1.2e-3, -3576.2867, 611.73432, 0.05160679),
    (ALUMINIUM, STEEL, -1.2e-3, 944.60301, 604.31506, -0.0096238191),
]
N, CURVATURE = 20106.193, 2.2843593


def circle():
    """Return the gap of set J on 40 × 40 elements over 1.15 of a circle of 4 mm."""
    x = 1.15 * 4e-3 * ((2.0 * np.arange(40) + 1.0) / 40.0 - 1.0)
    return Gap(x, x, CURVATURE * (x**2 + x[:, None] ** 2))


@pytest.mark.parametrize(("rail", "wheel", "xi", "force", "pressure", "centre"), CIRCLES)
def test_the_forces_are_contacts(rail, wheel, xi, force, pressure, centre):
    material = contact.Material.from_pair(*rail, *wheel)
    s = contact.solve(circle(), contact.Creepage(-xi), load=N, material=material, **BOTH)
    assert s.status is contact.Status.OK
    assert -force == pytest.approx(s.Fx, abs=2e-6 * 0.3 * N)
    assert s.max_pressure == pytest.approx(1e6 * pressure, rel=2e-6)
    assert float((s.x * s.p).sum() / s.p.sum()) == pytest.approx(1e-3 * centre, abs=1e-9)


def test_the_integrals_are_those_of_the_kernel():
    dx, dy = 1e-3, 2e-3
    t = (np.arange(400) + 0.5) / 400.0 - 0.5
    for X, Y in ((3e-3, 1e-3), (-2e-3, 4e-3), (0.0, 5e-3)):
        x, y = X - dx * t, Y - dy * t[:, None]
        r2 = x**2 + y**2
        direct = [float((v / r2).mean()) * dx * dy for v in (x, y)]
        assert [float(v) for v in integrals(X, Y, dx, dy)] == pytest.approx(direct, rel=1e-5, abs=1e-12)
    assert float(integrals(0.0, 0.0, dx, dy)[0]) == pytest.approx(0.0, abs=1e-18)


def test_the_coupling_is_antisymmetric():
    """The work of a traction on the displacement of a pressure is minus that of the pressure on the opening (Betti)."""
    rng = np.random.default_rng(1)
    p, qx, qy = rng.uniform(size=(3, 12, 9))
    coupling = Coupling(p.shape, 1e-3, 2e-3, contact.Material(8e10, 0.3, coupling=0.1))
    ux, uy = coupling.displacement(p)
    work = float((qx * ux + qy * uy).sum())
    assert float((p * coupling.opening(qx, qy)).sum()) == pytest.approx(work, rel=1e-9)


def test_free_rolling_of_cylinders_has_bentall_and_johnsons_creepage():
    """mu → 0, no force: |xi| = |beta| a/R 0.9148 (Bentall and Johnson 1967, as derived in other_contacts.md)."""
    a, R, n = 2e-3, 25e-3, 200
    material = contact.Material.from_pair(*ALUMINIUM, *STEEL)
    x = 1.1 * a * ((2.0 * np.arange(n) + 1.0) / n - 1.0)
    y = np.array([-1.0, 1.0])  # two elements of 2 m length
    p0 = material.contact_modulus * a / (2.0 * R)
    gap = Gap(x, y, x**2 / (2.0 * R) * np.ones((2, 1)))
    s = contact.solve(
        gap, contact.Creepage(), load=0.5 * math.pi * a * p0 * 4.0, friction=1e-4, material=material, force=0.0,
        **BOTH, throw=False,
    )  # fmt: skip
    assert abs(s.Fx) < 1e-4 * 1e-4 * s.N
    beta = material.coupling / (1.0 - material.poisson_ratio)
    assert abs(s.creepage.longitudinal) == pytest.approx(abs(beta) * a / R * 0.9148, rel=0.01)


def test_exchanging_the_bodies_and_the_creepage_mirrors_the_force():
    """The wheel's view of the pair: K and the creepage change their signs together, so does the force."""
    forces = []
    for sign in (1.0, -1.0):
        material = contact.Material(36e9, 0.3, coupling=0.1 * sign)
        s = contact.solve(
            circle(), contact.Creepage(sign * 6e-4, sign * 4e-4, sign * 0.2), load=N, material=material, **BOTH
        )
        forces.append((sign * s.Fx, sign * s.Fy, sign * s.Mz, s.max_pressure))
    np.testing.assert_allclose(forces[0], forces[1], rtol=1e-5)


@pytest.mark.filterwarnings("ignore::contact.errors.ModelWarning")
def test_the_pressure_of_another_method_acts_on_the_slip():
    """Fast methods neglect the coupling; the half space's traction on their pressure has most of it."""
    separation, material = contact.Separation.hertzian(1.1, 0.8), contact.Material(36e9, 0.3, coupling=-0.1)
    options = {"load": 5e4, "material": material}
    full = contact.solve(separation, contact.Creepage(), **options, **BOTH)
    half = contact.solve(separation, contact.Creepage(), **options, tangential="halfspace")
    fast = contact.solve(separation, contact.Creepage(), **options)
    assert fast.Fx == 0.0
    assert half.Fx == pytest.approx(full.Fx, rel=0.05)
    assert abs(full.Fx) > 0.1 * 0.3 * 5e4


def test_no_coupling_and_no_contact_change_nothing():
    like = contact.Material.from_pair(*STEEL, *STEEL)
    assert like.coupling == 0.0
    for approach in (-1e-3, 1e-5):
        one, other = (
            contact.solve(circle(), contact.Creepage(1e-3), approach=approach, material=m, **BOTH)
            for m in (like, contact.Material(like.shear_modulus, like.poisson_ratio))
        )
        assert (one.N, one.Fx) == (other.N, other.Fx)
    apart = contact.solve(
        circle(), contact.Creepage(1e-3), approach=-1e-3, material=contact.Material(8e10, 0.3, coupling=0.1), **BOTH
    )
    assert apart.status is contact.Status.NO_CONTACT
