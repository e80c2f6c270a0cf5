"""Shared fixtures and settings of the tests."""

import os
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from threading import Thread

import pytest
from hypothesis import settings

import contact
from contact.study import page
from tests.builds import BUILDS, ROOT

_approx = pytest.approx


def approx(expected, rel=None, abs=None, nan_ok=False):
    """Compare to a relative tolerance, where one is given, and to no other: pytest adds 1e-12, with which volumes of wear in
    cubic metres, or their depth in a metre, would be equal to anything."""
    return _approx(expected, rel, 0.0 if abs is None and rel is not None else abs, nan_ok)


pytest.approx = approx

_IS_WORKER = "PYTEST_XDIST_WORKER" in os.environ
# Helpers whose assertions get the detailed messages of tests.
pytest.register_assert_rewrite("tests.command_line", "tests.post_conditions")

# Use the same examples in every run, so that failures come from the tested change. --hypothesis-profile=search tries others.
settings.register_profile("repeatable", derandomize=True)
settings.register_profile("search", print_blob=True)
if settings.get_current_profile_name() == "default":
    settings.load_profile("repeatable")


@pytest.fixture(scope="session")
def ellipse() -> contact.Separation:
    """Return an elliptic separation: wheel radius 0.5 m on a rail head of 0.25 m, A = 1 1/m, B = 2 1/m."""
    return contact.Separation.hertzian(1.0, 2.0)


@pytest.fixture
def undrawn(monkeypatch) -> None:
    """Leave pictures out of pages, for tests of their text: each is drawn twice, .7 s."""
    monkeypatch.setattr(page, "_data", lambda figure: "")


@pytest.fixture
def drawn_once(monkeypatch) -> None:
    """Put the first picture of a page in place of all others, for tests of what is around them."""
    draw = page._data
    drawn: list[str] = []

    def data(figure) -> str:
        if not drawn:
            drawn.append(draw(figure))
        return drawn[0]

    monkeypatch.setattr(page, "_data", data)


@pytest.fixture(scope="session")
def once(tmp_path_factory) -> Callable[[str], Path]:
    """Return a function that builds one of `BUILDS` once for all workers and returns its path.

    `once(name)` builds in the first worker that needs it, while the others wait. It builds in a process of its own, with the
    environment that the session begins with.
    """
    import fcntl  # not on Windows

    shared, environment = tmp_path_factory.getbasetemp(), dict(os.environ)
    if _IS_WORKER:
        shared = shared.parent

    def built(name: str) -> Path:
        path, mark = shared / name, shared / f"{name}.built"
        command = [sys.executable, "-m", "tests.builds", name, path]
        with (shared / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not mark.exists():
                done = subprocess.run(
                    command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
                )
                if done.returncode:
                    raise RuntimeError(f"{name} could not be built:\n{done.stdout}")
                mark.touch()
        return path

    return built


@pytest.fixture(scope="session", autouse=True)
def _building(request, once) -> None:
    """Build what the session's tests need beside them: a worker that waits for a build leaves its processor idle."""
    used = {name for item in request.session.items for name in item.fixturenames}

    def build() -> None:
        for name in BUILDS:
            if name in used:
                with suppress(RuntimeError):  # the fixture raises it again
                    once(name)

    if _IS_WORKER:
        Thread(target=build, daemon=True).start()


#: Folders in which every test is slow: whole FMUs, runs over a line, and the page with the compiled kernels.
SLOW = {"system", "life", "vehicle", "explorer"}


@pytest.hookimpl(tryfirst=True)  # before pytest evaluates -m
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark slow folders, and sort the tests.

    Slow tests that need no build run first, while the builds go on, then the others in the order of the builds. Quick tests run
    last, so that at the end no worker waits for a long test of another one.
    """
    order = {name: number for number, name in enumerate(BUILDS, 1)}
    for item in items:
        if item.path.parent.name in SLOW:
            item.add_marker("slow")

    def place(item: pytest.Item) -> tuple[bool, int]:
        return "slow" not in item.keywords, max(order.get(name, 0) for name in ("", *getattr(item, "fixturenames", ())))

    items.sort(key=place)
