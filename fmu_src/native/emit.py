"""Compile kernels to object files: numba's IR without anything of Python, compiled for each platform.

This module runs as a program, ``python -m fmu_src.native.emit NAME OPTIONS FOLDER …``. Before its import, numba must be told
not to optimise and not to target this machine. Loops that numba has unrolled vectorise badly later, and code for this CPU
would not run on others. Several models in one process share the kernels that numba compiles. LLVM then optimises each model in
a process of its own.

The numba conventions used here are not documented: the prefix `cfunc.`, the arguments of a function's body, the names of its
runtime, and how it makes machine code. Therefore pyproject.toml pins the numba version of the build, and tests compare results.
"""

from __future__ import annotations

import os
import re
import struct
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_src.native.ir_to_c import as_c
from fmu_src.native.memory import PREFIX

if TYPE_CHECKING:
    from fmu_src.native.kinds import Kernels

#: Environment variables that must be set before numba is imported.
ENVIRONMENT = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_OPT": "0",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
    "NUMBA_DISABLE_INTEL_SVML": "1",
}

#: Platform of FMI 2.0 → LLVM triple. Code is optimised for the first; the others differ only in their calling conventions.
TRIPLES = {
    "linux64": "x86_64-unknown-linux-gnu",
    "win64": "x86_64-w64-windows-gnu",
    "darwin64": "x86_64-apple-macosx11.0.0",
}
#: Processors that kernels are compiled for: all since 2009, and those with AVX2 since 2013. The wrapper chooses at run time.
CPUS = {"v2": "x86-64-v2", "v3": "x86-64-v3"}
#: Processor for which the code is optimised that is then written as C.
PLAIN = "x86-64"

#: External symbols that the objects may need: libm and memory functions. Symbols of Python or numba are not allowed. This
#: proves that nothing allocates, counts references or raises an exception (its pickled message would remain).
_LIBM = {
    "acos",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "cos",
    "exp",
    "expm1",
    "log",
    "pow",
    "sin",
    "sqrt",
    "tan",
    "fabs",
}
ALLOWED = _LIBM | {"memset", "memcpy", "memmove"}

#: Prefixes of the names of data that only Python exceptions and objects need.
_REFUSED = (".const.pickle", "numba.dynamic")

#: Kind whose entries the kernels of other kinds call.
CALLED = "pair"

#: Platforms for which the FMU brings its own exp, log and pow, one version for each processor (`libm.py`).
OWN_LIBM = {"win64"}


def objects(folder: Path, platform: str) -> list[Path]:
    """Return the paths of the objects of a platform: the data, then the kernels for each processor."""
    return [folder / f"{platform}-{part}.o" for part in ("data", *CPUS)]


def sources(folder: Path, prefix: str = PREFIX) -> list[Path]:
    """Return the paths of the same as C sources: the data, then the kernels. `prefix` is that of the component."""
    return [folder / (part if prefix == PREFIX else f"{prefix}_{part}") for part in ("data.c", "kernels.c")]


def emit(components: Mapping[Path, Kernels]) -> None:
    """Write the `objects` of each component for every platform, and its `sources` in C, into its folder.

    The names of the kernels end with the processor, for example model_outputs_v2, and in C with `any`. The objects of a
    component do not depend on which others are emitted in the same call. No kernel can be called in this process afterwards.
    Names begin with `Kernels.kind` instead of `model`.

    Raises
    ------
    RuntimeError
        If the kernels need a symbol that is not in ALLOWED.
    """
    from fmu_src.native.kinds import SIGNATURES

    # This comes before machine code is switched off, since components may call kernels to make their data.
    made = {folder: (own.entries(), own.data(), own.kind) for folder, own in components.items()}
    make_no_machine_code()
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool, ThreadPoolExecutor(len(made)) as chains:

        def finish(code: bytes, names: tuple[str, ...], data: str, folder: Path, in_c: list[Path]) -> None:
            of_data = pool.submit(_write_data, data, folder, in_c[0])
            plain = pool.submit(_plain, code).result()
            parts = [pool.submit(_write_kernels, plain, names, suffix, folder) for suffix in CPUS]
            for part in (of_data, *parts, pool.submit(_write_sources, plain, names, in_c[1])):
                part.result()

        finished = []
        for folder, (entries, data, prefix) in made.items():
            code = linked(entries, data, prefix).as_bitcode()
            names = tuple(_symbol(entry, prefix) for entry in SIGNATURES)
            text, in_c = data_as_ir(data, prefix), sources(folder, prefix)
            finished.append(chains.submit(finish, code, names, text, folder, in_c))
        for chain in finished:
            chain.result()


def make_no_machine_code() -> None:
    """Make numba stop at the IR: no machine code and no wrappers for calls from Python. This saves half of its work."""
    from numba.core import caching, codegen, cpu, registry

    def no_pointer(library: Any, name: str) -> int:
        library._ensure_finalized()  # links the functions that it calls
        return 0

    registry.cpu_target.target_context.refresh()
    codegen.JITCodeLibrary._finalize_specific = lambda library: None
    codegen.JITCodeLibrary.get_pointer_to_function = no_pointer
    codegen.JITCPUCodegen._add_module = lambda self, module: None
    codegen.JITCPUCodegen.set_env = lambda self, name, environment: None
    cpu.CPUContext.create_cpython_wrapper = lambda self, *arguments, **options: None
    # The kernels in the cache on disk are machine code.
    caching.Cache.load_overload = lambda self, signature, context: None
    caching.Cache.save_overload = lambda self, signature, compiled: None


