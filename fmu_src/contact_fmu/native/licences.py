"""Licences of everything in a native FMU, for its folder documentation/licenses."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from contact.compile.libm import ZIG
from ..place import licence

_OVERVIEW = """\
Contents of this FMU and their licences:

wheelrail-contact.txt   the model, on all platforms (MIT)
fmi.txt                 the declarations of the Functional Mock-up Interface that it is compiled with (2-clause BSD)

Also in the libraries for Windows and macOS (linked by zig):
zig.txt                 compiler-rt: memory and mathematical functions (MIT)

Also in the library for Windows:
musl.txt                exp, log and pow, by Arm; mathematical functions that zig has translated (MIT)
"""


def licences(headers: Path) -> Iterator[tuple[str, str]]:
    """Yield (name, text) of the licence files. `headers` is the folder of the FMI project's headers.

    The library for Linux contains no foreign code.
    """
    interface = (headers / "fmi2Functions.h").read_text()
    interface = interface[interface.index("Copyright") :]
    yield "license.txt", _OVERVIEW
    yield "wheelrail-contact.txt", licence()
    yield "fmi.txt", interface[: interface.index("*/")].rstrip() + "\n"
    for name, path in (("zig", "LICENSE"), ("musl", "lib/libc/musl/COPYRIGHT")):
        yield f"{name}.txt", (ZIG / path).read_text()
