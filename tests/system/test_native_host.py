"""The native FMU in a host written in C, on Linux and, where Wine is installed, as the Windows library."""

import re
import shutil

import pytest


@pytest.mark.parametrize("command", ["instantiate", "every_call", "status_functions", "log_categories", "threads"])
def test_on_linux(host, command):
    host(command)


@pytest.mark.parametrize("command", ["instantiate", "every_call", "status_functions", "log_categories", "threads"])
def test_on_windows_under_wine(windows, command):
    windows(command)


@pytest.mark.parametrize("name", ["host_fmi3", "windows_fmi3"])
@pytest.mark.parametrize("command", ["instantiate", "every_call", "threads"])
def test_fmi_3(request, name, command):
    request.getfixturevalue(name)(command)


def test_every_state_meets_every_function(host, host_fmi3):
    assert int(host("every_call").split()[0]) > 500
    assert int(host_fmi3("every_call").split()[0]) > 1000


@pytest.mark.parametrize("name", ["host", "host_fmi3"])
def test_random_calls_do_no_harm(request, name):
    request.getfixturevalue(name)("random_calls", 20_000)


def test_cycles_and_steps_leave_memory_as_it_was(host):
    host("soak", 3000)


@pytest.mark.parametrize("name", ["host", "host_fmi3"])
def test_valgrind_finds_nothing(request, name):
    """Leaks and reads of what was never written, over all calls and a thousand random ones."""
    host = request.getfixturevalue(name)
    if not shutil.which("valgrind"):
        pytest.skip("valgrind is not installed")
    check = ("valgrind", "--error-exitcode=9", "--leak-check=full", "-q")
    host("every_call", before=check)
    host("random_calls", 1000, before=check)


@pytest.mark.parametrize("name", ["host", "host_fmi3"])
def test_speed_can_be_measured(request, name):
    assert re.findall(r"step ([\d.]+) us", request.getfixturevalue(name)("speed", 100))
