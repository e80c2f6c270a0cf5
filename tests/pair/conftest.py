"""Pairs that several modules solve."""

import pytest

from tests.pair.made import make


@pytest.fixture(scope="module")
def right():
    return make()


@pytest.fixture(scope="module")
def pair():
    return make()


@pytest.fixture(scope="module")
def left():
    return make("left")
