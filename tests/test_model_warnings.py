"""What a method leaves out is said where it matters (`contact.errors.ModelWarning`)."""

import copy
import math
import warnings

import numpy as np
import pytest

import contact
from contact import Creepage, Separation, stress
from contact.errors import ModelWarning
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.pair import WheelRailPair
from contact.study.ellipse import ellipse

HERTZ, ROLLING = Separation.hertzian(1.1, 0.8), Creepage(1e-3)
UNLIKE = contact.Material.from_pair(60e9, 0.31, 210e9, 0.28)
SOLVERS = {
    "solve": lambda material: contact.solve(HERTZ, ROLLING, load=5e4, material=material),
    "forces": lambda material: contact.forces([HERTZ], ROLLING, load=5e4, material=material),
    "Solver": lambda material: contact.Solver(material=material).forces(HERTZ, ROLLING, load=5e4),
    "WheelRailPair": lambda material: WheelRailPair(Pair(profile.s1002(), profile.rail_60e1()), material=material),
}


def bent(slope: float) -> Separation:
    """Return a contact whose angle changes by `slope` per metre of y."""
    y = np.linspace(-8e-3, 8e-3, 101)
    return Separation(y, 20.0 * y**2, 1.1, tilt=np.tan(np.clip(slope * y, -1.2, 1.2)))


@pytest.mark.parametrize("name", SOLVERS)
def test_methods_on_strips_say_that_they_take_unlike_bodies_as_alike(name):
    with pytest.warns(ModelWarning, match=r"material.coupling = 0.1\d*: methods on strips take both bodies as alike"):
        SOLVERS[name](UNLIKE)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        SOLVERS[name](contact.STEEL)


def test_the_half_space_takes_unlike_bodies_and_says_nothing():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        contact.solve(
            HERTZ, ROLLING, load=5e4, material=UNLIKE, normal="halfspace", tangential="halfspace", spacing=1.5e-3
        )


