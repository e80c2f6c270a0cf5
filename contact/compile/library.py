"""Build the library of all kernels: ``python -m contact.compile.library FOLDER [--first | --added | --systems]``.

It writes objects for this machine, with the entries of Python and of the C interface, and where there is a linker the library
beside them. With ``--first`` these have only the entries behind `contact.solve`; with ``--added`` also those functions that
other packages add for Python (`Added`). Beside each object lies the bitcode of its kernels before LLVM optimises them. With
``--systems`` there is instead kernels.bc, the bitcode of all kernels with all that other packages add, and what
`objects` makes of it for all systems. `linking` then links that.

It imports all modules that have entries (`contact.core.entry`). `contact.core.checkout` starts it, with settings of numba.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from multiprocessing import get_context
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any, NamedTuple

from contact.compile import emit
from contact.core.checkout import is_first, modules, registered
from contact.core.library import NAME, get_include
from contact.version import __version__

#: Beginning of the names of the functions that the C interface calls.
PREFIX = "wrk"
#: Large kernels of the object of patches and of that of pairs. Those of later objects that call them do so where they are.
_OF_PATCHES = (
    "contact.kernels.normal.press.press",
    "contact.kernels.normal.tangent.linearise",
    "contact.kernels.normal.tangent.follow",
    "contact.kernels.normal.descent.fill_descent",
    "contact.kernels.normal.factors.fill_factors",
    *(f"contact.kernels.pipeline.{name}" for name in ("press_case", "complete_pressure", "roll_case", "solve_case")),
    *(f"contact.kernels.jacobian.{name}" for name in ("solve_with_jacobian", "derive_solved", "roll_creepages")),
    "contact.kernels.together.roll_together",
    "contact.kernels.given_force.solve_under_force",
    "contact.kernels.damage.assess.damage_kernel",
)
_OF_PAIRS = ("contact.kernels.pair_conditions.derive_pair", "contact.kernels.flexible.solve_flexible")
#: The C sources of the C interface.
C_INTERFACE = sorted((get_include().parent / "c").glob("*.c"))


class Added(NamedTuple):
    """A function for C that another package adds to the library.

    A module that pyproject.toml lists under ``added`` has a function `added()`, which returns them.

    Parameters
    ----------
    name : str
        Name in the library.
    function : function of Python
        What numba compiles.
    result, arguments : str, tuple of str
        Types (`pointers.TYPES`) of the result, and of the arguments without the last one.
    last : function (type of the constant arrays) -> named tuple of numba types
        Type of the last argument: pointers.
    file : str
        Name of the file of C that has the function; empty where nobody needs it in C or in the libraries, but in kernels.bc.
    python : bool
        Whether Python calls it.
    """

    name: str
    function: Callable[..., Any]
    result: str
    arguments: tuple[str, ...]
    last: Callable[[Any], Any]
    file: str = ""
    python: bool = False


def entries() -> Iterator[Any]:
    """Yield all entries that Python calls."""
    from contact.core.calls import Entry

    for path, name in modules():
        if b"\n@entry\n" not in path.read_bytes():
            continue
        module = import_module(name)
        yield from (
            one for one in vars(module).values() if isinstance(one, Entry) and one.__module__ == module.__name__
        )


def flags(folder: Path) -> list[str]:
    """Return the flags of a C compiler for the C interface. `folder` has the declarations of its entries."""
    return [f"-I{folder}", f"-I{get_include()}", f'-DWR_VERSION="{__version__}"']


class Constants(NamedTuple):
    """What every entry of the C interface gets last: pointers to the constant arrays, `c_tables.data`."""

    data: Any


class Kernels:
    """What numba makes of all entries, and of what other packages add as far as `needed` says so.

    No kernel can be called in this process afterwards.
    """

    def __init__(self, needed: Callable[[Added], bool]) -> None:
        from contact.compile import c_tables
        from contact.kernels.entries import all_entries

        self.of_python = list(entries())
        self.of_c = all_entries()
        # Before machine code is switched off, since these call kernels to make their constants.
        self.added: list[Added] = []
        for name in registered()["added"]:
            self.added += filter(needed, import_module(name).added())
        self.data = c_tables.data()
        emit.make_no_machine_code()

    @property
    def exported(self) -> list[str]:
        """Names of the functions that can be called from outside the library: by Python, and of what other packages add."""
        return [*(one.symbol for one in self.of_python), *(one.name for one in self.added if one.file)]

    def emission(self, of_python: Sequence[Any], others: bool, elsewhere: Sequence[Any] = ()) -> emit.Emission:
        """Let numba make entries of Python and, if `others`, those of C and what was added.

        Functions `elsewhere` are called where they are.
        """
        from numba import cfunc, types

        from contact.compile.pointers import TYPES, Doubles
        from contact.core.compiled import as_c_function

        made = emit.Emission(self.data, elsewhere)
        tables = types.UniTuple(Doubles, len(self.data))

        def add(name: str, function: Any, result: str, arguments: tuple[str, ...], given: Any) -> None:
            typed = TYPES[result](*(TYPES[kind] for kind in arguments), given)
            pointers = ("ptr",) * (len(given.types) - 1)
            made.add(name, cfunc(typed, error_model="numpy")(function), result, (*arguments, *pointers))

        for one in of_python:
            made.add_entry(one.symbol, as_c_function(one))
        for name, (function, result, arguments) in self.of_c.items() if others else ():
            add(f"{PREFIX}_{name}", function, result, arguments, types.NamedTuple((tables,), Constants))
        for one in self.added if others else ():
            add(one.name, one.function, one.result, one.arguments, one.last(tables))
        return made


def write_declarations(folder: Path, ends: tuple[str, ...]) -> None:
    """Write wheelrail_entries.h: the entries that the C interface calls, one function for each end of a name."""
    from contact.kernels.entries import all_entries

    named = {"i64": "int64_t", "f64": "double", "ptr": "void *"}
    lines = ["/* Generated from contact/kernels/entries. */", "#include <stdint.h>"]
    for name, (_, result, arguments) in all_entries().items():
        taken = ", ".join(named[kind] for kind in arguments)
        lines += [f"{named[result]} {PREFIX}_{name}{end}({taken});" for end in ends]
    (folder / "wheelrail_entries.h").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_objects(kernels: Kernels, folder: Path, *, first: bool) -> None:
    """Write the objects for this machine: of all kernels, or only of the `first`, those behind `contact.solve`.

    A process of its own optimises these, and one those of `contact`, while numba makes what is left. A system that cannot
    fork gets one object.
    """
    from contact.core.compiled import as_c_function

    data = emit.data_as_ir(kernels.data)
    if not first and not hasattr(os, "fork"):
        _write_object(kernels.emission(kernels.of_python, True), kernels.exported, data, folder / "kernels.o")
        return
    made = kernels.emission([one for one in kernels.of_python if is_first(one.function.__module__)], False)
    if first:
        _write_object(made, kernels.exported, data, folder / "first.o")
        return
    rest = [one for one in kernels.of_python if one.symbol not in made.names]
    for one in rest:
        if one.dispatcher.overloads:  # these entries of one patch cost nothing here, and a copy of it elsewhere
            made.add_entry(one.symbol, as_c_function(one))
    elsewhere = _offered(made, _OF_PATCHES)
    beside = [_begin_object(made, kernels.exported, data, folder / "first.o")]
    rest = [one for one in rest if one.symbol not in made.names]
    of_contact = [one for one in rest if one.function.__module__.startswith("contact.")]
    made = kernels.emission(of_contact, False, elsewhere)
    elsewhere = [*elsewhere, *_offered(made, _OF_PAIRS)]
    beside.append(_begin_object(made, kernels.exported, "", folder / "pairs.o"))
    others = kernels.emission([one for one in rest if one not in of_contact], True, elsewhere)
    _write_object(others, kernels.exported, "", folder / "others.o")
    for process in beside:
        process.join()
        if process.exitcode:
            raise RuntimeError("an object of the library could not be written")


def _begin_object(*given: Any) -> BaseProcess:
    """Let a process of its own write an object (`_write_object`)."""
    process = get_context("fork").Process(target=_write_object, args=given, daemon=True)
    process.start()
    return process


def _offered(made: emit.Emission, names: Sequence[str]) -> list[Any]:
    """Let other modules call kernels, by their names, where an emission has them."""
    return [function for name in names for function in made.offer(_kernel(name))]


def _kernel(name: str) -> Any:
    """Return a kernel as numba's dispatcher."""
    module, _, name = name.rpartition(".")
    found = getattr(import_module(module), name)
    return getattr(found, "dispatcher", found)


