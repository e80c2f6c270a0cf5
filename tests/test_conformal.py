"""Contact angle varying over the patch (theory.md 8.6)."""

import math

import numpy as np
import pytest

import contact
from contact.geometry import profile, wheelset
from contact.geometry.wheelset import Pose
from contact.halfspace.gap import Gap
from contact.kernels.conformal import bend, surface_at
from contact.kernels.records import CASE
from contact.kernels.rows import Strip

Y = np.linspace(-15e-3, 15e-3, 121)
TANGENTIAL = [name for name, method in contact.methods().batched.tangential.items() if method.fields]
HALF_SPACE = (
    {"normal": "halfspace", "tangential": "halfspace"},
    {"normal": "strip_halfspace", "tangential": "halfspace"},
)
CREEPAGE = contact.Creepage(2e-3, -1e-3, 0.3)


def bent(tilt, rolling=1.0 / 0.46, y=Y):
    return contact.Separation(y, 2.0 * y**2, 1.1, 0.02 * y, tilt, rolling)


def numbers(sol):
    return sol.Fx, sol.Fy, sol.Mz, sol.power_per_metre, sol.slip_area


@pytest.mark.parametrize("options", [*({"tangential": name} for name in TANGENTIAL), *HALF_SPACE])
def test_without_tilt_it_is_the_plane_bit_for_bit(options):
    one, other = (contact.solve(bent(0.0), CREEPAGE, load=8e4, conformal=c, **options) for c in (True, False))
    assert numbers(one) == numbers(other)
    for name in ("qx", "qy", "sx", "sy", "stick"):
        assert (getattr(one, name) == getattr(other, name)).all()


def test_the_height_is_the_integral_of_a_slope_that_is_linear_between_samples():
    y, tilt = np.array([-2.0, 0.0, 1.0, 4.0]), np.array([1.0, 0.0, 0.5, -1.0])
    fine = np.linspace(-3.0, 6.0, 90001)
    slope = np.interp(fine, y, tilt)
    height = np.concatenate(([0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(fine))))
    height -= np.interp(-2.0, fine, height)
    for at in (-2.5, -2.0, -0.7, 0.0, 0.3, 1.0, 3.9, 4.0, 5.0):
        own_slope, own_height = surface_at(y, tilt, at)
        assert own_slope == pytest.approx(np.interp(at, y, tilt), abs=1e-12)
        assert own_height == pytest.approx(np.interp(at, fine, height), abs=1e-6)


def test_strips_have_the_exact_change_of_radius_and_the_spin_of_their_angle():
    """A wheel of radius r rolls straight at a contact angle: ξ(y) = -(r(y) - r0)/r0, phi(y) = sin(angle + Δ)/r0."""
    r0, angle, bow = 0.46, -0.3, 12.0
    case, strips = np.zeros(1, CASE)[0], np.zeros((len(Strip), 3))
    case.phi, case.vx, case.vy = math.sin(angle) / r0, 0.0, 5e-3
    strips[Strip.Y] = y = np.array([-8e-3, 0.0, 6e-3])
    case.rolling = math.cos(angle) / r0
    bend(contact.Separation(Y, 0.0 * Y, 1.0, tilt=bow * Y).samples, case, strips, 3)
    delta, height = np.arctan(bow * y), 0.5 * bow * y**2
    np.testing.assert_allclose(strips[Strip.TILT], bow * y, atol=1e-15)
    np.testing.assert_allclose(strips[Strip.PHI], np.sin(angle + delta) / r0, rtol=1e-12)
    np.testing.assert_allclose(strips[Strip.VY], 5e-3 * np.cos(delta), rtol=1e-12)
    radius_change = y * math.sin(angle) + height * math.cos(angle)
    np.testing.assert_allclose(strips[Strip.VX] - strips[Strip.PHI] * y, -radius_change / r0, atol=1e-15)


def test_without_friction_the_pressure_of_a_tilted_surface_pushes_sideways():
    sol = contact.solve(bent(0.1), CREEPAGE, load=8e4, friction=0.0, conformal=True)
    assert sol.N == 8e4
    assert sol.Fy == sol.pressure_y == pytest.approx(0.1 * 8e4, rel=1e-12)
    assert sol.used_friction == 0.0
    assert sol.Fx == 0.0
    assert sol.damage.T_gamma == 0.0


@pytest.mark.parametrize("options", [{}, {"tangential": "halfspace", "spacing": 1e-3}])
def test_wear_numbers_count_creep_forces_without_the_pressure(options):
    sol = contact.solve(bent(0.1), CREEPAGE, load=8e4, conformal=True, **options)
    # on the half space the traction bears its part of the load
    borne = -0.1 * (sol.Fy - sol.pressure_y) if options else 0.0
    assert pytest.approx(8e4, rel=2e-6) == sol.N  # the turns between pressure and traction end at 1e-6
    assert sol.pressure_y == pytest.approx(0.1 * (8e4 - borne), rel=1e-6)
    expected = abs(sol.Fx * CREEPAGE.longitudinal) + abs((sol.Fy - sol.pressure_y) * CREEPAGE.lateral)
    assert sol.damage.T_gamma == pytest.approx(expected, rel=1e-12)
    assert contact.solve(bent(0.1), CREEPAGE, load=8e4, **options).pressure_y == 0.0


