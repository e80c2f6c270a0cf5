"""The C interface gives the numbers of Python, bit for bit."""

import ctypes
import math
from dataclasses import replace

import numpy as np
import pytest

import contact
from contact import stress
from contact.compile.c_header import PATH, header
from contact.geometry import profile
from contact.geometry.surfaces import Flat, RailSurface, SurfacePair, WheelSurface, compiled
from contact.geometry.wheelset import Pair as Profiles
from contact.geometry.wheelset import Pose, Velocity
from contact.inputs.options import SAMPLES
from contact.kernels.enumerations import Height, Status
from contact.kernels.records import DAMAGE, RESULT
from contact.pair import WheelRailPair
from tests.capi.library import FIELDS, LOAD, OPTIONS, Pair, Patch


def _patch_options(library, **changed):
    made = np.zeros(1, OPTIONS)
    library.need("wr_contact_default", made)
    for name, value in changed.items():
        made[name] = value
    return made


SEPARATION = contact.Separation((y := np.linspace(-12e-3, 12e-3, 101)), 0.8 * y**2 + 3e3 * y**3 + 2e6 * y**4, 1.1)
CREEPAGE = contact.Creepage(1e-3, 5e-4, 0.2)


def set_case(patch, creepage=CREEPAGE, load=80e3):
    patch.case["load_kind"], patch.case["amount"] = 0, load
    patch.case["vx"], patch.case["vy"], patch.case["phi"] = creepage.longitudinal, creepage.lateral, creepage.spin


def equal(record, solution):
    for name in ("Fx", "Fy", "Mz", "N", "approach"):
        assert record[name][0] == getattr(solution, name), name


def test_the_committed_header_is_the_generated_one():
    assert PATH.read_text() == header()


@pytest.mark.parametrize(
    ("which", "force", "status"),
    [
        (0, None, Status.OK),
        (1, (-6e3, None), Status.OK),
        (2, (None, 4e3), Status.OK),
        (3, (-6e3, 4e3), Status.OK),
        (3, (-3e4, 2e4), Status.UNREACHABLE),
    ],
)
@pytest.mark.parametrize(("normal", "tangential"), [("strip_halfspace", "fastrip_mapped"), ("analyn", "fastrip"),
                                                ("kik_piotrowski", "fastsim"), ("hertz", "polach")])  # fmt: skip
def test_a_patch_has_the_bits_of_the_solver(library, normal, tangential, which, force, status):
    """Under creepages, and under forces along x, y and both; each step starts from the last one."""
    known = contact.methods().batched
    patch = Patch(library, normal=int(known.normal[normal].id), tangential=int(known.tangential[tangential].id))
    solver = contact.Solver(normal=normal, tangential=tangential)
    separation, result = patch.separation(SEPARATION), np.zeros(1, RESULT)
    name, more = "wr_contact_solve", ()
    if which:
        numbers = [ctypes.c_double(np.nan if f is None else f) for f in force]
        name, more = "wr_contact_solve_force", (ctypes.c_int64(which), *numbers)
    for step in range(3):
        creepage, load = contact.Creepage(1e-3, 5e-4 * (step + 1), 0.2), 80e3 + 1e3 * step
        set_case(patch, creepage, load)
        want = solver.solve(SEPARATION, creepage, load=load, force=force, warm=step > 0)
        code = library.need(name, patch.memory, separation, *more, patch.case, result)
        equal(result, want)
        assert (patch.case["vx"][0], patch.case["vy"][0]) == (want.creepage.longitudinal, want.creepage.lateral)
        assert want.status is status
        assert code == (0 if status is Status.OK else status)
        library.need("wr_contact_accept", patch.memory)


def test_trying_is_free_and_accept_is_not(library):
    patch, result, again = Patch(library), np.zeros(1, RESULT), np.zeros(1, RESULT)
    separation = patch.separation(SEPARATION)
    set_case(patch)
    library.need("wr_contact_solve", patch.memory, separation, patch.case, result)
    other = patch.case.copy()
    other["amount"] = 60e3
    library.need("wr_contact_solve", patch.memory, separation, other, again)
    library.need("wr_contact_solve", patch.memory, separation, patch.case, again)
    assert again == result
    library.need("wr_contact_accept", patch.memory)
    library.need("wr_contact_solve", patch.memory, separation, patch.case, again)
    assert again["iterations"] < result["iterations"] or again["Fx"] != result["Fx"]
    library.need("wr_contact_forget", patch.memory)
    library.need("wr_contact_solve", patch.memory, separation, patch.case, again)
    assert again == result


