"""Derivatives of the compiled core against the same kernels on dual numbers, which have no step and no truncation."""

import dataclasses

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.kernels.enumerations import Height
from contact.kernels.records import GIVEN
from contact.pair import WheelRailPair
from tests import dual
from tests.dual import Dual, copied, plain, record, slope, value
from tests.separations import two_lobes

SEPARATION, CREEPAGE, LOAD = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 5e-4, 0.2), 80e3
NORMAL, TANGENTIAL = (dict(of) for of in (contact.methods().batched.normal, contact.methods().batched.tangential))
#: Rows of `Solution.jacobian`.
ANSWERS = ("Fx", "Fy", "Mz", "N", "approach", "power")
WRENCH = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")


UNIT = np.array([1.0, 1.0, 5e-3, 1.0, 1e-9, 1.0])


def scaled(error: np.ndarray, wanted: np.ndarray) -> float:
    """Return the largest error over the largest of the wanted slopes, moments over 5 mm. Some laws have columns of zeros."""
    return float(np.abs(error / UNIT).max() / max(np.abs(wanted / UNIT).max(), 1.0))


def solver_of(normal: str, tangential: str) -> contact.Solver:
    made = contact.Solver(normal=normal, tangential=tangential, n_strips=10, n_elements=10)
    made.arrays.case["tolerance"] = 1e-11
    return made


@pytest.mark.parametrize(
    ("tangential", "separation"),
    [
        *((name, SEPARATION) for name in TANGENTIAL),
        *(("fastrip_mapped", two_lobes(2e-6, spacing)) for spacing in (8e-3, 12e-3)),
    ],
)
def test_columns_of_creepage_and_friction(tangential, separation):
    """Two lobes and two patches pull each other along. All columns are taken at once, each over its largest element."""
    solver = solver_of("strip_halfspace", tangential)
    solution = solver.solve(separation, CREEPAGE, load=LOAD, derivatives=True)
    assert solution.jacobian is not None
    columns = solution.jacobian.values[:, [0, 1, 2, 4]]
    for signs in ((1.0, 1.0, 1.0, 1.0), (1.0, -1.0, 1.0, -1.0)):
        seeds = signs / np.maximum(np.abs(columns / UNIT[:, None]).max(axis=0), LOAD / 3.0)  # 1e-6 of the load is noise
        own, case = copied(solver.arrays.workspace), record(solver.arrays.case[0])
        result = record(solver.arrays.result[0])
        for member, seed in zip(("vx", "vy", "phi", "mu"), seeds, strict=True):
            setattr(case, member, Dual(getattr(case, member), seed))
        case.kinetic = case.mu
        plain("result", "clear_forces")(result)
        plain("pipeline", "roll_case")(None, solution.strips.y.size, case, own, result)
        assert value(result.Fx) == solution.Fx
        wanted = np.array([slope(getattr(result, name)) for name in ANSWERS])
        assert np.abs((columns @ seeds - wanted) / UNIT).max() < 3e-6


@pytest.mark.parametrize("normal", NORMAL)
def test_columns_of_approach_and_load(normal):
    """The column of the load is that of the approach over the stiffness. The bound is the curvature over the step."""
    solver = solver_of(normal, "fastrip_mapped")
    approach = solver.forces(SEPARATION, CREEPAGE, load=LOAD).approach
    given = solver.solve(SEPARATION, CREEPAGE, approach=approach, derivatives=True)
    own, case, result = copied(solver.arrays.workspace), record(solver.arrays.case[0]), record(solver.arrays.result[0])
    own.space.memory[:] = 0.0
    plain("result", "clear")(result)
    case.amount = Dual(case.amount, 1.0)
    samples = copied(SEPARATION.packed.value)
    n = plain("pipeline", "press_case")(samples, case, own, result)
    plain("pipeline", "roll_case")(samples, n, case, own, result)
    assert value(result.N) == pytest.approx(given.N, rel=1e-9)
    by_approach = np.array([slope(getattr(result, name)) for name in ANSWERS])
    loaded = solver.solve(SEPARATION, CREEPAGE, load=LOAD, derivatives=True)
    assert given.jacobian is not None
    assert loaded.jacobian is not None
    assert scaled(given.jacobian.values[:, 3] - by_approach, by_approach) < 3e-5
    by_load = by_approach / by_approach[3]
    assert scaled(loaded.jacobian.values[:, 3] - by_load, by_load) < 3e-5


