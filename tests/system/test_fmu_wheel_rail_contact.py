"""The FMU `WheelRailContact` through the C interface of FMI."""

import subprocess
import sys
from pathlib import Path

import fmpy
import pytest
from contact_case import NAME
from fmu_instance import Instance

from contact.version import __version__
from contact_fmu.catalogue import models
from contact_fmu.python.packaging import build
from contact_fmu.python.runtime import DECLARED

ROOT = Path(__file__).parents[2]


def test_the_build_is_reproducible(fmus, tmp_path):
    for model in models(41, accumulation=True):
        path = build(model, tmp_path)
        assert path.read_bytes() == (fmus / path.name).read_bytes()


def test_two_builds_and_two_versions_live_in_one_process(open_fmu, tmp_path):
    command = [sys.executable, ROOT / "build_fmu.py", "--packaging", "python", "--out", tmp_path, "--points", "7"]
    subprocess.run(command, check=True, timeout=120, capture_output=True)
    fmpy.extract(str(tmp_path / "python" / f"{NAME}.fmu"), str(tmp_path / "seven"))
    large, small = open_fmu(NAME), Instance(tmp_path / "seven")
    for fmu in (large, small):
        fmu.initialize()
        fmu.step()
        assert fmu["force.n"] == pytest.approx(80e3)
    assert "geometry.g[41]" in large.variables
    assert "geometry.g[8]" not in small.variables
    small.fmu.freeInstance()


@pytest.mark.parametrize(
    ("options", "version", "told"),
    [
        ({"points": 41}, ("0.1.2",), "wheelrail-contact 0.1.2, "),
        ({"samples": 41}, ("9.8.7",), "wheelrail-contact 9.8.7, "),
        ({"points": 41}, (), "of an earlier version, "),
    ],
)
def test_an_fmu_of_another_version_is_refused_with_both_versions(fmus, tmp_path, options, version, told):
    fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path / "old"))
    (tmp_path / "old" / "resources" / DECLARED).write_text(repr(("contact", options, "{old}", *version)))
    log: list = []
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance(tmp_path / "old", log=log)
    assert told in log[0][1]
    assert f"not what the installed {__version__} says" in log[0][1]


#: A host in Python that makes an instance.
HOST = """
import ctypes, sys
sys.modules["contact_fmu"] = None  # as if it were not installed
logger = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3, *[ctypes.c_char_p] * 2)(lambda *words: print(words[-1].decode()))
functions = (ctypes.c_void_p * 5)(ctypes.cast(logger, ctypes.c_void_p))
make = ctypes.CDLL(sys.argv[1]).fmi2Instantiate
make.restype = ctypes.c_void_p
print("instantiated" if make(b"a", 1, b"", sys.argv[2].encode(), functions, 0, 0) else "none")
"""


def test_without_the_package_no_instance_is_made_and_the_reason_is_logged(fmus, tmp_path):
    folder = Path(fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path)))
    library = folder / "binaries" / "linux64" / f"{NAME}.so"
    words = [sys.executable, "-c", HOST, library, (folder / "resources").as_uri()]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout.startswith("this FMU needs the package wheelrail-contact in the host's Python: ")
    assert done.stdout.endswith("none\n")
