"""The library of a checkout: its parts, what each is made from, where it is kept, and how the builder is started.

A part is kept in the user's cache, under a name that is a hash of all that it is made from. Building needs numba.
"""

from __future__ import annotations

import contextlib
import getpass
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import warnings
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.util import resolve_name
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
_KERNELS = "contact.kernels."
#: Part of the library → how the names of the modules begin whose entries it has: those behind `contact.solve`, and those of the
#: half space, which read no table. The part without a name has all but the latter, and the C interface. "systems" has all.
PARTS = {
    "first": (
        *(f"{_KERNELS}{name}." for name in ("solver", "pipeline", "separation", "quadrature", "kalker", "friction")),
        *(f"{_KERNELS}{name}." for name in ("hertz", "cubic", "damage.assess", "normal", "tangential")),
    ),
    "halfspace": ("contact.halfspace.", f"{_KERNELS}stress."),
}
#: Libraries that were not used for this time [s] are removed. At most `_MOST` are kept besides those of the last hour.
_STALE, _RECENT, _MOST = 30 * 86400.0, 3600.0, 12
PREFIX = "wheelrail-contact-"
_IMPORT = re.compile(r"^\s*(?:from\s+([\w.]+)\s+import\s+(\([^)]*\)|.*)|import\s+(.*))", re.MULTILINE)


def build(folder: Path, part: str = "") -> Path:
    """Return a folder that the builder fills with a part. If another process does so already, wait for it."""
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
                _run_builder(made, part)
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


def _run_builder(folder: Path, part: str) -> None:
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
    command = [sys.executable, "-m", "contact.compile.library", str(folder), part]
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
def fingerprint(part: str = "") -> str:
    """Return a hash of what a part of the library is made from: version, sources, tools, processor."""
    content = hashlib.sha256(f"{__version__} {part} {_processor()}".encode())
    for tool in _TOOLS:
        with contextlib.suppress(PackageNotFoundError):
            content.update(f"{tool} {version(tool)}".encode())
    for path in sources(part):
        content.update(f"{path.relative_to(_ROOT)}\0".encode() + path.read_bytes())
    return content.hexdigest()[:16]


def _processor() -> str:
    """Return what tells this processor from those for which its library may be wrong: on Linux all that it can do."""
    said = f"{platform.machine()} {platform.processor()}"
    with contextlib.suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
        said += next((line for line in lines if line.startswith(("flags", "Features"))), "")
    return said


def sources(part: str = "") -> list[Path]:
    """Return the sources of a part: its entries with all that their modules import, the builder, the tables and C that it has.

    Kernels use nothing but what stands in files with kernels, or beside these in folders of that name.
    """
    known = _known()
    pending = [name for name, path in known.items() if has(part, name) and _has_kernels(path)]
    pending += [] if part == "halfspace" else ["contact.compile.c_tables"]
    pending += [] if part in PARTS else ["contact.kernels.entries"]
    found = _reached(pending, known)
    builder = [path for name in ("core", "compile") for path in (_HERE / name).glob("*.py")]
    in_c = [path for name in ("c", "include") for path in (_HERE / name).iterdir()]
    if part in PARTS:
        in_c = [path for path in in_c if path.suffix == ".h" or path.name == "library.c"]
    tables = () if part == "halfspace" else (_HERE / "data").glob("*creep*.csv")
    return sorted({*(known[name] for name in found), *builder, *in_c, *tables})


def sources_of_added() -> list[Path]:
    """Return the sources of what other packages add to the library: their modules, and those of others that these import."""
    names = registered()["added"]
    packages = tuple(name.partition(".")[0] for name in names)
    known = _modules((*registered()["kernels"], *packages))
    return sorted(known[name] for name in _reached(list(names), known, packages))


def _reached(pending: list[str], known: Mapping[str, Path], of: tuple[str, ...] = ("",)) -> set[str]:
    """Return the known modules among the pending ones, and what those with a name that begins so import."""
    found: set[str] = set()
    while pending:
        name = pending.pop()
        if name in known and name not in found:
            found.add(name)
            pending += _imported(name, known[name]) if name.startswith(of) else ()
    return found


def _imported(name: str, path: Path) -> Iterator[str]:
    """Yield the names of the modules that one imports, anywhere in it, and those of what it imports from them."""
    for origin, listed, plain in _IMPORT.findall(path.read_text(encoding="utf-8")):
        yield from re.findall(r"[\w.]+", plain)
        if origin:
            module = resolve_name(origin, _package(name, path))
            yield module
            yield from (f"{module}.{one}" for one in re.findall(r"\w+", listed))


def _package(name: str, path: Path) -> str:
    return name if path.stem == "__init__" else name.rpartition(".")[0]


@cache
def registered() -> dict[str, list[str]]:
    """Return what pyproject.toml says of the library: folders of packages, packages with kernels, modules that add C functions.

    A package that is installed by a wheel has no such file. It builds nothing.
    """
    told = tomllib.loads(_PROJECT.read_text(encoding="utf-8")) if _PROJECT.is_file() else {}
    return {"roots": [], "kernels": [], "added": [], **told.get("tool", {}).get("contact", {}).get("library", {})}


def part_of(module: str) -> str:
    """Return the smallest part of the library that has the entries of a module."""
    return next((part for part, begins in PARTS.items() if f"{module}.".startswith(begins)), "")


def has(part: str, module: str) -> bool:
    """Return whether a part of the library has the entries of a module."""
    smallest = part_of(module)
    return part in ("systems", smallest) or (part not in PARTS and smallest != "halfspace")


def roots() -> list[Path]:
    """Return the folders of this checkout that hold packages."""
    return [_ROOT / name for name in registered()["roots"]]


def modules() -> list[tuple[Path, str]]:
    """Return path and name of the modules with kernels in all packages that pyproject.toml lists."""
    return [(path, name) for name, path in _known().items() if _has_kernels(path)]


def _known() -> dict[str, Path]:
    """Return the modules, by their names, that kernels may use, and those that make the tables and the library."""
    return {
        name: path
        for name, path in _modules(registered()["kernels"]).items()
        if {"compile", "core", "theory", "kernels"} & {*name.split(".")} or _has_kernels(path)
    }


def _modules(packages: Iterable[str]) -> dict[str, Path]:
    """Return the modules of packages of this checkout, by their names."""
    return {
        ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__"): path
        for root in roots()
        for package in packages
        for path in sorted((root / package).rglob("*.py"))
    }


def _has_kernels(path: Path) -> bool:
    text = path.read_bytes()
    return any(b"\n@" + mark in text for mark in (b"kernel\n", b"entry\n", b"inlined\n"))


def folder_of(part: str = "") -> Path:
    """Return the folder of a part of the library of this checkout."""
    return cache_folder(part) / _name(part)


def _name(part: str) -> str:
    return "-".join(filter(None, (PREFIX + fingerprint(part), part)))


def cache_folder(part: str = "") -> Path:
    """Return the folder in which libraries of checkouts are kept: CONTACT_CACHE_DIR if set, else the system's for caches.

    Where that cannot be written, and does not have this part, it is a folder of the user among the temporary ones.
    """
    own = os.environ.get("CONTACT_CACHE_DIR")
    folder = Path(own) if own else _usual_folder()
    if folder is not None and (_can_be_written(folder) or (folder / _name(part)).is_dir()):
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
