"""`contact.Solver` gives the same bits as `contact.solve` after any earlier calls."""

import dataclasses

import numpy as np
import pytest

import contact
from contact.errors import ContactError
from contact.friction import Friction
from reference.random_cases import noisy, two_lobed

#: Iterative and direct methods, one of each march, and one with forces only.
PAIRS = [
    ("analyn", "fastrip"),
    ("analyn", "polach"),
    ("hertz", "fastsim"),
    ("strip_halfspace", "fastrip_mapped"),
    ("kik_piotrowski", "table"),
]
SMALL = {"n_strips": 10, "n_elements": 10}
#: All arrays except `memory`, of which a warm start reads only the part that the patches of the solution have filled.
ARRAYS = ("x", "y", "p", "dA", "patch_edges")
WITH_FIELDS = ("qx", "qy", "sx", "sy", "stick")


def wheel(depth=0.0):
    """Return a gap with two lobes: an ellipse and a flatter one, which is `depth` [m] lower than the first."""
    y = np.linspace(-0.02, 0.02, 81)
    return contact.Separation(y, np.minimum(2.0 * (y + 0.004) ** 2, 3.0 * (y - 0.008) ** 2 + depth), 1.1)


ELLIPSE = contact.Separation.hertzian(1.0, 2.0)
CALLS = [
    (ELLIPSE, contact.Creepage(1e-3, -5e-4, 0.2), {"load": 60e3}),
    (wheel(2e-5), contact.Creepage(-2e-3, 1e-3, 0.0), {"load": 90e3}),
    (ELLIPSE, contact.Creepage(), {"approach": 5e-5}),
    (ELLIPSE, contact.Creepage(0.0, 0.0, 1.0), {"approach": -1e-5}),  # apart
    (wheel(), contact.Creepage(0.05, 0.0, 0.0), {"load": 20e3}),  # full slip
    (ELLIPSE, contact.Creepage(1e-3, -5e-4, 0.2), {"load": 60e3}),  # the first one again
]


def prepared(normal="strip_halfspace", tangential="fastrip_mapped", **others):
    """Return a small solver, by default with the default methods."""
    return contact.Solver(normal=normal, tangential=tangential, **(SMALL | others))


def numbers(solution):
    """Return every plain number of a solution."""
    found = {
        each.name: getattr(solution, each.name)
        for each in dataclasses.fields(solution)
        if each.type in ("float", "int")
    }
    return found | {"status": solution.status}


def arrays(solution):
    """Return every array of a solution."""
    names = ARRAYS + (WITH_FIELDS if solution.has_fields else ())
    found = {name: getattr(solution, name) for name in names}
    strips = {f"strips.{name}": getattr(solution.strips, name) for name in solution.strips.__slots__}
    return found | {name: array for name, array in strips.items() if array is not None}  # None on a plane


def assert_same_bits(found, expected):
    assert numbers(found) == numbers(expected)
    for name, array in arrays(expected).items():
        np.testing.assert_array_equal(arrays(found)[name], array, err_msg=name, strict=True)


# Results of contact.solve


@pytest.mark.parametrize(("normal", "tangential"), PAIRS)
def test_results_equal_solve_bit_for_bit_after_any_other_calls(normal, tangential):
    solver = prepared(normal, tangential, friction=0.35, speed=30.0)
    for separation, creepage, amount in CALLS:
        methods = {"normal": normal, "tangential": tangential, **SMALL}
        expected = contact.solve(separation, creepage, friction=0.35, speed=30.0, throw=False, **methods, **amount)
        assert_same_bits(solver.solve(separation, creepage, throw=False, **amount), expected)
        forces = solver.forces(separation, creepage, **amount)
        for each in dataclasses.fields(forces):
            assert getattr(forces, each.name) == getattr(expected, each.name), each.name


