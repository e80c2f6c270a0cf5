"""Compile the C parts of the library with zig and link them with the kernels for each system."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from contact.compile.libm import compile_libm
from contact.compile.library import C_INTERFACE, flags
from contact.compile.objects import OWN_LIBM, TRIPLES, objects

#: What every library for Windows has. It needs the Universal C Runtime, which is part of Windows since version 10.
OF_WINDOWS = Path(__file__).parent / "windows.c"
_RUNTIME = ("convert", "heap", "math", "private", "runtime", "stdio", "string")
#: Linker options: the libraries of Windows and not zig's start-up code for it, which takes a minute to build; no time stamp.
WITHOUT_MINGW = ("-nostdlib", "-Wl,-Brepro", "-lkernel32", *(f"-lapi-ms-win-crt-{part}-l1-1-0" for part in _RUNTIME))
_VISIBLE = ("-std=c11", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-fPIC")
#: -ffp-contract=off: fused operations would make the results differ between processors.
FLAGS = (*_VISIBLE, "-fvisibility=hidden")
#: System → target of zig.
_TARGETS = {
    "linux64": "x86_64-linux-gnu.2.17",
    "win64": "x86_64-windows-gnu",
    "darwin64": "x86_64-macos.11.0",
    "aarch64-linux": "aarch64-linux-gnu.2.17",
    "aarch64-darwin": "aarch64-macos.11.0",
}


def link(system: str, library: Path, kernels: Path, sources: Sequence[Path], headers: Sequence[Path]) -> None:
    """Link the library of a system from the C interface, other `sources` in C, and the compiled kernels in a folder.

    `headers` are the folders of the headers that the sources need. Systems without objects have the kernels in C.
    """
    in_c = system not in TRIPLES
    library.parent.mkdir(exist_ok=True)
    include = [f"-I{path}" for path in headers]
    defined = ["-DWR_ANY", "-DKERNELS_IN_C"] if in_c else ["-DWR_SEVERAL"]
    of_system = [OF_WINDOWS] if system == "win64" else []
    made = compile_libm(compiler(system), library.parent, run) if system in OWN_LIBM else []

    def compile_c(path: Path, options: tuple[str, ...]) -> None:
        made.append(library.parent / f"{path.stem}.o")
        unused = "-Wno-unused-parameter"
        run(*compiler(system), *options, *defined, *flags(kernels), unused, *include, "-c", path, "-o", made[-1])

    for path in (*C_INTERFACE, *sources, *of_system):
        compile_c(path, FLAGS)
    for path in (kernels / "kernels.c", kernels / "data.c") if in_c else ():
        compile_c(path, _VISIBLE)
    # names without a folder, because a macOS library has a trace of them
    names, ready = [path.name for path in made], [] if in_c else objects(kernels, system)
    options = _of_system(_TARGETS[system], library.name)
    run(*compiler(system), "-shared", "-s", *names, *ready, "-o", library, *options, cwd=library.parent)
    for path in (*made, *library.parent.glob("*.lib")):
        path.unlink()


def _of_system(target: str, name: str) -> list[str]:
    """Return the linker options of a system. A macOS library stores its own path, which must not be that of the build."""
    if "linux" in target:
        return ["-Wl,-z,defs", "-lm"]
    if "windows" in target:
        return [*WITHOUT_MINGW]
    return [f"-Wl,-install_name,@rpath/{name}"]


def compiler(system: str) -> list[str]:
    """Return the command of the C compiler for a system."""
    return [sys.executable, "-m", "ziglang", "cc", "-target", _TARGETS[system], "-fno-sanitize=undefined"]


def run(*command: str | Path, cwd: Path | None = None) -> None:
    """Run a command in a folder.

    Raises
    ------
    RuntimeError
        If it fails. The message has its output.
    """
    words = list(map(str, command))
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=cwd, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}\n{done.stdout}")
