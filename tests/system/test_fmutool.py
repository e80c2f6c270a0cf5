"""Renault's fmutool, which checks more FMI rules than the schema, has no findings in any FMU that we build."""

import sys

import pytest
from fmu_manipulation_toolbox.cli.fmutool import fmutool


@pytest.mark.parametrize("packaging", ["python", "native"])
def test_fmutool_has_no_findings(packaging, request, monkeypatch, capsys):
    folder = request.getfixturevalue("fmus") if packaging == "python" else request.getfixturevalue("native").parent
    built = sorted(folder.rglob("*.fmu"))
    assert built
    for fmu in built:
        monkeypatch.setattr(sys, "argv", ["fmutool", "-input", str(fmu), "-check"])
        fmutool()  # exits if it finds an error
        said = "".join(capsys.readouterr())
        assert "seems to be compliant with FMI" in said
        assert "No semantic error" in said
        assert not [line for line in said.splitlines() if not line.startswith("INFO")], f"{fmu.name}:\n{said}"
