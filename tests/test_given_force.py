"""Given tangential forces: round trips for every method, Carter's inverse, CONTACT's creepages, unreachable forces, errors."""

import math

import numpy as np
import pytest

import contact
import reference
from contact.friction import Friction
from contact.given_force import rising_root
from contact.halfspace import pressed
from contact.kernels.given_force import LARGEST

LOAD, MU = 8e4, 0.3
SEPARATION = contact.Separation.hertzian(1.1, 0.8)
METHODS = contact.methods().tangential
BOTH = {"normal": "halfspace", "tangential": "halfspace"}


def scale(solution):
    """Return the creepage at which the force saturates, roughly."""
    return 3.0 * MU * LOAD / (4.0 * solution.material.shear_modulus * solution.area / math.pi)


@pytest.mark.parametrize("method", [name for name, m in METHODS.items() if m.lateral])
@pytest.mark.parametrize(
    ("creepage", "known"), [((8e-4, -6e-4, 0.0), (1, 1)), ((-1e-3, 5e-4, 0.2), (1, 1)), ((-1.5e-3, 4e-4, 0.1), (1, 0))]
)
def test_the_creepages_of_a_force_are_those_that_made_it(method, creepage, known):
    true = contact.solve(SEPARATION, contact.Creepage(*creepage), load=LOAD, tangential=method)
    force = tuple(f if k else None for f, k in zip((true.Fx, true.Fy), known, strict=True))
    start = contact.Creepage(0.0, 0.0 if known[1] else creepage[1], creepage[2])
    found = contact.solve(SEPARATION, start, load=LOAD, tangential=method, force=force)
    assert found.status is contact.Status.OK
    assert math.hypot(found.Fx - true.Fx, found.Fy - true.Fy) <= 1e-4 * MU * LOAD
    away = found.creepage.longitudinal - creepage[0], found.creepage.lateral - creepage[1]
    assert math.hypot(*away) <= 1e-2 * scale(true)
    assert found.creepage.spin == creepage[2]
    again = contact.solve(SEPARATION, found.creepage, load=LOAD, tangential=method)
    assert (again.Fx, again.Fy) == pytest.approx((found.Fx, found.Fy), abs=1e-5 * MU * LOAD)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 0.99])
def test_carters_creepage_has_his_inverse(share):
    """|xi| = mu a/R (1 - √(1 - f)), with a/R = 2 a A of two cylinders of equal material, here for a long ellipse."""
    separation = contact.Separation.hertzian(1.0, 1e-3)
    s = contact.solve(separation, contact.Creepage(), load=LOAD, tangential="carter", normal="hertz")
    found = contact.solve(
        separation, contact.Creepage(), load=LOAD, tangential="carter", normal="hertz", force=share * MU * LOAD
    )
    full = contact.solve(
        separation, contact.Creepage(), load=LOAD, tangential="carter", normal="hertz", force=0.75 * MU * LOAD
    )
    ratio = found.creepage.longitudinal / full.creepage.longitudinal
    assert ratio == pytest.approx((1.0 - math.sqrt(1.0 - share)) / 0.5, rel=1e-4)
    assert s.Fx == 0.0


@pytest.mark.parametrize("share", [0.1, 0.9, 0.99])
@pytest.mark.parametrize("unknown", [(1, 1), (1, 0), (0, 1)])
def test_creepages_of_the_half_space_come_with_the_traction(monkeypatch, share, unknown):
    """One Newton iteration finds traction and creepages, so TANG is called once, with the force of its answer."""
    calls, tang = [], pressed.tang
    monkeypatch.setattr(pressed, "tang", lambda *a, **kw: calls.append(1) or tang(*a, **kw))
    given = share * MU * LOAD / math.hypot(*unknown)
    force = tuple(sign * given if k else None for sign, k in zip((-1.0, 1.0), unknown, strict=True))
    start = contact.Creepage(0.0 if unknown[0] else 2e-5, 0.0 if unknown[1] else -3e-5, 0.05)
    found = contact.solve(SEPARATION, start, load=LOAD, force=force, **BOTH)
    assert found.status is contact.Status.OK
    assert len(calls) == 1
    for wanted, own in zip(force, (found.Fx, found.Fy), strict=True):
        assert wanted is None or own == pytest.approx(wanted, abs=2e-6 * MU * LOAD)


def test_the_creepages_are_contacts():
    """Set H, d01: CONTACT 25.1 on the same elements, both forces given, with spin; 1e-5 of the creepage at saturation."""
    a, b, N, mu = 6.6426586e-3, 3.0965875e-3, 52484.647, 0.22003132
    s = (np.arange(44) - 21.5) / 22.0 * 1.05
    x, y = a * s, b * s
    # Hertz: the gap of the parabolas that touch on this ellipse, from the displacement of the pressure itself
    steel, p0 = reference.STEEL, 1218.2835e6
    t = (np.arange(400000) + 0.5) / 400000
    u = t / (1.0 - t) * a  # t to infinity; the integrand of the displacement of an elliptic load
    weight = a / (1.0 - t) ** 2 / t.size
    A, B = (
        p0
        * a
        * b
        / steel.contact_modulus
        * float((weight / ((q**2 + u**2) * np.sqrt((a**2 + u**2) * (b**2 + u**2)))).sum())
        for q in (a, b)
    )
    gap = contact.halfspace.Gap(x, y, A * x**2 + B * y[:, None] ** 2)
    force = -0.33263474 * mu * N, 0.61591731 * mu * N
    found = contact.solve(gap, contact.Creepage(0.0, 0.0, -0.27852912), load=N, friction=mu, force=force, **BOTH)
    assert found.max_pressure == pytest.approx(1217.6574e6, rel=1e-5)
    assert found.status is contact.Status.OK
    at_saturation = 3.0 * mu * N / (4.0 * steel.shear_modulus * a * b)
    assert found.creepage.longitudinal == pytest.approx(0.000559645, abs=1e-5 * at_saturation)
    assert found.creepage.lateral == pytest.approx(-0.000210207, abs=1e-5 * at_saturation)
    assert found.Mz == pytest.approx(4.7200194, rel=1e-4)


