"""Each damage model: published breakpoints, options for disputed variants, and refused input."""

import math

import numpy as np
import pytest

import reference
from contact.damage import (
    ArchardMap,
    Burstow,
    PearceSherratt,
    Usfd,
    burstow,
    energy_index,
    fatigue_index,
    pearce_sherratt,
    shakedown_limit,
    stress_index,
    t_gamma,
    usfd,
    wear_coefficient,
)
from contact.damage.shakedown import ELLIPSE, LINE


def energies():
    return [pytest.param(*values, id=name) for name, values in reference.frictional_energies()]


@pytest.mark.parametrize(("xi", "eta", "phi", "Fx", "Fy", "Mz", "dissipation"), energies())
def test_t_gamma_with_spin_is_an_upper_bound_of_contacts_dissipation(xi, eta, phi, Fx, Fy, Mz, dissipation):
    bound = t_gamma(Fx, Fy, xi, eta, 1e-3 * Mz, 1e3 * phi)
    # all three terms dissipate here, so both are equal in exact theory; 4 % is the grid error of the reference
    assert dissipation <= bound <= 1.04 * dissipation


def test_t_gamma_is_thesis_6_1_and_ignores_signs():
    assert t_gamma(-3000.0, 2000.0, 1e-3, -2e-3) == pytest.approx(7.0, rel=1e-15)
    assert t_gamma(-3000.0, 2000.0, 1e-3, -2e-3, -5.0, 0.4) == pytest.approx(9.0, rel=1e-15)


def test_pearce_sherratt_has_the_published_values_at_its_breakpoints():
    D, unit = 0.92, 1e-9 / 920.0  # mm²/km in m²/m, D in mm
    below_100, at_100, at_200, above_200 = pearce_sherratt([100.0 * (1.0 - 1e-15), 100.0, 200.0, 200.0 + 1e-9], D)
    assert at_100 == pytest.approx(25.0 * unit, rel=1e-14)
    assert below_100 == pytest.approx(at_100, rel=1e-14), "the lower breakpoint is continuous"
    assert at_200 == pytest.approx(25.0 * unit, rel=1e-14)
    assert above_200 == pytest.approx(84.0 * unit, rel=1e-9), "the published law jumps from 25 to 84 at 200 N"
    assert pearce_sherratt(40.0, D) == pytest.approx(10.0 * unit, rel=1e-14)


def test_pearce_sherratt_without_jump_is_continuous_and_else_the_published_law():
    T = np.linspace(0.0, 400.0, 40001)
    smooth = pearce_sherratt(T, 0.92, PearceSherratt(jump=False))
    published = pearce_sherratt(T, 0.92)
    assert np.abs(np.diff(smooth)).max() < 1.0001 * 1.19 * 0.01 * 1e-9 / 920.0, (
        "steps no larger than the steepest slope"
    )
    outside = (T <= 179.0 / 1.19) | (T > 200.0)  # the severe branch meets the plateau at 150.42 N
    assert np.array_equal(smooth[outside], published[outside])
    assert (smooth[~outside] > published[~outside]).all()


def test_burstow_rises_from_15_peaks_at_65_and_crosses_zero_at_175():
    assert burstow([0.0, 15.0, 40.0, 65.0, 120.0, 175.0]) == pytest.approx(
        [0.0, 0.0, 5e-6, 10e-6, 5e-6, 0.0], rel=1e-14, abs=1e-20
    )
    assert burstow(285.0) == pytest.approx(-10e-6, rel=1e-14), "recalled: wear removes cracks beyond 175 N"


def test_burstow_clips_the_wear_branch_only_when_asked():
    clip = Burstow(clip_negative=True)
    assert burstow([285.0, 1e5], clip) == pytest.approx([0.0, 0.0], abs=0.0)
    assert burstow([40.0, 120.0], clip) == pytest.approx(burstow([40.0, 120.0]), rel=0.0)
    assert burstow(20.0, Burstow(threshold=20.0)) == 0.0
    assert burstow(20.0) > 0.0


@pytest.mark.parametrize(
    ("branch", "at_100"), [("continuous", 55.0 + 61.9 * 22.8), ("proportional", 6190.0), ("from_zero", 61.9 * 22.8)]
)
def test_usfd_severe_branch_has_the_three_forms_of_the_sources(branch, at_100):
    law = Usfd(severe_branch=branch)
    area = 100e-6  # m² = 100 mm²
    unit = 1e-9 / 7.85e-6 * 1e-3  # µg/(m mm²) in m/m
    rate = usfd(np.array([5.0, 50.0, 77.2, 100.0]) * 100.0, area, law)
    assert rate == pytest.approx(np.array([26.5, 55.0, 55.0, at_100]) * unit, rel=1e-12)


