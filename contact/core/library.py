"""The library of compiled kernels: where it is, and the addresses of its functions.

A wheel holds it, in `contact/library`. A checkout builds the parts that are needed when they are needed
(`contact.core.checkout`).
"""

from __future__ import annotations

import ctypes
import math
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact.core.checkout import PREFIX, build, cache_folder, fingerprint, folder_of, part_of, registered
from contact.version import __version__

_HERE = Path(__file__).parents[1]
#: Name of the library on this system.
NAME = {"win32": "wheelrail.dll", "darwin": "libwheelrail.dylib"}.get(sys.platform, "libwheelrail.so")
#: This system, by its name in FMI 2.0 or, for 64-bit ARM, in 3.0.
_ARM = platform.machine().lower() in ("aarch64", "arm64")
SYSTEM = {"win32": "win64", "darwin": "aarch64-darwin" if _ARM else "darwin64"}.get(
    sys.platform, "aarch64-linux" if _ARM else "linux64"
)
#: The library of an installed package.
INSTALLED = _HERE / "library" / SYSTEM / NAME


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
        raise ImportError(
            f"{path} was not linked: the C interface of a checkout needs cc, gcc or clang, and C that compiles"
        )
    return path


def address(symbol: str, module: str) -> int:
    """Return the address of a function of the library, the entry of a module."""
    return loaded(part_of(module)).address(symbol)


def constants(k: int, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return array `k` of the constant arrays that the kernels read (`contact.compile.c_tables`). It is read-only."""
    numbers = (ctypes.c_double * math.prod(shape)).from_address(loaded("first").constants(k))
    found = np.frombuffer(memoryview(numbers).cast("B")).reshape(shape)
    found.setflags(write=False)
    return found


@dataclass(frozen=True)
class Loaded:
    """A library in this process: the address of a function by its name, and that of a constant array by its number."""

    address: Callable[[str], int]
    constants: Callable[[int], int]


@cache
def loaded(part: str = "") -> Loaded:
    """Return the library of this package. A checkout may build only a part of it."""
    whole = _whole(part)
    return of_library(whole) if whole else of_folder(cached(part))


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
    """Load the object files of a checkout on a machine that has no linker."""
    from llvmlite import binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
    for path in folder.glob("*.o"):
        engine.add_object_file(str(path))
    engine.finalize_object()
    _KEPT.append(engine)
    return Loaded(
        lambda symbol: int(engine.get_function_address(symbol)),
        lambda k: int(engine.get_global_value_address(f"wr_data{k}")),
    )


_KEPT: list[object] = []


def _whole(part: str = "") -> Path | None:
    """Return the library with a part and what other packages add: the installed one, or the newest of this checkout.

    A folder that is being filled has a longer name.
    """
    if INSTALLED.is_file():
        return INSTALLED
    found = list(cache_folder().glob(f"{PREFIX}{fingerprint('systems')}-systems-*/linked-*/{SYSTEM}/{NAME}"))
    if part != "halfspace":
        found += cache_folder().glob(f"{PREFIX}{fingerprint()}-added-{'?' * 12}/{NAME}")
    return max(found, key=lambda path: path.stat().st_mtime, default=None)


def cached(part: str = "") -> Path:
    """Return the folder of a part of the library of this checkout, or of a larger one. Build it if it is not there."""
    folder = folder_of(part)
    if not folder.is_dir() and not registered()["kernels"]:
        raise ImportError(
            f"wheelrail-contact has no compiled library for {platform.system()} on {platform.machine()}: {INSTALLED} is "
            "missing. Install a wheel for this system, or build one from the sources (CONTRIBUTING.md)."
        )
    larger = folder_of() if part == "first" else folder
    return build(larger) if larger.is_dir() else build(folder, part)
