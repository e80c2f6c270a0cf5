"""Renault's fmutool, which checks more FMI rules than the schema, has no findings in any FMU that we build."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.parametrize("packaging", ["python", "native"])
def test_fmutool_has_no_findings(packaging, request):
    folder = request.getfixturevalue("fmus") if packaging == "python" else request.getfixturevalue("native").parent
    built = sorted(folder.rglob("*.fmu"))
    assert built
    for fmu in built:
        command = [Path(sys.executable).with_name("fmutool"), "-input", fmu, "-check"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
        said = done.stdout + done.stderr
        assert done.returncode == 0, f"{fmu.name}:\n{said}"
        assert "seems to be compliant with FMI" in said
        assert "No semantic error" in said
        assert not [line for line in said.splitlines() if not line.startswith("INFO")], f"{fmu.name}:\n{said}"
