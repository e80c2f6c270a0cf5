"""Objects with arrays in threads and processes: every answer is right, or a ContactError says to make another object."""

import copy
import importlib
import inspect
import multiprocessing
import pickle
import pkgutil
import re
import signal
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from threading import Barrier, Thread
from typing import Any, NamedTuple

import numpy as np
import pytest

import contact
import contact_models
from contact import Creepage, Separation
from contact.accumulation import Histogram, Section
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import Flat, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.instance.ownership import OwnsArrays
from contact.pair import HalfspacePair, RollerRig, TransientPair, WheelRailPair, over_poses
from contact.pair import solution as pair_solutions
from contact.results import solution as solutions
from contact.stress import Endurance
from contact_models.vehicle.coupling import OpenVehicle
from tests.vehicle.parts import simulation

GAP = Separation.hertzian(1.1, 0.8)
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
REFUSED = r"in use by another thread.*Make one for each thread"


def pair():
    return Pair(WHEEL, RAIL)


def surfaces(spacing=None):
    flat = WheelSurface.constant(WHEEL, Flat(0.02))
    return SurfacePair(flat, RAIL, rows=20, columns=20, spacing=spacing)


def pose(k):
    return Pose(y=1e-4 * (k % 40))


class Kind(NamedTuple):
    """How an object is made, and what it answers to question `k`, as numbers. A `stepper` advances with each question."""

    make: Callable[[], Any]
    ask: Callable[[Any, int], Any]
    stepper: bool = False


def loads(patches):
    return [(patch.load, patch.approach, patch.creepage.spin) for patch in patches]


def forces(solution):
    return [*solution.force, *solution.moment, solution.z]


def require_refusal(error):
    """Raise an error that is not that of a second thread."""
    if "one for each thread" not in str(error):
        raise error


OWNERS = {
    "Solver": Kind(contact.Solver, lambda o, k: o.solve(GAP, Creepage(1e-4 * (k % 40)), load=8e4).Fx),
    "Solver of forces": Kind(contact.Solver, lambda o, k: o.forces(GAP, Creepage(1e-4 * (k % 40)), load=8e4).Fx),
    "Pair": Kind(pair, lambda o, k: loads(o.contacts(pose(k), load=8e4))),
    "Pair touching": Kind(pair, lambda o, k: o.touch(pose(k))),
    "SurfacePair": Kind(surfaces, lambda o, k: [patch.approach for patch in o.contacts(pose(k), penetration=1e-4)]),
    "WheelRailPair": Kind(lambda: WheelRailPair(pair()), lambda o, k: forces(o.solve(pose(k), load=8e4))),
    "WheelRailPair driven": Kind(
        lambda: WheelRailPair(pair()), lambda o, k: forces(o.solve(pose(k), Velocity(20.0), load=8e4, force=2e3))
    ),
    "WheelRailPair on surfaces": Kind(
        lambda: WheelRailPair(surfaces()), lambda o, k: forces(o.solve(pose(k), penetration=1e-4))
    ),
    "HalfspacePair": Kind(
        lambda: HalfspacePair(surfaces()), lambda o, k: forces(o.solve(pose(10 * k), penetration=1e-4))
    ),
    "TransientPair": Kind(
        lambda: TransientPair(surfaces(spacing=1e-3)),
        lambda o, k: forces(o.shift(pose(0), Velocity(0.0, spin=1e-6), penetration=1e-4)),
        stepper=True,
    ),
    "RollerRig": Kind(
        lambda: RollerRig(pair(), 0.5), lambda o, k: forces(o.solve(pose(k), Velocity(20.0), vertical=5e4))
    ),
    "Transient": Kind(
        lambda: contact.Transient(GAP, load=80e3, spacing=1e-3),
        lambda o, k: o.roll(Creepage(1e-3), distance=1e-3).Fx,
        stepper=True,
    ),
    "Simulation": Kind(simulation, lambda o, k: [o.advance(1e-4, 5), o.state.q.copy()][1], stepper=True),
    "OpenVehicle": Kind(lambda: OpenVehicle(simulation()), lambda o, k: o.ask()),
}
(PATCH,) = pair().contacts(Pose(), load=8e4)
SOLVED = contact.solve(PATCH.separation, PATCH.creepage, load=8e4)
OWNERS |= {
    "Histogram": Kind(
        lambda: Histogram(WHEEL), lambda o, k: [o.add(PATCH, SOLVED, distance=1.0), o["wear"]][1], stepper=True
    ),
    "Section": Kind(
        lambda: Section(RAIL, Endurance(3e8, 8.0, 1e6), [1e-3, 2e-3]),
        lambda o, k: [o.add(PATCH, SOLVED), o.damage.copy()][1],
        stepper=True,
    ),
}
COPIES = {"copy": copy.copy, "deepcopy": copy.deepcopy, "pickle": lambda o: pickle.loads(pickle.dumps(o))}
PURE = [name for name, kind in OWNERS.items() if not kind.stepper]


