"""Compile the C parts of the library with zig and link them with the kernels for each system."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from .libm import compile_libm
from .objects import OWN_LIBM, objects
from .systems import ARM, C_SOURCES, WRAPPER, flags

#: What every library for Windows has. It needs the Universal C Runtime, which is part of Windows since version 10.
OF_WINDOWS = Path(__file__).parent / "c_windows" / "library.c"
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


def link(system: str, name: str, kernels: Path, folder: Path) -> Path:
    """Link the library of a system and return its path, `folder`/`system`/`name`.

    `kernels` is the folder of the compiled kernels, and `folder`/sources has headers that the C sources need.
    """
    library, in_c = folder / system / name, system in ARM
    library.parent.mkdir(exist_ok=True)
    include = [f"-I{path}" for path in (WRAPPER[0].parent, folder / "sources")]
    defined = ["-DWR_ANY", "-DKERNELS_IN_C"] if in_c else ["-DWR_SEVERAL"]
    of_system = [OF_WINDOWS] if system == "win64" else []
    made = compile_libm(compiler(system), library.parent, run) if system in OWN_LIBM else []

    def compile_c(path: Path, options: tuple[str, ...]) -> None:
        made.append(library.parent / f"{path.stem}.o")
        unused = "-Wno-unused-parameter"
        run(*compiler(system), *options, *defined, *flags(kernels), unused, *include, "-c", path, "-o", made[-1])

    for path in (*C_SOURCES, *(path for path in WRAPPER if path.suffix == ".c"), *of_system):
        compile_c(path, FLAGS)
    for path in (kernels / "kernels.c", kernels / "data.c") if in_c else ():
        compile_c(path, _VISIBLE)
    # names without a folder, because a macOS library has a trace of them
    names, ready = [path.name for path in made], [] if in_c else objects(kernels, system)
    options = _of_system(_TARGETS[system], name)
    run(*compiler(system), "-shared", "-s", *names, *ready, "-o", library, *options, cwd=library.parent)
    for path in (*made, *library.parent.glob("*.lib")):
        path.unlink()
    return library


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