def _symbol(entry: str, prefix: str) -> str:
    """Return the name of an entry, model_outputs …, in the objects of a component with this prefix."""
    return prefix + entry.removeprefix(PREFIX)


def _plain(code: bytes) -> bytes:
    """Return the kernels of a component optimised for all processors, without vectors, as bitcode. `code` is their bitcode."""
    _llvm_for_all()
    return _optimised(code, PLAIN, vectors=False).as_bitcode()


def _write_sources(plain: bytes, entries: Sequence[str], path: Path) -> None:
    """Write the kernels of a component as C."""
    path.write_text(as_c(str(_named(_llvm_for_all().parse_bitcode(plain), entries, "any"))))


def _write_data(text: str, folder: Path, in_c: Path) -> None:
    """Write the objects of a component's data for all platforms, and the data as C. `text` is their IR."""
    llvm = _llvm_for_all()
    in_c.write_text(as_c(text))
    for platform in TRIPLES:
        _write(llvm.parse_assembly(text), platform, "", objects(folder, platform)[0])


def _write_kernels(plain: bytes, entries: Sequence[str], suffix: str, folder: Path) -> None:
    """Write the objects of a component's kernels for one processor and all platforms."""
    _llvm_for_all()
    optimised = _named(_optimised(plain, CPUS[suffix]), entries, suffix)
    for platform in TRIPLES:
        path = objects(folder, platform)[1 + list(CPUS).index(suffix)]
        _write(optimised.clone(), platform, CPUS[suffix], path)
        if platform in OWN_LIBM:
            path.write_bytes(_with_own_libm(path.read_bytes(), suffix))


def _llvm_for_all() -> Any:
    """Return llvmlite's binding with the code generators of all platforms initialised."""
    from llvmlite import binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return llvm


def _direct(module: Any, platform: str, cpu: str) -> Any:
    """Set the platform of a module and return the LLVM target machine."""
    from llvmlite import binding as llvm

    target = llvm.Target.from_triple(TRIPLES[platform])
    machine = target.create_target_machine(cpu=cpu, opt=3, reloc="pic", codemodel="default")
    module.triple, module.data_layout = TRIPLES[platform], str(machine.target_data)
    return machine


def _write(module: Any, platform: str, cpu: str, path: Path) -> None:
    path.write_bytes(_direct(module, platform, cpu).emit_object(module))


def data_as_ir(data: Sequence[Any], prefix: str = PREFIX) -> str:
    """Return the IR of the arrays as constants that all kernels share."""
    lines = []
    for i, array in enumerate(data):
        content = "".join(f"\\{byte:02X}" for byte in array.tobytes())
        lines.append(f'@{prefix}_data{i} = hidden constant [{array.nbytes} x i8] c"{content}", align 64')
    return "\n".join(lines)


def _nothing(values: Any, work: Any, given: Any) -> int:
    return 0


def _no_field(values: Any, work: Any, k: Any, given: Any) -> int:
    return 0


#: What stands for entries that a component does not need.
_UNNEEDED: dict[str, Callable[..., Any]] = {"model_start": _nothing, "model_lazy": _nothing, "model_field": _no_field}


def linked(entries: Mapping[str, Callable[..., Any]], data: Sequence[Any], prefix: str = PREFIX) -> Any:
    """Return one module of all entries, in which only these are visible from outside."""
    from llvmlite import binding as llvm
    from numba import cfunc, types

    from fmu_src.native.component import Given
    from fmu_src.native.kinds import SIGNATURES
    from fmu_src.native.memory import Doubles

    parts, glue, entries = [], _Glue(data, prefix), {**_UNNEEDED, **entries}
    visible = {_symbol(entry, prefix) for entry in SIGNATURES}
    given = types.NamedTuple((Doubles, Doubles, types.UniTuple(Doubles, len(data))), Given)
    for name, (result, arguments) in SIGNATURES.items():
        compiled = cfunc(result(*arguments, given), error_model="numpy")(entries[name])
        text = re.sub(r"^target .*$", "", _without_origin(compiled.inspect_llvm()), flags=re.MULTILINE)
        glue.add(_symbol(name, prefix), result, arguments, compiled.native_name.removeprefix("cfunc."))
        parts.append(llvm.parse_assembly(text))
    module, *others = parts
    for part in others:
        module.link_in(part)
    for function in module.functions:  # numba's runtime: see `_Glue.text`
        if function.name in ("NRT_incref", "NRT_decref") and not function.is_declaration:
            function.linkage = "weak_any"
    module.link_in(llvm.parse_assembly(glue.text()))
    for i, symbol in enumerate((*module.functions, *module.global_variables)):
        if symbol.name in visible:
            symbol.visibility = "hidden"
        elif not symbol.is_declaration:
            symbol.linkage = "internal"
            if not symbol.name.startswith(_REFUSED):
                symbol.name = f"{_readable(symbol.name)}.{i}"
    return module