NORMALS = ("analyn", "hertz", "kik_piotrowski", "linder", "semi_winkler", "strip_halfspace")
RAIL, TWO = profile.rail_60e1(inclination=1 / 40), profile.rail_60e1(inclination=1 / 20)
#: Tread, flange root under yaw, and two patches.
PLACES = [
    *((normal, {}, 3e-3, 2e-3) for normal in NORMALS),
    *((normal, {"side": "left"}, -6.2e-3, -8e-3) for normal in NORMALS),
    ("analyn", {"rail": TWO, "combine_distance": 1e-3, "combine_angle": 0.01}, 6e-3, 2e-3),
]
#: Members of a motion by the accuracy of their columns: those that move the surfaces, and the velocities.
MOVES = [name for name in GIVEN.names or () if name in ("y", "z", "roll", "yaw") or name.startswith("rail")]
GROUPS = (MOVES, 2e-4), ([name for name in GIVEN.names or () if name not in MOVES], 1e-5)


@pytest.mark.parametrize(("members", "bound"), GROUPS, ids=["moves", "velocities"])
@pytest.mark.parametrize(("normal", "options", "y", "yaw"), PLACES)
def test_all_columns_of_a_pair(normal, options, y, yaw, members, bound):
    """The whole kernel runs on dual numbers: search, frames, creepages, strips and tractions.

    All columns of a group are taken at once, each over its largest element, with different signs in each of two directions.
    """
    pair = WheelRailPair(Pair(profile.s1002(), **{"rail": RAIL, **options}), normal=normal, n_strips=10, n_elements=10)
    pair.arrays.case["tolerance"] = 1e-11
    pose, velocity = Pose(y=y, yaw=yaw, roll=1e-3), Velocity(20.0, y=0.01, yaw=3e-3, spin=-20.01 / 0.46)
    pose = dataclasses.replace(pose, z=pair.solve(pose, velocity, load=LOAD).z)
    pair.forget()
    found = pair.solve(pose, velocity, derivatives=True)
    assert found.jacobian is not None
    assert len(found.contacts) == 1 + ("rail" in options)
    columns = found.jacobian.values[:6, [(GIVEN.names or ()).index(member) for member in members]]
    for signs in np.random.default_rng(len(members)).choice((-1.0, 1.0), (2, len(members))):
        arrays, given = copied(pair.arrays), record(pair.pair.given(pose, velocity, None))
        arrays.memory[:] = 0.0
        seeds = signs / np.abs(columns).max(axis=0)
        for member, seed in zip(members, seeds, strict=True):
            setattr(given, member, Dual(getattr(given, member), seed))
        plain("pair", "solve_pair")(Height.GIVEN, 0.0, given, arrays)
        total = arrays.total[0]
        np.testing.assert_allclose([value(total.Fx), value(total.Fy), value(total.Fz)], found.force, rtol=1e-8)
        wanted = np.array([slope(getattr(total, name)) for name in WRENCH])
        assert np.abs(columns @ seeds - wanted).max() < bound


def test_a_dual_number_does_not_lose_its_derivative_in_silence():
    with pytest.raises(TypeError):
        np.zeros(1)[0] = Dual(1.0, 1.0)
    z = Dual(0.3, 1.0)
    h = 1e-6
    for name, of in vars(dual.MATH).items():
        if callable(of) and name not in ("floor", "atan2", "copysign", "isfinite"):
            assert slope(of(z)) == pytest.approx((of(0.3 + h) - of(0.3 - h)) / (2.0 * h), rel=1e-8), name
    assert slope(dual.MATH.atan2(z, 2.0)) == pytest.approx(2.0 / 4.09)
    assert slope((z**3 - 1.0 / z) ** 0.5 if z > 2.0 else 2.0 - z * z / (1.0 + z)) == pytest.approx(
        -(2.0 * 0.3 * 1.3 - 0.09) / 1.69
    )
