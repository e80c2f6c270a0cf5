"""From kernels to object files: numba's IR, freed of everything that is Python, compiled for each platform.

Run as a program, ``python -m fmu_src.native.emit NAME OPTIONS FOLDER …``, since numba must be told before it is imported
not to optimise and not to know this machine: loops that arrive unrolled vectorise badly later, and code for this very CPU
would not run on another. Several models in one process share what numba compiles of the kernels; LLVM optimises each in
processes beside it.

numba's conventions used here (the prefix `cfunc.`, the arguments of a function's body, the names of its runtime, how it
makes machine code) are not documented; pyproject.toml pins numba's version for the build, and tests compare results.
"""

from __future__ import annotations

import json
import os
import re
import struct
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fmu_src.native.component import Component

#: Environment of the process that emits, before numba is imported.
ENVIRONMENT = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_OPT": "0",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
    "NUMBA_DISABLE_INTEL_SVML": "1",
}

#: Platform of FMI 2.0 → triple of LLVM. Code is optimised for the first: the others call functions in another way, no more.
TRIPLES = {
    "linux64": "x86_64-unknown-linux-gnu",
    "win64": "x86_64-w64-windows-gnu",
    "darwin64": "x86_64-apple-macosx11.0.0",
}
#: Processors that there are kernels for: every one since 2009, and those with AVX2 since 2013; the wrapper chooses.
CPUS = {"v2": "x86-64-v2", "v3": "x86-64-v3"}

#: What the objects may need from outside: libm and memory functions. Nothing of Python or numba, so nothing allocates, no
#: reference is counted and no exception raised (its pickled message would remain).
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

#: Beginnings of the names of data that only exceptions and objects of Python need.
_REFUSED = (".const.pickle", "numba.dynamic")

#: Platforms whose exp, log and pow come with the FMU, once for every processor: `libm.py`.
OWN_LIBM = {"win64"}


def objects(folder: Path, platform: str) -> list[Path]:
    """Paths of what `emit` writes for a platform: the data, and the kernels for each processor."""
    return [folder / f"{platform}-{part}.o" for part in ("data", *CPUS)]


def emit(components: Mapping[Path, Component]) -> None:
    """Write the `objects` of each component for every platform into its folder.

    The kernels' names end with that of the processor, model_outputs_v2. What is written of a component does not depend on
    which others are emitted with it. No kernel can be called in this process afterwards.

    Raises
    ------
    RuntimeError
        If the kernels need something that is not ALLOWED.
    """
    # Before machine code is done without: components may call kernels to make their data.
    made = {folder: (own.entries(), own.data(), bool(own.resources)) for folder, own in components.items()}
    _make_no_machine_code()
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        parts = []
        for folder, (entries, data, with_resources) in made.items():
            text = str(_linked(entries, data, with_resources))
            parts += [pool.submit(_write_kernels, text, tuple(entries), suffix, folder) for suffix in CPUS]
            parts.append(pool.submit(_write_data, _constants(data), folder))
        for part in parts:
            part.result()


def _make_no_machine_code() -> None:
    """Let numba make IR alone: neither code for this process nor wrappers for calls from Python, half of its work."""
    from numba.core import caching, codegen, cpu, registry

    def no_pointer(library: Any, name: str) -> int:
        library._ensure_finalized()  # links what it calls
        return 0

    registry.cpu_target.target_context.refresh()
    codegen.JITCodeLibrary._finalize_specific = lambda library: None
    codegen.JITCodeLibrary.get_pointer_to_function = no_pointer
    codegen.JITCPUCodegen._add_module = lambda self, module: None
    codegen.JITCPUCodegen.set_env = lambda self, name, environment: None
    cpu.CPUContext.create_cpython_wrapper = lambda self, *arguments, **options: None
    # Kernels kept on disk are machine code.
    caching.Cache.load_overload = lambda self, signature, context: None
    caching.Cache.save_overload = lambda self, signature, compiled: None