def test_fields_and_damage_are_those_of_the_solution(library):
    patch, result = Patch(library), np.zeros(1, RESULT)
    set_case(patch)
    library.need("wr_contact_solve", patch.memory, patch.separation(SEPARATION), patch.case, result)
    want = contact.Solver().solve(SEPARATION, CREEPAGE, load=80e3)
    arrays, fields = np.zeros((8, 80, 20)), np.zeros(1, FIELDS)
    fields["size"], fields["n_strips_most"] = FIELDS.itemsize, 80
    for name, array in zip(("x", "y", "p", "qx", "qy", "sx", "sy", "stick"), arrays, strict=True):
        fields[name] = array.ctypes.data
    library.need("wr_contact_fields", patch.memory, fields)
    n = int(fields["n_strips"][0])
    assert n == 20
    for name, array in zip(("x", "p", "qx", "qy", "sx", "sy"), arrays[[0, 2, 3, 4, 5, 6], :n], strict=True):
        assert np.array_equal(array, np.asarray(getattr(want, name))), name
    assert np.array_equal(arrays[7, :n] > 0.5, np.asarray(want.stick) > 0.5)
    assert np.array_equal(arrays[1, :n, 0], np.asarray(want.strips.y))
    parameters = np.zeros(1, contact.damage.DamageParameters().record(contact.STEEL, 0.46, 20.0).dtype)
    damage = np.zeros(1, DAMAGE)
    library.need("wr_damage_default", parameters)
    library.need("wr_contact_damage", patch.memory, parameters, damage)
    assert damage["T_gamma"][0] == abs(want.Fx * 1e-3) + abs(want.Fy * 5e-4)


def _surface_load():
    """Return the arrays of a load by name, and its struct."""
    arrays, load = {n: np.empty(64 * 64 if n in ("p", "qx", "qy") else 64) for n in LOAD.names[3:]}, np.zeros(1, LOAD)
    load["size"], load["nx"], load["ny"] = LOAD.itemsize, 64, 64
    for name, array in arrays.items():
        load[name] = array.ctypes.data
    return arrays, load


@pytest.mark.parametrize(("body", "number"), [("rail", 0), ("wheel", 1)])
@pytest.mark.parametrize("limit", [math.inf, 8e8])
def test_stresses_have_the_bits_of_python(library, limit, body, number):
    patch, result = Patch(library, pressure_limit=limit), np.zeros(1, RESULT)
    set_case(patch)
    library.need("wr_contact_solve", patch.memory, patch.separation(SEPARATION), patch.case, result)
    solution = contact.Solver(material=replace(contact.STEEL, pressure_limit=limit)).solve(
        SEPARATION, CREEPAGE, load=80e3
    )
    want = stress.SurfaceLoad.of(solution)
    arrays, load = _surface_load()
    assert result["limited"][0] == (limit < math.inf)
    library.need("wr_contact_surface_load", patch.memory, load)
    for name, array in arrays.items():
        assert np.array_equal(array, getattr(want, name).ravel()), name
    points = np.linspace(-4e-3, 4e-3, 9), np.linspace(-2e-3, 3e-3, 9), np.linspace(0.0, 4e-3, 9)
    found = np.empty((9, 6))
    nu = ctypes.c_double(contact.STEEL.poisson_ratio)
    library.need("wr_stress", load, ctypes.c_int64(number), nu, ctypes.c_int64(9), *points, found)
    field = stress.at(solution, *points, body=body)
    for name, values in zip(("xx", "yy", "zz", "xy", "xz", "yz"), found.T, strict=True):
        assert np.array_equal(values, getattr(field, name)), name
    assert found[:, 2].min() < -1e8


