"""Make LLVM's IR of kernels by numba, without anything of Python in it.

Before numba is imported, it must be told not to optimise and not to target this machine (`contact.core.checkout.ENVIRONMENT`).
Loops that numba has unrolled vectorise badly later, and code for this CPU would not run on others.

The numba conventions used here are not documented: the prefix `cfunc.`, the arguments of a function's body, the names of its
runtime, and how it makes machine code. Therefore pyproject.toml pins the numba version of the build, and tests compare results.
"""

from __future__ import annotations

import gc
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

#: External symbols that the objects may need: libm and memory functions. Symbols of Python or numba are not allowed. This
#: proves that nothing allocates, counts references or raises an exception (its pickled message would remain).
_LIBM = {
    *("acos", "asin", "asinh", "atan", "atan2", "atanh", "cos", "exp"),
    *("expm1", "fabs", "log", "pow", "sin", "sqrt", "tan"),
}
ALLOWED = _LIBM | {"memset", "memcpy", "memmove", "sched_yield"}

#: Prefixes of the names of data that only Python exceptions and objects need.
_REFUSED = (".const.pickle", "numba.dynamic")

#: Beginning of the names of the constant arrays.
DATA = "wr_data"
#: Type of an argument or of a result, as tables of entries name it → that of LLVM.
_TYPES = {"i64": "i64", "f64": "double", "ptr": "ptr"}


def show_no_warnings() -> None:
    """Show no warning of numba."""
    import warnings

    from numba.core.errors import NumbaWarning

    warnings.simplefilter("ignore", NumbaWarning)  # unoptimised code cannot be cached


