"""Shared cases: one wheel-rail-like ellipse and what surrounds it."""

import pytest
from hypothesis import settings

import contact

# Helpers whose assertions are to say as much as those of tests.
pytest.register_assert_rewrite("tests.command_line", "tests.post_conditions")

# The same examples every time: what a run finds is due to the change that it tests. --hypothesis-profile=search looks farther.
settings.register_profile("repeatable", derandomize=True)
settings.register_profile("search", print_blob=True)
if settings.get_current_profile_name() == "default":
    settings.load_profile("repeatable")


@pytest.fixture(scope="session")
def ellipse() -> contact.Separation:
    """Wheel radius 0.5 m on a rail head of 0.25 m: A = 1 1/m, B = 2 1/m."""
    return contact.Separation.hertzian(1.0, 2.0)


#: Folders whose tests are all slow: whole FMUs, and runs of a train over a line.
SLOW = {"system", "life"}


@pytest.hookimpl(tryfirst=True)  # before -m is looked at
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark slow folders. Tests of native FMUs come first: a worker builds these while the other compiles, and none waits."""
    for item in items:
        if item.path.parent.name in SLOW:
            item.add_marker("slow")
    items.sort(key=lambda item: "native" not in getattr(item, "fixturenames", ()))
