"""Builds of the native FMUs are reproducible."""

import os
import subprocess
import sys
from pathlib import Path

from contact.core.checkout import ENVIRONMENT
from contact_fmu.catalogue import models
from contact_fmu.native import packaging

WHEELSET = next(model for model in models(41) if model.table.name == "Wheelset")


def test_the_same_kernels_give_the_same_bytes(native_wheelset, tmp_path):
    """The kernels are those of the fixture. The guid, a hash of all content, is then also the same."""
    again = packaging.build(WHEELSET, tmp_path)
    assert [path.read_bytes() for path in again] == [
        path.read_bytes() for path in (native_wheelset, native_wheelset.parent / "fmi3" / native_wheelset.name)
    ]


def test_the_same_sources_give_the_same_kernels(tmp_path):
    """They do not depend on the order of sets in the compiling process or on what it compiled before."""
    found = []
    for seed, before in (("1", "0"), ("2", "1")):
        (tmp_path / seed).mkdir()
        command = [sys.executable, Path(__file__).with_name("small_module.py"), tmp_path / seed, before]
        subprocess.run(command, check=True, env=os.environ | ENVIRONMENT | {"PYTHONHASHSEED": seed}, timeout=300)
        found.append({path.name: path.read_bytes() for path in sorted((tmp_path / seed).iterdir())})
    assert found[0] == found[1]
    assert len(found[0]) == 3 * 3 + 2  # data and two processors for each system, and C