@pytest.fixture(params=OWNERS)
def kind(request):
    return OWNERS[request.param]


@pytest.mark.parametrize("name", PURE)
def test_two_threads_with_one_object_get_right_answers_or_are_refused(name):
    kind = OWNERS[name]
    one, n = kind.make(), 8 if name in ("HalfspacePair", "SurfacePair", "RollerRig") else 40
    right = [kind.ask(one, k) for k in range(n)]

    def answer(k):
        try:
            return kind.ask(one, k)
        except ContactError as error:
            return require_refusal(error)

    with ThreadPoolExecutor(2) as threads:
        for found, expected in zip(threads.map(answer, range(n)), right, strict=True):
            if found is not None:  # a warm start changes a result within the tolerance of its method
                np.testing.assert_allclose(found, expected, rtol=1e-3, atol=1e-3 * np.abs(expected).max())


@pytest.mark.parametrize("name", [name for name in OWNERS if OWNERS[name].stepper])
def test_steps_of_two_threads_are_made_one_after_the_other_or_refused(name):
    kind = OWNERS[name]
    one, alone, made = kind.make(), kind.make(), []

    def answer(k):
        try:
            made.append(kind.ask(one, k))
        except ContactError as error:
            require_refusal(error)

    with ThreadPoolExecutor(2) as threads:
        list(threads.map(answer, range(12)))
    steps = [kind.ask(alone, k) for k in range(len(made) + 1)]
    np.testing.assert_allclose(kind.ask(one, 0), steps[-1], rtol=1e-9, atol=1e-15)


def test_a_call_while_another_one_runs_is_refused_and_does_not_wait(kind):
    one = kind.make()
    kind.ask(one, 0)
    with one._turn, pytest.raises(ContactError, match=REFUSED):
        kind.ask(one, 0)
    kind.ask(one, 0)


@pytest.mark.parametrize("way", COPIES)
def test_a_copy_answers_as_the_object_would_and_shares_no_array_with_it(kind, way):
    one = kind.make()
    kind.ask(one, 3)
    other = COPIES[way](one)
    assert type(other) is type(one)
    np.testing.assert_array_equal(kind.ask(other, 7), kind.ask(one, 7))
    with one._turn:
        kind.ask(other, 7)


def test_a_copied_solver_has_the_surface_and_the_table_that_were_set():
    solver = contact.Solver(normal="hertz", tangential="fastsim")
    solver.set_surface(0.1, 33.0)
    solver.calibrate(contact.theory.kalker.constant_table(4.0, 3.0, 1.0))
    for way in COPIES.values():
        found = way(solver).solve(GAP, Creepage(1e-4), load=8e4)
        assert (found.speed, found.friction) == (33.0, 0.1)
        assert found.Fx == solver.solve(GAP, Creepage(1e-4), load=8e4).Fx


def test_copies_do_not_warn_again(recwarn):
    unlike = contact.Material.from_pair(60e9, 0.31, 210e9, 0.28)
    one = WheelRailPair(pair(), material=unlike)
    recwarn.clear()
    for way in COPIES.values():
        way(one)
    assert not recwarn.list