def test_usfd_default_is_continuous_at_77_and_nearly_so_at_10():
    area, unit = 1e-4, 1e-3 / 7850.0
    lower = usfd(np.array([10.4 - 1e-9, 10.4 + 1e-9]) * 100.0, area) / unit
    upper = usfd(np.array([77.2 - 1e-9, 77.2 + 1e-9]) * 100.0, area) / unit
    assert upper[1] == pytest.approx(upper[0], rel=1e-8)
    assert lower == pytest.approx([55.12, 55.0], rel=1e-8), "published constants leave a step of 0.12"
    dropped = usfd(77.2001 * 100.0, area, Usfd(severe_branch="from_zero")) / unit
    assert dropped < 0.01, "the branch 61.9 I - 4778.7 starts from zero"


def test_archard_map_has_the_kth_regions():
    H = 2.7e9
    v = np.array([0.0, 0.199, 0.2, 0.7, 0.701, 5.0])
    assert wear_coefficient(v, 1e9, H) == pytest.approx([5e-4, 5e-4, 35e-4, 35e-4, 5e-4, 5e-4], rel=0.0)
    assert wear_coefficient(v, 0.8 * H, H) == pytest.approx(wear_coefficient(v, 1e9, H), rel=0.0)
    assert wear_coefficient(v, 0.8001 * H, H) == pytest.approx(np.full(6, 350e-4), rel=0.0), "seizure at any velocity"
    assert wear_coefficient(0.3, 1e9, H, ArchardMap(severe=31e-4)) == 31e-4


def test_fatigue_index_on_an_ellipse_is_thesis_6_6():
    N, a, b, k = 80e3, 6e-3, 4e-3, 300e6
    p0 = 1.5 * N / (math.pi * a * b)
    thesis = 0.25 - 2.0 * math.pi * a * b * k / (3.0 * N)
    assert fatigue_index(0.25, p0, k) == pytest.approx(thesis, rel=1e-12)
    assert fatigue_index(0.4, 750e6, 300e6) == pytest.approx(0.0, abs=1e-15), "zero on the line p0/k = 1/utilisation"


def test_shakedown_limits_meet_and_begin_where_johnsons_do():
    x, y = LINE[-1]
    assert y == pytest.approx(1.0 / x, rel=2e-3)
    assert shakedown_limit([0.0, 0.3, 0.5, 1.0]) == pytest.approx([4.0, 2.90, 2.0, 1.0], rel=1e-15)
    assert (np.diff(shakedown_limit(np.linspace(0.0, 1.0, 1001))) < 0.0).all()
    assert fatigue_index(0.5, shakedown_limit(0.5) * 300e6) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("aspect", ELLIPSE)
def test_limit_of_the_frictionless_ellipse_is_its_greatest_orthogonal_shear(aspect):
    """k/|τxz|max under Hertz's pressure, a = aspect, b = 1, integrated from Boussinesq's point forces over the ellipse."""
    # the shear is that of -z ∂(∂φ/∂z)/∂x of the potential φ = ∬ p/(2π r) dA: 3 z² (x - ξ)/(2π r⁵) a point force
    t, weight = np.polynomial.legendre.leggauss(60)
    angle = 2.0 * np.pi * np.arange(120) / 120
    r, c, s = np.sin(0.25 * np.pi * (t + 1.0)), np.cos(angle), np.sin(angle)  # dense towards the edge
    xi, eta = aspect * r[:, None] * c, r[:, None] * s
    force = (0.25 * np.pi * weight * np.cos(0.25 * np.pi * (t + 1.0)) * r * np.sqrt(1.0 - r**2))[:, None] * (
        aspect * 2.0 * np.pi / 120
    )

    def shear(place):
        x, z = place
        distance = np.sqrt((x - xi) ** 2 + eta**2 + z**2)
        return -float((force * 3.0 * z**2 * (x - xi) / (2.0 * np.pi * distance**5)).sum())

    optimize = pytest.importorskip("scipy.optimize")
    found = optimize.minimize(shear, (0.85 * aspect, 0.45 * aspect), method="Nelder-Mead", options={"xatol": 1e-5})
    assert -1.0 / found.fun == pytest.approx(ELLIPSE[aspect], rel=2e-3)


def test_stress_index_is_traction_above_yield():
    assert stress_index([3e8, 0.0], [4e8, 0.0], 3e8) == pytest.approx([2e8, -3e8], rel=1e-15)


def test_energy_index_is_positive_for_a_traction_that_opposes_the_rigid_slip():
    x, y, phi = 2e-3, 1e-3, 0.5
    wx, wy = 1e-3 - phi * y, -2e-3 + phi * x
    assert energy_index(-1e8 * wx, -1e8 * wy, x, y, 1e-3, -2e-3, phi) == pytest.approx(1e8 * (wx**2 + wy**2), rel=1e-12)


def test_scalars_give_floats_and_arrays_broadcast():
    assert isinstance(burstow(40.0), float)
    assert usfd(np.ones((2, 1)), np.full(3, 1e-4)).shape == (2, 3)
