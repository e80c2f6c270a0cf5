"""The library of compiled kernels: where it is, and the addresses of its functions.

A wheel holds it, in `contact/library`. A checkout builds it when it is first needed, which needs numba, and keeps it in the
user's cache under a name that is a hash of all that it is made from.
"""

from __future__ import annotations

import contextlib
import ctypes
import getpass
import hashlib
import math
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact.version import __version__

_HERE = Path(__file__).parents[1]
_ROOT = _HERE.parent
#: Name of the library on this system.
NAME = {"win32": "wheelrail.dll", "darwin": "libwheelrail.dylib"}.get(sys.platform, "libwheelrail.so")
#: This system, by its name in FMI 2.0 or, for 64-bit ARM, in 3.0.
_ARM = platform.machine().lower() in ("aarch64", "arm64")
SYSTEM = {"win32": "win64", "darwin": "aarch64-darwin" if _ARM else "darwin64"}.get(
    sys.platform, "aarch64-linux" if _ARM else "linux64"
)
#: The library of an installed package.
INSTALLED = _HERE / "library" / SYSTEM / NAME
#: What a checkout says of its library.
_PROJECT = _ROOT / "pyproject.toml"
#: Packages that compile it.
_TOOLS = ("numba", "llvmlite", "numpy")
#: Environment variables of the builder, which must be set before numba is imported (`contact.compile.emit`).
ENVIRONMENT = {
    "CONTACT_JIT": "build",
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_OPT": "0",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
    "NUMBA_DISABLE_INTEL_SVML": "1",
    "NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING": "1",  # of overloads that do not fit, which nobody reads
}
#: Libraries that were not used for this time [s] are removed. At most `_MOST` are kept besides those of the last hour.
_STALE, _RECENT, _MOST = 30 * 86400.0, 3600.0, 8
PREFIX = "wheelrail-contact-"


def get_include() -> Path:
    """Return the folder of wheelrail.h, for compilers of programs that call the library.

    Examples
    --------
    >>> import contact
    >>> (contact.get_include() / "wheelrail.h").is_file()
    True
    """
    return _HERE / "include"


def get_library() -> Path:
    """Return the library with the C interface, wheelrail.h. A checkout builds it if necessary.

    Raises
    ------
    ImportError
        If this machine has none: no library fits, or a checkout has no C compiler.

    Examples
    --------
    >>> import contact
    >>> contact.get_library().is_file()
    True
    """
    path = _whole() or cached() / NAME
    if not path.is_file():
        raise ImportError(f"{path} was not linked: the C interface of a checkout needs cc, gcc or clang")
    return path


def address(symbol: str) -> int:
    """Return the address of a function of the library."""
    return loaded().address(symbol)


