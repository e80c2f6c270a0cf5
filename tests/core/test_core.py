"""The library of kernels, and how Python calls it."""

import copy
import json
import os
import pickle
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import contact
from contact.core import checkout, library, pack
from contact.kernels.arrays import Samples
from contact.kernels.cubic import slopes
from contact.kernels.geometry.search import axle
from contact.kernels.hertz import local_factors
from contact.kernels.root import begin

ROOT = Path(contact.__file__).parents[1]

USE_ALL = """
import json, sys
import contact
from contact.geometry import profile
from contact.geometry.records import Pose, Velocity
from contact.geometry.wheelset import Pair
from contact.pair import WheelRailPair
separation, creepage = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 5e-4, 0.2)
for normal in ("analyn", "hertz", "kik_piotrowski", "strip_halfspace", "halfspace"):
    rolling = "halfspace" if normal == "halfspace" else "fastrip"
    contact.solve(separation, creepage, load=8e4, normal=normal, tangential=rolling, throw=False).damage
contact.forces(separation, (1e-3, 0.0, 0.0), load=[1e4, 2e4])
pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1 / 40)))
pair.solve(Pose(y=1e-3), Velocity(20.0), load=8e4)
print(json.dumps(sorted({"numba", "llvmlite"} & set(sys.modules))))
"""


def run(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run Python code in a process of its own."""
    own = {name: value for name, value in os.environ.items() if name != "CONTACT_JIT"} | environment
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=own, cwd=ROOT, timeout=600)


def test_the_library_needs_no_numba():
    try:
        library.get_library()
    except ImportError:
        pytest.skip("no linker here: llvmlite loads the kernels")
    done = run(USE_ALL)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == []


@pytest.mark.slow
def test_numba_gives_the_bits_of_the_library():
    code = """
import numpy as np
from contact.kernels.hertz import local_factors
from contact.kernels.cubic import slopes
from contact.kernels.geometry.search import axle
y = np.linspace(0.0, 1.0, 9) ** 1.5
out = np.zeros(9)
slopes(y, np.sin(3.0 * y), 9, out)
print(repr((local_factors(1.3, 0.4), axle(0.01, -0.02), out.tolist())))
"""
    of_library, of_numba = run(code), run(code, CONTACT_JIT="1")
    assert of_library.returncode == 0, of_library.stderr
    assert of_library.stdout == of_numba.stdout != ""


def test_results_have_the_types_of_the_annotations():
    assert [type(x) for x in local_factors(1.0, 2.0)] == [float] * 4
    assert axle(roll=0.0, yaw=0.0) == (0.0, 1.0, 0.0)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((np.zeros(3), np.zeros(3), 3), "slopes takes 4 arguments, not 3"),
        ((np.zeros(3), np.zeros(3), 3.5, np.zeros(3)), "integer"),
        ((np.zeros(3), np.zeros((3, 3)), 3, np.zeros(3)), "shape \\(3, 3\\)"),
        ((np.zeros(3), np.zeros(6)[::2], 3, np.zeros(3)), "not contiguous"),
        ((np.zeros(3), np.zeros(3, np.float32), 3, np.zeros(3)), "float32"),
        ((np.zeros(3), [0.0, 0.0, 0.0], 3, np.zeros(3)), "list"),
    ],
)
def test_a_wrong_argument_is_refused(arguments, said):
    with pytest.raises((TypeError, Exception), match=said):
        slopes(*arguments)


def test_a_record_of_another_type_is_refused():
    with pytest.raises(TypeError, match="a record"):
        begin(np.zeros(1), 0.0, 0.0, 0.0, 0.0)


def test_a_kernel_for_other_kernels_says_so():
    from contact.kernels.normal.analyn import analyn

    with pytest.raises(TypeError, match="analyn is compiled for other kernels only"):
        analyn()


def test_packed_arguments_follow_their_arrays_into_a_copy():
    samples = Samples(*np.linspace(0.0, 1.0, 15).reshape(5, 3))
    packed = pack(Samples, samples)
    for other in (copy.deepcopy(packed), pickle.loads(pickle.dumps(packed))):
        assert other.words != packed.words
        assert other.words == pack(Samples, other.value).words


def test_the_library_of_another_processor_has_another_name(monkeypatch):
    """Machines that share a home folder would else run instructions that one of them does not have."""
    here = checkout.fingerprint.__wrapped__()
    assert checkout.fingerprint.__wrapped__() == here
    monkeypatch.setattr(checkout, "_processor", lambda: "another one")
    assert checkout.fingerprint.__wrapped__() != here


def test_a_checkout_without_library_and_numba_says_what_to_install(tmp_path):
    code = """
import importlib.metadata as metadata
known = metadata.version
def version(name):
    if name == "numba":
        raise metadata.PackageNotFoundError(name)
    return known(name)
metadata.version = version
from contact.kernels.hertz import local_factors
local_factors(1.0, 2.0)
"""
    done = run(code, CONTACT_CACHE_DIR=str(tmp_path))
    assert done.returncode == 1
    assert "ImportError: this checkout of wheelrail-contact has no compiled library yet" in done.stderr
    assert "pip install" in done.stderr


def test_a_cache_that_cannot_be_written_is_replaced_by_a_temporary_folder(tmp_path, monkeypatch):
    file = tmp_path / "file"
    file.touch()
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(checkout.tempfile, "tempdir", str(temporary))
    monkeypatch.setenv("CONTACT_CACHE_DIR", str(file / "cache"))
    with pytest.warns(UserWarning, match=rf"CONTACT_CACHE_DIR = {file}/cache cannot be written; .* {temporary}"):
        assert checkout.cache_folder().parent == temporary
    monkeypatch.delenv("CONTACT_CACHE_DIR")
    monkeypatch.setenv("XDG_CACHE_HOME", str(file))
    monkeypatch.setattr(checkout.sys, "platform", "linux")
    assert checkout.cache_folder().parent == temporary

    def unknown():
        raise KeyError("getpwuid(): uid not found: 4711")

    monkeypatch.setattr(checkout.getpass, "getuser", unknown)
    assert checkout.cache_folder().parent == temporary


def test_a_cache_that_has_the_library_is_used_though_it_cannot_be_written(tmp_path, monkeypatch):
    (tmp_path / (checkout.PREFIX + checkout.fingerprint())).mkdir()
    monkeypatch.setattr(checkout, "_can_be_written", lambda folder: False)
    monkeypatch.setenv("CONTACT_CACHE_DIR", str(tmp_path))
    assert checkout.cache_folder() == tmp_path


def test_a_part_that_a_cache_lacks_which_cannot_be_written_is_kept_in_a_temporary_folder(tmp_path, monkeypatch):
    shared = tmp_path / "cache"
    (shared / (checkout.PREFIX + checkout.fingerprint())).mkdir(parents=True)
    monkeypatch.setattr(checkout, "_can_be_written", lambda folder: False)
    monkeypatch.setattr(checkout.tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("CONTACT_CACHE_DIR", str(shared))
    assert checkout.folder_of("").parent == shared
    with pytest.warns(UserWarning, match="cannot be written"):
        assert checkout.folder_of("halfspace").parent.parent == tmp_path


def test_without_any_folder_for_the_library_a_message_names_the_variable(tmp_path, monkeypatch):
    file = tmp_path / "file"
    file.touch()
    monkeypatch.setenv("CONTACT_CACHE_DIR", str(file))
    with pytest.raises(ImportError, match=rf"cannot be kept in {file} .*; set CONTACT_CACHE_DIR to a folder"):
        checkout.build(file / "library")

    def nowhere():
        raise FileNotFoundError(2, "No usable temporary directory found")

    monkeypatch.setattr(checkout.tempfile, "gettempdir", nowhere)
    with pytest.raises(ImportError, match=r"No usable temporary directory found.*; set CONTACT_CACHE_DIR"):
        checkout.cache_folder()


def test_the_first_solution_of_a_clone_needs_only_the_entries_that_are_compiled_first():
    code = """
from contact.core import library
folder = library.get_library().parent
def cached(part=""):
    if part != "first":
        raise ImportError("the whole library")
    return folder
library._whole, library.cached = lambda part="": None, cached
import contact
separation, creepage = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 5e-4, 0.2)
contact.solve(separation, creepage, load=8e4, derivatives=True).damage
contact.solve(separation, creepage, load=8e4, force=-3e3, friction=contact.friction.Friction(0.4, 0.2, law="rational"))
contact.solve(separation, creepage, load=8e4, **contact.THESIS)
contact.forces(separation, creepage, load=[1e4, 2e4])
from contact.kernels.geometry.search import axle
axle(0.0, 0.0)
"""
    done = run(code)
    assert done.stderr.splitlines()[-1] == "ImportError: the whole library", done.stderr


def test_a_build_that_was_killed_is_built_anew(tmp_path):
    code = f"""
