"""C host `host/script.c`, which runs commands from standard input, compiled for a platform."""

import os
import re
import subprocess
from pathlib import Path

import fmpy
import numpy as np

from contact.compile.linking import compiler
from contact_fmu.native.headers import HEADERS
from reference.native import HOST, compile_program, resources_of

SOURCE = HOST / "script.c"
_PLATFORMS = {"linux64": (".so", []), "win64": (".dll", ["wine"])}


class Script:
    """The compiled host for one platform, in its own folder."""

    def __init__(self, platform: str, folder: Path) -> None:
        self.platform = platform
        self.suffix, self.before = _PLATFORMS[platform]
        self.program = folder / f"{platform}.exe"
        self.environment = os.environ | {"WINEDEBUG": "-all"}
        flags = ["-std=gnu11", "-O1", f"-I{HEADERS}"]
        compile_program([*compiler(platform), *flags], platform, [HOST / "common.c", SOURCE], self.program)

    def __call__(self, unzipped: Path, kind: int, commands: str, before: tuple[str, ...] = ()) -> np.ndarray:
        """Run commands on an FMU in model exchange (0) or co-simulation (1) and return the printed numbers."""
        description = fmpy.read_model_description(str(unzipped))
        library = unzipped / "binaries" / self.platform / (description.coSimulation.modelIdentifier + self.suffix)
        where = resources_of(unzipped, self.platform)
        done = subprocess.run(
            [*before, *self.before, self.program, library, description.guid, str(kind), where],
            input=commands,
            capture_output=True,
            text=True,
            timeout=300,
            env=self.environment,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        # messages, as of a doubtful status, stand on lines of their own
        return np.array(re.findall(r"^[-+]?(?:\d[\d.e+-]*|nan|inf)$", done.stdout, re.MULTILINE), dtype=float)