def test_two_pairs_made_of_one_are_both_right_at_the_same_time():
    geometry = pair()
    alone = [forces(WheelRailPair(geometry).solve(pose(k), load=8e4)) for k in range(40)]
    for shared in (geometry, WheelRailPair(geometry).pair):

        def whole(_, shared=shared):
            one = WheelRailPair(shared)
            found = []
            for k in range(40):
                one.forget()
                found.append(forces(one.solve(pose(k), load=8e4)))
            return found

        with ThreadPoolExecutor(2) as threads:
            for found in threads.map(whole, range(2)):
                np.testing.assert_array_equal(found, alone)


def test_two_pairs_with_one_ledger_take_turns():
    from contact.instance import workspace

    ledger = workspace.ledger(np.stack((WHEEL.y, WHEEL.z)), np.stack((RAIL.y, RAIL.z)), 20, 200, -0.1, 1e-3)
    one, other = (WheelRailPair(pair(), ledger=ledger) for _ in range(2))
    with one._turn, pytest.raises(ContactError, match=REFUSED):
        other.solve(Pose(), load=8e4, distance=1.0)
    with WheelRailPair(pair())._turn:
        other.solve(Pose(), load=8e4, distance=1.0)


def test_solve_and_over_poses_may_be_called_from_any_thread():
    one, y = WheelRailPair(pair()), np.linspace(-2e-3, 2e-3, 5)
    right = [contact.solve(GAP, Creepage(1e-4 * k), load=8e4).Fx for k in range(40)]
    poses = over_poses(one, y=y, load=8e4, threads=1).Fy
    with ThreadPoolExecutor(4) as threads:
        found = threads.map(lambda k: contact.solve(GAP, Creepage(1e-4 * k), load=8e4).Fx, range(40))
        again = [threads.submit(over_poses, one, y=y, load=8e4, threads=2) for _ in range(4)]
    assert list(found) == right
    for each in again:
        np.testing.assert_array_equal(each.result().Fy, poses)


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_a_pair_and_its_solutions_travel_to_processes_and_back(way):
    if way not in multiprocessing.get_all_start_methods():
        pytest.skip(f"this system has no {way}")
    one, poses = WheelRailPair(pair()), [pose(10 * k) for k in range(4)]
    here = [copy.copy(one).solve(each, load=8e4) for each in poses]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(way)) as processes:
        there = list(processes.map(partial(solve_from_cold, one), poses))
        solved = processes.submit(contact.solve, GAP, Creepage(1e-3), load=8e4).result()
    for mine, other in zip(here, there, strict=True):
        np.testing.assert_array_equal(mine.force, other.force)
        assert mine.contacts == other.contacts
    np.testing.assert_array_equal(solved.qx, contact.solve(GAP, Creepage(1e-3), load=8e4).qx)


def solve_from_cold(one, pose):
    one.forget()
    return one.solve(pose, load=8e4)


