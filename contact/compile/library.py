"""Build a part of the library of all kernels: ``python -m contact.compile.library FOLDER [PART]``.

It writes objects for this machine, and where there is a linker the library beside them. Beside each object lies the bitcode of
its kernels before LLVM optimises them. PART is one of `contact.core.checkout`; the part without a name has all entries of
Python but those of the half space, and the C interface. The part "added" has also those functions that other packages add for
Python (`Added`). For "systems" there is instead kernels.bc, the bitcode of all kernels with all that other packages add, and
what `objects` makes of it for all systems. `linking` then links that.

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

import numpy as np

from contact.compile import emit
from contact.core.checkout import PARTS, has, modules, registered
from contact.core.library import NAME, get_include
from contact.version import __version__

#: Beginning of the names of the functions that the C interface calls.
PREFIX = "wrk"
#: Object, in the order in which they are made → how the names of its entries of Python begin; the last one has the others too.
_OBJECTS = {
    "pressed": ("contact.kernels.normal.", "contact.kernels.pipeline.press_case"),
    "rolled": tuple(f"contact.kernels.{name}." for name in ("pipeline", "solver", "tangential", "damage.assess")),
    "pairs": ("contact.",),
    "others": ("",),
}
#: Large kernels that later objects call where they are.
_OFFERED = (
    *(f"contact.kernels.normal.{name}" for name in ("press.press", "tangent.linearise", "tangent.follow")),
    *(f"contact.kernels.normal.{name}" for name in ("descent.fill_descent", "factors.fill_factors")),
    *(f"contact.kernels.pipeline.{name}" for name in ("press_case", "complete_pressure", "roll_case", "solve_case")),
    *(f"contact.kernels.jacobian.{name}" for name in ("solve_with_jacobian", "derive_solved", "roll_creepages")),
    "contact.kernels.together.roll_together",
    "contact.kernels.given_force.solve_under_force",
    "contact.kernels.damage.assess.damage_kernel",
    "contact.kernels.pair_conditions.derive_pair",
    *(f"contact.kernels.flexible.{name}" for name in ("solve_flexible", "_solve_either_way")),
    *(f"contact.kernels.pair_patches.{name}" for name in ("press_patch", "_roll_patch")),
)
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
        Whether FMUs for hosts with Python have it.
    """

    name: str
    function: Callable[..., Any]
    result: str
    arguments: tuple[str, ...]
    last: Callable[[Any], Any]
    file: str = ""
    python: bool = False


def entries(part: str = "systems") -> Iterator[Any]:
    """Yield all entries of a part that Python calls."""
    from contact.core.calls import Entry

    for path, name in modules():
        if has(part, name) and b"\n@entry\n" in path.read_bytes():
            found = vars(import_module(name)).values()
            yield from (one for one in found if isinstance(one, Entry) and one.__module__ == name)


def flags(folder: Path) -> list[str]:
    """Return the flags of a C compiler for the C interface. `folder` has the declarations of its entries."""
    return [f"-I{folder}", f"-I{get_include()}", f'-DWR_VERSION="{__version__}"']


class Constants(NamedTuple):
    """What every entry of the C interface gets last: pointers to the constant arrays, `c_tables.data`."""

    data: Any


class Kernels:
    """What numba makes of the entries of a part, and of what other packages add to it.

    No kernel can be called in this process afterwards.
    """

    def __init__(self, part: str) -> None:
        from contact.compile import c_tables
        from contact.kernels.entries import all_entries

        self.of_python = list(entries(part))
        self.of_c = {} if part in PARTS else all_entries()
        # Before machine code is switched off, since these call kernels to make their constants.
        self.added: list[Added] = []
        for name in registered()["added"] if part in ("added", "systems") else ():
            self.added += [one for one in import_module(name).added() if one.python or part == "systems"]
        self.data = [np.zeros(0)] * c_tables.NUMBER if part == "halfspace" else c_tables.data()
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


def write_objects(kernels: Kernels, folder: Path) -> None:
    """Write the objects for this machine.

    A process of its own optimises each while numba makes the next one. A system that cannot fork has this one alone.
    """
    from contact.core.compiled import as_c_function

    data, left = emit.data_as_ir(kernels.data), kernels.of_python
    elsewhere: list[Any] = []
    beside: list[BaseProcess] = []
    for name, begins in _OBJECTS.items():
        these = [one for one in left if f"{one.__module__}.{one.__qualname__}".startswith(begins)]
        others = name == "others" and bool(kernels.of_c)
        if not these and not others:
            continue
        made = kernels.emission(these, others, elsewhere)
        for one in left:
            if (
                one not in these and one.dispatcher.overloads
            ):  # costs nothing here, and elsewhere a copy of all it calls
                made.add_entry(one.symbol, as_c_function(one))
        left = [one for one in left if one.symbol not in made.names]
        elsewhere = [*elsewhere, *(function for one in _OFFERED for function in made.offer(_kernel(one)))]
        given, data = (made, kernels.exported, data, folder / f"{name}.o"), ""
        if hasattr(os, "fork"):
            beside.append(get_context("fork").Process(target=_write_object, args=given, daemon=True))
            beside[-1].start()
        else:
            _write_object(*given)
    for process in beside:
        process.join()
        if process.exitcode:
            raise RuntimeError("an object of the library could not be written")


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


def link_for_this_machine(folder: Path, part: str) -> None:
    """Link a part of the library by the system's compiler if there is one, with its C interface if it has it.

    Without a compiler Python alone can use the objects.
    """
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        return
    write_declarations(folder, ("",))
    options = ("-std=c11", "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-fvisibility=hidden", *flags(folder))
    in_c = [path for path in C_INTERFACE if part not in PARTS or path.name == "library.c"]
    command = [compiler, *options, "-o", str(folder / NAME), *map(str, (*in_c, *folder.glob("*.o"))), "-lm"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    sys.stdout.write(done.stderr)  # a compiler without headers or a linker is like none


def main() -> None:
    """Build into the folder that the command line names."""
    emit.show_no_warnings()
    folder, part = Path(sys.argv[1]), "".join(sys.argv[2:])
    kernels = Kernels(part)
    if part != "systems":
        write_objects(kernels, folder)
        link_for_this_machine(folder, part)
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