def _readable(name: str) -> str:
    """Return the dotted name of a numba function without the numbers that depend on what the process compiled before."""
    parts, rest = [], name.removeprefix("_ZN") if name.startswith("_ZN") else ""
    while found := re.match(r"\d+", rest):
        end = found.end() + int(found[0])
        parts.append(rest[found.end() : end])
        rest = rest[end:]
    return ".".join(parts) or "data"


class _Glue:
    """IR of functions with C calling conventions that call numba's functions and pass them the constant data."""

    def __init__(self, data: Sequence[Any], prefix: str) -> None:
        self.data, self.prefix = data, prefix
        # The kernels' arrays belong to the caller and have no reference count, so these two functions do nothing. ALLOWED
        # proves that nothing else of numba's runtime is needed.
        self.lines = ["define void @NRT_incref(ptr %0) { ret void }", "define void @NRT_decref(ptr %0) { ret void }"]
        for i, array in enumerate(data):
            self.lines.append(f"@{prefix}_data{i} = external hidden constant [{array.nbytes} x i8], align 64")

    def add(self, name: str, result: Any, arguments: Sequence[Any], body: str) -> None:
        """Add a function `name` that calls numba's `body`, i32 body(result*, exception**, arguments…), which never fails."""
        names = [*(f"{_TYPES[str(a)]} %a{i}" for i, a in enumerate(arguments)), "ptr %resources", "ptr %own"]
        constants = [f"ptr @{self.prefix}_data{i}" for i in range(len(self.data))]
        kind = _TYPES[str(result)]
        types = ", ".join(["ptr", "ptr", *(n.split()[0] for n in names), *("ptr" for _ in constants)])
        self.lines += [
            f'declare i32 @"{body}"({types})',
            f"define {kind} @{name}({', '.join(names)}) {{",
            f"  %result = alloca {kind}",
            "  %exception = alloca ptr",
            f"  store {kind} zeroinitializer, ptr %result",
            f'  call i32 @"{body}"({", ".join(["ptr %result", "ptr %exception", *names, *constants])})',
            f"  %value = load {kind}, ptr %result",
            f"  ret {kind} %value",
            "}",
        ]

    def text(self) -> str:
        return "\n".join(self.lines)


_TYPES = {"int64": "i64", "float64": "double", "float64*": "ptr"}


def _without_origin(text: str) -> str:
    """Return the IR with blank exception messages. Nothing reads them, and they name source files of this machine."""
    return re.sub(
        r'^(@"?\.const\.pickledata\S* = .*constant \[\d+ x i8\]) c".*?"',
        r"\1 zeroinitializer",
        text,
        flags=re.MULTILINE,
    )


def _optimised(code: bytes, cpu: str, *, vectors: bool = True) -> Any:
    """Return the module with this bitcode optimised for a processor."""
    from llvmlite import binding as llvm

    module = llvm.parse_bitcode(code)
    machine = _direct(module, next(iter(TRIPLES)), cpu)
    options = llvm.create_pipeline_tuning_options(speed_level=3 if vectors else 2)
    if not vectors:  # these come for each processor; the compiler of the C code chooses its own
        options.loop_vectorization = options.slp_vectorization = False
        options.loop_interleaving = options.loop_unrolling = False
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return module


def _named(module: Any, entries: Iterable[str], suffix: str) -> Any:
    """Return the module with `suffix` at the names of its entries, and of another component's entries that it calls.

    Raises
    ------
    RuntimeError
        If it needs a symbol that is not in ALLOWED.
    """
    from fmu_src.native.kinds import SIGNATURES

    called = {_symbol(entry, CALLED) for entry in SIGNATURES}
    for function in module.functions:
        if function.name in entries or (function.is_declaration and function.name in called):
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


def refuse_the_rest(module: Any) -> None:
    needed = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    needed |= {g.name for g in module.global_variables if g.is_declaration and not re.search(r"_data\d+$", g.name)}
    needed |= {g.name for g in module.global_variables if g.name.startswith(_REFUSED)}
    needed = {name for name in needed if not re.fullmatch(rf"{CALLED}_\w+_(?:{'|'.join(CPUS)}|any)", name)}
    if needed - ALLOWED:
        raise RuntimeError(f"the kernels need symbols that the FMU may not have: {', '.join(sorted(needed - ALLOWED))}")


def main() -> None:
    """Emit the objects of the models that the command line names."""
    if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
        os.execve(
            sys.executable, [sys.executable, "-m", "fmu_src.native.emit", *sys.argv[1:]], os.environ | ENVIRONMENT
        )
    import warnings

    from numba.core.errors import NumbaWarning

    warnings.simplefilter("ignore", NumbaWarning)  # unoptimised code cannot be cached
    from fmu_src.native.kinds import kernels_of

    components = {}
    for name, folder in zip(*(iter(sys.argv[1:]),) * 2, strict=True):
        components[Path(folder)] = kernels_of(name)
    emit(components)


if __name__ == "__main__":
    main()
