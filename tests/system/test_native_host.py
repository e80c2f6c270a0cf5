"""The native FMU in a C host, on Linux and, if Wine is installed, as the Windows library."""

import os
import re
import shutil
import subprocess

import pytest
from contact_case import NAME

from contact_fmu.catalogue import models
from contact_fmu.native import table
from contact_fmu.tables.wheel_rail_contact import POINTS
from reference.native import ATTACKED, ROLES, SANITIZED, kernel_library, sanitized

OTHERS = [name for name in ROLES if name != NAME]
VALGRIND = ("valgrind", "--error-exitcode=9", "--leak-check=full", "-q")
COMMANDS = ("instantiate", "every_call", "status_functions", "log_categories", "threads")


@pytest.mark.parametrize("name", ROLES)
@pytest.mark.parametrize("command", [command for command in COMMANDS if command != "every_call"])
def test_on_linux(hosts, name, command):
    hosts("linux64", name)(command)


@pytest.mark.parametrize(
    ("name", "command"),
    [
        *((NAME, command) for command in COMMANDS),
        *((name, "threads") for name in OTHERS),
        *((n, "fuzz") for n in ROLES),
    ],
)
def test_on_windows_under_wine(hosts, name, command):
    hosts("win64", name)(command, 5000)


@pytest.mark.parametrize("name", ["host_fmi3", "windows_fmi3"])
@pytest.mark.parametrize("command", ["instantiate", "every_call", "threads"])
def test_fmi_3(request, name, command):
    request.getfixturevalue(name)(command)


@pytest.mark.parametrize("name", ROLES)
def test_every_state_meets_every_function(hosts, name):
    assert int(hosts("linux64", name)("every_call").split()[0]) > 500


def test_every_state_meets_every_function_in_fmi_3(host_fmi3):
    assert int(host_fmi3("every_call").split()[0]) > 1000


@pytest.mark.parametrize("name", ROLES)
def test_no_wrong_call_ends_the_host(hosts, name, tmp_path):
    """A NULL for every pointer of every function of both versions is an Error; random calls return. Each trial is a process.

    100 random sequences of calls of each version and 100 forged states, 20 000 in `make soak`.
    """
    trials = 20_000 if "SOAK" in os.environ else 100
    said = hosts("linux64", name).wrong_calls(tmp_path, trials)
    (of_2, wrong_2), (of_3, wrong_3) = (map(int, found) for found in re.findall(r"(\d+) functions, (\d+) wrong", said))
    assert of_2 == 39
    assert of_3 > 60
    assert min(wrong_2, wrong_3) > 500
    (taken,) = re.findall(rf"(\d+) of {trials} forged states taken", said)
    assert int(taken) > trials // 10  # so they have been tried


@pytest.mark.parametrize("name", [*ROLES, *ATTACKED])
def test_hard_circumstances_end_no_host(hosts, name, tmp_path):
    """A failed allocation is told and the next instance is whole; 128 kB of stack suffice; fork and reload change no digit."""
    if name != "WheelRailPair" and "SOAK" not in os.environ:
        pytest.skip(f"{name} MEETS NO HARDSHIP: all FMUs have one wrapper; run by make soak")
    counts = [int(n) for n in re.findall(r"(\d+) allocations", hosts("linux64", name).hardships(tmp_path))]
    assert len(counts) == 2
    assert min(counts) > 4


@pytest.mark.parametrize("name", ATTACKED)
def test_no_wrong_call_ends_the_host_of_an_fmu_of_another_view(hosts, name, tmp_path):
    """The contact with curvatures and the vehicles, with forged tracks, bodies and clocks in their states."""
    if "SOAK" not in os.environ:
        pytest.skip(f"{name} MEETS NO WRONG CALLS: all FMUs have one wrapper; minutes, run by make soak")
    assert re.search(r"[1-9]\d* of 2000 forged states taken", hosts("linux64", name).wrong_calls(tmp_path, 2000))


def test_any_function_in_any_order_does_what_its_state_allows(host):
    """This includes invalid state bytes and values of any size. In the end every call has been made in every state."""
    assert host("fuzz", 1_000_000).split()[0] == "0"


@pytest.mark.parametrize("name", OTHERS)
def test_any_function_in_any_order_of_the_other_fmus(hosts, name):
    hosts("linux64", name)("fuzz", 30_000)


def test_random_calls_of_fmi_3_do_no_harm(host_fmi3):
    host_fmi3("random_calls", 20_000)


@pytest.mark.parametrize("name", ROLES)
def test_cycles_and_steps_leave_memory_as_it_was(hosts, name):
    """300 instances and 10 000 steps, in `make soak` 10 000 and a million."""
    hosts("linux64", name)("soak", *((10_000, 1_000_000) if "SOAK" in os.environ else (300, 10_000)))


def test_two_fmus_in_one_process_do_not_share_symbols(hosts, host, tmp_path):
    """Their symbols have equal names, but RTLD_LOCAL keeps them apart. One FMU with two guids is tested too."""
    twin = tmp_path / "twin.so"
    shutil.copy(host.library, twin)
    component = models(POINTS)[0].component
    guid = "{" + "0" * 36 + "}"
    (tmp_path / table.NAME).write_bytes(table.content(component, guid))
    host("two_libraries", 0, twin, guid, tmp_path.as_uri())
    for name in OTHERS:
        other = hosts("linux64", name)
        host("two_libraries", 0, other.library, other.guid, other.resources)


@pytest.mark.parametrize("name", [*ROLES, "Wheelset"])
def test_sanitizers_find_nothing_in_the_sources(hosts, name, tmp_path):
    """Wrong accesses, leaks and undefined behaviour, in the wrapper and in the kernels: every call, random and wrong ones.

    Wrong calls take minutes where an instance is large, and are left to `make soak`, as WheelRailContact is: the kernels that
    it calls are those of WheelRailPair.
    """
    if name == NAME and "SOAK" not in os.environ:
        pytest.skip(f"{name} IS NOT COMPILED WITH SANITIZERS: run by make soak")
    if subprocess.run([*SANITIZED, "-x", "c", "-", "-o", tmp_path / "a"], input=b"int main(void) {}").returncode:
        pytest.skip("SANITIZERS FIND NOTHING: gcc or its sanitizers are not installed (apt-get install gcc)")
    usual = hosts("linux64", name)
    host = sanitized(tmp_path, usual.library.parents[2], name)
    if name in ROLES:
        for command in COMMANDS:
            host(command, 5)
        host("fuzz", 20_000)
    if name == "Wheelset" or "SOAK" in os.environ:
        host.wrong_calls(tmp_path, 50)


def test_valgrind_finds_nothing(host, host_fmi3, hosts):
    """It looks for leaks and reads of uninitialised memory, over all calls and random ones. The pair has most kernels."""
    if not shutil.which("valgrind"):
        pytest.skip("MEMORY IS NOT CHECKED: valgrind is not installed (apt-get install valgrind)")
    host("every_call", before=VALGRIND)
    host_fmi3("every_call", before=VALGRIND)
    host_fmi3("random_calls", 2000, before=VALGRIND)
    hosts("linux64", "WheelRailPair")("fuzz", 1000, before=VALGRIND)


def test_speed_can_be_measured(host, tmp_path):
    said = host("speed", 1, kernel_library(tmp_path, "v2")) + host("first_step")
    assert all(float(number) > 0.0 for number in re.findall(r": ([\d.]+)", said))
    assert said.count("\n") == 8
