"""Build the library of all kernels: ``python -m contact.compile.library FOLDER [--added | --systems]``.

It writes kernels.bc, the kernels before LLVM optimises them, and kernels.o for this machine, with the entries of Python and of
the C interface, and where there is a linker the library beside it. With ``--added`` these also have those functions that other
packages add for Python (`Added`). With ``--systems`` kernels.bc has all that they add, and instead of kernels.o there is what
`objects` makes of it for all systems. `linking` then links that.

It imports all modules that have entries (`contact.core.entry`). `contact.core.checkout` starts it, with settings of numba.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from contact.compile import emit
from contact.core.checkout import modules, registered
from contact.core.library import NAME, get_include
from contact.version import __version__

#: Beginning of the names of the functions that the C interface calls.
PREFIX = "wrk"
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
    """What numba makes of all entries, and of what other packages add as far as `needed` says so."""

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

    @property
    def exported(self) -> list[str]:
        """Names of the functions that can be called from outside the library: by Python, and of what other packages add."""
        return [*(one.symbol for one in self.of_python), *(one.name for one in self.added if one.file)]

    def module(self) -> tuple[Any, list[str]]:
        """Return one LLVM module, and the names of its C functions. No kernel can be called in this process afterwards."""
        from numba import cfunc, types

        from contact.compile.pointers import TYPES, Doubles
        from contact.core.compiled import as_c_function

        emit.make_no_machine_code()
        made = emit.Emission(self.data)
        tables = types.UniTuple(Doubles, len(self.data))

        def add(name: str, function: Any, result: str, arguments: tuple[str, ...], given: Any) -> None:
            typed = TYPES[result](*(TYPES[kind] for kind in arguments), given)
            pointers = ("ptr",) * (len(given.types) - 1)
            made.add(name, cfunc(typed, error_model="numpy")(function), result, (*arguments, *pointers))

        for one in self.of_python:
            made.add_entry(one.symbol, as_c_function(one))
        for name, (function, result, arguments) in self.of_c.items():
            add(f"{PREFIX}_{name}", function, result, arguments, types.NamedTuple((tables,), Constants))
        for one in self.added:
            add(one.name, one.function, one.result, one.arguments, one.last(tables))
        module = made.module()
        hidden = set(made.names) - set(self.exported)
        for function in module.functions:
            if function.name in hidden:
                function.visibility = "hidden"
        return module, made.names


def write_declarations(folder: Path, ends: tuple[str, ...]) -> None:
    """Write wheelrail_entries.h: the entries that the C interface calls, one function for each end of a name."""
    from contact.kernels.entries import all_entries

    named = {"i64": "int64_t", "f64": "double", "ptr": "void *"}
    lines = ["/* Generated from contact/kernels/entries. */", "#include <stdint.h>"]
    for name, (_, result, arguments) in all_entries().items():
        taken = ", ".join(named[kind] for kind in arguments)
        lines += [f"{named[result]} {PREFIX}_{name}{end}({taken});" for end in ends]
    (folder / "wheelrail_entries.h").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_object(module: Any, path: Path) -> None:
    """Optimise a module for this machine and write its object file."""
    from llvmlite import binding as llvm

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
    emit.refuse_the_rest(module)
    path.write_bytes(machine.emit_object(module))


def link_for_this_machine(folder: Path) -> None:
    """Link the library, with its C interface, by the system's compiler if there is one. Else Python alone can use kernels.o."""
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        return
    write_declarations(folder, ("",))
    options = ("-std=c11", "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-fvisibility=hidden", *flags(folder))
    command = [compiler, *options, "-o", str(folder / NAME), *map(str, C_INTERFACE), str(folder / "kernels.o"), "-lm"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    sys.stdout.write(done.stderr)  # a compiler without headers or a linker is like none


def main() -> None:
    """Build into the folder that the command line names."""
    emit.show_no_warnings()
    folder, for_systems = Path(sys.argv[1]), "--systems" in sys.argv
    for_python = "--added" in sys.argv
    kernels = Kernels(lambda one: for_systems or (for_python and one.python))
    module, names = kernels.module()
    data = emit.data_as_ir(kernels.data)
    code = module.as_bitcode()
    (folder / "kernels.bc").write_bytes(code)  # for the explorer, and for the test that all kernels can become C
    if not for_systems:
        from llvmlite import binding as llvm

        module.link_in(llvm.parse_assembly(data))
        write_object(module, folder / "kernels.o")
        link_for_this_machine(folder)
        return
    from contact.compile import objects

    write_declarations(folder, tuple(f"_{suffix}" for suffix in (*objects.CPUS, objects.IN_C)))
    in_c: dict[str, list[str]] = {}
    for one in kernels.added:
        in_c.setdefault(one.file, []).append(one.name)
    apart = in_c.pop("", [])
    names = [name for name in names if name not in apart]
    objects.write(code, names, kernels.exported, data, {"kernels.c": names, **in_c}, folder)


if __name__ == "__main__":
    main()
