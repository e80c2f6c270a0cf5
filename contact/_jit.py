"""Numba options of all kernels, and the cache of compiled kernels.

* ``error_model="numpy"``: no exception branches. A kernel prevents a division by zero, it does not catch it.
* ``nogil=True``: a kernel touches no Python object, so threads of a host run in parallel.
* ``_nrt=False``: arrays have no reference counts in kernels, which allocate nothing. They took a fifth of the time of a
  contact. A kernel may return arrays in a tuple, but not an array of its own making.
* No ``fastmath``: results must not depend on the instruction set. The native FMU is compared bit for bit.
* Compiled kernels are kept on disk. The cache is keyed by the content of `contact/kernels`, and for a kernel elsewhere
  also by the content of its own folder. Modification times are ignored, so another checkout with the same kernels
  compiles nothing.

Kernels allocate no memory, raise no exception and take no function as argument. One source therefore serves Python,
batches and the native FMU.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import sys
import time
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from llvmlite.binding import Linkage
from numba import config, njit, typeof, types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, UserProvidedCacheLocator
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import AnalysisPass, register_pass
from numba.core.typed_passes import NoPythonSupportedFeatureValidation
from numba.extending import overload

from contact._remembered import remembering

_KERNELS = Path(__file__).parent / "kernels"
_PREFIX = "wheelrail-contact-"
#: Caches that were not used for this time [s] are removed. At most `_MOST` caches are kept.
_STALE, _MOST = 30 * 86400.0, 8
_OPTIONS = {"error_model": "numpy", "nogil": True, "_nrt": False}


def _base() -> Path:
    """Return the folder of all caches: NUMBA_CACHE_DIR if it is set, else the system's cache folder."""
    if config.CACHE_DIR:
        return Path(config.CACHE_DIR)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")


@cache
def _fingerprint(folder: Path) -> str:
    """Return a hash of the sources in `contact/kernels` and in `folder`."""
    content = hashlib.sha256(Path(__file__).read_bytes())
    for root in sorted({_KERNELS, folder}):
        for path in sorted(root.rglob("*.py")):
            content.update(f"{path.relative_to(root)}\0".encode() + path.read_bytes())
    return content.hexdigest()[:16]


@cache
def cache_directory(folder: Path) -> Path:
    """Return the cache directory of the kernels with the present sources. If it is new, remove stale caches."""
    inside = _KERNELS if folder.is_relative_to(_KERNELS) else folder
    path = _base() / (_PREFIX + _fingerprint(inside))
    with contextlib.suppress(OSError):
        if path.exists():
            os.utime(path)
        else:
            _remove_stale(path.parent)
    return path


def _remove_stale(base: Path) -> None:
    """Remove caches that were not used for `_STALE` seconds, and all but the `_MOST` latest."""
    caches = sorted(base.glob(_PREFIX + "*"), key=lambda path: path.stat().st_mtime, reverse=True)
    for i, path in enumerate(caches):
        if i >= _MOST or path.stat().st_mtime < time.time() - _STALE:
            shutil.rmtree(path, ignore_errors=True)


class _Locator(UserProvidedCacheLocator):
    """numba's cache, keyed by content."""

    def __init__(self, function: Callable[..., Any], file: str) -> None:
        self._py_file, self._lineno = file, function.__code__.co_firstlineno
        self._module = function.__module__
        self._cache_path = str(cache_directory(Path(file).parent))

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> _Locator:
        return cls(function, file)

    def get_source_stamp(self) -> str:
        return ""  # the directory's name identifies the sources

    def get_disambiguator(self) -> str:
        return f"{self._module}-{self._lineno}"


class _Implementation(CompileResultCacheImpl):
    _locator_classes = [_Locator]  # noqa: RUF012 - numba declares it so


class _ContentCache(FunctionCache):
    _impl_class = _Implementation


class _NoEnvironment:
    """Where numba would set the Python environment of machine code."""

    def set_env(self, name: str, environment: Any) -> None:
        pass