@pytest.mark.parametrize("method", [name for name, m in METHODS.items() if m.saturates])
def test_more_than_friction_allows_is_unreachable(method):
    """The answer has the status and the forces of its creepage, never the prescribed force."""
    for force in (1.05 * MU * LOAD, (-0.8 * MU * LOAD, 0.7 * MU * LOAD)):
        found = contact.solve(SEPARATION, contact.Creepage(), load=LOAD, tangential=method, force=force)
        assert found.status is contact.Status.UNREACHABLE
        assert math.hypot(found.Fx, found.Fy) <= MU * LOAD * (1.0 + 1e-9)
        again = contact.solve(SEPARATION, found.creepage, load=LOAD, tangential=method)
        assert (found.Fx, found.Fy) == (again.Fx, again.Fy)


def test_a_force_that_only_other_creepages_forbid_is_unreachable():
    """With a lateral creepage as large as rolling, the longitudinal force cannot come near friction."""
    found = contact.solve(SEPARATION, contact.Creepage(0.0, 1.0), load=LOAD, force=0.95 * MU * LOAD)
    assert found.status is contact.Status.UNREACHABLE
    assert abs(found.creepage.longitudinal) == LARGEST
    lateral = contact.solve(
        SEPARATION, contact.Creepage(), load=LOAD, tangential="carter", force=(None, 0.5 * MU * LOAD), throw=False
    )
    assert lateral.status is contact.Status.UNREACHABLE
    assert lateral.Fy == 0.0


def test_no_force_under_spin_is_a_lateral_creepage():
    """The camber of spin is carried by a creepage, and the moment stays."""
    found = contact.solve(SEPARATION, contact.Creepage(0.0, 0.0, 0.5), load=LOAD, force=(0.0, 0.0), **BOTH)
    assert abs(found.Fx) + abs(found.Fy) < 1e-5 * MU * LOAD
    assert abs(found.creepage.longitudinal) < 1e-9
    assert found.creepage.lateral != 0.0
    assert found.Mz < 0.0


def test_no_contact_and_no_friction():
    assert contact.solve(SEPARATION, contact.Creepage(), load=0.0, force=1.0).status is contact.Status.NO_CONTACT
    smooth = contact.solve(SEPARATION, contact.Creepage(), load=LOAD, friction=0.0, force=0.0)
    assert smooth.status is not contact.Status.UNREACHABLE
    assert (
        contact.solve(SEPARATION, contact.Creepage(), load=LOAD, friction=0.0, force=1.0).status.name == "UNREACHABLE"
    )


@pytest.mark.parametrize("method", ["fastrip_mapped", "halfspace"])
def test_a_friction_law_and_a_curved_surface_work_too(method):
    law = Friction(0.4, 0.2, 1.0, "rational")
    found = contact.solve(SEPARATION, contact.Creepage(), load=LOAD, friction=law, tangential=method, force=5e3)
    assert found.Fx == pytest.approx(5e3, abs=0.1)
    y = np.linspace(-12e-3, 12e-3, 101)
    bent = contact.Separation(y, 0.8 * y**2, 1.1, tilt=2.0 * y, rolling=2.0)
    force = 4e3, 6e3
    found = contact.solve(
        bent, contact.Creepage(0.0, 0.0, 0.1), load=LOAD, tangential=method, conformal=True, force=force
    )
    assert (found.Fx, found.Fy) == pytest.approx(force, abs=1.0)


def test_a_root_is_found_over_flats_and_jumps():
    for function, true in (
        (lambda x: max(min(x - 3.0, 1.0), -1.0), 3.0),
        (lambda x: -1.0 if x < 0.3 else 1.0, 0.3),
        (lambda x: math.copysign(abs(x - 7.0) ** (1 / 3), x - 7.0), 7.0),
    ):
        root = rising_root(function, 0.0, 1.0, (-10.0, 10.0), shortest=1e-9)
        assert root.x == pytest.approx(true, abs=1e-6)
    assert rising_root(lambda x: -1.0, 0.0, 1.0, (-10.0, 10.0), shortest=1e-9).beyond


@pytest.mark.parametrize("method", ["fastrip_mapped", "fastsim"])
def test_a_prepared_solver_finds_the_same_creepages(method):
    solver = contact.Solver(tangential=method, friction=MU)
    for force in (12e3, (9e3, -5e3), (None, 7e3), 2.0 * MU * LOAD):
        one = solver.solve(SEPARATION, contact.Creepage(0.0, 0.0, 0.2), load=LOAD, force=force)
        other = contact.solve(
            SEPARATION, contact.Creepage(0.0, 0.0, 0.2), load=LOAD, force=force, tangential=method, friction=MU
        )
        assert (one.status, one.Fx, one.Fy, one.creepage) == (other.status, other.Fx, other.Fy, other.creepage)
    assert one.status is contact.Status.UNREACHABLE
    with pytest.raises(contact.ContactError, match="force = 'much' is not a number"):
        solver.solve(SEPARATION, contact.Creepage(), load=LOAD, force="much")
