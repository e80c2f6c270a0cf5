"""The library that a host loads of an FMU for hosts with Python: `c/entry.c`, for Linux and Windows.

A wheel has them beside its other libraries. A checkout builds them by zig, in two seconds, and keeps them.
"""

from __future__ import annotations

from pathlib import Path

from contact.core import checkout, library
from ..archive import digest

#: System → name of the file, among the libraries of all systems.
FILES = {"linux64": "libwheelrail-entry.so", "win64": "wheelrail-entry.dll"}
_HERE = Path(__file__).parent / "c"
_LOCATION = Path(__file__).parents[1] / "native" / "c" / "location.h"
#: The libraries of an installed package.
_INSTALLED = library.INSTALLED.parents[1]


def libraries() -> dict[str, bytes]:
    """Return the library of each system.

    Raises
    ------
    ImportError
        If they are neither installed nor can be built here.
    """
    if all((_INSTALLED / system / name).is_file() for system, name in FILES.items()):
        made = _INSTALLED
    else:
        name = f"{checkout.PREFIX}entry-{digest(_LOCATION, Path(__file__), *_HERE.iterdir())}"
        made = checkout.cache_folder() / name
        with checkout.locked(made):
            build([system for system, name in FILES.items() if not (made / system / name).is_file()], made)
    return {system: (made / system / name).read_bytes() for system, name in FILES.items()}


def build(wanted: list[str], made: Path) -> None:
    """Build the libraries of these systems into their folders in `made`."""
    if not wanted:
        return
    try:
        import ziglang  # noqa: F401

        from contact.compile.linking import OF_WINDOWS, WITHOUT_MINGW, compiler, run
        from ..native.headers import HEADERS
    except ModuleNotFoundError as error:
        raise ImportError(
            f"{error}: to build FMUs for hosts with Python without a wheel  pip install 'wheelrail-contact[native]'"
        ) from None
    flags = ("-std=c11", "-O2", "-Wall", "-Wextra", "-fPIC", "-fvisibility=hidden")
    include = (f"-I{_LOCATION.parent}", f"-I{HEADERS}")
    for system in wanted:
        folder = made / system
        folder.mkdir(parents=True, exist_ok=True)
        objects = []
        for source in (*sorted(_HERE.glob("*.c")), *((OF_WINDOWS,) if system == "win64" else ())):
            objects.append(f"{source.stem}.o")
            run(*compiler(system), *flags, *include, "-c", source, "-o", folder / objects[-1])
        options = WITHOUT_MINGW if system == "win64" else ("-Wl,-z,defs", "-ldl")
        run(*compiler(system), "-shared", "-s", *objects, "-o", FILES[system], *options, cwd=folder)
        for path in (*(folder / name for name in objects), *folder.glob("*.lib")):
            path.unlink()
