"""Accumulated damage: linear growth, conserved volume, merging in any order, mirror symmetry, exact files."""

import dataclasses
from itertools import permutations

import numpy as np
import pytest

import contact
from contact.accumulation import MAXIMA, SUMS, Histogram, load, save, worn_profile
from contact.damage import WEAR_LAWS, ArchardMap, DamageParameters, evaluate, usfd
from contact.errors import ContactError
from contact.geometry.profile import Profile, cone, named, rail_60e1, rail_arc
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.kernels.damage import deposit
from contact.kernels.records import LEDGER
from contact.kernels.rows import Bin, Strip
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL

WHEEL, RAIL = named("1/40"), rail_60e1()
METHODS = f"{DEFAULT_NORMAL} + {DEFAULT_TANGENTIAL}"
POSES = (Pose(y=1e-3, yaw=2e-3), Pose(y=5e-3, yaw=5e-3), Pose(y=7e-3, yaw=5e-3))  # tread, tread and flange root, flange


def solved(pose, side="right", wheel=WHEEL, rail=RAIL, **track):
    patches = Pair(wheel, rail, side=side, **track).contacts(pose, Velocity(forward=30.0), load=60e3)
    solutions = tuple(
        contact.solve(p.separation, p.creepage, load=p.load, speed=30.0, throw=False, n_strips=20, n_elements=20)
        for p in patches
    )
    return patches, solutions


@pytest.fixture(scope="module")
def contacts():
    return [solved(pose) for pose in POSES]


@pytest.fixture(scope="module", params=["wheel", "rail"])
def profile(request):
    return {"wheel": WHEEL, "rail": RAIL}[request.param]


def run(profile, contacts, distance=10.0, **options):
    histogram = Histogram(profile, **options)
    for patches, solutions in contacts:
        histogram.add(patches, solutions, distance=distance)
    return histogram


def values(histogram):
    return np.array([histogram[name] for name in SUMS | MAXIMA])


def test_the_cases_contain_two_patches_and_a_steep_one(contacts):
    assert [len(patches) for patches, _ in contacts] == [1, 2, 1]
    assert contacts[-1][0][0].angle < np.radians(-65.0)


def test_constant_conditions_give_linear_growth(profile, contacts):
    once, often = run(profile, contacts), Histogram(profile)
    for _ in range(7):
        for patches, solutions in contacts:
            often.add(patches, solutions, distance=10.0)
    assert often.distance == pytest.approx(7.0 * once.distance, rel=1e-15)
    for name in SUMS:
        np.testing.assert_allclose(often[name], 7.0 * once[name], rtol=1e-13, atol=1e-13 * often[name].max())
    np.testing.assert_array_equal(often["energy_index_max"], once["energy_index_max"])


@pytest.mark.parametrize("width", [5e-5, 5e-4, 7e-3])
def test_worn_volume_is_the_integral_of_the_depth_over_the_strips(profile, contacts, width):
    histogram, volume, area, T_gamma = run(profile, contacts, width=width), 0.0, 0.0, 0.0
    for patches, solutions in contacts:
        for patch, solution in zip(patches, solutions, strict=True):
            damage = evaluate(solution, patch.rolling_radius)
            depth = damage.archard.depth_per_strip
            volume += 10.0 * damage.archard.volume
            area += 10.0 * (depth * solution.strips.dy).sum()
            T_gamma += 10.0 * damage.T_gamma
    assert volume > 0.0
    assert histogram.volume == pytest.approx(volume, rel=1e-13)
    assert histogram["T_gamma"].sum() == pytest.approx(T_gamma, rel=1e-13)
    if profile.kind == "wheel":
        assert (histogram.depth * width).sum() == pytest.approx(area, rel=1e-13)
    else:  # one pass removes as much from each metre of rail as the wheel loses in rolling one metre
        assert (histogram.depth * width).sum() == pytest.approx(volume / histogram.distance, rel=1e-13)


