"""resources/model.bin of a native FMU: what is damaged is refused with a message that names the file."""

import shutil
import struct
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from zipfile import ZipFile

import fmpy
import numpy as np
import pytest

from contact_fmu.native.table import MAGIC, NAME
from contact_fmu.resources import checksum

ROOT = Path(__file__).parents[2]


def _message(folder: Path) -> str:
    """Try to instantiate an FMU; return its first message."""
    said: list[str] = []

    def log(environment, instance, status, category, message):
        said.append(message.decode())

    callbacks = fmpy.fmi2.fmi2CallbackFunctions()
    callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(log)
    callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.fmi2.calloc)
    callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.fmi2.free)
    description = fmpy.read_model_description(str(folder))
    fmu = fmpy.fmi2.FMU2Slave(
        guid=description.guid, unzipDirectory=str(folder), modelIdentifier=description.coSimulation.modelIdentifier
    )
    with suppress(Exception):  # fmpy raises no other
        fmu.instantiate(callbacks=callbacks)
        fmu.freeInstance()
    return said[0] if said else ""


@pytest.fixture
def pair_folder(native, tmp_path) -> Path:
    """Return a folder of the FMU that has most: inputs, methods and resources of its own. All FMUs have one reader."""
    return Path(fmpy.extract(str(native.with_name("WheelRailPair.fmu")), str(tmp_path)))


def test_a_damaged_file_is_refused(pair_folder):
    file = pair_folder / "resources" / NAME
    whole = file.read_bytes()
    assert _message(pair_folder) == ""
    random = np.random.default_rng(1)
    for at in (*random.integers(0, len(whole), 40), *range(0, 200, 8)):
        damaged = bytearray(whole)
        damaged[at] ^= 1 << int(random.integers(8))
        file.write_bytes(damaged)
        assert NAME in _message(pair_folder), at
    for size in (0, 7, 20, 100, len(whole) // 2, len(whole) - 1):
        file.write_bytes(whole[:size])
        assert NAME in _message(pair_folder), size
    file.unlink()
    assert NAME in _message(pair_folder)


def test_sizes_that_do_not_fit_are_refused_even_with_a_checksum(pair_folder):
    """Each number of the head is changed in turn."""
    file = pair_folder / "resources" / NAME
    whole = file.read_bytes()
    for word in range(20):
        for value in (-2, 1 << 40, (1 << 63) - 1):
            body = bytearray(whole[16:])
            struct.pack_into("<q", body, 8 * word, value)
            file.write_bytes(MAGIC + struct.pack("<Q", checksum(bytes(body))) + body)
            assert NAME in _message(pair_folder), (word, value)


def test_the_table_of_another_fmu_is_refused(native, tmp_path):
    """It has another guid."""
    folders = [
        Path(fmpy.extract(str(native.with_name(f"{n}.fmu")), str(tmp_path / n))) for n in ("WheelRailPair", "Wheelset")
    ]
    shutil.copy(folders[1] / "resources" / NAME, folders[0] / "resources" / NAME)
    assert "guid" in _message(folders[0])


def test_all_fmus_have_one_library(native):
    """The file for each system is the same in every FMU and in both versions of FMI."""
    found = {}
    for path in native.parent.rglob("*.fmu"):
        with ZipFile(path) as archive:
            for name in archive.namelist():
                if name.startswith("binaries/"):
                    found.setdefault(Path(name).suffix, set()).add(archive.read(name))
    assert {end: len(contents) for end, contents in found.items()} == {".so": 1, ".dll": 1, ".dylib": 1}


def test_packing_loads_no_compiler(native, tmp_path):
    """Neither numba nor zig, nor the modules that call them; tried with the pair, which has resources of its own."""
    code = f"""
import sys
from contextlib import suppress
from pathlib import Path
from contact_fmu.catalogue import models
from contact_fmu.native import packaging
packaging.build(models(30)[2], Path({str(tmp_path)!r}))
loaded = {{"numba", "llvmlite", "ziglang", "fmpy", "contact.compile.emit", "contact.compile.linking"}} & set(sys.modules)
sys.exit(", ".join(loaded) or 0)
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
