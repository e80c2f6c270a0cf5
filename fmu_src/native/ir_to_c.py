"""Write the LLVM IR of kernels as C11, so that an FMU carries sources from which any C compiler makes its library.

The IR must be optimised, but not with vectors: it then has a small vocabulary (`ir_function`). Anything else raises a
ValueError; nothing is guessed. The C code has the operations of the IR, one by one. Compile it with ``-ffp-contract=off`` for
results that do not depend on the processor.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Sequence

from fmu_src.native.ir_function import GLOBAL, Function, identifier, unknown

# Memory is read and written by memcpy, because the IR does not say which types a pointer may alias.
_ACCESS = """static inline {type} load_{name}(const char *p) {{ {type} v; memcpy(&v, p, sizeof v); return v; }}
static inline void store_{name}(char *p, {type} v) {{ memcpy(p, &v, sizeof v); }}"""
_HEADER = "\n".join(
    (
        *(f"#include <{name}.h>" for name in ("math", "stdbool", "stdint", "string")),
        *(_ACCESS.format(type=f"{name}_t", name=name) for name in ("int64", "int32", "int8")),
        _ACCESS.format(type="double", name="double"),
        _ACCESS.format(type="char *", name="pointer"),
        "static inline int64_t smin(int64_t a, int64_t b) { return a < b ? a : b; }",
        "static inline int64_t smax(int64_t a, int64_t b) { return a > b ? a : b; }",
        "static inline int64_t umin(uint64_t a, uint64_t b) { return (int64_t)(a < b ? a : b); }",
        "static inline int64_t umax(uint64_t a, uint64_t b) { return (int64_t)(a > b ? a : b); }",
    )
)
_CONSTANT = re.compile(
    rf'({GLOBAL}) = (.*?)\b(?:constant|global) \[(\d+) x i8\](?: c"(.*?)"| (zeroinitializer))?(?:, align \d+)?$'
)


def as_c(ir: str) -> str:
    """Return C code for a module. What is not internal in the IR can be seen from other files.

    Raises
    ------
    ValueError
        If the IR has an instruction, a type or an intrinsic that cannot be written as C.
    """
    lines = ir.splitlines()
    functions = [Function(body) for body in _bodies(lines)]
    constants = [_constant(line) for line in lines if line.startswith("@")]
    heads = [f"{function.head};" for function in functions]
    return "\n".join((_HEADER, *constants, *heads, *(function.code() for function in functions))) + "\n"


def _constant(line: str) -> str:
    """Return the C code of a constant: bytes of the IR, as 64-bit words."""
    found = _CONSTANT.match(line)
    if not found:
        raise unknown(line)
    name, linkage, size, text, zero = found.groups()
    head = f"const uint64_t {identifier(name)}[{-(-int(size) // 8)}]"
    if text is None and zero is None:
        return f"extern {head};"
    content = bytes(int(size)) if zero else _bytes(text)
    if len(content) != int(size):
        raise unknown(line)
    words = struct.unpack(f"<{-(-len(content) // 8)}Q", content + bytes(-len(content) % 8))
    return f"{'static ' if 'internal' in linkage else ''}{head} = {{{', '.join(map(hex, words))}}};"


def _bytes(text: str) -> bytes:
    """Return the bytes of a string of the IR, in which \\22 stands for a byte and \\\\ for a backslash."""
    escaped = re.compile(rb"\\(\\|[0-9A-Fa-f]{2})")
    return escaped.sub(lambda found: b"\\" if found[1] == b"\\" else bytes([int(found[1], 16)]), text.encode("latin-1"))


def _bodies(lines: Sequence[str]) -> Iterator[list[str]]:
    """Yield the lines of each function, without the last brace."""
    body: list[str] = []
    for line in lines:
        if line.startswith("define"):
            body = [line]
        elif body and line == "}":
            yield body
            body = []
        elif body:
            body.append(line)
