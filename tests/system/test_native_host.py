"""The native FMU in a host written in C, on Linux and, where Wine is installed, as the Windows library."""

import re
import shutil
from copy import copy
from pathlib import Path

import fmpy
import pytest
from native_host import kernel_library, kernel_objects
from random_cases import POINTS

from fmu_src.native import source
from fmu_src.native.packaging import FLAGS, HEADERS, WRAPPER, compiler, run
from fmu_src.native.wheel_rail_contact import component

COMMANDS = ("instantiate", "every_call", "status_functions", "log_categories", "threads")


@pytest.mark.parametrize("command", COMMANDS)
def test_on_linux(host, command):
    host(command)


@pytest.mark.parametrize("command", [*COMMANDS, "fuzz"])
def test_on_windows_under_wine(windows, command):
    windows(command, 5000)


@pytest.mark.parametrize("name", ["host_fmi3", "windows_fmi3"])
@pytest.mark.parametrize("command", ["instantiate", "every_call", "threads"])
def test_fmi_3(request, name, command):
    request.getfixturevalue(name)(command)


def test_every_state_meets_every_function(host, host_fmi3):
    assert int(host("every_call").split()[0]) > 500
    assert int(host_fmi3("every_call").split()[0]) > 1000


def test_any_function_in_any_order_does_what_its_state_allows(host):
    """Also bytes that are no state, and values of any size; in the end every call of the table was made in every state."""
    assert host("fuzz", 600_000).split()[0] == "0"


def test_random_calls_of_fmi_3_do_no_harm(host_fmi3):
    host_fmi3("random_calls", 20_000)


def test_cycles_and_steps_leave_memory_as_it_was(host):
    """10 000 instances, a million steps."""
    host("soak", 10_000)


def test_two_fmus_in_one_process_do_not_meet(host, native, tmp_path):
    """Their symbols have the same names; loaded by RTLD_LOCAL each has its own. One FMU is also two, with other guids."""
    twin = tmp_path / "twin.so"
    guid = "{" + "0" * 36 + "}"
    twin.write_bytes(host.library.read_bytes().replace(host.guid.encode(), guid.encode()))
    host("two_libraries", 0, twin, guid)
    for path in native.parent.glob("*.fmu"):
        if path != native:
            unzipped = Path(fmpy.extract(str(path), str(tmp_path / path.stem)))
            library = unzipped / "binaries" / "linux64" / f"{path.stem}.so"
            host("two_libraries", 0, library, fmpy.read_model_description(str(unzipped)).guid)


def test_the_wrapper_does_nothing_undefined(host, tmp_path):
    """Compiled such that what C leaves undefined ends the program."""
    model = component(POINTS)
    (tmp_path / "model.h").write_text(source.header(model, host.guid))
    (tmp_path / "model.c").write_text(source.body(model))
    checked = copy(host)
    checked.library = tmp_path / "checked.so"
    run(
        *(*compiler("linux64"), *FLAGS, "-fPIC", "-fsanitize=undefined", "-fsanitize-trap=undefined", f"-I{tmp_path}"),
        *(f"-I{WRAPPER}", f"-I{HEADERS}", *WRAPPER.glob("*.c"), tmp_path / "model.c"),
        *(*kernel_objects(), "-o", checked.library, "-lm"),
    )
    for command in COMMANDS:
        checked(command)
    checked("fuzz", 50_000)


@pytest.mark.parametrize(("name", "command"), [("host", "fuzz"), ("host_fmi3", "random_calls")])
def test_valgrind_finds_nothing(request, name, command):
    """Leaks and reads of what was never written, over all calls and random ones."""
    host = request.getfixturevalue(name)
    if not shutil.which("valgrind"):
        pytest.skip("valgrind is not installed")
    check = ("valgrind", "--error-exitcode=9", "--leak-check=full", "-q")
    host("every_call", before=check)
    host(command, 2000, before=check)


def test_speed_can_be_measured(host, host_fmi3, tmp_path):
    said = host("speed", 1, kernel_library(tmp_path, "v2")) + host("first_step")
    assert all(float(number) > 0.0 for number in re.findall(r": ([\d.]+)", said))
    assert said.count("\n") == 5
    assert re.findall(r"step ([\d.]+) us", host_fmi3("speed", 100))