@pytest.mark.parametrize("limit", [math.inf, 7e8])
def test_the_load_of_a_patch_of_a_pair_carries_its_forces(library, limit):
    options = _patch_options(library, n_samples=81, pressure_limit=limit)
    pair = Pair(library, profile.s1002(), profile.rail_60e1(), patch=options)
    pair.input["surface"]["pressure_limit"] = limit
    pair.input["motion"]["y"], pair.input["motion"]["yaw"] = 2e-3, 2e-3
    pair.solve()
    result, (arrays, load) = np.zeros(1, RESULT), _surface_load()
    library.need("wr_pair_patch", pair.memory, 0, result, None)
    library.need("wr_pair_surface_load", pair.memory, 0, load)
    cell = np.ptp(arrays["x"]) * np.ptp(arrays["y"]) / 63**2
    assert 64 * np.ptp(arrays["x"]) / 63 == pytest.approx(result["length"][0], rel=1e-9)
    for name, force, error in (("p", "N", 1e-9), ("qx", "Fx", 0.02), ("qy", "Fy", 0.02)):
        assert arrays[name].sum() * cell == pytest.approx(result[force][0], rel=error), name
    assert result["pmax"][0] == limit if limit < math.inf else result["pmax"][0] > 7e8
    assert arrays["p"].max() == pytest.approx(result["pmax"][0], rel=0.01)


def test_a_method_without_tractions_has_no_load_for_stresses(library):
    known = contact.methods().batched
    patch, result = Patch(library, tangential=int(known.tangential["polach"].id)), np.zeros(1, RESULT)
    set_case(patch)
    library.need("wr_contact_solve", patch.memory, patch.separation(SEPARATION), patch.case, result)
    _, load = _surface_load()
    assert library.about(library.call("wr_contact_surface_load", patch.memory, load)) == "memory"