def constants(k: int, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return array `k` of the constant arrays that the kernels read (`contact.compile.c_tables`). It is read-only."""
    numbers = (ctypes.c_double * math.prod(shape)).from_address(loaded().constants(k))
    found = np.frombuffer(memoryview(numbers).cast("B")).reshape(shape)
    found.setflags(write=False)
    return found


@dataclass(frozen=True)
class Loaded:
    """A library in this process: the address of a function by its name, and that of a constant array by its number."""

    address: Callable[[str], int]
    constants: Callable[[int], int]


@cache
def loaded() -> Loaded:
    """Return the library of this package."""
    whole = _whole()
    return of_library(whole) if whole else of_folder(cached())


def of_folder(folder: Path) -> Loaded:
    """Load the library in a folder that the builder has filled for this machine."""
    linked = folder / NAME
    return of_library(linked) if linked.is_file() else _of_objects(folder)


def of_library(path: Path) -> Loaded:
    """Load a library.

    Raises
    ------
    ImportError
        If it is that of another version.
    """
    library, end = ctypes.CDLL(str(path)), ""
    if hasattr(library, "wr_version"):
        library.wr_version.restype = ctypes.c_char_p
    version = library.wr_version().decode() if hasattr(library, "wr_version") else "an unknown version"
    if version != __version__:
        raise ImportError(
            f"{path} is the library of wheelrail-contact {version}, and this is version {__version__}. "
            "Install the package again: pip install --force-reinstall wheelrail-contact"
        )
    if hasattr(library, "wr_processor"):  # it has each entry for several processors
        library.wr_processor.restype = ctypes.c_char_p
        end = "_" + library.wr_processor().decode()

    def find(symbol: str) -> int:
        try:
            return ctypes.cast(getattr(library, symbol + end), ctypes.c_void_p).value or 0
        except AttributeError:
            raise ImportError(
                f"{path} has no function {symbol}: it was built from other sources. "
                "Install the package again: pip install --force-reinstall wheelrail-contact"
            ) from None

    library.wr_constants.restype = ctypes.c_void_p
    return Loaded(find, lambda k: library.wr_constants(k) or 0)


def _of_objects(folder: Path) -> Loaded:
    """Load the object file of a checkout on a machine that has no linker."""
    from llvmlite import binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
    engine.add_object_file(str(folder / "kernels.o"))
    engine.finalize_object()
    _KEPT.append(engine)
    return Loaded(
        lambda symbol: int(engine.get_function_address(symbol)),
        lambda k: int(engine.get_global_value_address(f"wr_data{k}")),
    )


_KEPT: list[object] = []


def _whole() -> Path | None:
    """Return the library with what other packages add: the installed one, or the newest that this checkout has built.

    A folder that is being filled has a longer name.
    """
    if INSTALLED.is_file():
        return INSTALLED
    found = [
        path
        for place in (f"systems-*/linked-*/{SYSTEM}", f"added-{'?' * 12}")
        for path in cache_folder().glob(f"{PREFIX}{fingerprint()}-{place}/{NAME}")
    ]
    return max(found, key=lambda path: path.stat().st_mtime, default=None)


def cached() -> Path:
    """Return the folder of the library of this checkout. Build it if it is not there."""
    folder = cache_folder() / (PREFIX + fingerprint())
    if not folder.is_dir() and not registered()["kernels"]:
        raise ImportError(
            f"wheelrail-contact has no compiled library for {platform.system()} on {platform.machine()}: {INSTALLED} is "
            "missing. Install a wheel for this system, or build one from the sources (CONTRIBUTING.md)."
        )
    return build(folder)


def build(folder: Path, *options: str) -> Path:
    """Return a folder that the builder fills, with these options. If another process does so already, wait for it."""
    if folder.is_dir():
        with contextlib.suppress(OSError):
            os.utime(folder)
        return folder
    try:
        with locked(folder):
            if not folder.is_dir():
                made = folder.parent / f"{folder.name}.{os.getpid()}"
                shutil.rmtree(made, ignore_errors=True)
                made.mkdir()
                _run_builder(made, *options)
                with contextlib.suppress(OSError):  # another process was faster
                    made.rename(folder)
                shutil.rmtree(made, ignore_errors=True)
    except OSError as error:
        raise _not_writable(folder.parent, error) from None
    _remove_stale(folder.parent)
    return folder


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Let one process at a time build what belongs into a folder."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    with (folder.parent / f"{folder.name}.lock").open("w") as held:
        with contextlib.suppress(ImportError):  # not on Windows, where two processes may build the same
            import fcntl

            fcntl.flock(held, fcntl.LOCK_EX)
        yield


def _run_builder(folder: Path, *options: str) -> None:
    """Run the builder (`contact.compile.library`) in a process of its own. On a terminal a line says so."""
    try:
        version("numba")
    except PackageNotFoundError:
        raise ImportError(
            "this checkout of wheelrail-contact has no compiled library yet, and numba, which compiles it, is not installed: "
            "pip install 'numba==0.68.1', or install a wheel"
        ) from None
    shows = sys.stderr is not None and sys.stderr.isatty()
    begin = time.monotonic()
    command = [sys.executable, "-m", "contact.compile.library", str(folder), *options]
    path = os.pathsep.join(filter(None, (*map(str, roots()), os.environ.get("PYTHONPATH"))))
    own = os.environ | ENVIRONMENT | {"PYTHONPATH": path}
    with subprocess.Popen(
        command, cwd=_ROOT, env=own, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        output = None
        while output is None:
            if shows:
                spent = time.monotonic() - begin
                sys.stderr.write(f"\rcontact: compiling the library, once for these sources: {spent:.0f} s\033[K")
                sys.stderr.flush()
            try:
                output, _ = process.communicate(timeout=1.0)
            except subprocess.TimeoutExpired:
                continue
    if shows:
        sys.stderr.write("\r\033[K")
    if process.returncode:
        tail = "\n".join(output.splitlines()[-12:])
        raise ImportError(f"the library of wheelrail-contact could not be built:\n{tail}")


@cache
def fingerprint() -> str:
    """Return a hash of what the library of this checkout is made from: version, sources, tools, processor."""
    content = hashlib.sha256(f"{__version__} {_processor()}".encode())
    for tool in _TOOLS:
        with contextlib.suppress(PackageNotFoundError):
            content.update(f"{tool} {version(tool)}".encode())
    for path in sources():
        content.update(f"{path.relative_to(_ROOT)}\0".encode() + path.read_bytes())
    return content.hexdigest()[:16]


def _processor() -> str:
    """Return what tells this processor from those for which its library may be wrong: on Linux all that it can do."""
    said = f"{platform.machine()} {platform.processor()}"
    with contextlib.suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
        said += next((line for line in lines if line.startswith(("flags", "Features"))), "")
    return said


def sources() -> list[Path]:
    """Return the sources of the library: all files with kernels, the C interface and the builder."""
    builder = [path for name in ("core", "compile", "kernels") for path in (_HERE / name).rglob("*.py")]
    in_c = [path for name in ("c", "include") for path in (_HERE / name).iterdir()]
    return sorted({*(path for path, _ in modules()), *builder, *in_c})


@cache
def registered() -> dict[str, list[str]]:
    """Return what pyproject.toml says of the library: folders of packages, packages with kernels, modules that add C functions.

    A package that is installed by a wheel has no such file. It builds nothing.
    """
    told = tomllib.loads(_PROJECT.read_text(encoding="utf-8")) if _PROJECT.is_file() else {}
    return {"roots": [], "kernels": [], "added": [], **told.get("tool", {}).get("contact", {}).get("library", {})}


def roots() -> list[Path]:
    """Return the folders of this checkout that hold packages."""
    return [_ROOT / name for name in registered()["roots"]]


def modules() -> list[tuple[Path, str]]:
    """Return path and name of the modules with kernels in all packages that pyproject.toml lists."""
    return [
        (path, ".".join(path.relative_to(root).with_suffix("").parts))
        for root in roots()
        for name in registered()["kernels"]
        for path in sorted((root / name).rglob("*.py"))
        if _has_kernels(path)
    ]


def _has_kernels(path: Path) -> bool:
    text = path.read_bytes()
    return any(b"\n@" + mark in text for mark in (b"kernel\n", b"entry\n", b"inlined\n"))


def cache_folder() -> Path:
    """Return the folder in which libraries of checkouts are kept: CONTACT_CACHE_DIR if set, else the system's for caches.

    Where that cannot be written, and does not have this library, it is a folder of the user among the temporary ones.
    """
    own = os.environ.get("CONTACT_CACHE_DIR")
    folder = Path(own) if own else _usual_folder()
    if folder is not None and (_can_be_written(folder) or (folder / (PREFIX + fingerprint())).is_dir()):
        return folder
    try:
        temporary = Path(tempfile.gettempdir()) / f"wheelrail-contact-{_user()}"
    except OSError as error:
        raise _not_writable(folder or Path(), error) from None
    if own:
        text = f"CONTACT_CACHE_DIR = {own} cannot be written; the library is kept in {temporary}"
        warnings.warn(text, stacklevel=2)
    return temporary


def _usual_folder() -> Path | None:
    """Return the system's folder for caches; None for a user without a home."""
    try:
        if sys.platform == "win32":
            return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
        if sys.platform == "darwin":
            return Path.home() / "Library" / "Caches"
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    except RuntimeError:
        return None


def _user() -> str:
    """Return the name of the user, or the number of one that the system does not know, as in containers."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return str(os.getuid()) if hasattr(os, "getuid") else "user"


def _can_be_written(folder: Path) -> bool:
    """Return whether the folder, or the first one above it that is there, takes files."""
    existing = next((path for path in (folder, *folder.absolute().parents) if path.exists()), folder)
    return existing.is_dir() and os.access(existing, os.W_OK | os.X_OK)


def _not_writable(folder: Path, error: OSError) -> ImportError:
    return ImportError(
        f"the library of wheelrail-contact cannot be kept in {folder} ({error.strerror or error}); "
        "set CONTACT_CACHE_DIR to a folder that can be written"
    )


def _remove_stale(base: Path) -> None:
    """Remove libraries that were not used for `_STALE` seconds, and all but the `_MOST` latest and those of the last hour.

    Many checkouts share the folder: none removes what another one uses at present.
    """
    kept = sorted(
        (path for path in base.glob(PREFIX + "*") if path.is_dir()),
        key=lambda path: path.stat().st_mtime,
        reverse=True,
    )
    for i, path in enumerate(kept):
        age = time.time() - path.stat().st_mtime
        if age > _STALE or (i >= _MOST and age > _RECENT):
            shutil.rmtree(path, ignore_errors=True)