import os, pathlib, signal
from contact.core import checkout
def half(folder, part):
    (folder / "first.o").write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
checkout._run_builder = half
checkout.build(pathlib.Path({str(tmp_path)!r}) / "library")
"""
    assert run(code).returncode == -9
    whole = code.replace("os.kill(os.getpid(), signal.SIGKILL)", "(folder / 'others.o').write_text('whole')")
    assert run(whole).returncode == 0
    assert {path.name for path in (tmp_path / "library").iterdir()} == {"first.o", "others.o"}


def test_one_at_a_time_builds_a_library_and_none_leaves_its_lock(tmp_path):
    folder, inside, most = tmp_path / "library", [], []

    def build(_):
        with checkout.locked(folder):
            inside.append(1)
            time.sleep(1e-3)
            most.append(len(inside))
            inside.pop()

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(build, range(64)))
    assert max(most) == 1
    assert not list(tmp_path.iterdir())


def test_a_library_of_another_version_is_named(monkeypatch):
    path = library.get_library()
    with pytest.raises(ImportError, match="built from other sources"):
        library.of_library(path).address("contact_kernels_of_tomorrow")
    monkeypatch.setattr(library, "__version__", "99.0")
    with pytest.raises(ImportError, match=rf"{path} is the library of wheelrail-contact .*, and this is version 99.0"):
        library.of_library(path)


def test_the_library_holds_the_constants_that_numba_computes(tmp_path):
    """Python reads the influence of strips from the library; a process with numba computes it."""
    code = "from contact.theory import strips; print([part.tobytes().hex()[:4000] for part in strips.tables()])"
    assert run(code).stdout == run(code, CONTACT_JIT="1").stdout != ""


def test_the_builder_compiles_a_kernel_once_for_all_its_constants():
    """Numba alone compiles it again for each constant, and each enumeration, in a call."""
    code = """
from contact.compile import emit
from contact.core import kernel
from contact.kernels.enumerations import Height
@kernel
def twice(i, pair):
    return 2 * i + pair[0]
@kernel
def caller(i):
    return twice(i, (i, i)) + twice(3, (1, 2)) + twice(pair=(7, i), i=7) + twice(Height.LOAD, (i, Height.LOAD))
emit.make_no_machine_code()
caller.compile("(int64,)")
print(len(twice.overloads))
"""
    done = run(code, **checkout.ENVIRONMENT)
    assert done.stdout.strip() == "1", done.stderr
