"""A small comparison for the tests."""

import pytest

import contact
from tests.study.problems import METHODS, problem


@pytest.fixture(scope="session")
def small():
    """Return a comparison of two cases (one without contact), two methods and a coarse half space."""
    cases = [problem(), problem("apart", load=None, approach=-1e-6)]
    return contact.compare(cases, METHODS, n_strips=12, n_elements=12, reference_elements=20)
