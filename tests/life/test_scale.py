"""Runs on several workers: results do not depend on their number, their order or a crash of a worker."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest

from contact.errors import ContactError
from contact_models.life import declared_set, scale
from contact_models.life.scale import Workers
from contact_models.life.wear import Life
from tests.life.short_set import written


def deadly(item: tuple[str, int]) -> int:
    """Kill the worker on the first call with number 2. Otherwise return the square."""
    folder, number = item
    mark = Path(folder) / "killed"
    if number == 2 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def test_without_workers_items_are_done_in_order():
    seen = []
    with Workers() as pool:
        assert pool.map(abs, [-3, 2, -1], lambda done, total: seen.append((done, total))) == [3, 2, 1]
    assert seen == [(1, 3), (2, 3), (3, 3)]


@pytest.fixture(scope="module")
def two():
    """Two workers, of which each takes seconds to begin."""
    pytest.importorskip("distributed")
    with Workers(2) as pool:
        yield pool


def test_killed_worker_loses_nothing(two, tmp_path):
    assert two.map(deadly, [(str(tmp_path), k) for k in range(5)]) == [0, 1, 4, 9, 16]
    assert (tmp_path / "killed").exists()


def test_a_scheduler_without_workers_is_named(monkeypatch):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(scale, "_PATIENCE", 0.2)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=":0") as cluster,
        pytest.raises(ContactError, match=r"scheduler = 'tcp://.*' has no workers after 0\.2 s; start some with"),
        Workers(scheduler=cluster.scheduler_address),
    ):
        pass


def test_wear_has_the_same_bits_with_any_number_of_workers(two, tmp_path):
    saved = []
    for pool in (Workers(1), two):
        life = Life(declared_set.read(written(tmp_path)))
        life.step(pool, go_on=True)
        saved.append(life.save())
    assert all(np.array_equal(saved[0][name], saved[1][name]) for name in saved[0])
