"""Compile the C parts of an FMU with zig and link them to one library for each platform."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import fmpy

from fmu_src.native.emit import OWN_LIBM
from fmu_src.native.library import WRAPPER as WRAPPER
from fmu_src.native.libm import compile_libm

_BEAT = 15.0  # between two signs of life of a long command [s]
#: What every library for Windows has. It needs the Universal C Runtime, which is part of Windows since version 10.
OF_WINDOWS = Path(__file__).parent / "c_windows" / "library.c"
_RUNTIME = ("convert", "heap", "math", "private", "runtime", "stdio", "string")
#: Linker options: the libraries of Windows and not zig's start-up code for it, which takes a minute to build; no time stamp.
WITHOUT_MINGW = ("-nostdlib", "-Wl,-Brepro", "-lkernel32", *(f"-lapi-ms-win-crt-{part}-l1-1-0" for part in _RUNTIME))
HEADERS = Path(fmpy.__file__).parent / "c-code"  # headers of the FMI project (2-clause BSD licence)
#: -ffp-contract=off: fused operations would make the results differ between processors.
FLAGS = ("-std=c11", "-O2", "-ffp-contract=off", "-fvisibility=hidden", "-Wall", "-Wextra", "-fPIC")
#: Platform → target of zig, and the end of a library's name.
_TARGETS = {
    "linux64": ("x86_64-linux-gnu.2.17", ".so"),
    "win64": ("x86_64-windows-gnu", ".dll"),
    "darwin64": ("x86_64-macos.11.0", ".dylib"),
    "aarch64-linux": ("aarch64-linux-gnu.2.17", ".so"),
    "aarch64-darwin": ("aarch64-macos.11.0", ".dylib"),
}
#: Platforms whose library is made from the kernels in C. FMI 3.0 has these names, FMI 2.0 has none for 64-bit ARM.
FROM_C = ("aarch64-linux", "aarch64-darwin")


def link(platform: str, name: str, sources: Sequence[Path], objects: Sequence[Path], folder: Path) -> Path:
    """Compile the C files among `sources`, link them with `objects` and return the path of the library in `folder`."""
    target, ending = _TARGETS[platform]
    library = folder / platform / (name + ending)
    library.parent.mkdir(exist_ok=True)
    made = compile_libm(compiler(platform), library.parent, run) if platform in OWN_LIBM else []
    include = [f"-I{path}" for path in (*sorted({path.parent for path in sources}), HEADERS)]
    own = [OF_WINDOWS] if "windows" in target else []
    for path in (*(path for path in sources if path.suffix == ".c"), *own):
        made.append(library.parent / f"{path.stem}.o")
        run(*compiler(platform), *FLAGS, "-Wno-unused-parameter", *include, "-c", path, "-o", made[-1])
    # names without a folder, because a macOS library has a trace of them
    names, options = [path.name for path in made], _of_system(target, library.name)
    run(*compiler(platform), "-shared", "-s", *names, *objects, "-o", library, *options, cwd=library.parent)
    return library


def _of_system(target: str, name: str) -> list[str]:
    """Return the linker options of a system. A macOS library stores its own path, which must not be that of the build."""
    if "linux" in target:
        return ["-Wl,-z,defs", "-lm"]
    if "windows" in target:
        return [*WITHOUT_MINGW]
    return [f"-Wl,-install_name,@rpath/{name}"]


def compiler(platform: str) -> list[str]:
    """Return the command of the C compiler for a platform."""
    return [sys.executable, "-m", "ziglang", "cc", "-target", _TARGETS[platform][0], "-fno-sanitize=undefined"]


def run(*command: str | Path, waiting: Callable[[], None] | None = None, cwd: Path | None = None) -> None:
    """Run a command in a folder. If it fails, raise an error with its output. Every 15 s that it lasts, `waiting` is called."""
    words = list(map(str, command))
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=cwd) as process:
        said = None
        while said is None:
            try:
                said, _ = process.communicate(timeout=_BEAT)
            except subprocess.TimeoutExpired:
                if waiting is not None:
                    waiting()
    if process.returncode:
        raise RuntimeError(f"{' '.join(words)}\n{said}")