class _LinkedLibrary(JITCodeLibrary):
    """Intermediate code for other kernels to link. Optimised and made machine code once, with them.

    It only remembers what it links itself. So the code of a kernel is copied once into each kernel for Python, not once more
    for each kernel between them.
    """

    _with_linked: Any = None

    def finalize(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def alone(self) -> Any:
        """Return the module without what it links."""
        return super()._get_module_for_linking()

    def _get_module_for_linking(self) -> Any:
        """Return the module with all that it links, as numba's own libraries expect it."""
        self._ensure_finalized()
        if self._with_linked is None:
            self._with_linked = self.alone().clone()
            _link(self._with_linked, self)
        return self._with_linked

    def get_pointer_to_function(self, name: str) -> int:
        return 0

    @property
    def codegen(self) -> _NoEnvironment:
        return _NoEnvironment()


def _link(module: Any, library: JITCodeLibrary) -> None:
    """Link into a module of `library` all that the library links, directly or not."""
    pending, seen = list(library._linking_libraries), {library}
    while pending:
        one = pending.pop()
        if one in seen:
            continue
        seen.add(one)
        if isinstance(one, _LinkedLibrary):
            module.link_in(one.alone(), preserve=True)
            pending += one._linking_libraries
        else:
            module.link_in(one._get_module_for_linking(), preserve=True)


class _WholeLibrary(JITCodeLibrary):
    """Machine code of a kernel for Python, optimised as a whole with all kernels that it calls.

    Nothing else may call its copies of these, so LLVM may change their arguments and inlines more of them. The default methods
    take an eighth less time. The copies get names of their own: LLVM's loader has one table of names for all code of a
    process, local names included, and would take such a copy for the function that other machine code calls.
    """

    def finalize(self) -> None:
        _link(self._final_module, self)
        self._linking_libraries.clear()
        super().finalize()

    def _optimize_final_module(self) -> None:
        for function in self._final_module.functions:
            if function.linkage == Linkage.linkonce_odr and function.name.startswith("_ZN"):
                function.linkage, function.name = Linkage.internal, function.name + ".own"
        # numba would optimise twice, to remove reference counts in between. Kernels have none.
        passes, builder = self._codegen._module_pass_manager()
        passes.run(self._final_module, builder)


def _compiler_into(library: type[JITCodeLibrary]) -> type[CompilerBase]:
    """Return numba's compiler with another kind of library for its code."""

    @register_pass(mutates_CFG=False, analysis_only=True)
    class Choose(AnalysisPass):
        _name = library.__name__

        def __init__(self) -> None:
            AnalysisPass.__init__(self)

        def run_pass(self, state: Any) -> bool:
            state.library = library(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
            return False

    class Compiler(CompilerBase):
        def define_pipelines(self) -> list[Any]:
            passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
            passes.add_pass_after(Choose, NoPythonSupportedFeatureValidation)
            passes.finalize()
            return [passes]

    return Compiler


_WHOLE = {"no_cfunc_wrapper": True, "pipeline_class": _compiler_into(_WholeLibrary)}
_LINKED = {"no_cfunc_wrapper": True, "no_cpython_wrapper": True, "pipeline_class": _compiler_into(_LinkedLibrary)}


def _show_to_kernels(dispatcher: Any, function: Callable[..., Any], options: Mapping[str, Any]) -> None:
    """Let kernels that call this one link its intermediate code; a literal argument counts as its type.

    numba would give each kernel machine code of its own, with all kernels that it calls in it, and a wrapper for calls from
    Python; and a version of its own to each literal. Together that is half of the time of compilation.
    """
    linked = remembering(njit(**options, **_LINKED)(function))

    def get_call_template(arguments: tuple[Any, ...], named: Mapping[str, Any]) -> Any:
        plain = tuple(types.unliteral(argument) for argument in arguments)
        return linked.get_call_template(plain, {name: types.unliteral(argument) for name, argument in named.items()})

    dispatcher.get_call_template, dispatcher.get_overload = get_call_template, linked.get_overload


def _compiled(function: Callable[..., Any], options: Mapping[str, Any]) -> Any:
    dispatcher = njit(**options, **_WHOLE)(function)
    if not config.DISABLE_JIT:
        _show_to_kernels(dispatcher, function, options)
        remembering(dispatcher)
    return dispatcher


def uncached(function: Callable[..., Any]) -> Any:
    """Compile `function` as a kernel that may lay arrays over memory that it is given, for this process only.

    numba refuses to return such arrays without reference counts. They have nothing to count, because nobody owns them.
    """
    return _compiled(function, {**_OPTIONS, "_nrt": True})


def kernel(function: Callable[..., Any]) -> Any:
    """Compile `function` with the options above, once for each set of argument types."""
    dispatcher = _compiled(function, _OPTIONS)
    if not config.DISABLE_JIT:
        dispatcher._cache = _ContentCache(function)
    return dispatcher


def inlined(function: Callable[..., Any]) -> Any:
    """Compile `function` into each kernel that calls it. For thin functions, which as separate kernels compile for seconds."""
    return njit(**_OPTIONS, inline="always")(function)


def compiled_for(dispatcher: Any, *arguments: Any) -> Callable[..., Any]:
    """Return the machine code of a kernel for arguments of these types; compile it if necessary.

    A call of the machine code does not look up the argument types, which takes numba 10 µs for a workspace. The types are
    not checked either: pass only arguments of the same types.
    """
    return dispatcher.compile(tuple(typeof(argument) for argument in arguments))


def chosen_by(stub: Callable[..., Any], kernels: Mapping[type, Any]) -> None:
    """Make compiled calls of `stub` run the kernel for the type of its first argument, a marker.

    Several calls of this function for one stub add their kernels.
    """
    functions = {marker: chosen.py_func for marker, chosen in kernels.items()}

    @overload(stub, jit_options={**_OPTIONS, **_LINKED}, strict=False, inline="always")
    def _choose(family, *arguments):
        return functions.get(family.instance_class)
