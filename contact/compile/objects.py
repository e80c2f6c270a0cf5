"""Compile the module of all kernels for each system, by LLVM: objects for x86-64, and C11 for all other processors."""

from __future__ import annotations

import os
import struct
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from contact.compile.emit import refuse_the_rest
from contact.compile.ir_to_c import as_c

#: Platform of FMI 2.0 → LLVM triple. Code is optimised for the first; the others differ only in their calling conventions.
TRIPLES = {
    "linux64": "x86_64-unknown-linux-gnu",
    "win64": "x86_64-w64-windows-gnu",
    "darwin64": "x86_64-apple-macosx11.0.0",
}
#: Processors that kernels are compiled for: all since 2009, and those with AVX2 since 2013. The library chooses at run time.
CPUS = {"v2": "x86-64-v2", "v3": "x86-64-v3"}
#: Processor for which the code is optimised that is then written as C, and the end of its entries' names.
PLAIN, IN_C = "x86-64", "any"
#: Platforms for which the library brings its own exp, log and pow, one version for each processor (`libm.py`).
OWN_LIBM = {"win64"}


def objects(folder: Path, platform: str) -> list[Path]:
    """Return the paths of the objects of a platform: the data, then the kernels for each processor."""
    return [folder / f"{platform}-{part}.o" for part in ("data", *CPUS)]


def write(
    code: bytes,
    names: Sequence[str],
    exported: Sequence[str],
    data: str,
    in_c: Mapping[str, Sequence[str]],
    folder: Path,
) -> None:
    """Write the `objects` of every platform, and the same as C, into a folder.

    Parameters
    ----------
    code : bytes
        The module of all kernels as bitcode.
    names : sequence of str
        Its entries that are written; others are left out. In the objects their names end with the processor, for example
        pair_outputs_v2, and in C with `IN_C`.
    exported : sequence of str
        Those of them that can be called from outside the library.
    data : str
        The constant arrays as IR.
    in_c : mapping
        Name of a C file → entries, with which and with all that they call the file is written. data.c has the arrays.
    """
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        of_data = pool.submit(_write_data, data, folder)
        plain = pool.submit(without_vectors, code, names).result()
        parts = [pool.submit(_write_kernels, plain, names, exported, suffix, folder) for suffix in CPUS]
        parts += [pool.submit(_write_c, plain, entries, folder / name) for name, entries in in_c.items()]
        for part in (of_data, *parts):
            part.result()


def without_vectors(code: bytes, names: Sequence[str]) -> bytes:
    """Return these entries optimised for all processors, without vectors, as bitcode."""
    return bytes(optimised(only(_llvm().parse_bitcode(code), names), PLAIN, vectors=False).as_bitcode())


def in_c(plain: bytes, names: Sequence[str]) -> str:
    """Return these entries and what they call as C.

    Raises
    ------
    RuntimeError, ValueError
        If a kernel needs Python, for example to raise an error, or has what cannot be written as C.
    """
    return as_c(str(_named(only(_llvm().parse_bitcode(plain), names), names, IN_C)))


def _write_c(plain: bytes, names: Sequence[str], path: Path) -> None:
    path.write_text(in_c(plain, names), encoding="utf-8")


def _write_data(text: str, folder: Path) -> None:
    llvm = _llvm()
    (folder / "data.c").write_text(as_c(text), encoding="utf-8")
    for platform in TRIPLES:
        _write_object(llvm.parse_assembly(text), platform, "", objects(folder, platform)[0])


def _write_kernels(plain: bytes, names: Sequence[str], exported: Sequence[str], suffix: str, folder: Path) -> None:
    """Write the objects of all platforms for one processor."""
    found = {f"{name}_{suffix}" for name in exported}
    module = _named(optimised(_llvm().parse_bitcode(plain), CPUS[suffix]), names, suffix)
    for platform in TRIPLES:
        path, own = objects(folder, platform)[1 + list(CPUS).index(suffix)], module.clone()
        for function in own.functions:
            if platform == "win64" and function.name in found:
                function.storage_class = "dllexport"
        _write_object(own, platform, CPUS[suffix], path)
        if platform in OWN_LIBM:
            path.write_bytes(_with_own_libm(path.read_bytes(), suffix))


def _llvm() -> Any:
    """Return llvmlite's binding with the code generators of all platforms initialised."""
    from llvmlite import binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return llvm


def only(module: Any, names: Iterable[str]) -> Any:
    """Return the module with these entries and what they call alone."""
    from llvmlite import binding as llvm

    kept = set(names)
    for function in module.functions:
        if not function.is_declaration and function.name not in kept:
            function.linkage = "internal"
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    machine = llvm.Target.from_triple(next(iter(TRIPLES.values()))).create_target_machine()
    passes.run(module, llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options()))
    return module


def optimised(module: Any, cpu: str, *, vectors: bool = True) -> Any:
    """Return the module optimised for a processor."""
    from llvmlite import binding as llvm

    machine = _direct(module, next(iter(TRIPLES)), cpu)
    options = llvm.create_pipeline_tuning_options(speed_level=3 if vectors else 2)
    if not vectors:  # these come for each processor; the compiler of the C code chooses its own
        options.loop_vectorization = options.slp_vectorization = False
        options.loop_interleaving = options.loop_unrolling = False
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return module


def _direct(module: Any, platform: str, cpu: str) -> Any:
    """Set the platform of a module and return the LLVM target machine."""
    from llvmlite import binding as llvm

    target = llvm.Target.from_triple(TRIPLES[platform])
    machine = target.create_target_machine(cpu=cpu, opt=3, reloc="pic", codemodel="default")
    module.triple, module.data_layout = TRIPLES[platform], str(machine.target_data)
    return machine


def _write_object(module: Any, platform: str, cpu: str, path: Path) -> None:
    path.write_bytes(_direct(module, platform, cpu).emit_object(module))


def _named(module: Any, names: Iterable[str], suffix: str) -> Any:
    """Return the module with `suffix` at the names of its entries, after a look at all that it needs."""
    entries = set(names)
    for function in module.functions:
        if function.name in entries:
            function.name = f"{function.name}_{suffix}"
    refuse_the_rest(module)
    return module


def _with_own_libm(code: bytes, suffix: str) -> bytes:
    """Return a COFF object that calls exp_v3 … instead of exp, log and pow.

    The object is changed and not the IR, because LLVM splits calls on vectors only when it writes the object. The symbol table
    has 18 bytes for each symbol: a short name in bytes 1 to 8, the section in bytes 13 and 14 (zero for an external symbol).
    """
    changed = bytearray(code)
    table, count = struct.unpack_from("<II", code, 8)
    for at in range(table, table + 18 * count, 18):
        name = changed[at : at + 8].rstrip(b"\0")
        if name in (b"exp", b"log", b"pow") and changed[at + 12 : at + 14] == b"\0\0":
            changed[at : at + 8] = (name + f"_{suffix}".encode()).ljust(8, b"\0")
    return bytes(changed)