def _write_object(made: emit.Emission, exported: Sequence[str], data: str, path: Path) -> None:
    """Optimise an emission for this machine and write its object file."""
    from llvmlite import binding as llvm

    module = made.module(exported)
    path.with_suffix(".bc").write_bytes(module.as_bitcode())
    module.link_in(llvm.parse_assembly(data))
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    target = llvm.Target.from_default_triple()
    machine = target.create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=3,
        reloc="pic",
        codemodel="default",
    )
    module.triple, module.data_layout = llvm.get_default_triple(), str(machine.target_data)
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(module, builder)
    emit.refuse_the_rest(module, made.elsewhere)
    path.write_bytes(machine.emit_object(module))


def link_for_this_machine(folder: Path, *, first: bool) -> None:
    """Link the library by the system's compiler if there is one, with its C interface unless it has only the `first` kernels.

    Without a compiler Python alone can use the objects.
    """
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        return
    write_declarations(folder, ("",))
    options = ("-std=c11", "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-fvisibility=hidden", *flags(folder))
    in_c = [path for path in C_INTERFACE if not first or path.name == "library.c"]
    command = [compiler, *options, "-o", str(folder / NAME), *map(str, (*in_c, *folder.glob("*.o"))), "-lm"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    sys.stdout.write(done.stderr)  # a compiler without headers or a linker is like none


def main() -> None:
    """Build into the folder that the command line names."""
    emit.show_no_warnings()
    folder, options = Path(sys.argv[1]), set(sys.argv[2:])
    for_systems = "--systems" in options
    kernels = Kernels(lambda one: for_systems or ("--added" in options and one.python))
    if not for_systems:
        write_objects(kernels, folder, first="--first" in options)
        link_for_this_machine(folder, first="--first" in options)
        return
    from contact.compile import objects

    write_declarations(folder, tuple(f"_{suffix}" for suffix in (*objects.CPUS, objects.IN_C)))
    made = kernels.emission(kernels.of_python, True)
    code = made.module(kernels.exported).as_bitcode()
    (folder / "kernels.bc").write_bytes(code)  # for the explorer
    in_c: dict[str, list[str]] = {}
    for one in kernels.added:
        in_c.setdefault(one.file, []).append(one.name)
    apart = in_c.pop("", [])
    names = [name for name in made.names if name not in apart]
    data = emit.data_as_ir(kernels.data)
    objects.write(code, names, kernels.exported, data, {"kernels.c": names, **in_c}, folder)


if __name__ == "__main__":
    main()
