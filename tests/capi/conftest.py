"""The library of this checkout, for the tests of the C interface."""

import shutil
from pathlib import Path

import pytest

from contact.core import library


@pytest.fixture(scope="session")
def built() -> Path:
    """Folder with the library, its object and wheelrail_entries.h."""
    if shutil.which("gcc") is None:
        pytest.skip("gcc is missing")
    folder = library.cached()
    assert (folder / library.NAME).is_file()
    return folder
