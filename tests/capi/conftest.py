"""The library of this checkout, for the tests of the C interface."""

import shutil
from pathlib import Path

import pytest

import contact
from tests.capi.library import Library


@pytest.fixture(scope="session")
def built() -> Path:
    """Folder with the library."""
    if shutil.which("gcc") is None:
        pytest.skip("gcc is missing")
    return contact.get_library().parent


@pytest.fixture(scope="module")
def library(built) -> Library:
    """The same, to call its functions."""
    return Library(built)