def test_merging_is_the_sum_of_the_parts_in_any_order(profile, contacts):
    whole = run(profile, contacts)
    parts = [run(profile, [case], distance=10.0) for case in contacts]
    for a, b, c in permutations(parts):
        for merged in ((a + b) + c, a + (b + c)):
            np.testing.assert_allclose(values(merged), values(whole), rtol=1e-13, atol=0.0)
            assert merged.distance == whole.distance
            assert merged.methods == {METHODS}
            assert merged.materials == {contact.STEEL}


@pytest.mark.parametrize("pose", POSES)
def test_the_mirror_image_wears_the_mirrored_profile(profile, pose):
    mirrored = Pose(y=-pose.y, yaw=-pose.yaw)
    right, left = (run(profile, [solved(p, side)]) for p, side in ((pose, "right"), (mirrored, "left")))
    assert right["wear"].max() > 0.0
    for name in SUMS | MAXIMA:
        np.testing.assert_allclose(left[name], right[name], rtol=1e-9, atol=1e-9 * max(right[name].max(), 1e-300))


def test_strips_lie_where_the_contact_points_of_the_profiles_are(contacts):
    for patches, solutions in contacts:
        for profile in (WHEEL, RAIL):
            for patch, solution in zip(patches, solutions, strict=True):
                histogram = run(profile, [((patch,), (solution,))])
                touched = histogram["contact"] > 0.0
                y0 = (patch.on_wheel if profile is WHEEL else patch.on_rail)[0]
                at = np.interp(y0, profile.y, histogram.arc)
                low, high = histogram.centres[touched][[0, -1]]
                assert low - 5e-4 < at < high + 5e-4
                assert high - low == pytest.approx(solution.strips.dy.sum(), abs=1.5e-3)


def test_on_a_plane_and_an_arc_the_coordinates_are_exact():
    """A cone's arc length is the plane's coordinate; on a rail of radius R it is R asin(y/R)."""
    wheel, rail = cone(0.0), rail_arc(0.1)
    patches, solutions = solved(Pose(), wheel=wheel, rail=rail, gauge_point=2e-3)
    (patch,), (solution,) = patches, solutions
    half = solution.strips.y[-1] + 0.5 * solution.strips.dy[-1]
    for profile, reach, on in ((wheel, half, patch.on_wheel), (rail, 0.1 * np.arcsin(half / 0.1), patch.on_rail)):
        histogram = run(profile, [(patches, solutions)], width=2e-5, distance=1.0)
        across = histogram["contact"].sum() * histogram.width
        assert across == pytest.approx(solution.strips.dy.sum(), rel=1e-12), "strips keep their width in all sums"
        ends = (
            histogram.edges[:-1][histogram["contact"] > 0.0].min(),
            histogram.edges[1:][histogram["contact"] > 0.0].max(),
        )
        assert 0.5 * (ends[1] - ends[0]) == pytest.approx(reach, abs=2.1e-5)
        assert 0.5 * (ends[0] + ends[1]) == pytest.approx(on[0], abs=2.1e-5)


