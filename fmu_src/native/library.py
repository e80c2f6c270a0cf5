"""Build the library of all kernels that Python calls: ``python -m fmu_src.native.library FOLDER [SYSTEM …]``.

It writes kernels.o for this machine and, where there is a linker, the library beside it. With names of systems (`linking`) it
writes the libraries of wheels. It imports all modules that have entries (`contact.core.entry`), with the settings of numba that
`emit.ENVIRONMENT` lists.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from fmu_src.native.emit import ENVIRONMENT

_PROCESSOR = Path(__file__).parent / "c_library" / "processor.c"
_INTERFACE = Path(__file__).parents[2] / "contact" / "c" / "wheelrail.c"
_INCLUDE = Path(__file__).parents[2] / "contact" / "include"
#: Beginning of the names of the functions that the C interface calls, and of its tables.
PREFIX = "wrk"


def entries() -> Iterator[Any]:
    """Yield all entries of the library."""
    from contact.core import library
    from contact.core.calls import Entry

    root = Path(library.__file__).parents[2]
    for path in library.sources():
        if b"\n@entry\n" not in path.read_bytes():
            continue
        module = import_module(".".join(path.relative_to(root).with_suffix("").parts))
        yield from (
            one for one in vars(module).values() if isinstance(one, Entry) and one.__module__ == module.__name__
        )


def module_of(listed: Iterable[Any], data: Sequence[Any]) -> tuple[Any, list[str]]:
    """Return one LLVM module with a C function for each entry of Python and of the C interface, and their names."""
    from llvmlite import binding as llvm
    from numba import cfunc, types

    from contact.core.compiled import as_c_function
    from contact.kernels.entries import all_entries
    from fmu_src.native.component import Given
    from fmu_src.native.emit import _REFUSED, _Glue, _readable, whole_module
    from fmu_src.native.memory import Doubles

    libraries, names, glue = [], [], _Glue(data, PREFIX)
    for one in listed:
        made = as_c_function(one)
        libraries.append(made._library)
        names.append(one.symbol)
        glue.add_plain(one.symbol, made.native_name.removeprefix("cfunc."))
    kinds = {"i64": types.int64, "f64": types.float64, "ptr": Doubles}
    given = types.NamedTuple((Doubles, types.UniTuple(Doubles, len(data))), Given)
    for name, (function, result, arguments) in all_entries().items():
        taken = tuple(kinds[kind] for kind in arguments)
        made = cfunc(kinds[result](*taken, given), error_model="numpy")(function)
        libraries.append(made._library)
        names.append(f"{PREFIX}_{name}")
        glue.add(names[-1], kinds[result], taken, made.native_name.removeprefix("cfunc."))
    module = whole_module(libraries)
    for function in module.functions:  # numba's runtime: the arrays belong to the caller and have no reference count
        if function.name in ("NRT_incref", "NRT_decref") and not function.is_declaration:
            function.linkage = "weak_any"
    module.link_in(llvm.parse_assembly(glue.text()))
    seen = set(names)
    for i, symbol in enumerate((*module.functions, *module.global_variables)):
        if symbol.name not in seen and not symbol.is_declaration:
            symbol.linkage = "internal"
            if not symbol.name.startswith(_REFUSED):
                symbol.name = f"{_readable(symbol.name)}.{i}"
    return module, names


def write_declarations(folder: Path, ends: Sequence[str]) -> None:
    """Write wheelrail_entries.h: the entries that the C interface calls, one function for each end of a name."""
    from contact.kernels.entries import all_entries

    kinds = {"i64": "int64_t", "f64": "double", "ptr": "void *"}
    lines = ["/* Generated from contact/kernels/entries. */", "#include <stdint.h>"]
    for name, (_, result, arguments) in all_entries().items():
        taken = ", ".join([*(kinds[kind] for kind in arguments), "void *"])
        lines += [f"{kinds[result]} {PREFIX}_{name}{end}({taken});" for end in ends]
    (folder / "wheelrail_entries.h").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_object(module: Any, path: Path) -> None:
    """Optimise a module for this machine and write its object file."""
    from llvmlite import binding as llvm

    from fmu_src.native.emit import refuse_the_rest

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
    refuse_the_rest(module)
    path.write_bytes(machine.emit_object(module))


def link(folder: Path) -> None:
    """Link the library, with its C interface, by the system's compiler if there is one. Else Python alone can use kernels.o."""
    from contact import __version__
    from contact.core.library import NAME

    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        return
    write_declarations(folder, ("",))
    flags = ("-shared", "-fPIC", "-O2", "-ffp-contract=off", "-fvisibility=hidden", f"-I{folder}", f"-I{_INCLUDE}")
    version = f'-DWR_VERSION="{__version__}"'
    parts = (_INTERFACE, folder / "kernels.o")
    command = [compiler, "-std=c11", *flags, version, "-o", str(folder / NAME), *map(str, parts), "-lm"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    sys.stdout.write(done.stderr)  # a compiler without headers or a linker is like none


def build(folder: Path, listed: Iterable[Any], data: Sequence[Any], platforms: Sequence[str]) -> None:
    """Write the library for other systems, each into a folder of its name, and the kernels as C, kernels.c.

    The library has each entry for processors with and without AVX2 (`emit.CPUS`) and says which this one runs. Libraries of
    `linking.FROM_C` are made from the C.
    """
    from contact import __version__
    from fmu_src.native import emit, linking

    module, names = module_of(listed, data)
    plain = emit._plain(module.as_bitcode())
    text = emit.data_as_ir(data, PREFIX)
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        parts = [pool.submit(emit._write_kernels, plain, names, suffix, folder) for suffix in emit.CPUS]
        parts.append(pool.submit(emit._write_sources, plain, names, folder / "kernels.c"))
        for part in (*parts, pool.submit(emit._write_data, text, folder, folder / "data.c")):
            part.result()
    write_declarations(folder, [f"_{suffix}" for suffix in (*emit.CPUS, "any")])
    for platform in platforms:
        in_c = platform in linking.FROM_C
        sources = [_PROCESSOR, _INTERFACE, *((folder / "kernels.c", folder / "data.c") if in_c else ())]
        flags = (
            f"-I{folder}",
            f"-I{_INCLUDE}",
            "-DWR_ANY" if in_c else "-DWR_SEVERAL",
            f'-DWR_VERSION="{__version__}"',
        )
        of_platform = [] if in_c else emit.objects(folder, platform)
        linking.link(platform, linking.library_name(platform), sources, of_platform, folder, exports=flags)


def main() -> None:
    """Build the library into the folder that the command line names, for this machine or for the systems that follow."""
    if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
        own = os.environ | ENVIRONMENT
        os.execve(sys.executable, [sys.executable, "-m", "fmu_src.native.library", *sys.argv[1:]], own)
    import warnings

    from llvmlite import binding as llvm
    from numba.core.errors import NumbaWarning

    from fmu_src.native import c_tables
    from fmu_src.native.emit import data_as_ir, make_no_machine_code

    warnings.simplefilter("ignore", NumbaWarning)
    folder, platforms = Path(sys.argv[1]), sys.argv[2:]
    listed, data = list(entries()), c_tables.data()
    make_no_machine_code()
    if platforms:
        build(folder, listed, data, platforms)
        return
    module, _ = module_of(listed, data)
    module.link_in(llvm.parse_assembly(data_as_ir(data, PREFIX)))
    write_object(module, folder / "kernels.o")
    link(folder)


if __name__ == "__main__":
    main()