@pytest.mark.parametrize("tangential", TANGENTIAL)
def test_full_slip_bears_the_pressure_of_the_longer_surface(tangential):
    sol = contact.solve(bent(0.2), contact.Creepage(0.3), load=8e4, tangential=tangential, conformal=True)
    assert sol.Fx == pytest.approx(-0.3 * 8e4 * math.sqrt(1.04), rel=3e-3)


@pytest.mark.parametrize("tangential", TANGENTIAL)
def test_the_mirror_image_has_the_mirrored_forces(tangential):
    tilt = 0.05 + 20.0 * Y + 900.0 * Y**2
    one = contact.solve(bent(tilt), CREEPAGE, load=8e4, tangential=tangential, conformal=True)
    s = contact.Separation(Y, 2.0 * Y**2, 1.1, -0.02 * Y, -tilt[::-1], 1.0 / 0.46)
    other = contact.solve(s, contact.Creepage(2e-3, 1e-3, -0.3), load=8e4, tangential=tangential, conformal=True)
    assert (other.Fx, other.Fy) == pytest.approx((one.Fx, -one.Fy), abs=1e-6 * 8e4)
    assert other.Mz == pytest.approx(-one.Mz, abs=1e-8 * 8e4)
    assert other.power_per_metre == pytest.approx(one.power_per_metre, rel=1e-6)


@pytest.mark.parametrize("options", HALF_SPACE)
def test_the_half_space_pushes_sideways_and_bears_the_longer_surface(options):
    rough = contact.solve(bent(0.2), contact.Creepage(0.3), load=8e4, conformal=True, spacing=1e-3, **options)
    smooth = contact.solve(bent(0.1), CREEPAGE, load=8e4, friction=0.0, conformal=True, spacing=1e-3, **options)
    assert rough.Fx == pytest.approx(-0.3 * 8e4 * math.sqrt(1.04), rel=1e-3)
    assert smooth.Fy == pytest.approx(0.1 * 8e4, rel=1e-9)


def test_strips_follow_the_half_space_in_what_the_bent_surface_changes():
    """At the flange root (Δ over 29°) mapped FaStrip and TANG on the same pressure change alike from plane to surface."""
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
    (patch,) = wheelset.contacts(wheel, rail, Pose(y=6.5e-3, yaw=5e-3), load=8e4)
    for creepage in (patch.creepage, contact.Creepage(1e-4, 2e-4, 0.0), contact.Creepage(0.0, 0.0, 0.3)):
        changes = []
        for tangential in ("fastrip_mapped", "halfspace"):
            plane, surface = (
                np.array([s.Fx, s.Fy, 100.0 * s.Mz])
                for s in (
                    contact.solve(
                        patch.separation, creepage, load=patch.load, normal="strip_halfspace", tangential=tangential,
                        n_strips=40, n_elements=40, conformal=c,
                    )
                    for c in (False, True)
                )
            )  # fmt: skip
            changes.append((surface - plane) / (0.3 * patch.load))
        np.testing.assert_allclose(*changes, atol=0.035)  # the bent influence numbers make up to .012 of it
        assert abs(changes[0]).max() > 0.05


@pytest.mark.parametrize("tangential", [*TANGENTIAL, "halfspace"])
def test_extreme_surfaces_leave_no_nan(tangential):
    for tilt, rolling in ((1e3, 1e3), (-1e3, 1e3), (1e3 * np.sign(Y), -1e3), (1e-300, 1e-300)):
        for creepage in (CREEPAGE, contact.Creepage(1e6, -1e6, 1e6)):
            s = contact.solve(
                bent(tilt, rolling), creepage, load=8e4, tangential=tangential, conformal=True,
                n_strips=12, n_elements=12, throw=False,
            )  # fmt: skip
            assert all(map(math.isfinite, numbers(s)))


def test_methods_without_conformal_contact_are_refused():
    for call in (contact.solve, contact.forces):
        with pytest.raises(contact.ContactError, match="is only for a plane contact"):
            call(bent(0.1), CREEPAGE, load=8e4, conformal=True, tangential="polach")
    x, y = np.linspace(-9e-3, 9e-3, 30), np.linspace(-9e-3, 9e-3, 30)
    gap = Gap(x, y, 1.1 * x[None, :] ** 2 + 2.0 * y[:, None] ** 2)
    with pytest.raises(contact.ContactError, match="a gap on a grid has only the contact plane"):
        contact.solve(gap, CREEPAGE, load=8e4, conformal=True, **HALF_SPACE[0])