def _write_data(text: str, folder: Path) -> None:
    """Write the objects of a component's data, given as IR."""
    llvm = _llvm_for_all()
    for platform in TRIPLES:
        _write(llvm.parse_assembly(text), platform, "", objects(folder, platform)[0])


def _write_kernels(text: str, entries: Sequence[str], suffix: str, folder: Path) -> None:
    """Write the objects of a component's kernels, given as IR, for one processor."""
    _llvm_for_all()
    optimised = _optimised(text, entries, suffix, CPUS[suffix])
    for platform in TRIPLES:
        path = objects(folder, platform)[1 + list(CPUS).index(suffix)]
        _write(optimised.clone(), platform, CPUS[suffix], path)
        if platform in OWN_LIBM:
            path.write_bytes(_with_own_libm(path.read_bytes(), suffix))


def _llvm_for_all() -> Any:
    """LLVM, ready for all platforms."""
    from llvmlite import binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return llvm


def _direct(module: Any, platform: str, cpu: str) -> Any:
    """Direct a module to a platform; return the machine for it."""
    from llvmlite import binding as llvm

    target = llvm.Target.from_triple(TRIPLES[platform])
    machine = target.create_target_machine(cpu=cpu, opt=3, reloc="pic", codemodel="default")
    module.triple, module.data_layout = TRIPLES[platform], str(machine.target_data)
    return machine


def _write(module: Any, platform: str, cpu: str, path: Path) -> None:
    path.write_bytes(_direct(module, platform, cpu).emit_object(module))


def _constants(data: Sequence[Any]) -> str:
    """IR of the arrays as constants that all kernels share."""
    lines = []
    for i, array in enumerate(data):
        content = "".join(f"\\{byte:02X}" for byte in array.tobytes())
        lines.append(f'@model_data{i} = hidden constant [{array.nbytes} x i8] c"{content}", align 64')
    return "\n".join(lines)


def _linked(entries: Mapping[str, Callable[..., Any]], data: Sequence[Any], with_resources: bool) -> Any:
    """One module of all entries, in which these alone are visible."""
    from llvmlite import binding as llvm
    from numba import cfunc

    from fmu_src.native.component import SIGNATURES
    from fmu_src.native.memory import Doubles

    parts, glue = [], _Glue(data, with_resources)
    for name, (result, arguments) in SIGNATURES.items():
        pointers = len(data) + with_resources
        signature = result(*arguments, *(Doubles for _ in range(pointers)))
        compiled = cfunc(signature, error_model="numpy")(entries[name])
        text = re.sub(r"^target .*$", "", _without_origin(compiled.inspect_llvm()), flags=re.MULTILINE)
        glue.add(name, result, arguments, compiled.native_name.removeprefix("cfunc."))
        parts.append(llvm.parse_assembly(text))
    module, *others = parts
    for part in others:
        module.link_in(part)
    for function in module.functions:  # numba's runtime: see `_Glue.text`
        if function.name in ("NRT_incref", "NRT_decref") and not function.is_declaration:
            function.linkage = "weak_any"
    module.link_in(llvm.parse_assembly(glue.text()))
    for i, symbol in enumerate((*module.functions, *module.global_variables)):
        if symbol.name in entries:
            symbol.visibility = "hidden"
        elif not symbol.is_declaration:
            symbol.linkage = "internal"
            if not symbol.name.startswith(_REFUSED):
                symbol.name = f"{_readable(symbol.name)}.{i}"
    return module


def _readable(name: str) -> str:
    """The dotted name of a function of numba's, without the numbers that depend on what the process compiled before."""
    parts, rest = [], name.removeprefix("_ZN") if name.startswith("_ZN") else ""
    while found := re.match(r"\d+", rest):
        end = found.end() + int(found[0])
        parts.append(rest[found.end() : end])
        rest = rest[end:]
    return ".".join(parts) or "data"