def make_no_machine_code() -> None:
    """Make numba stop at the IR of each function: nothing is linked, optimised or wrapped for calls from Python.

    `modules_of` then links the functions, each once, and LLVM optimises them as a whole.
    """
    from numba.core import codegen, cpu, postproc, registry, rewrites, transforms
    from numba.core.runtime.context import NRTContext
    from numba.core.types import functions

    def finish(library: Any) -> None:
        library._finalize_dynamic_globals()
        library._finalized = True

    search: Callable[..., Any] = functions.BaseFunction.get_call_type
    answers: dict[tuple[Any, ...], tuple[Any, Any]] = {}

    def get_call_type(self: Any, context: Any, args: tuple[Any, ...], kws: Any) -> Any:
        """Search the overloads of an operation once for each set of types: a quarter of the time goes into this search."""
        if kws:
            return search(self, context, args, kws)
        key = (self.typing_key, args)
        if key not in answers:
            signature = search(self, context, args, kws)
            answers[key] = signature, self._impl_keys[signature.args]
        signature, implementation = answers[key]
        self._impl_keys[signature.args] = implementation
        return signature

    def find_no_lives(self: Any, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
        made = self.func_ir
        made.blocks = transforms.canonicalize_cfg(made.blocks)
        made.variable_lifetime, made.generator_info = postproc.VariableLifetime(made.blocks), None

    registry.cpu_target.target_context.refresh()
    gc.disable()
    share_overloads()
    # Numba looks nine times for what lives how long, to count references, and for array expressions, which kernels have not:
    # a quarter of its time.
    rewrites.rewrite_registry.rewrites["after-inference"].clear()
    postproc.PostProcessor.run = find_no_lives
    functions.BaseFunction.get_call_type = get_call_type  # type: ignore[method-assign]
    codegen.JITCodeLibrary.add_llvm_module = lambda library, module: library._final_module.link_in(module)
    codegen.JITCodeLibrary.finalize = finish
    codegen.JITCodeLibrary.get_pointer_to_function = lambda library, name: 0
    codegen.JITCPUCodegen._add_module = lambda self, module: None
    codegen.JITCPUCodegen.set_env = lambda self, name, environment: None
    cpu.CPUContext.create_cpython_wrapper = lambda self, *arguments, **options: None
    cpu.CPUContext.create_cfunc_wrapper = lambda self, *arguments, **options: None
    # The kernels' arrays belong to the caller and have no reference count. ALLOWED proves that nothing else of numba's runtime
    # is needed.
    NRTContext.incref = NRTContext.decref = lambda self, builder, kind, value: None


def share_overloads() -> None:
    """Let calls with a constant, or with a member of an enumeration, share what is compiled for any integer.

    Numba compiles a function again for each constant in its calls: 13 % of all functions here. LLVM, which sees the whole
    library, finds the constants by itself.
    """
    from numba import types
    from numba.core import dispatcher

    find: Callable[..., Any] = dispatcher._DispatcherBase.get_call_template

    def plain(kind: Any) -> Any:
        if isinstance(kind, types.BaseTuple) and not isinstance(kind, types.BaseNamedTuple):
            return types.BaseTuple.from_types([plain(of) for of in kind])
        return kind.dtype if isinstance(kind, types.IntEnumMember) else types.unliteral(kind)

    def get_call_template(self: Any, args: tuple[Any, ...], kws: Any) -> Any:
        return find(self, tuple(map(plain, args)), {name: plain(kind) for name, kind in dict(kws).items()})

    dispatcher._DispatcherBase.get_call_template = get_call_template  # type: ignore[method-assign, assignment]


def modules_of(libraries: Iterable[Any], without: Iterable[Any] = ()) -> Iterator[Any]:
    """Yield the LLVM modules of numba's libraries and of all that they link, directly or not, each once.

    Libraries of functions that are elsewhere are left out, with what only these link.
    """
    pending, seen = list(libraries), set(map(id, without))
    while pending:
        library = pending.pop()
        if id(library) not in seen:
            seen.add(id(library))
            pending += library._linking_libraries
            yield library._final_module


def data_as_ir(data: Sequence[Any]) -> str:
    """Return the IR of the arrays as constants that all kernels share."""
    lines = []
    for i, array in enumerate(data):
        content = "".join(f"\\{byte:02X}" for byte in array.tobytes())
        lines.append(f'@{DATA}{i} = hidden constant [{array.nbytes} x i8] c"{content}", align 64')
    return "\n".join(lines)


class Emission:
    """Entries that numba compiles, which become one LLVM module. All read the same constant arrays `data`.

    The functions `elsewhere` are in a module of the same process that is linked with this one.
    """

    def __init__(self, data: Sequence[Any], elsewhere: Sequence[Any] = ()) -> None:
        self.data, self.elsewhere = data, elsewhere
        self.names: list[str] = []
        self._libraries: list[Any] = []
        self._offered: list[Any] = []
        self._glue = [
            f"@{DATA}{i} = external hidden constant [{array.nbytes} x i8], align 64" for i, array in enumerate(data)
        ]

    def add(self, name: str, made: Any, result: str, arguments: Sequence[str]) -> None:
        """Add a C function `name` that calls what `cfunc` has `made`, with the constant arrays as further arguments.

        Numba's function is i32 body(result*, exception**, arguments…). It never fails.
        """
        given = [f"{_TYPES[kind]} %a{i}" for i, kind in enumerate(arguments)]
        constants = [f"ptr @{DATA}{i}" for i in range(len(self.data))]
        types = ", ".join(["ptr", "ptr", *(_TYPES[kind] for kind in arguments), *("ptr" for _ in constants)])
        kind, body = _TYPES[result], self._body(name, made)
        self._glue += [
            f'declare i32 @"{body}"({types})',
            f"define {kind} @{name}({', '.join(given)}) {{",
            f"  %result = alloca {kind}",
            "  %exception = alloca ptr",
            f"  store {kind} zeroinitializer, ptr %result",
            f'  call i32 @"{body}"({", ".join(["ptr %result", "ptr %exception", *given, *constants])})',
            f"  %value = load {kind}, ptr %result",
            f"  ret {kind} %value",
            "}",
        ]

    def add_entry(self, name: str, made: Any) -> None:
        """Add a C function `name` that passes two addresses to what `cfunc` has `made` (`contact.core.compiled`)."""
        body = self._body(name, made)
        self._glue += [
            f'declare i32 @"{body}"(ptr, ptr, i64, i64)',
            f"define void @{name}(ptr %a, ptr %r) {{",
            "  %result = alloca ptr",
            "  %exception = alloca ptr",
            "  %1 = ptrtoint ptr %a to i64",
            "  %2 = ptrtoint ptr %r to i64",
            f'  call i32 @"{body}"(ptr %result, ptr %exception, i64 %1, i64 %2)',
            "  ret void",
            "}",
        ]

    def _body(self, name: str, made: Any) -> str:
        self.names.append(name)
        self._libraries.append(made._library)
        return str(made.native_name).removeprefix("cfunc.")

    def offer(self, kernel: Any) -> list[Any]:
        """Let other modules call a kernel in this one. Return the functions that numba has made of it so far."""
        functions = list(kernel.overloads.values())
        self._offered += functions
        return functions

    def module(self, exported: Iterable[str] = ()) -> Any:
        """Return the module; it can be made once. Only entries and what is offered can be seen from outside.

        Of these only those that are `exported` can be seen from outside the library.
        """
        from llvmlite import binding as llvm

        module = _whole(self._libraries, (function.library for function in self.elsewhere))
        module.link_in(llvm.parse_assembly("\n".join(self._glue)))
        hidden = {*self.names, *_symbols(self._offered)}.difference(exported)
        for i, symbol in enumerate((*module.functions, *module.global_variables)):
            if symbol.name in hidden:
                symbol.linkage, symbol.visibility = "external", "hidden"
            elif not symbol.is_declaration and symbol.name not in self.names:
                symbol.linkage = "internal"
                if not symbol.name.startswith(_REFUSED):
                    symbol.name = f"{_readable(symbol.name)}.{i}"
        return module


def _symbols(functions: Iterable[Any]) -> set[str]:
    """Return the names of functions that numba has made in LLVM's modules."""
    return {function.fndesc.llvm_func_name for function in functions}


def _whole(libraries: Iterable[Any], without: Iterable[Any]) -> Any:
    """Return one module of numba's libraries and of all that they link. They are used up."""
    parts = list(modules_of(libraries, without))
    while len(parts) > 1:  # two by two, since LLVM looks through the whole module for each part that is linked to it
        for part, next_part in zip(parts[::2], parts[1::2], strict=False):
            part.link_in(next_part)
        parts = parts[::2]
    (module,) = parts
    module.triple = module.data_layout = ""
    return module


def _readable(name: str) -> str:
    """Return the dotted name of a numba function without the numbers that depend on what the process compiled before."""
    parts, rest = [], name.removeprefix("_ZN") if name.startswith("_ZN") else ""
    while found := re.match(r"\d+", rest):
        end = found.end() + int(found[0])
        parts.append(rest[found.end() : end])
        rest = rest[end:]
    return ".".join(parts) or "data"


def refuse_the_rest(module: Any, elsewhere: Iterable[Any] = ()) -> None:
    """Raise an error if a module needs what the library may not have, besides functions that are `elsewhere` in it.

    Raises
    ------
    RuntimeError
        If it needs a symbol that is not in ALLOWED.
    """
    needed = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    needed |= {g.name for g in module.global_variables if g.is_declaration and not g.name.startswith(DATA)}
    needed |= {g.name for g in module.global_variables if g.name.startswith(_REFUSED)}
    if refused := needed - ALLOWED - _symbols(elsewhere):
        users = [f.name for f in module.functions if not f.is_declaration and any(name in str(f) for name in refused)]
        raise RuntimeError(
            f"the kernels need symbols that the library may not have: {', '.join(sorted(refused))}. They stand in "
            f"{', '.join(users)}, or in what was compiled into it; a symbol with pickle in its name is an error of Python"
        )
