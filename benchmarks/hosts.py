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

from benchmarks.tables import fill, read_options, table

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
    fill(arguments.out, {"hosts": of_hosts(arguments.folder)})


if __name__ == "__main__":
    main()