def test_a_callback_that_uses_its_own_object_is_refused_and_the_object_serves_afterwards():
    def roll(*_):
        rolled.roll(Creepage(1e-3), distance=1e-3)

    rolled = contact.Transient(GAP, load=80e3, spacing=1e-3, progress=roll)
    with pytest.raises(ContactError, match=REFUSED):
        rolled.roll(Creepage(1e-3), distance=1e-3)
    rolled._progress = None
    assert rolled.roll(Creepage(1e-3), distance=1e-3).Fx < 0.0


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this system has no timer")
def test_a_signal_handler_may_solve_while_the_same_problem_is_solved():
    right, inside, going = contact.solve(GAP, Creepage(1e-3), load=8e4).Fx, [], [True]

    def solve(*_):
        inside.append(contact.solve(GAP, Creepage(2e-3), load=8e4).Fx)
        if going:  # the next one comes after this one, or on a slow machine handlers would wait inside each other
            signal.setitimer(signal.ITIMER_REAL, 1e-3)

    before = signal.signal(signal.SIGALRM, solve)
    signal.setitimer(signal.ITIMER_REAL, 1e-3)
    try:
        outside = {contact.solve(GAP, Creepage(1e-3), load=8e4).Fx for _ in range(400)}
    finally:
        going.clear()
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert outside == {right}
    assert inside
    assert set(inside) == {contact.solve(GAP, Creepage(2e-3), load=8e4).Fx}


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this system has no timer")
def test_an_interrupted_call_leaves_its_object_usable():
    def interrupt(*_):
        raise KeyboardInterrupt

    one = WheelRailPair(pair())
    right = one.solve(pose(3), load=8e4).Q
    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        for _ in range(20):
            try:
                signal.setitimer(signal.ITIMER_REAL, 2e-3)
                while True:
                    one.solve(pose(3), load=8e4)
            except KeyboardInterrupt:
                assert abs(one.solve(pose(3), load=8e4).Q - right) < 1e-6 * right
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("name", ["x", "qx", "strips", "friction", "force", "contacts", "damage"])
def test_two_threads_may_read_one_solution(monkeypatch, name):
    """Fields and patches are made when they are first read."""
    of_pair = name in ("force", "contacts", "damage")
    module, maker = (pair_solutions, "_made") if of_pair else (solutions, "_arrays")
    make, both = getattr(module, maker), Barrier(2)

    def slow(*left):
        time.sleep(0.02)
        return make(*left)

    monkeypatch.setattr(module, maker, slow)
    solution = (
        WheelRailPair(pair()).solve(Pose(), load=8e4) if of_pair else contact.solve(GAP, Creepage(1e-3), load=8e4)
    )

    def read():
        both.wait()
        found.append(getattr(solution, name))

    found = []
    readers = [Thread(target=read) for _ in range(2)]
    for reader in readers:
        reader.start()
    for reader in readers:
        reader.join()
    assert len(found) == 2


def test_results_can_be_pickled_and_copied():
    one = WheelRailPair(pair())
    solved = one.solve(Pose(y=3e-3), Velocity(20.0), load=8e4, derivatives=True)
    run = one.run({"time": [0.0, 0.1], "velocity.x": 20.0, "load": 8e4})
    case = contact.forces(GAP, Creepage(1e-3), load=[4e4, 8e4], derivatives=True)
    for copied in COPIES.values():
        again = copied(solved)
        np.testing.assert_array_equal(again.force, solved.force)
        assert again.contacts == solved.contacts
        assert again.jacobian["Fy", "pose.y"] == solved.jacobian["Fy", "pose.y"]
        assert copied(run).solutions[1].Q == run.solutions[1].Q
        np.testing.assert_array_equal(copied(run)["Q"], run["Q"])
        np.testing.assert_array_equal(copied(case).Fx, case.Fx)
        np.testing.assert_array_equal(copied(over_poses(one, load=8e4)).Q, over_poses(one, load=8e4).Q)
        (patch,) = one.pair.contacts(Pose(), load=8e4)
        assert not copied(patch).separation.y.flags.writeable
        np.testing.assert_array_equal(copied(patch).separation.g, patch.separation.g)


def test_every_class_that_keeps_arrays_for_kernels_lets_one_thread_in():
    """Words of arrays that are packed once, and blocks of memory, belong to a class that takes turns."""
    kept = re.compile(r"= pack\(|workspace\.(allocate|pair_arrays|\w*search|sheet|derivative_arrays)\(")
    found = set()
    for package in (contact, contact_models):
        for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
            if module.name.startswith(("contact.kernels", "contact.core", "contact.plot", "contact.cli")):
                continue
            for _, each in inspect.getmembers(importlib.import_module(module.name), inspect.isclass):
                if each.__module__ == module.name and kept.search(inspect.getsource(each)):
                    found.add(each)
    assert {contact.Solver, Pair, WheelRailPair, OpenVehicle} <= found
    assert [each for each in found if not issubclass(each, OwnsArrays)] == []
