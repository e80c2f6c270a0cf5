"""Time of the native WheelRailContact called from C, compared with its bare kernel (part of `make bench`)."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import fmpy

from reference.native import Host, kernel_library

ROOT = Path(__file__).parents[1]


def main() -> None:
    with tempfile.TemporaryDirectory() as directory:
        folder = Path(directory)
        command = [sys.executable, ROOT / "build_fmu.py", "--packaging", "native", "--out", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        unzipped = Path(fmpy.extract(str(folder / "native" / "WheelRailContact.fmu"), str(folder / "unzipped")))
        host = Host("linux64", folder, unzipped)
        cpu = "v3" if "avx2" in Path("/proc/cpuinfo").read_text() else "v2"
        kernels = kernel_library(folder, cpu)
        said = [*host("speed", 10, kernels).splitlines()]
        first = [host("first_step").strip() for _ in range(20)]
    said.append(min(first, key=lambda line: float(re.findall(r": ([\d.]+)", line)[0])))
    found = dict(line.split(": ", 1) for line in said)
    overhead = float(found["fmi2DoStep"].split()[0]) - float(found["kernel"].split()[0])
    print("| native WheelRailContact from C, default methods | measured | bar |\n| --- | --- | --- |")
    for what, measured in found.items():
        print(f"| {what} | {measured} | {BARS.get(what, '')} |")
    print(f"| fmi2DoStep minus its kernel | {overhead:.2f} us | 1 us |")


BARS = {"set 90 inputs": "1 us", "load to first step": "20 000 us", "8 contacts at 1 kHz": "5 times real time"}


if __name__ == "__main__":
    main()