def test_friction_and_speed_of_a_call_stay_for_later_calls():
    solver, (separation, creepage, amount) = prepared(), CALLS[4]
    falling = Friction.polach()
    first = solver.solve(separation, creepage, friction=falling, speed=10.0, **amount)
    assert_same_bits(solver.solve(separation, creepage, **amount), first)
    assert_same_bits(first, contact.solve(separation, creepage, friction=falling, speed=10.0, **SMALL, **amount))
    faster = solver.solve(separation, creepage, speed=40.0, **amount)
    assert_same_bits(faster, contact.solve(separation, creepage, friction=falling, speed=40.0, **SMALL, **amount))


# Warm starts


@pytest.mark.parametrize("depth", [0.0, 1e-5, 3e-5])
def test_a_warm_start_gives_the_same_answer_within_the_tolerance_of_the_method(depth):
    solver = prepared(n_strips=20)
    solver.solve(wheel(depth), CALLS[0][1], load=80e3)
    near = wheel(depth + 5e-7)
    warm = solver.solve(near, CALLS[0][1], load=81e3, warm=True)
    cold = contact.solve(near, CALLS[0][1], load=81e3, n_strips=20, n_elements=10)
    assert pytest.approx(cold.N, rel=1e-3) == warm.N
    assert warm.approach == pytest.approx(cold.approach, rel=1e-3)
    assert warm.area == pytest.approx(cold.area, rel=2e-3)
    assert abs(warm.Fx - cold.Fx) < 1e-3 * 0.3 * cold.N
    assert abs(warm.Fy - cold.Fy) < 1e-3 * 0.3 * cold.N
    assert warm.iterations < cold.iterations


def test_after_forget_a_warm_call_is_a_cold_one():
    solver = prepared("strip_halfspace")
    solver.solve(wheel(), CALLS[0][1], load=80e3)
    solver.forget()
    again = solver.solve(wheel(), CALLS[0][1], load=70e3, warm=True)
    assert_same_bits(again, contact.solve(wheel(), CALLS[0][1], load=70e3, normal="strip_halfspace", **SMALL))


def test_a_warm_start_from_a_solution_is_that_of_solve():
    start = contact.solve(wheel(), CALLS[0][1], load=80e3, normal="strip_halfspace", **SMALL)
    solver = prepared("strip_halfspace")
    solver.start_from(start)
    expected = contact.solve(wheel(), CALLS[0][1], load=70e3, normal="strip_halfspace", start=start, **SMALL)
    assert_same_bits(solver.solve(wheel(), CALLS[0][1], load=70e3, warm=True), expected)


# Room


@pytest.mark.parametrize("way", ["solve", "forces"])
def test_a_larger_separation_makes_room(way):
    y = np.linspace(-0.02, 0.02, 501)
    large = contact.Separation(y, 2.0 * y**2, 1.0)
    solver = prepared(n_samples=41)
    small = solver.solve(ELLIPSE, CALLS[0][1], load=60e3)
    found = getattr(solver, way)(large, CALLS[0][1], load=60e3)
    expected = contact.solve(large, CALLS[0][1], load=60e3, **SMALL)
    assert (found.Fx, found.Fy, found.Mz, found.N, found.area) == (
        expected.Fx, expected.Fy, expected.Mz, expected.N, expected.area,
    )  # fmt: skip
    assert_same_bits(solver.solve(large, CALLS[0][1], load=60e3), expected)
    assert_same_bits(solver.solve(ELLIPSE, CALLS[0][1], load=60e3), small)


# Bad input


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"load": 1e3, "friction": 0.5, "speed": -1.0}, "speed = -1"),
        ({"load": -1.0, "friction": 0.5}, "load = -1"),
        ({"load": 1e9}, r"load = 1e\+09: .*y = \[-0.0223607, 0.0223607\] m"),
    ],
)
def test_after_bad_input_the_solver_goes_on(arguments, message):
    solver = prepared()
    before = solver.solve(ELLIPSE, CALLS[0][1], load=60e3)
    with pytest.raises(ContactError, match=message):
        solver.solve(ELLIPSE, CALLS[0][1], **arguments)
    assert_same_bits(solver.solve(ELLIPSE, CALLS[0][1], load=60e3), before)
    assert_same_bits(solver.solve(ELLIPSE, CALLS[0][1], load=60e3, speed=20.0), before)


