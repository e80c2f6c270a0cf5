"""The native FMU in a host written in C, on Linux and, where Wine is installed, as the Windows library."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import fmpy
import numpy as np
import pytest
from contact_case import NAME
from test_native_fmu import OUTPUTS, expected, random_case, scales

from fmu_src.native import source
from fmu_src.native.packaging import HEADERS, compiler
from fmu_src.native.wheel_rail_contact import component
from fmu_src.tables.wheel_rail_contact import table

HOST = Path(__file__).with_name("native_host.c")
SUFFIX = {"linux64": ("so", ""), "win64": ("dll", ".exe")}


class Host:
    """The compiled host for one platform."""

    def __init__(self, platform: str, folder: Path, unzipped: Path, extra: tuple[str, ...] = ()) -> None:
        library, program = SUFFIX[platform]
        self.guid = fmpy.read_model_description(str(unzipped)).guid
        self.library = unzipped / "binaries" / platform / f"{NAME}.{library}"
        (folder / "model.h").write_text(source.header(component(41), self.guid))
        self.program = folder / f"host{program}"
        libraries = ["-ldl", "-lpthread", "-lm"] if platform == "linux64" else []
        flags = ["-std=gnu11", "-O1", f"-I{folder}", f"-I{HEADERS}", *extra]
        command = [*compiler(platform), *flags, HOST, "-o", self.program, *libraries]
        subprocess.run(list(map(str, command)), check=True, timeout=300)
        self.prefix = [] if platform == "linux64" else ["wine"]
        self.environment = os.environ | {"WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all"}

    def __call__(self, command: str, argument: int = 0, stdin: str | None = None, before: tuple[str, ...] = ()) -> str:
        """Run a command of the host; return what it prints."""
        done = subprocess.run(
            [*before, *self.prefix, self.program, self.library, self.guid, command, str(argument)],
            input=stdin,
            capture_output=True,
            text=True,
            timeout=300,
            env=self.environment,
        )
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
        return done.stdout


@pytest.fixture(scope="module")
def host(native_folder, tmp_path_factory):
    return Host("linux64", tmp_path_factory.mktemp("linux"), native_folder)


@pytest.fixture(scope="module")
def windows(native_folder, tmp_path_factory):
    if not shutil.which("wine"):
        pytest.skip("THE WINDOWS LIBRARY IS NOT TESTED: wine is not installed (apt-get install wine64)")
    return Host("win64", tmp_path_factory.mktemp("windows"), native_folder)


@pytest.mark.parametrize("command", ["instantiate", "every_call", "status_functions", "log_categories", "threads"])
def test_on_linux(host, command):
    host(command)


@pytest.mark.parametrize("command", ["instantiate", "every_call", "status_functions", "log_categories", "threads"])
def test_on_windows_under_wine(windows, command):
    windows(command)


def test_every_state_meets_every_function(host):
    assert int(host("every_call").split()[0]) > 500


def test_random_calls_do_no_harm(host):
    host("random_calls", 20_000)


def test_cycles_and_steps_leave_memory_as_it_was(host):
    host("soak", 3000)


def test_valgrind_finds_nothing(host):
    """Leaks and reads of what was never written, over all calls and a thousand random ones."""
    if not shutil.which("valgrind"):
        pytest.skip("valgrind is not installed")
    check = ("valgrind", "--error-exitcode=9", "--leak-check=full", "-q")
    host("every_call", before=check)
    host("random_calls", 1000, before=check)


@pytest.mark.parametrize(("platform", "tolerance"), [("host", 1e-12), ("windows", 1e-10)])
def test_equals_the_solver_on_random_cases(platform, tolerance, request):
    """Windows has other mathematical functions; loads are iterated to 1e-11, and widths follow less closely."""
    run = request.getfixturevalue(platform)
    references = {s.name: r for r, s in enumerate(table(41).scalars)}
    reals = [s.name for s in table(41).scalars[references["force.x"] :] if s.name not in ("patch.count", "status")]
    lines, wanted = [], []
    for seed in range(100):
        values, solution, radius = random_case(seed)
        kinds = ("i" if isinstance(value, int) else "r" for value in values.values())
        words = (f"{references[n]} {k} {float(v)!r}" for (n, v), k in zip(values.items(), kinds, strict=True))
        lines.append(f"{len(values)} {' '.join(words)}")
        answer = expected(solution, radius)
        wanted.append((answer, scales(solution, answer)))
    columns = [reals.index(name) for name in OUTPUTS]
    rows = run("cases", stdin="\n".join(lines)).split("\n")[:-1]
    worst = 0.0
    for seed, (row, (answer, scale)) in enumerate(zip(rows, wanted, strict=True)):
        actual = np.array(row.split(), dtype=float)[columns]
        np.testing.assert_array_less(np.abs(actual - answer), tolerance * scale + 1e-300, err_msg=f"seed {seed}")
        worst = max(worst, np.max(np.abs(actual - answer) / (scale + 1e-300)))
    print(f"{platform}: greatest difference {worst:.1e}")


def test_speed_can_be_measured(host):
    assert re.findall(r"step ([\d.]+) us", host("speed", 100))
