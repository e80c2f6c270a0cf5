"""The location of the resources is a URI, which hosts spell in many ways. The profiles of a pair are found by all of them."""

from copy import copy

import pytest
from spellings import OF_WINDOWS, SPELLINGS

PLATFORMS = ["linux64", "win64"]


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
