"""Names of the C interface in a host that links its files statically."""

import re
import shutil
import subprocess

import pytest

from contact.compile.library import C_INTERFACE, flags, write_declarations
from tests.capi.library import ROOT

HEADER = (ROOT / "contact/include/wheelrail.h").read_text()


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """Name of each function and variable that a file gives to others → whether it is hidden."""
    if shutil.which("gcc") is None or shutil.which("readelf") is None:
        pytest.skip("gcc or readelf is missing")
    folder = tmp_path_factory.mktemp("names")
    write_declarations(folder, ("",))
    subprocess.run(["gcc", "-std=c11", *flags(folder), "-c", *map(str, C_INTERFACE)], cwd=folder, check=True)
    found = {}
    for path in folder.glob("*.o"):
        told = subprocess.run(["readelf", "-sW", path], capture_output=True, text=True, check=True).stdout
        for line in told.splitlines():
            match line.split():
                case [_, _, _, _, "GLOBAL", visibility, place, name] if place != "UND":
                    found[name] = visibility == "HIDDEN"
    return found


def test_only_the_functions_of_the_header_are_exported(shared):
    declared = set(re.findall(r"^WR_API [^(]*?(\w+)\(", HEADER, re.MULTILINE))
    assert {name for name, hidden in shared.items() if not hidden} == declared | {"wr_constants"}


def test_functions_that_the_files_share_have_a_prefix_that_no_host_has(shared):
    assert len(shared) > len(re.findall("^WR_API", HEADER, re.MULTILINE)) + 1
    assert [name for name, hidden in shared.items() if hidden and not name.startswith("wri_")] == []