def test_a_strip_is_divided_among_bins_by_overlap_and_the_outer_bins_take_the_rest():
    """Bins have width 0.7 and begin at 2.1. Strips are given in bin widths from there."""
    width, start, distance, dy = 0.7, 3.0, 2.0, 0.1
    edges = width * (start + np.array([[0.5, 1.2, -2.0, 2.5], [2.5, 1.4, -1.0, 4.5]]))
    expected = np.array([[0.25, 0.5, 0.25], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    strips = np.zeros((len(Strip), 4))
    strips[Strip.DY] = dy
    rates = np.arange(1.0, 4.0 * len(Bin) + 1.0).reshape(len(Bin), 4)
    for is_wheel, wear in ((True, 1.0), (False, 1.0), (False, 1.25)):
        bins = np.zeros((len(Bin), 3))
        settings = np.array([(start, width, distance)], LEDGER)[0]
        deposit.deposit(rates, edges, strips, 4, settings, 1.0, is_wheel, wear, bins)
        for row in range(Bin.ENERGY_INDEX_MAX):
            rate = rates[Bin.VOLUME if row == Bin.WEAR and not is_wheel else row]
            rate = wear * rate if row in (Bin.WEAR, Bin.VOLUME) else rate
            of_bins = distance * dy * rate @ expected
            scale = 1.0 if row in (Bin.VOLUME, Bin.T_GAMMA) else width
            np.testing.assert_allclose(bins[row], of_bins / scale, rtol=1e-14)
        greatest = np.where(expected > 0.0, rates[Bin.ENERGY_INDEX_MAX][:, None], 0.0).max(axis=0)
        np.testing.assert_array_equal(bins[Bin.ENERGY_INDEX_MAX], greatest)


def test_exceedance_counts_the_distance_with_a_positive_index(contacts):
    (patch,) = contacts[0][0]
    hard, weak = Histogram(RAIL), Histogram(RAIL)
    for histogram, shear_yield in ((hard, 500e6), (weak, 50e6)):
        steel = contact.Material(82e9, 0.28, shear_yield=shear_yield)
        slipping = contact.solve(patch.separation, contact.Creepage(9e-3, 0.0, 0.0), load=patch.load, material=steel)
        assert (evaluate(slipping).stress_index.max > 0.0) is (histogram is weak)
        histogram.add(patch, slipping, distance=3.0)
    assert hard["stress_exceedance"].max() == hard["fatigue_exceedance"].max() == 0.0
    # on the arc a bin is longer than its projection, by 1/cos of up to 4°
    for name in ("contact", "stress_exceedance", "fatigue_exceedance"):
        assert 2.99 < weak[name].max() <= 3.0 * (1.0 + 1e-12), name
    np.testing.assert_array_equal(weak["fatigue_exceedance"], weak["contact"])
    assert (weak["stress_exceedance"] <= weak["contact"]).all(), "the traction vanishes at the edges of the patch"
    assert weak["stress_exceedance"].sum() < weak["contact"].sum()


def test_views_divide_by_the_rolled_distance(contacts):
    wheel, rail = (run(p, contacts, radius=0.5) for p in (WHEEL, RAIL))
    np.testing.assert_allclose(wheel.per("metre")["wear"] * 30.0, wheel["wear"], rtol=1e-15)
    turns = wheel.distance / (2.0 * np.pi * 0.5)
    np.testing.assert_allclose(wheel.per("revolution")["wear"] * turns, wheel["wear"], rtol=1e-14)
    np.testing.assert_array_equal(rail.per("pass")["wear"], rail.depth)
    assert (rail.per("pass")["contact"] <= 1.0 + 1e-12).all()


def test_a_wheel_in_the_air_rolls_on_without_damage():
    histogram = Histogram(WHEEL)
    histogram.add((), (), distance=5.0)
    assert histogram.distance == 5.0
    assert not values(histogram).any()


def chord_minus_tangent(profile):
    """Angle between each chord and the mean of the tangents at its ends [rad]."""
    return np.arctan2(np.diff(profile.z), np.diff(profile.y)) - 0.5 * (profile.angle[1:] + profile.angle[:-1])


def test_the_worn_profile_has_lost_the_worn_area(profile, contacts):
    histogram = run(profile, contacts)
    times = 1e-4 / histogram.depth.max()
    worn = worn_profile(histogram, times, smoothing=2e-3)
    outline = np.concatenate((profile.y, worn.y[::-1])), np.concatenate((profile.z, worn.z[::-1]))
    signed = 0.5 * (outline[0] @ np.roll(outline[1], -1) - outline[1] @ np.roll(outline[0], -1))
    lost = signed if profile.kind == "wheel" else -signed
    # the area between the curves is ∫ depth (1 ± depth κ/2) ds: depth up to 0.05 mm on radii down to 13 mm
    assert abs(lost) == pytest.approx(times * (histogram.depth * histogram.width).sum(), rel=5e-3)
    into = worn.z - profile.z if profile.kind == "rail" else profile.z - worn.z
    assert into.min() >= 0.0, "material is lost, not gained"
    assert np.abs(chord_minus_tangent(worn) - chord_minus_tangent(profile)).max() < 1e-3, "angles belong to the points"


def test_worn_profiles_run_on_each_other_and_wear_on(contacts):
    worn = []
    for new in (WHEEL, RAIL):
        histogram = run(new, contacts[:2])
        worn.append(worn_profile(histogram, 2e-4 / histogram.depth.max()))
    wheel, rail = worn
    patches, solutions = solved(POSES[0], wheel=wheel, rail=rail)
    second = [run(profile, [(patches, solutions)]) for profile in worn]
    assert second[0].volume == pytest.approx(second[1].volume, rel=1e-12)
    assert second[0].volume > 0.0
    with pytest.raises(ContactError, match="different profiles"):
        second[0] + run(WHEEL, contacts[:1])


def test_no_wear_leaves_the_profile(profile):
    worn = worn_profile(Histogram(profile))
    for name in ("y", "z", "angle"):
        np.testing.assert_array_equal(getattr(worn, name), getattr(profile, name))


def test_a_file_gives_back_every_bit(profile, contacts, tmp_path):
    pytest.importorskip("xarray")
    path = tmp_path / "damage.nc"
    constants = DamageParameters(archard=ArchardMap(severe=40e-4), with_spin=True)
    before = run(profile, contacts, parameters=constants, width=3e-4, radius=0.42)
    save(before, path)
    after = load(path)
    np.testing.assert_array_equal(values(after), values(before))
    np.testing.assert_array_equal(after.edges, before.edges)
    for name in ("distance", "methods", "materials", "parameters", "width", "radius"):
        assert getattr(after, name) == getattr(before, name), name
    assert (after + before).volume == 2.0 * before.volume, "what was loaded goes on accumulating"


def test_a_file_explains_itself(contacts, tmp_path):
    xarray = pytest.importorskip("xarray")
    save(run(RAIL, contacts), tmp_path / "damage.nc")
    stored = xarray.load_dataset(tmp_path / "damage.nc", engine="scipy")
    assert stored.attrs["source"] == f"wheelrail-contact {contact.__version__}"
    assert METHODS in stored.attrs["methods"]
    assert "severe_from" in stored.attrs["parameters"]
    assert stored["wear"].attrs["units"] == "m2"
    assert {"units", "long_name"} <= set(stored["energy_index"].attrs)


def test_a_file_of_something_else_is_refused(tmp_path):
    xarray = pytest.importorskip("xarray")
    xarray.Dataset({"a": ("x", [1.0])}).to_netcdf(tmp_path / "other.nc", engine="scipy")
    with pytest.raises(ContactError, match=r"other\.nc"):
        load(tmp_path / "other.nc")


def test_histograms_that_do_not_match_do_not_add_up():
    one = Histogram(WHEEL)
    for other, word in (
        (Histogram(RAIL), "different profiles"),
        (Histogram(WHEEL, width=1e-3), "width"),
        (Histogram(WHEEL, radius=0.5), "radius"),
        (Histogram(WHEEL, parameters=DamageParameters(with_spin=True)), "parameters"),
    ):
        with pytest.raises(ContactError, match=word):
            one + other


def test_bad_input_is_refused_and_nothing_is_added(contacts):
    patches, solutions = contacts[0]
    histogram = Histogram(WHEEL)
    polach = contact.solve(patches[0].separation, patches[0].creepage, load=60e3, tangential="polach")
    for arguments, distance, message in (
        ((patches, ()), 1.0, "1 patches have 0 solutions"),
        ((patches, solutions), -1.0, "distance"),
        ((patches, [polach]), 1.0, "polach"),
    ):
        with pytest.raises(ContactError, match=message):
            histogram.add(*arguments, distance=distance)
    for other in (Profile(p.kind, p.y, p.z + 2e-4) for p in (WHEEL, RAIL)):
        with pytest.raises(ContactError, match=rf"on_{other.kind} .*does not lie on"):
            Histogram(other).add(patches, solutions, distance=1.0)
    with pytest.raises(ContactError, match="is none of"):
        histogram["depth"]
    with pytest.raises(ContactError, match="'metre', 'revolution'"):
        histogram.per("pass")
    with pytest.raises(ContactError, match="nothing has rolled"):
        histogram.per("metre")
    with pytest.raises(ContactError, match="smoothing"):
        worn_profile(histogram, smoothing=1e-4)
    assert histogram.distance == 0.0
    assert not values(histogram).any()


def test_strip_without_area_leaves_no_damage_and_no_nan(contacts):
    """Shortly before a patch separates, a strip may have zero length."""
    (patch, *_), (solution, *_) = contacts[0]
    dA = solution.dA.copy()
    dA[3] = 0.0
    histogram = Histogram(WHEEL)
    histogram.add(patch, dataclasses.replace(solution, dA=dA), distance=10.0)
    for name in (*SUMS, *MAXIMA):
        assert np.isfinite(histogram[name]).all(), name


@pytest.mark.parametrize("times", [0.0, 0.3, 7.0])
def test_scaled_histogram_is_that_of_another_distance(profile, contacts, times):
    histogram = run(profile, contacts)
    later = histogram.scaled(times)
    assert later.distance == times * histogram.distance
    for name in SUMS:
        np.testing.assert_array_equal(later[name], times * histogram[name])
    np.testing.assert_array_equal(later["energy_index_max"], histogram["energy_index_max"])
    with pytest.raises(ContactError, match="times = -1"):
        histogram.scaled(-1.0)


@pytest.mark.parametrize("law", WEAR_LAWS)
def test_depth_of_every_wear_law_integrates_to_its_volume(profile, contacts, law):
    histogram, volume = run(profile, contacts, parameters=DamageParameters(wear_law=law)), 0.0
    for patches, solutions in contacts:
        for patch, solution in zip(patches, solutions, strict=True):
            damage, circumference = evaluate(solution, patch.rolling_radius), 2.0 * np.pi * patch.rolling_radius
            local = usfd(-(solution.qx * solution.sx + solution.qy * solution.sy).clip(max=0.0), 1.0)
            volume += (
                10.0
                * {
                    "archard": damage.archard.volume,
                    "usfd": damage.usfd * solution.area,
                    "usfd_local": (local * solution.dA).sum(),
                    "pearce_sherratt": damage.pearce_sherratt * circumference,
                }[law]
            )
    assert volume > 0.0
    assert histogram.volume == pytest.approx(volume, rel=1e-12)
    if profile.kind == "rail":
        assert (histogram.depth * histogram.width).sum() == pytest.approx(volume / histogram.distance, rel=1e-12)
    else:  # rolling radii of the patches differ from the nominal one by less than 30 mm
        assert (histogram.depth * histogram.width).sum() == pytest.approx(volume / (2.0 * np.pi * 0.46), rel=0.07)
    np.testing.assert_array_equal(histogram["contact"], run(profile, contacts)["contact"])


def test_worn_area_of_pearce_and_sherratt_is_theirs(contacts):
    """Their law gives the area of the cross-section for any radius."""
    histogram = run(WHEEL, contacts, parameters=DamageParameters(wear_law="pearce_sherratt"))
    areas = [
        evaluate(s, p.rolling_radius).pearce_sherratt
        for patches, solutions in contacts
        for p, s in zip(patches, solutions, strict=True)
    ]
    assert (histogram.depth * histogram.width).sum() == pytest.approx(10.0 * sum(areas), rel=1e-12)
