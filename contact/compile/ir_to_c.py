"""Write the LLVM IR of kernels as C11, so that an FMU carries sources from which any C compiler makes its library.

The IR must be optimised, but not with vectors: it then has a small vocabulary (`ir_function`). Anything else raises a
ValueError; nothing is guessed. The C code has the operations of the IR, one by one. Compile it with ``-ffp-contract=off`` for
results that do not depend on the processor.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Sequence

from contact.compile.ir_function import Function
from contact.compile.ir_text import GLOBAL, identifier, number, split, type_in_c, unknown

# Memory is read and written by memcpy, because the IR does not say which types a pointer may alias.
_ACCESS = """static inline {type} load_{name}(const char *p) {{ {type} v; memcpy(&v, p, sizeof v); return v; }}
static inline void store_{name}(char *p, {type} v) {{ memcpy(p, &v, sizeof v); }}"""
_INCLUDED = "\n".join(f"#include <{name}.h>" for name in ("math", "stdbool", "stdint", "string"))
#: Functions that the code may call, a line each. Those that it does not call are left out.
_FUNCTIONS = "\n".join(
    (
        *(_ACCESS.format(type=f"{name}_t", name=name) for name in ("int64", "int32", "int16", "int8")),
        _ACCESS.format(type="double", name="double"),
        _ACCESS.format(type="char *", name="pointer"),
        "static inline int64_t smin(int64_t a, int64_t b) { return a < b ? a : b; }",
        "static inline int64_t smax(int64_t a, int64_t b) { return a > b ? a : b; }",
        "static inline int64_t umin(uint64_t a, uint64_t b) { return (int64_t)(a < b ? a : b); }",
        "static inline int64_t umax(uint64_t a, uint64_t b) { return (int64_t)(a > b ? a : b); }",
    )
).splitlines()
_CONSTANT = re.compile(
    rf'({GLOBAL}) = (.*?)\b(?:constant|global) \[(\d+) x (\w+)\](?: (?:c"(.*?)"|\[(.*)\]|(zeroinitializer)))?(?:, align \d+)?$'
)
#: An entry of kernels for any processor that is defined elsewhere, or a function of the system. The C library's have headers.
_LINKED = re.compile(
    r"declare(?:\s+(?:noundef|dso_local|local_unnamed_addr))*\s+(\w+)\s+(@(?:\w+_any|sched_yield))\((.*?)\)"
)
#: Type of the elements of a constant → its form for `struct`.
_PACKED = {"double": "d", "i64": "q", "i32": "i", "i8": "b", "i1": "?"}


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
    heads = [*_linked(lines), *(f"{function.head};" for function in functions)]
    code = [*constants, *heads, *(function.code() for function in functions)]
    called = set(re.findall(r"\b(\w+)\(", "\n".join(code)))
    needed = [line for line in _FUNCTIONS if re.findall(r"(\w+)\(", line)[0] in called]
    return "\n".join((_INCLUDED, *needed, *code)) + "\n"


def _linked(lines: Sequence[str]) -> Iterator[str]:
    """Yield the C declarations of entries of other kernels that are linked with these, as a vehicle calls a pair's."""
    for line in lines:
        if found := _LINKED.match(line):
            result, name, given = found.groups()
            kinds = ", ".join(type_in_c(argument.split()[0]) for argument in split(given))
            yield f"{type_in_c(result)} {identifier(name)}({kinds or 'void'});"


def _constant(line: str) -> str:
    """Return the C code of a constant array: its bytes as 64-bit words."""
    found = _CONSTANT.match(line)
    if not found or found[4] not in _PACKED:
        raise unknown(line)
    name, linkage, count, kind, text, listed, zero = found.groups()
    size = int(count) * struct.calcsize(_PACKED[kind])
    head = f"const uint64_t {identifier(name)}[{-(-size // 8)}]"
    if text is None and listed is None and zero is None:
        return f"extern {head};"
    content = bytes(size) if zero else _bytes(text) if text is not None else _packed(listed, kind)
    if len(content) != size:
        raise unknown(line)
    words = struct.unpack(f"<{-(-size // 8)}Q", content + bytes(-size % 8))
    own = "static " if re.search(r"\b(?:internal|private)\b", linkage) else ""
    return f"{own}{head} = {{{', '.join(map(hex, words))}}};"


def _packed(listed: str, kind: str) -> bytes:
    """Return the bytes of the elements of a constant. What LLVM leaves open becomes 0."""
    values = [element.split()[1] for element in listed.split(",")]
    if kind == "double":
        numbers = [0.0 if value in ("poison", "undef") else number(value) for value in values]
        return struct.pack(f"<{len(numbers)}d", *numbers)
    words = {"poison": 0, "undef": 0, "true": 1, "false": 0}
    return struct.pack(f"<{len(values)}{_PACKED[kind]}", *(words[v] if v in words else int(v) for v in values))


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
