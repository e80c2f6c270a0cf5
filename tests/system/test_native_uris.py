"""The location of the resources is a URI, which hosts spell in many ways. The profiles of a pair are found by all of them."""

import re
from copy import copy

import pytest

PLATFORMS = ["linux64", "win64"]
SPELLINGS = {
    "capital letters": lambda uri: uri.replace("file:", "FILE:"),
    "mixed letters": lambda uri: uri.replace("file:", "File:"),
    "one slash": lambda uri: uri.replace("file:///", "file:/"),
    "localhost": lambda uri: uri.replace("file:///", "file://localhost/"),
    "a query": lambda uri: uri + "?version=2",
    "a fragment": lambda uri: uri + "#top",
    "both": lambda uri: uri + "?version=2#top?",
    "a last slash": lambda uri: uri + "/",
    "small hexadecimal digits": lambda uri: re.sub("%[0-9A-F]{2}", lambda found: found[0].lower(), uri),
    "letters that need no code": lambda uri: uri.replace("resources", "%72esource%73"),
}
OF_WINDOWS = {
    "a colon as code": lambda uri: uri.replace("Z:", "Z%3A"),
    "a colon as code in small letters": lambda uri: uri.replace("Z:", "z%3a"),
    "a small drive": lambda uri: uri.replace("Z:", "z:"),
}


def instantiated(host, uri: str) -> None:
    """Assert that the pair finds its profiles at this location, and runs."""
    given = copy(host)
    given.resources = uri
    given("status_functions")


@pytest.fixture(params=PLATFORMS)
def host(hosts, request):
    return hosts(request.param, "WheelRailPair")


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_a_pair_finds_its_profiles_by_every_spelling(host, spelling):
    uri = SPELLINGS[spelling](host.resources)
    assert uri != host.resources
    instantiated(host, uri)


@pytest.mark.parametrize("spelling", OF_WINDOWS)
def test_on_windows_a_drive_may_be_spelt_in_every_way(hosts, spelling):
    host = hosts("win64", "WheelRailPair")
    uri = OF_WINDOWS[spelling](host.resources)
    assert uri != host.resources
    instantiated(host, uri)


@pytest.mark.parametrize("change", [("resources", "resource"), ("file:///", "http:///"), ("%20", "%2520")])
def test_another_location_is_refused(host, change):
    with pytest.raises(AssertionError, match=r"FAILED|resource"):
        instantiated(host, host.resources.replace(*change))
