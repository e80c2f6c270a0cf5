"""The libraries of all systems, which native FMUs and wheels hold: kernels, C interface and FMI in one file.

A wheel has them in `contact/library`. In a checkout they are built when they are first needed, and kept beside the library of
this machine (`contact.core.library`). The folder has

* ``<system>/``, the library of a system,
* ``sources/``, headers that the C sources of an FMU need, ``sources/data.c``, and for each kind of model ``<kind>.c``,
* ``licenses/``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from shutil import copy

from contact.core import checkout, library
from ..archive import digest
from ..python import entry
from .kinds import KINDS, OF_PYTHON, names

_HERE = Path(__file__).parent
#: The libraries of an installed package.
INSTALLED = library.INSTALLED.parents[1]
#: Headers of the C interface, the C source that chooses the kernels for the processor, and the wrapper that makes an FMU of it.
INCLUDE = library.get_include()
PROCESSOR = _HERE / "c_library" / "processor.c"
WRAPPER = sorted((_HERE / "c").iterdir())
#: The C source of the library that a host loads of FMUs for hosts with Python.
ENTRY = sorted((_HERE.parent / "python" / "c").iterdir())
#: System, by its name in FMI 2.0 or, for 64-bit ARM, in 3.0 → file name of the library.
SYSTEMS = {
    "linux64": "libwheelrail.so",
    "win64": "wheelrail.dll",
    "darwin64": "libwheelrail.dylib",
    "aarch64-linux": "libwheelrail.so",
    "aarch64-darwin": "libwheelrail.dylib",
}
#: Systems whose libraries every FMU has, and those that are made from C.
USUAL, ARM = ("linux64", "win64", "darwin64"), ("aarch64-linux", "aarch64-darwin")


def folder(systems: Sequence[str] = USUAL, say: Callable[[str], None] = print) -> Path:
    """Return the folder of the libraries of these systems. A checkout builds those that are missing and says so.

    Raises
    ------
    ImportError
        If they are missing and cannot be built here: an installation from an sdist has that of its own system alone.
    """
    if INSTALLED.is_dir():
        if lacking := [one for one in systems if not (INSTALLED / one / SYSTEMS[one]).is_file()]:
            raise ImportError(
                f"{INSTALLED} has no library for {', '.join(lacking)}: it was built from an sdist. Install a wheel, which has "
                "those of all systems, to pack native FMUs"
            )
        return INSTALLED
    compiled = kernels(say)
    made = _linked(compiled)

    def missing() -> list[str]:
        return [system for system in systems if not (made / system / SYSTEMS[system]).is_file()]

    if missing():
        with checkout.locked(made):
            _link(compiled, made, missing(), say)
    return made


@cache
def of_this_machine() -> Path:
    """Return a library with the FMI functions of FMUs for hosts with Python, for this machine. A checkout builds it."""
    if library.INSTALLED.is_file():
        return library.INSTALLED
    linked = _linked(_compiled("systems")) / library.SYSTEM / library.NAME
    if linked.is_file():
        return linked
    compiled = checkout.build(_compiled("added"), "added")
    made = _linked(compiled)
    with checkout.locked(made):
        if not (made / library.NAME).is_file():
            _link_here(compiled, made)
    return made / library.NAME


def kernels(say: Callable[[str], None] = print) -> Path:
    """Return the folder of the kernels of a checkout, compiled for all systems. They are compiled if they are not there."""
    made = _compiled("systems")
    if not made.is_dir():
        import ziglang  # noqa: F401 - without it the libraries could not be linked, which the user must not learn minutes later

        say("compiling the kernels for all systems, some minutes the first time")
    return checkout.build(made, "systems")


def _compiled(what: str) -> Path:
    """Return the folder of compiled kernels of a checkout. Its name has a hash of everything that they are made from."""
    part, content = "systems" if what == "systems" else "", digest(*checkout.sources_of_added())
    return checkout.cache_folder() / f"{checkout.PREFIX}{checkout.fingerprint(part)}-{what}-{content}"


def _linked(compiled: Path) -> Path:
    """Return the folder of the libraries that are linked with these kernels."""
    return compiled / f"linked-{digest(*WRAPPER, PROCESSOR, _HERE / 'licences.py', *ENTRY)}"


def _link(compiled: Path, made: Path, systems: Sequence[str], say: Callable[[str], None]) -> None:
    try:
        from contact.compile.linking import link
        from .headers import HEADERS
        from .licences import licences
    except ModuleNotFoundError as error:
        raise ImportError(f"{error}: to build native FMUs  pip install 'wheelrail-contact[native]'") from None
    sources = made / "sources"
    sources.mkdir(parents=True, exist_ok=True)
    headers = [*HEADERS.glob("fmi[23]*.h"), *INCLUDE.glob("wheelrail_records.h")]
    for path in (*headers, *(path for path in compiled.glob("*.c") if path.name != "kernels.c")):
        copy(path, sources)
    (sources / "build.h").write_text(header("wheelrail", KINDS, in_c=False), encoding="utf-8")
    in_c, include = [PROCESSOR, *(path for path in WRAPPER if path.suffix == ".c")], (WRAPPER[0].parent, sources)
    for system in systems:
        say(f"linking the library for {system}")
        link(system, made / system / SYSTEMS[system], compiled, in_c, include)
    entry.build([one for one in systems if one in entry.FILES], made)
    (made / "licenses").mkdir(exist_ok=True)
    for name, text in licences(HEADERS):
        (made / "licenses" / name).write_text(text, encoding="utf-8")


def _link_here(compiled: Path, made: Path) -> None:
    """Link the FMI functions with the objects of this machine."""
    from contact.compile.linking import FLAGS, compiler, run
    from .headers import HEADERS

    made.mkdir(exist_ok=True)
    symbols = [f"#define {name}_any {name}" for kind in OF_PYTHON for name in names(kind)]
    (made / "build.h").write_text(header("wheelrail", OF_PYTHON, in_c=False) + "\n".join(symbols), encoding="utf-8")
    include = [f"-I{path}" for path in (made, WRAPPER[0].parent, HEADERS, INCLUDE)]
    sources = [path for path in WRAPPER if path.suffix == ".c"]
    options = (*FLAGS, "-Wno-unused-parameter", "-DKERNELS_IN_C", "-shared", "-lm")
    run(*compiler(library.SYSTEM), *options, *include, *sources, *compiled.glob("*.o"), "-o", made / library.NAME)


def header(prefix: str, kinds: Sequence[str], *, in_c: bool) -> str:
    """Return build.h: which kinds of models are linked, and a prefix for all names that one file uses of another."""
    listed = " ".join(f"DO({kind}, cpu)" for kind in kinds)
    lines = [
        "/* Generated: which kernels are here, and what all names begin with. */",
        "#ifndef BUILD_H",
        "#define BUILD_H",
    ]
    lines += ["#define KERNELS_IN_C"] if in_c else []
    lines += [f"#define OWN(name) {prefix}_##name", f"#define KINDS(DO, cpu) {listed}"]
    if in_c:
        shared = [f"{name}_any" for kind in kinds for name in names(kind)] + [f"wr_data{i}" for i in range(4)]
        lines += [f"#define {name} OWN({name})" for name in shared]
    return "\n".join([*lines, "#endif", ""])