class _Glue:
    """IR of functions with C's conventions around numba's, and of the constant data that these are given."""

    def __init__(self, data: Sequence[Any], with_resources: bool) -> None:
        self.data, self.with_resources = data, with_resources
        # Arrays of kernels belong to the caller and have no reference count; that numba's runtime is needed for nothing
        # else is what the list of allowed symbols proves.
        self.lines = ["define void @NRT_incref(ptr %0) { ret void }", "define void @NRT_decref(ptr %0) { ret void }"]
        for i, array in enumerate(data):
            self.lines.append(f"@model_data{i} = external hidden constant [{array.nbytes} x i8], align 64")

    def add(self, name: str, result: Any, arguments: Sequence[Any], body: str) -> None:
        """A function `name` that calls numba's `body`, i32 body(result*, exception**, arguments…), which never fails."""
        arguments_of_c = [*(f"{_TYPES[str(a)]} %a{i}" for i, a in enumerate(arguments)), "ptr %resources"]
        names = arguments_of_c if self.with_resources else arguments_of_c[:-1]
        constants = [f"ptr @model_data{i}" for i in range(len(self.data))]
        kind = _TYPES[str(result)]
        types = ", ".join(["ptr", "ptr", *(n.split()[0] for n in names), *("ptr" for _ in constants)])
        self.lines += [
            f'declare i32 @"{body}"({types})',
            f"define {kind} @{name}({', '.join(arguments_of_c)}) {{",
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
    """Blank the pickled messages of exceptions, which name source files of this machine; nothing reads them."""
    return re.sub(
        r'^(@"?\.const\.pickledata\S* = .*constant \[\d+ x i8\]) c".*?"',
        r"\1 zeroinitializer",
        text,
        flags=re.MULTILINE,
    )


def _optimised(text: str, entries: Iterable[str], suffix: str, cpu: str) -> Any:
    """The module for a processor, whose name is added to those of the entries."""
    from llvmlite import binding as llvm

    module = llvm.parse_assembly(text)
    for name in entries:
        module.get_function(name).name = f"{name}_{suffix}"
    machine = _direct(module, next(iter(TRIPLES)), cpu)
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(module, builder)
    _refuse_the_rest(module)
    return module


def _with_own_libm(code: bytes, suffix: str) -> bytes:
    """A COFF object that asks for exp_v3 … instead of exp, log and pow.

    In the object, as LLVM takes calls of vectors apart only when it writes it. Its table has 18 bytes a symbol, of which 8
    are a short name and 2, from the 13th on, the section, zero for what is elsewhere.
    """
    changed = bytearray(code)
    table, count = struct.unpack_from("<II", code, 8)
    for at in range(table, table + 18 * count, 18):
        name = changed[at : at + 8].rstrip(b"\0")
        if name in (b"exp", b"log", b"pow") and changed[at + 12 : at + 14] == b"\0\0":
            changed[at : at + 8] = (name + f"_{suffix}".encode()).ljust(8, b"\0")
    return bytes(changed)


def _refuse_the_rest(module: Any) -> None:
    needed = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    needed |= {g.name for g in module.global_variables if g.is_declaration and not g.name.startswith("model_data")}
    needed |= {g.name for g in module.global_variables if g.name.startswith(_REFUSED)}
    if needed - ALLOWED:
        raise RuntimeError(f"the kernels need more than the FMU may have: {', '.join(sorted(needed - ALLOWED))}")


def main() -> None:
    """Emit the objects of models of the catalogue."""
    if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
        os.execve(
            sys.executable, [sys.executable, "-m", "fmu_src.native.emit", *sys.argv[1:]], os.environ | ENVIRONMENT
        )
    import warnings

    from numba.core.errors import NumbaWarning

    warnings.simplefilter("ignore", NumbaWarning)  # unoptimised code cannot be cached
    from fmu_src.catalogue import Model

    components = {}
    for name, options, folder in zip(*(iter(sys.argv[1:]),) * 3, strict=True):
        model = Model(name, json.loads(options))
        components[Path(folder)] = model.module("native").component(**model.options)
    emit(components)


if __name__ == "__main__":
    main()
