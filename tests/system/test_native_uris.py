"""The location of the resources is a URI, which hosts spell in many ways. The profiles of a pair are found by all of them."""

import subprocess

import fmpy
import pytest
from pair_case import NAME
from script_host import Script
from spellings import OF_WINDOWS, SPELLINGS

from reference.native import resources_of


@pytest.fixture(params=["linux64", "win64"])
def heard(request, native, unzipped, tmp_path):
    """Return a function that makes a pair at each location in one process, and returns its exit status and its messages."""
    if request.param == "win64":
        request.getfixturevalue("wine")
    folder, script = unzipped(native.with_name(f"{NAME}.fmu")), Script(request.param, tmp_path)
    library = folder / "binaries" / request.param / (NAME + script.suffix)
    words = [*script.before, script.program, library, fmpy.read_model_description(str(folder)).guid, "1"]

    def hear(*uris: str) -> tuple[int, list[str]]:
        command = [*map(str, words), *uris]
        done = subprocess.run(command, input="", capture_output=True, text=True, env=script.environment, timeout=120)
        return done.returncode, done.stdout.splitlines()

    return hear, resources_of(folder, request.param), request.param


def test_a_pair_finds_its_profiles_by_every_spelling(heard):
    """On Windows a drive may be spelt in every way too."""
    hear, uri, platform = heard
    spelt = [spelling(uri) for spelling in (SPELLINGS | (OF_WINDOWS if platform == "win64" else {})).values()]
    assert uri not in spelt
    assert hear(*spelt) == (0, [])


def test_another_location_is_refused(heard):
    hear, uri, _ = heard
    changes = [("resources", "resource"), ("file:///", "http:///"), ("%20", "%2520")]
    status, messages = hear(*(uri.replace(*change) for change in changes))
    assert (status, len(messages)) == (1, len(changes))
    assert all("resource" in message for message in messages)
