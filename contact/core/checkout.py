"""The library of a checkout: what it is made from, where it is kept, and how the builder is started.

It is kept in the user's cache, under a name that is a hash of all that it is made from. Building needs numba.
"""

from __future__ import annotations

import contextlib
import getpass
import hashlib
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import warnings
from collections.abc import Iterator
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from contact.version import __version__

_HERE = Path(__file__).parents[1]
_ROOT = _HERE.parent
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
#: Modules of the kernels with the entries behind `contact.solve`, which are compiled first.
_FIRST = (
    *("solver", "pipeline", "separation", "quadrature", "kalker", "friction", "damage.assess", "tangential.table"),
    *("normal.between_panels", "normal.descent", "normal.factors", "normal.influence"),
)
#: Libraries that were not used for this time [s] are removed. At most `_MOST` are kept besides those of the last hour.
_STALE, _RECENT, _MOST = 30 * 86400.0, 3600.0, 8
PREFIX = "wheelrail-contact-"


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
    """Let one process at a time build what belongs into a folder, and remove its lock afterwards."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    path = folder.parent / f"{folder.name}.lock"
    while True:
        with path.open("w") as held:
            with contextlib.suppress(ImportError):  # not on Windows, where two processes may build the same
                import fcntl

                fcntl.flock(held, fcntl.LOCK_EX)
            try:
                if not os.path.samestat(path.stat(), os.fstat(held.fileno())):
                    continue
            except FileNotFoundError:  # who had it has removed it
                continue
            try:
                yield
            finally:
                with contextlib.suppress(OSError):
                    path.unlink()
            return


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
    """Return the sources of the library: all files with kernels, the C interface, the builder and the tables that it holds."""
    builder = [path for name in ("core", "compile", "kernels") for path in (_HERE / name).rglob("*.py")]
    in_c = [path for name in ("c", "include") for path in (_HERE / name).iterdir()]
    tables = [*(_HERE / "theory").glob("*.py"), *(_HERE / "data").glob("*creep*.csv")]  # `contact.compile.c_tables`
    return sorted({*(path for path, _ in modules()), *builder, *in_c, *tables})


@cache
def registered() -> dict[str, list[str]]:
    """Return what pyproject.toml says of the library: folders of packages, packages with kernels, modules that add C functions.

    A package that is installed by a wheel has no such file. It builds nothing.
    """
    told = tomllib.loads(_PROJECT.read_text(encoding="utf-8")) if _PROJECT.is_file() else {}
    return {"roots": [], "kernels": [], "added": [], **told.get("tool", {}).get("contact", {}).get("library", {})}


def is_first(module: str) -> bool:
    """Return whether the entries of a module are those behind `contact.solve`."""
    return module.removeprefix("contact.kernels.") in _FIRST


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
    for path in base.glob(PREFIX + "*.lock"):  # of builds that were killed
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > _RECENT:
                path.unlink()
