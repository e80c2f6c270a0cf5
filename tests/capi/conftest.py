"""The library of this checkout, for the tests of the C interface."""

import shutil
from pathlib import Path

import pytest

import contact


@pytest.fixture(scope="session")
def built() -> Path:
    """Folder with the library."""
    if shutil.which("gcc") is None:
        pytest.skip("gcc is missing")
    return contact.get_library().parent
