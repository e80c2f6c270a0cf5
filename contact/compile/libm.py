"""exp, log and pow for platforms whose own functions give other bits.

They are the functions of musl, by Arm, which zig ships as source. glibc has the same functions. Like those of glibc, they are
compiled with fused operations for processors that have these, and then give the same bits. So the FMU computes the same on
Windows as on Linux, whatever C library is there. Otherwise the functions of zig would be linked, which differ in the last
digit. Iteration and differentiation magnify this, by 1e5 for strips that interact.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import ziglang

from contact.compile.objects import CPUS

ZIG = Path(ziglang.__file__).parent
_MUSL = ZIG / "lib" / "libc" / "musl"
_FUNCTIONS = ("exp", "log", "pow")
_SHARED = (
    *("exp_data", "log_data", "pow_data", "__math_divzero", "__math_invalid", "__math_oflow", "__math_uflow"),
    "__math_xflow",
)
_INCLUDE = (
    *(_MUSL / name for name in ("src/internal", "src/include", "include", "arch/x86_64", "arch/generic")),
    *(ZIG / "lib" / "libc" / "include" / name for name in ("generic-musl", "x86_64-linux-musl")),
)
_FLAGS = {"v2": ["-ffp-contract=off"], "v3": ["-mfma", "-mavx2", "-ffp-contract=fast", "-D__FP_FAST_FMA=1"]}


def compile_libm(compiler: list[str], folder: Path, run: Callable[..., None]) -> list[Path]:
    """Compile exp_v2, log_v3 … into `folder` and return the paths of the objects."""
    include = [f"-I{path}" for path in _INCLUDE]
    objects = []
    for cpu in CPUS:
        for name in (*_FUNCTIONS, *(_SHARED if cpu == "v2" else ())):
            objects.append(folder / f"{name}_{cpu}.o")
            rename = [f"-D{function}={function}_{cpu}" for function in _FUNCTIONS]
            source = _MUSL / "src" / "math" / f"{name}.c"
            run(*compiler, "-O2", *_FLAGS[cpu], *rename, *include, "-c", source, "-o", objects[-1])
    return objects
