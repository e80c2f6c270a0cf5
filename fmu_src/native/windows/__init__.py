"""Link for Windows without the C run-time library of mingw: with import libraries of the system, and `runtime.c`.

zig would build that library before it links for the first time on a machine, which takes a minute of processor time. An FMU
needs no start-up code, no data of threads and no relocation of imported data. zig still links its compiler-rt, which has the
functions for memory, for long stack frames, and sin, cos, tan and sincos.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

RUNTIME = Path(__file__).with_name("runtime.c")
#: Linker options: neither the run-time library nor its start-up code.
ALONE = ["-nostdlib"]
#: Library of the system → its functions that an FMU may need. Every Windows since 10 has them: api-ms-win-crt-… are names
#: of parts of its universal C run-time library.
IMPORTS = {
    "KERNEL32": ("MultiByteToWideChar",),
    "api-ms-win-crt-heap-l1-1-0": ("calloc", "free", "malloc", "realloc"),
    "api-ms-win-crt-math-l1-1-0": ("acos", "asin", "asinh", "atan", "atan2", "atanh", "expm1"),
    "api-ms-win-crt-private-l1-1-0": ("memchr",),
    "api-ms-win-crt-stdio-l1-1-0": ("__stdio_common_vsprintf", "_wfopen", "fclose", "fread"),
    "api-ms-win-crt-string-l1-1-0": ("strcmp", "strcpy", "strlen", "strncmp"),
}


def parts(
    compiler: Sequence[str],
    sources: Sequence[Path],
    folder: Path,
    run: Callable[..., None],
    imports: Mapping[str, Sequence[str]] = IMPORTS,
) -> list[Path]:
    """Compile C files and make import libraries in `folder`. Return the paths of what is to be linked.

    zig finds the headers of C only where it may link the C library too, so the files are compiled before they are linked.
    """
    made = []
    for source in sources:
        made.append(folder / f"{source.stem}.o")
        run(*compiler, "-c", source, "-o", made[-1])
    for name, functions in imports.items():
        definition = folder / f"{name}.def"
        definition.write_text("\n".join((f"LIBRARY {name}.dll", "EXPORTS", *functions, "")))
        made.append(definition.with_suffix(".lib"))
        run(sys.executable, "-m", "ziglang", "dlltool", "-m", "i386:x86-64", "-d", definition, "-l", made[-1])
    return made
