"""The native FMUs in foreign hosts: the digits of each host, FMU and version of FMI (docs/use/fmu/hosts.md).

python -m benchmarks.hosts FOLDER [--out docs/use/fmu/hosts.md]

FOLDER has the native FMUs (dist/native). Every cell is a run of a script of examples/hosts in the interpreter
HOSTS_PYTHON, compared with what fmpy reads after one step of co-simulation.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import fmpy

from benchmarks.tables import read_options, table

EXAMPLES = Path(__file__).parents[1] / "examples" / "hosts"
PYTHON = os.environ.get("HOSTS_PYTHON", sys.executable)
#: FMU → input, its value, output that follows it.
CASES = {
    "EllipticContact": ("creepage.longitudinal", 1e-3, "force.x"),
    "WheelRailContact": ("creepage.longitudinal", 1e-3, "force.x"),
    "WheelRailPair": ("pose.y", 2e-3, "force.y"),
}
#: Host → script, words before those of the case, and what it does.
HOSTS: dict[str, tuple[str, tuple[str, ...], str]] = {
    "CasADi": ("casadi_sensitivity.py", (), "model exchange"),
    "Ecos": ("ecos_pair.py", (), "two steps"),
    "FMI Library": ("fmilib_contact.py", (), "one step"),
    "fmuloader": ("fmuloader_contact.py", (), "one step"),
    "libcosim": ("libcosim_contact.py", ("0",), "two steps"),
    "PathSim": ("pathsim_contact.py", (), "ten steps"),
}
#: What a host says where it takes no FMU of a version → the reason.
REASONS = {
    r"structuralParameter": "no structural parameters",
    r"\d+ values are given, but the variables have|fmi3GetFloat64 failed": "no arrays",
    r"== FMI_2|Allocating FMIL context": "no FMI 3",
}
FOOT = """
"Same" is every digit. Where a host makes more than one step, the later ones start from the last solution of the strips and
agree within its tolerance. CasADi and PathSim take one number for each variable of FMI 3.0, so they read no arrays; give them
the files of FMI 2.0. Ecos finds an array by its name, asks for a single number too, and shows 0 when it is refused.

## Not to be had

| host | what we found |
| --- | --- |
| OMSimulator | the package on PyPI fetches its program from another server |
| OpenModelica, OMPython | Debian has no `omc`, which OMPython calls |
| pyfmi | the source on PyPI, of 2018, does not build; it also needs Assimulo |
| Chrono | the package pychrono on PyPI is another program, a scheduler |
| FMI4j | Maven's repository cannot be reached |
| Rust (fmi-rs), Julia (FMI.jl) | their registries cannot be reached; Debian has no Julia |
| Scilab | Debian's has no FMI toolbox |
| npm | nothing that loads a binary FMU |
| gemseo-fmu, ovfmi, FMUGym, exudyn | load FMUs by fmpy and show what it shows; exudyn was run ([exudyn](exudyn.md)) |
| mosaik-fmi | needs fmipp, which needs swig to build |
| uniFMU, PythonFMU3 | make FMUs, load none |
| vdmcheck, fmusim | no package |

Events and intermediate values of co-simulation in FMI 3.0 are not offered (`hasEventMode`, `providesIntermediateUpdate`):
nothing happens within a step, and inputs may change between any two. A host that asks for them at the instantiation gets an
error that says so.

## What a host should not do

Every class has tests. Of those with an asterisk a part runs every time, and all of it in `make soak`.

| class | tests |
| --- | --- |
| null pointers, forged states | `test_native_host.py`: `no_wrong_call_ends_the_host`\\* |
| value references, order | `every_state_meets_every_function`, `any_function_in_any_order`, `random_calls_of_fmi_3` |
| values | `a_bad_input_is_discarded`, `extreme_values`; `test_native_traps.py` |
| states | `a_restored_or_serialised_state`, `damaged_bytes_are_no_state` |
| steps | `an_invalid_step_is_an_error`, `a_step_is_not_done_twice`; `test_native_discard.py` |
| allocations, small stacks, fork, reload | `test_native_host.py`: `hard_circumstances_end_no_host`\\* |
| threads | `on_linux` and `fmi_3` with `threads` |
| resources | `test_native_table.py`, `test_native_uris.py`, `test_damaged_files.py`\\* |
| memory over time | `cycles_and_steps_leave_memory_as_it_was`\\* |
| undefined behaviour | `sanitizers_find_nothing`\\*, `valgrind_finds_nothing` |
"""


def run(host: str, path: Path, case: tuple[str, float, str]) -> float | str:
    """Return the output, or the reason why there is none."""
    script, before, _ = HOSTS[host]
    given, value, wanted = case
    words = [PYTHON, EXAMPLES / script, path, *before, given, value, wanted]
    environment = os.environ | {"LD_LIBRARY_PATH": str(Path(PYTHON).parents[1] / "lib"), "PYTHONPATH": ""}
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, env=environment, timeout=600)
    said = done.stdout + done.stderr
    if found := re.search(rf"^{re.escape(wanted)} (-?[\d.e+-]+)$", done.stdout, re.MULTILINE):
        return float(found[1])
    reasons = [reason for pattern, reason in REASONS.items() if re.search(pattern, said)]
    return reasons[0] if reasons else said.strip().splitlines()[-1]


def reference(path: Path, case: tuple[str, float, str]) -> float:
    """Return the output after one step by fmpy."""
    given, value, wanted = case
    options = {"start_values": {given: value}, "output": [wanted], "fmi_type": "CoSimulation"}
    result = fmpy.simulate_fmu(str(path), stop_time=1e-3, step_size=1e-3, output_interval=1e-3, **options)
    return float(result[wanted][-1])


def cell(found: float | str, wanted: float) -> str:
    """Return a cell of the table."""
    if isinstance(found, str):
        return found
    return "same" if found == wanted else f"{abs(found / wanted - 1.0):.0e}"


def of_hosts(folder: Path) -> str:
    """Return the table."""
    files = [(name, version) for name in CASES for version in (2, 3)]
    paths = {(name, v): folder / ("" if v == 2 else "fmi3") / f"{name}.fmu" for name, v in files}
    wanted = {one: reference(path, CASES[one[0]]) for one, path in paths.items()}
    lines = [["fmpy, one step", *(cell(wanted[one], wanted[one[0], 2]) for one in files)]]
    for host, (_, _, does) in HOSTS.items():
        cells = [cell(run(host, paths[one], CASES[one[0]]), wanted[one[0], 2]) for one in files]
        lines.append([f"{host}, {does}", *cells])
    return table(["host", *(f"`{name}` {version}" for name, version in files)], lines)


def main() -> None:
    arguments = read_options(__doc__, folder=Path, out=Path)
    cases = "; ".join(f"`{name}`: {wanted} at {given} = {value:g}" for name, (given, value, wanted) in CASES.items())
    head = f"""# Hosts

Native FMUs of both versions of FMI: the difference of the number that a host reads from that of fmpy ({cases}).
`python -m benchmarks.hosts dist/native` writes this page from runs of the scripts of `examples/hosts`, which are tests too.
"""
    text = "\n".join([head, of_hosts(arguments.folder).rstrip("\n"), FOOT])
    print(text)
    if arguments.out:
        arguments.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