def test_stresses_of_unlike_bodies_ask_for_the_ratio_of_the_body():
    with pytest.warns(ModelWarning):
        solution = contact.solve(HERTZ, ROLLING, load=5e4, material=UNLIKE)
    with pytest.warns(ModelWarning, match="give poisson_ratio of the body"):
        stress.at(solution, 0.0, 0.0, 1e-3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        stress.at(solution, 0.0, 0.0, 1e-3, poisson_ratio=0.31)


def test_the_change_of_the_contact_angle_over_a_patch_is_told():
    solution = contact.solve(bent(20.0), ROLLING, load=2e4)
    low, high = solution.patch_edges[0]
    assert solution.bend == pytest.approx(20.0 * (high - low), rel=1e-3)
    assert contact.solve(HERTZ, ROLLING, load=2e4).bend == 0.0


def test_a_wide_bent_patch_in_the_plane_gives_a_warning():
    with pytest.warns(ModelWarning, match=r"bend = 0.\d+: the contact angle changes"):
        wide = contact.solve(bent(250.0), ROLLING, load=5e4)
    assert wide.bend > math.radians(23.0)
    with pytest.warns(ModelWarning, match="A conformal surface has both, but the influence numbers of a plane"):
        contact.solve(bent(250.0), ROLLING, load=5e4, conformal=True)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        contact.solve(bent(20.0), ROLLING, load=5e4)


def test_two_patches_in_one_plane_with_different_angles_give_a_warning():
    """Each of them changes its angle by less than .1 rad; that of both together changes by .5."""
    y = np.linspace(-20e-3, 20e-3, 401)
    separation = contact.Separation(y, 40.0 * np.minimum((y - 10e-3) ** 2, (y + 10e-3) ** 2), 1.1, tilt=25.0 * y)
    with pytest.warns(ModelWarning, match=r"bend = 0.\d+: the contact angle changes"):
        found = contact.solve(separation, ROLLING, load=5e4)
    assert found.n_patches == 2
    assert found.bend == pytest.approx(2.0 * math.atan(25.0 * found.patch_edges[1][1]), rel=1e-2)


def model_warnings(call):
    """Return the ModelWarnings of a call, every one that is given."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        call()
    return [str(each.message) for each in found if each.category is ModelWarning]


def test_each_object_warns_once_for_each_reason():
    """The text has a number, so Python would show it a hundred times in a loop."""
    geometry = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))
    poses = [Pose(y=6.68e-3 + 2e-6 * k, yaw=20e-3) for k in range(8)]
    for make in (WheelRailPair, lambda pair: WheelRailPair(pair, conformal=True)):
        for one in (make(geometry), make(geometry)):
            told = model_warnings(lambda one=one: [one.solve(pose, load=8e4) for pose in poses])
            assert [text.partition(" ")[0] for text in told] == ["gap_error", "beyond"]
    bend = [bent(250.0), bent(260.0)]
    solver = contact.Solver()
    assert len(model_warnings(lambda: [solver.solve(gap, ROLLING, load=5e4) for gap in bend])) == 1
    assert len(model_warnings(lambda: [contact.Solver().solve(bend[0], ROLLING, load=5e4) for _ in range(2)])) == 2
    each = [lambda gap=gap: contact.solve(gap, ROLLING, load=5e4) for gap in bend for _ in range(3)]
    assert [len(model_warnings(call)) for call in each] == [1, 0, 0, 1, 0, 0]
    assert len(model_warnings(lambda: contact.solve(bend[0], ROLLING, load=5e4, conformal=True))) == 1


def test_all_patches_of_a_pair_warn_once():
    for pair in (Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)) for _ in range(2)):
        patches = [pair.contacts(Pose(y=6.68e-3 + 2e-6 * k, yaw=20e-3), load=8e4)[0] for k in range(4)]
        told = model_warnings(
            lambda patches=patches: [contact.solve(p.separation, p.creepage, load=2.1e5, throw=False) for p in patches]
        )
        assert {text.partition(" ")[0] for text in told} == {"gap_error", "bend", "beyond"}
        assert len(told) == 3
    gaps = [p.separation for p in patches]
    assert len(model_warnings(lambda: [contact.forces(gaps, ROLLING, load=2.1e5) for _ in range(3)])) == 1


def test_a_warning_that_is_an_error_is_raised_again():
    solver = contact.Solver()
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelWarning)
        for _ in range(2):
            with pytest.raises(ModelWarning):
                solver.solve(bent(250.0), ROLLING, load=5e4)


def test_every_way_to_strips_tells_of_a_bent_patch():
    profiles, pose = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)), Pose(y=6.6e-3)
    for conformal in (False, True):
        told = r"bend = 0.\d+: the contact angle changes"
        with pytest.warns(ModelWarning, match=told):
            contact.forces([bent(250.0)], ROLLING, load=5e4, conformal=conformal)
        with pytest.warns(ModelWarning, match=told):
            contact.Solver(conformal=conformal).forces(bent(250.0), ROLLING, load=5e4)
        pair = WheelRailPair(profiles, conformal=conformal)
        with pytest.warns(ModelWarning, match=told):
            pair.solve(pose, load=8e4)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelWarning)
        pair.solve(Pose(), load=8e4)


def test_a_pressure_that_leaves_gaps_is_told():
    """A yawed wheel between tread and flange: the pressures along the strips are no semi-ellipses, at status OK."""
    pair, pose = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)), {"y": 6.68e-3, "yaw": 20e-3}
    (patch,) = pair.contacts(Pose(**pose), load=8e4)
    told = "gap_error = 0.0[3-9]"
    with pytest.warns(ModelWarning, match=told):
        contact.solve(patch.separation, ROLLING, load=patch.load)
    with pytest.warns(ModelWarning, match=told):
        contact.forces([patch.separation], ROLLING, load=patch.load)
    with pytest.warns(ModelWarning, match=told):
        WheelRailPair(pair).solve(Pose(**pose), load=8e4)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelWarning)
        WheelRailPair(pair).solve(Pose(y=4e-3, yaw=10e-3), load=8e4)


@pytest.mark.parametrize(("a_over_b", "told"), [(0.05, 1), (0.2, 0), (25.0, 0), (45.0, 1)])
def test_patches_beyond_the_table_of_creep_forces_are_told(a_over_b, told):
    """It reaches from .1 to 31.6; a third of the patches on flanges have 18 to 32."""
    separation = ellipse(a_over_b, 6e-3, 8e4)
    for given in ({}, {"tangential": "table"}, {"normal": "analyn"}):
        texts = model_warnings(lambda given=given: contact.Solver(**given).solve(separation, ROLLING, load=8e4))
        assert [text.partition(" = ")[0] for text in texts] == ["beyond"] * told
        assert contact.Solver(**given).solve(separation, ROLLING, load=8e4).beyond == pytest.approx(told, abs=1e-3)
    assert model_warnings(lambda: contact.Solver(tangential="fastrip").solve(separation, ROLLING, load=8e4)) == []
    assert len(model_warnings(lambda: contact.forces([separation], ROLLING, load=8e4))) == told


@pytest.mark.parametrize("tangential", contact.methods().batched.tangential)
def test_patches_beyond_kalkers_coefficients_are_told_by_every_method_that_reads_them(tangential):
    """They reach from 1/50 to 50: at a/b of 60 and 80 forces were .12 and .32 of mu N off, and two methods said so."""
    told = tangential not in ("carter", "johnson", "vermeulen_johnson")
    given = {"normal": "hertz", "tangential": tangential}
    texts = model_warnings(lambda: contact.Solver(**given).solve(ellipse(60.0, 6e-3, 8e4), ROLLING, load=8e4))
    assert [text.partition(" = ")[0] for text in texts] == ["beyond"] * told


def test_a_pair_tells_of_a_patch_beyond_the_table_of_creep_forces():
    """A cylinder on a rail with a radius of 60 m."""
    y = np.linspace(-0.037, 0.037, 297)
    edges = 250.0 * np.maximum(np.abs(y) - 0.028, 0.0) ** 2
    rails = [profile.Profile("rail", y, y**2 / (2.0 * radius) + edges) for radius in (60.0, 0.3)]
    for rail, told in zip(rails, (["beyond"], []), strict=True):
        pair = WheelRailPair(Pair(profile.cone(0.0), rail))
        texts = model_warnings(lambda pair=pair: pair.solve(Pose(), load=2e3))
        assert [text.partition(" = ")[0] for text in texts] == told
        assert pair.solve(Pose(), load=2e3).beyond == len(told)


def test_rows_of_a_yawed_flange_that_are_no_parabolas_are_told():
    """Elements on the same parabolas are .068 of mu N off those on the distance of both surfaces, and gap_error was .019."""
    profiles, pose = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)), Pose(y=7.7e-3, yaw=23.9e-3)
    with pytest.warns(ModelWarning, match="gap_error = "):
        found = WheelRailPair(profiles).solve(pose, load=9e4)
    assert max(c.gap_error for c in found.contacts) > 0.03
    patch = max(profiles.contacts(pose, load=9e4), key=lambda one: one.load)
    for options in ({}, {"normal": "halfspace", "tangential": "halfspace"}):
        with pytest.warns(ModelWarning, match="rows along x are no parabolas"):
            contact.solve(copy.copy(patch.separation), patch.creepage, load=patch.load, **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelWarning)
        for quiet in (Pose(y=7.7e-3), Pose(y=3e-3, yaw=20e-3), Pose(y=-2e-3, yaw=-20e-3)):
            WheelRailPair(profiles).solve(quiet, load=9e4)


@pytest.mark.parametrize("name", ["strip_halfspace", "analyn", "halfspace"])
def test_a_load_that_no_approach_above_round_off_carries_is_told(name):
    both = {"normal": name} | ({"tangential": name} if name == "halfspace" else {})
    with pytest.warns(
        ModelWarning, match=r"load = 1e-100: its approach is within the round-off of the gap over y = \["
    ):
        assert contact.solve(HERTZ, ROLLING, load=1e-100, **both).status is contact.Status.NO_CONTACT
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        contact.solve(HERTZ, ROLLING, load=0.0, **both)
        contact.solve(HERTZ, ROLLING, approach=-1e-3, **both)