def test_the_status_of_forces_reports_unreliable_results():
    solver = prepared()
    assert solver.forces(ELLIPSE, CALLS[0][1], load=1e9).status == contact.Status.OUT_OF_RANGE
    assert solver.solve(ELLIPSE, CALLS[0][1], load=1e9, throw=False).status == contact.Status.OUT_OF_RANGE
    assert solver.forces(ELLIPSE, CALLS[0][1], load=60e3).status == contact.Status.OK


# Later calls


@pytest.mark.parametrize("read", [True, False], ids=["read before", "read after"])
def test_later_calls_do_not_change_earlier_solutions(read):
    solver = prepared()
    separation, creepage, amount = CALLS[0]
    first = solver.solve(separation, creepage, **amount)
    before = {name: array.copy() for name, array in arrays(first).items()} if read else {}
    for other in CALLS[1:5]:
        solver.solve(*other[:2], friction=0.1, speed=5.0, throw=False, **other[2])
        solver.forces(*other[:2], **other[2])
    solver.solve(
        contact.Separation(np.linspace(-0.02, 0.02, 301), np.linspace(-0.02, 0.02, 301) ** 2, 2.0), creepage, load=1e4
    )
    assert_same_bits(first, contact.solve(separation, creepage, **SMALL, **amount))
    for name, array in before.items():
        np.testing.assert_array_equal(arrays(first)[name], array)


def test_two_solvers_do_not_share_memory():
    one, other = prepared(), prepared()
    first = one.solve(ELLIPSE, CALLS[0][1], load=60e3)
    other.solve(wheel(), CALLS[1][1], load=90e3, friction=0.1)
    assert_same_bits(one.solve(ELLIPSE, CALLS[0][1], load=60e3), first)


def test_the_repr_of_a_solver_shows_its_settings():
    assert (
        repr(prepared(friction=0.4))
        == "Solver(strip_halfspace + fastrip_mapped, 10 strips x 10 elements, friction 0.4)"
    )


@pytest.mark.parametrize("cap", [1, 2, 5, 39])
def test_a_cap_of_the_iterations_holds_and_says_when_it_is_reached(cap):
    """Gaps with noise of 2 µm, of which some need 40 iterations and more."""
    rng, solver, missed = np.random.default_rng(5), contact.Solver(max_iterations=cap), 0
    for _ in range(20):
        found = solver.solve(noisy(rng), contact.Creepage(1e-3), load=80e3, throw=False)
        assert found.iterations <= cap
        assert pytest.approx(80e3) == found.N
        assert np.all(np.isfinite(found.p))
        missed += found.status == contact.Status.NOT_CONVERGED
    assert missed >= (15 if cap < 5 else 1 if cap == 5 else 0)


def test_a_cap_that_is_not_reached_changes_nothing():
    given = {"load": 80e3, "throw": False}
    assert_same_bits(
        contact.solve(ELLIPSE, CALLS[0][1], max_iterations=25, **given), contact.solve(ELLIPSE, CALLS[0][1], **given)
    )


@pytest.mark.parametrize("cap", [3, 4, 5])
def test_where_the_cap_ends_the_iteration_the_strips_fill_the_patch(cap):
    """The last iteration moves the ends of the panels, so strips and pressures must follow."""
    rng, solver, given = np.random.default_rng(7), contact.Solver(max_iterations=cap), 0
    for _ in range(120):
        found = solver.solve(two_lobed(rng), contact.Creepage(1e-3), load=80e3, throw=False)
        if (
            found.status != contact.Status.NOT_CONVERGED or found.memory[0] == 0.0
        ):  # else converged, or ANALYN's solution
            continue
        for patch, (low, high) in enumerate(found.patch_edges):
            own = found.strips.patch == patch
            y, half = found.strips.y[own], 0.5 * found.strips.dy[own]
            np.testing.assert_allclose([y[0] - half[0], y[-1] + half[-1]], [low, high], rtol=0, atol=1e-12)
        given += 1
    assert given >= 20
