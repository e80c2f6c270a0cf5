"""A pair solves alike whatever its memory held before. In an FMU nobody fills it with zeros."""

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from examples.crossing.crossing import crossing

#: Arrays that are filled once, with the profiles, methods and parameters.
GIVEN = {
    *(f"search.{name}" for name in ("wheel", "rail", "motion", "grid", "case", "across.nodes", "across.weights")),
    "case", "damage_parameters", "memory", "rail", "offset",
}  # fmt: skip


def arrays(found, name=""):
    """Yield the names and arrays of nested tuples."""
    if isinstance(found, np.ndarray):
        yield name.lstrip("."), found
    for each in getattr(found, "_fields", ()):
        yield from arrays(getattr(found, each), f"{name}.{each}")


def numbers(solution):
    return np.array([*solution.force, *solution.moment, solution.z, solution.max_pressure, solution.gap_error])


def fill(array, rng):
    for part in [array[name] for name in array.dtype.names or ()] or [array]:
        part[...] = rng.uniform(-5.0, 5.0, part.shape) if part.dtype.kind == "f" else 77


@pytest.mark.parametrize(
    "methods",
    [*({"normal": name} for name in contact.methods().batched.normal), {"normal": "hertz", "tangential": "table"}],
)
def test_only_what_a_solution_keeps_for_the_next_one_matters_of_the_memory(methods):
    """It is the whole state of an FMU."""
    pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1.0 / 40.0)), **methods)
    left = ("workspace.rule", "workspace.tables", "ledger")
    own = {n: a for n, a in arrays(pair.arrays) if n not in GIVEN and not n.startswith(left) and a.size}
    assert {"search.lobes", "search.patches", "contacts", "total"} <= set(own)
    rng = np.random.default_rng(3)
    for _ in range(40):
        pose = Pose(rng.uniform(-8e-3, 8e-3), 0.0, rng.uniform(-5e-3, 5e-3), rng.uniform(-0.02, 0.02))
        load, found, before = rng.uniform(2e4, 1.5e5), [], pair.arrays.memory.copy()
        for _ in range(2):
            for array in own.values():
                fill(array, rng)
            for name in ("station", "rotation", "reach", "tilted", "changing"):
                fill(pair.arrays.search.motion[name], rng)
            pair.arrays.memory[:] = before
            answer = numbers(pair.solve(pose, Velocity(20.0, spin=-43.4), load=load))
            found.append(np.concatenate((answer, pair.arrays.memory)))
        np.testing.assert_array_equal(*found)


def test_what_the_memory_of_surfaces_held_does_not_matter():
    """The last motion must only be known as none: its radius is 0."""
    pair = WheelRailPair(SurfacePair(profile.s1002(), crossing(), rail_origin=(0.75, 0.0)), normal="analyn")
    left = ("workspace.rule", "workspace.tables", "ledger", "search.wheel.", "search.rail.")
    own = {n: a for n, a in arrays(pair.arrays) if n not in GIVEN and not n.startswith(left) and a.size}
    assert {"search.coarse", "search.boxes", "search.h", "total"} <= set(own)
    rng = np.random.default_rng(3)
    for station in (0.1, 0.158, 0.162, 0.3):
        found = []
        for _ in range(2):
            for array in own.values():
                fill(array, rng)
            fill(pair.arrays.search.motion[1:], rng)
            pair.arrays.search.motion[1].radius = 0.0
            pair.forget()
            found.append(numbers(pair.solve(Pose(y=1e-3), Velocity(20.0, spin=-43.4), station=station, load=8e4)))
        np.testing.assert_array_equal(*found)
