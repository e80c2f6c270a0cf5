"""Regression tests of the accuracy in docs/check/accuracy.md: no number may become more than 10 % worse than reached.

Comments give the bars of issue "The solver". The reached values are in docs/check/accuracy.md.
"""

import numpy as np
import pytest

import contact
import reference
from contact.registry import GAP_LIMIT
from contact.study.errors import mean_p95_max
from reference import accuracy

SLACK = 1.1


def assert_held(name, values, reached):
    found = mean_p95_max(values)
    for what, value, limit in zip(("mean", "p95", "max"), found, reached, strict=False):
        assert value <= SLACK * limit, f"{name}, {what}: {value:.5f}, reached before: {limit}"


@pytest.mark.parametrize(("method", "force", "moment", "adhesion"), [
    ("fastrip", (0.0136, 0.0422, 0.0973), (0.0080, 0.0252, 0.0551), 0.0221),  # bar .0165 / .058 / .17
    ("fastrip_mapped", (0.0016, 0.0053, 0.0186), (0.0012, 0.0043, 0.0157), 0.0267),  # bar .009 / .027 / .06; .007 / .022
    ("fastsim", (0.0320, 0.0906, 0.1827), (0.0331, 0.0860, 0.1321), 0.0665),
    ("fastsim_one", (0.0567, 0.1795, 0.3010), (0.0559, 0.1383, 0.2580), 0.140),  # CONTACT's own: .0547 / .1774 / .2900
    ("fastsim_elliptic", (0.0372, 0.1002, 0.1910), (0.0167, 0.0513, 0.1542), 0.130),
    ("strip_theory", (0.1240, 0.4260, 0.5780), (0.0665, 0.2252, 0.5370), 0.149),
    ("table", (0.0033, 0.0130, 0.0325), (0.0017, 0.0057, 0.0342), 0.0090),
])  # fmt: skip
def test_creep_forces_on_ellipses(method, force, moment, adhesion):
    errors = accuracy.errors_on_ellipses(method)
    assert_held("force", errors["force"], force)
    assert_held("moment", errors["moment"], moment)
    assert_held("adhesion area", errors["adhesion"], (adhesion,))


def by_spin(method):
    """Return the force errors on ellipses without and with spin."""
    spin = np.array([row["phi"] != 0.0 for row in reference.ellipses()])
    errors = accuracy.errors_on_ellipses(method)["force"]
    return errors[~spin], errors[spin]


@pytest.mark.parametrize(("law", "without", "with_spin"), [
    ("linear_saturated", 0.0704, 0.240),
    ("vermeulen_johnson", 0.0321, 0.377),
    ("polach", 0.0273, 0.119),
    ("shen_hedrick_elkins", 0.0170, 0.9),
])  # fmt: skip
def test_creep_force_laws_on_ellipses(law, without, with_spin):
    for reached, errors in zip((without, with_spin), by_spin(law), strict=True):
        assert_held(law, errors, (reached,))


@pytest.mark.parametrize(("method", "mean"), [("fastrip", 0.0695), ("fastrip_mapped", 0.0640), ("fastsim", 0.235)])
def test_traction_fields_on_ellipses(method, mean):
    assert_held("traction", list(accuracy.errors_on_fields(method).values()), (mean,))  # bar .081


@pytest.mark.parametrize(("method", "N", "pmax", "L2"), [
    ("analyn", 0.0156, 0.0167, 0.0958),  # bar 2.8 %, 3 %, .108
    ("strip_halfspace", 0.00031, 0.0009, 0.0095),  # bar 0.1 %, 0.3 %, .02
])  # fmt: skip
def test_normal_contact_of_real_patches(method, N, pmax, L2):
    errors = accuracy.errors_on_patches(method, "fastrip_mapped")
    assert_held("N", errors["N"], (N,))
    assert_held("pmax", errors["pmax"], (pmax,))
    assert_held("L2", errors["L2"], (L2,))


def test_kpec_is_contacts_kpec_patch_by_patch():
    own, theirs = accuracy.errors_of_normal("kpec"), accuracy.published_on_patches("kpec_fastsim")
    for what, tolerance in (("N", 0.006), ("pmax", 0.006), ("area", 0.006), ("L2", 0.01)):
        np.testing.assert_allclose(own[what], theirs[what], atol=tolerance, err_msg=what)


@pytest.mark.parametrize(("normal", "force", "moment"), [
    ("analyn", (0.0150, 0.0684, 0.1302), 0.0137),  # bar .025 / .08
    ("strip_halfspace", (0.0031, 0.0099, 0.0196), 0.0026),  # bar .012 / .03; .008
])  # fmt: skip
def test_creep_forces_on_real_patches(normal, force, moment):
    errors = accuracy.errors_on_patches(normal, "fastrip_mapped")
    assert_held("force", errors["force"], force)
    assert_held("moment", errors["moment"], (moment,))


def test_slopes_at_vanishing_creepage_on_real_patches():
    """Fx/ξ, Fy/η, Fy/φ, Mz/φ: bar 5, 5, 8, 12 %; aim 2, 2, 4, 6 %. With one smoothing length for all .8, 1.45, .8, 1.1 %."""
    mean = np.abs(accuracy.errors_of_slopes("strip_halfspace", "fastrip_mapped")).mean(axis=0)
    assert (mean <= SLACK * np.array([0.0093, 0.0148, 0.0069, 0.022])).all(), mean


def test_reference_is_the_one_described():
    """CONTACT's own columns give the numbers of accuracy.md, so the extraction is right."""
    mean = {m: accuracy.errors_on_ellipses(m, True)["force"].mean() for m in ("fastrip_orig", "fastrip_modf")}
    np.testing.assert_allclose([mean["fastrip_orig"], mean["fastrip_modf"]], (0.0169, 0.0179), atol=1e-4)
    kpec, own = (accuracy.published_on_patches(n) for n in ("kpec_fastsim", "analyn_fastsim"))
    np.testing.assert_allclose([np.abs(kpec["N"]).mean(), np.abs(own["pmax"]).mean()], (0.016, 0.076), atol=5e-4)
    np.testing.assert_allclose([kpec["L2"].mean(), own["L2"].mean()], (0.152, 0.130), atol=1e-3)


def test_default_answers_on_difficult_patches_and_where_analyn_fails_it_says_so():
    # flange roots, worn profiles, neighbours: 18 patches of set O; over all 81 the default is .009 and .005 off
    force, pressure, gap_error = accuracy.errors_of(reference.wheel_rail_patches())
    assert force.mean() < 0.017
    # .049 with a coarser table of effective creepages, .097 when every patch had one equivalent ellipse
    assert force.max() < 0.055  # .0529 while the moment of slender ellipses counted more in the effective creepages
    # a peak narrower than a strip: 20, 24, 30, 48 strips give 5.1, 3.5, 1.9, 1.2 % too little
    assert np.abs(pressure).max() < 0.053
    # .018 without the waves between strips; a worn profile has .033, its force is .023 off
    assert gap_error.max() < 0.034
    force, pressure, gap_error = accuracy.errors_of(reference.wheel_rail_patches(), **contact.THESIS)
    wrong = np.abs(pressure) > 0.20
    assert wrong.sum() == 3
    assert np.all(gap_error[wrong] > GAP_LIMIT)
    assert np.sum(gap_error[~wrong] > GAP_LIMIT) <= 7  # false alarms: 6 of 15