def test_the_derivatives_of_a_patch_have_the_bits_of_the_solver(library):
    patch, jacobian = Patch(library), np.zeros((6, 5))
    set_case(patch)
    library.need("wr_contact_derivatives", patch.memory, patch.separation(SEPARATION), patch.case, jacobian)
    want = contact.Solver().solve(SEPARATION, CREEPAGE, load=80e3, derivatives=True).jacobian.values
    assert jacobian.tolist() == want.tolist()


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(
    ("height", "speed", "slowest"),
    [("load", 20.0, 1e-3), ("vertical", 20.0, 1e-3), ("given", 20.0, 1e-3),
     *(("load", speed, slowest) for speed in (-3.0, -1e-12, 0.0, 0.02) for slowest in (1e-3, 5.0))],
)  # fmt: skip
def test_a_pair_and_its_derivatives_have_the_bits_of_python(library, side, height, speed, slowest):
    """Also rolling back, standing and near it."""
    wheel, rail, jacobian = profile.s1002(), profile.rail_60e1(), np.zeros((6, 17))
    pair = Pair(library, wheel, rail, side=side, reference_speed=slowest)
    reference = WheelRailPair(Profiles(wheel, rail, side="right" if side == 1 else "left", reference_speed=slowest))
    motion = pair.input["motion"]
    motion["vx"], motion["vy"], motion["spin"] = speed, 1e-4, -0.99 * speed / 0.46
    for lateral in (0.0, 3e-3, 6.5e-3):
        pose = Pose(lateral, 1e-4 if height == "given" else 0.0, 0.0, 2e-3)
        force = {} if height == "given" else {height: 80e3}
        velocity = Velocity(speed, y=1e-4, spin=-0.99 * speed / 0.46)
        want = reference.solve(pose, velocity, **force, derivatives=height != "vertical")
        pair.input["height"] = {"load": Height.LOAD, "vertical": Height.VERTICAL, "given": Height.GIVEN}[height]
        motion["y"], motion["z"], motion["yaw"] = pose.y, pose.z, pose.yaw
        pair.solve()
        total = pair.answer["total"][0]
        assert [total[n] for n in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")] == [*want.force, *want.moment]
        assert total["n_patches"] == len(want.contacts)
        assert total["z"] == want.z
        for k, one in enumerate(want.contacts):
            assert pair.answer["patches"][0, k]["N"] == one.N
        if height != "vertical":
            library.need("wr_pair_derivatives", pair.memory, pair.input, jacobian)
            slopes = want.jacobian.values
            assert jacobian[:, : slopes.shape[1] - 1].tolist() == slopes[:6, :-1].tolist()
            assert height == "load" or not jacobian[:, 16].any()
            pair.solve()
        library.need("wr_pair_accept", pair.memory)


@pytest.mark.parametrize(("side", "tilted"), [(1, 0), (-1, 1)])
def test_a_pair_on_surfaces_has_the_bits_of_python(library, side, tilted):
    wheel = WheelSurface.constant(profile.s1002()).with_deviations(Flat(0.04, 0.46))
    upper = profile.rail_60e1()
    slices = [np.stack((upper.y, upper.z + depth), axis=1) for depth in (0.0, 0.0, 2e-3)]
    rail, origin = RailSurface((-0.5, 0.0, 0.5), slices), SurfacePair(profile.s1002(), upper).rail_origin
    body = "right" if side == 1 else "left"
    surfaces = SurfacePair(wheel, rail, side=body, tilted=bool(tilted), rail_origin=origin)
    numbers = compiled.numbers(surfaces.wheel), compiled.numbers(surfaces.rail, surfaces.rail_origin)
    pair = Pair(library, *numbers, side=side, tilted=tilted, patch=_patch_options(library, n_samples=SAMPLES.usual))
    reference = WheelRailPair(surfaces)
    for step, station in enumerate((-0.2, 0.1, 0.3)):
        pose, rotation = Pose(1e-3 * step, 0.0, 0.0, 2e-3), -0.03 * step
        want = reference.solve(pose, Velocity(20.0), load=80e3, station=station, rotation=rotation)
        pair.input["motion"]["y"], pair.input["motion"]["yaw"] = pose.y, pose.yaw
        pair.input["station"], pair.input["rotation"] = station, rotation
        for _ in range(2):  # trying is free
            pair.solve()
        total = pair.answer["total"][0]
        assert [total[n] for n in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")] == [*want.force, *want.moment]
        assert total["n_patches"] == len(want.contacts) > 0
        result = np.zeros(1, RESULT)
        library.need("wr_pair_patch", pair.memory, 0, result, None)
        assert result["N"][0] == pytest.approx(want.contacts[0].N, rel=1e-3)
        library.need("wr_pair_accept", pair.memory)


def test_a_pair_on_surfaces_names_what_is_wrong(library):
    wheel = compiled.numbers(WheelSurface.constant(profile.s1002()))
    broken = wheel.copy()
    broken[0] = 1e6
    for bad in (broken, broken[:7]):
        with pytest.raises(AssertionError, match=r"wheel\.numbers"):
            Pair(library, bad, wheel)
    with pytest.raises(AssertionError, match=r"options\.n_bins"):
        Pair(library, wheel, wheel, n_bins=4)


def test_trying_a_pair_is_free(library):
    pair = Pair(library, profile.s1002(), profile.rail_60e1(), n_bins=200)
    pair.input["distance"] = 1.0
    pair.solve()
    first, bins = pair.answer.copy(), np.zeros((2, 10, 200))
    library.need("wr_pair_bins", pair.memory, bins, 4000)
    assert not bins.any()
    pair.input["motion"]["y"] = 4e-3
    pair.solve()
    pair.input["motion"]["y"] = 0.0
    pair.solve()
    assert pair.answer.tobytes() == first.tobytes()
    library.need("wr_pair_accept", pair.memory)
    library.need("wr_pair_bins", pair.memory, bins, 4000)
    assert bins.any()
    assert library.call("wr_pair_accept", pair.memory) < 0  # booked once


def test_profiles_without_tangents_get_those_of_python(library):
    wheel, rail = profile.s1002(), profile.rail_60e1()
    plain = [profile.Profile(p.kind, p.y, p.z) for p in (wheel, rail)]
    pair = Pair(library, *plain, angles=False)
    pair.solve()
    want = WheelRailPair(Profiles(*plain)).solve(Pose(), Velocity(20.0), load=80e3)
    assert pair.answer["total"]["Fy"][0] == pytest.approx(want.force[1], rel=1e-6)
