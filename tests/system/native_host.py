"""The hosts in C, `native_host.c` and `native_host_fmi3.c`, compiled for a platform and run over a native FMU."""

import os
import subprocess
from collections.abc import Iterable
from pathlib import Path

import fmpy
import numpy as np
from contact_case import NAME
from random_cases import OUTPUTS, POINTS, Case

from fmu_src.native import source
from fmu_src.native.packaging import HEADERS, compiler
from fmu_src.native.wheel_rail_contact import component

#: Name that a version of FMI has for a platform → that of the builder, and the host's source.
PLATFORMS = {
    "linux64": ("linux64", "native_host.c"),
    "win64": ("win64", "native_host.c"),
    "x86_64-linux": ("linux64", "native_host_fmi3.c"),
    "x86_64-windows": ("win64", "native_host_fmi3.c"),
}
SUFFIX = {"linux64": ("so", ""), "win64": ("dll", ".exe")}


class Host:
    """The compiled host for one platform of one version of FMI."""

    def __init__(self, platform: str, folder: Path, unzipped: Path, extra: tuple[str, ...] = ()) -> None:
        own, code = PLATFORMS[platform]
        library, program = SUFFIX[own]
        self.guid = fmpy.read_model_description(str(unzipped)).guid
        self.library = unzipped / "binaries" / platform / f"{NAME}.{library}"
        (folder / "model.h").write_text(source.header(component(POINTS), self.guid))
        self.program = folder / f"host{program}"
        libraries = ["-ldl", "-lpthread", "-lm"] if own == "linux64" else []
        flags = ["-std=gnu11", "-O1", f"-I{folder}", f"-I{HEADERS}", *extra]
        command = [*compiler(own), *flags, Path(__file__).with_name(code), "-o", self.program, *libraries]
        subprocess.run(list(map(str, command)), check=True, timeout=300)
        self.prefix = [] if own == "linux64" else ["wine"]
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

    def solve(self, cases: Iterable[Case]) -> np.ndarray:
        """OUTPUTS of the FMU after one step from the start, a row for each case."""
        table = component(POINTS).table
        names = [scalar.name for scalar in table.scalars]
        lines = []
        for case in cases:
            kinds = ("i" if isinstance(value, int) else "r" for value in case.values.values())
            words = (f"{names.index(n)} {k} {float(v)!r}" for (n, v), k in zip(case.values.items(), kinds, strict=True))
            lines.append(f"{len(case.values)} {' '.join(words)}")
        rows = np.loadtxt(self("cases", stdin="\n".join(lines)).splitlines(), ndmin=2)
        return rows[:, [names.index(name) - names.index("force.x") for name in OUTPUTS]]
