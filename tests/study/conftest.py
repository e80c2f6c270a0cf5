"""Two small comparisons that the tests look at."""

import pytest

import contact

METHODS = ("hertz+fastsim", "analyn+fastrip")


def problem(name="ellipse", **given):
    return contact.Case(
        contact.Separation.hertzian(1.1, 0.8),
        contact.Creepage(-1e-3, 5e-4, 0.1),
        **({"load": 60e3} | given),
        name=name,
    )


@pytest.fixture(scope="session")
def small():
    """Two cases, one of them without contact, two methods and a coarse half space."""
    cases = [problem(), problem("apart", load=None, approach=-1e-6)]
    return contact.compare(cases, METHODS, n_strips=12, n_elements=12, reference_elements=20)
