"""Shared fixtures and settings of the tests."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

import contact

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


@pytest.fixture(scope="session")
def once(tmp_path_factory) -> Callable[[str, Callable[[Path], object]], Path]:
    """Return a function that makes a file or folder once for all workers.

    `once(name, make)` calls `make(path)` in the first worker that needs it, while the others wait, and returns the path.
    """
    import fcntl  # not on Windows

    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent

    def made(name: str, make: Callable[[Path], object]) -> Path:
        path, mark = shared / name, shared / f"{name}.made"
        with (shared / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not mark.exists():
                make(path)
                mark.touch()
        return path

    return made


#: Folders in which every test is slow: whole FMUs, runs over a line, and the page with the compiled kernels.
SLOW = {"system", "life", "vehicle", "explorer"}


@pytest.hookimpl(tryfirst=True)  # before pytest evaluates -m
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark slow folders, and sort the tests.

    Those of native FMUs run first, so that one worker builds these while the other compiles. Quick tests run last, so that
    at the end no worker waits for a long test of another one.
    """
    for item in items:
        if item.path.parent.name in SLOW:
            item.add_marker("slow")
    items.sort(key=lambda item: ("native" not in getattr(item, "fixturenames", ()), "slow" not in item.keywords))
