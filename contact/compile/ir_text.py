"""Read the text of LLVM IR: its blocks, types, operands and constants, and what they are in C."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Sequence

#: Type of the IR → type in C, bytes, end of the names of the functions that load and store it.
TYPES = {
    "double": ("double", 8, "double"),
    "i64": ("int64_t", 8, "int64"),
    "i32": ("int32_t", 4, "int32"),
    "i16": ("int16_t", 2, "int16"),
    "i8": ("int8_t", 1, "int8"),
    "i1": ("bool", 1, "int8"),
    "ptr": ("char *", 8, "pointer"),
    "void": ("void", 0, ""),
}
LOCAL = r'%(?:"[^"]+"|[\w$.\-]+)'
GLOBAL = r'@(?:"[^"]+"|[\w$.\-]+)'


def unknown(text: str) -> ValueError:
    """Return the error for IR that cannot be written as C."""
    return ValueError(f"cannot be written as C: {text[:200]}")


def identifier(name: str) -> str:
    """Return the C name of a global value."""
    return re.sub(r"\W", "_", name.strip('@%"'))


def blocks_of(lines: Sequence[str]) -> Iterator[tuple[str, list[str]]]:
    """Yield label and instructions of each block. A switch becomes one line. The first block may have no label: %0."""
    body: list[str] = []
    label, begun = "%0", ""
    for line in lines:
        if found := re.match(r'("[^"]+"|[\w$.\-]+):', line):
            if body:
                yield label, body
            label, body = "%" + found[1], []
        elif text := re.sub(r", ![\w.]+ !\d+", "", line.strip()):
            begun = f"{begun} {text}".strip()
            if not begun.startswith("switch") or begun.endswith("]"):
                body.append(begun)
                begun = ""
    yield label, body


def phis_of(body: Sequence[str]) -> Iterator[tuple[str, tuple[str, dict[str, str]]]]:
    """Yield name → (type, value for each block before)."""
    for line in body:
        if found := re.match(rf"({LOCAL}) = phi (\{{.*?\}}|\S+) (.*)$", line):
            pairs = re.findall(rf"\[ (.*?), ({LOCAL}) \]", found[3])
            yield found[1], (found[2], {block: value for value, block in pairs})


def number(text: str) -> float:
    """Return the value of a float64 constant of the IR, which has a decimal form or that of its bits."""
    if not re.fullmatch(r"0x[0-9A-F]{16}|[-+]?\d+\.\d+(?:e[-+]\d+)?", text):
        raise unknown(f"double {text}")
    return struct.unpack("<d", struct.pack("<Q", int(text, 16)))[0] if text.startswith("0x") else float(text)


def double_in_c(text: str) -> str:
    """Return a float64 constant in C, exactly."""
    value = number(text)
    if value != value:
        return "NAN"
    if abs(value) == float("inf"):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return repr(value) if value.is_integer() and abs(value) < 1e15 else value.hex()


def type_in_c(kind: str) -> str:
    if kind not in TYPES and not mask_of(kind):
        raise unknown(f"type {kind}")
    return TYPES[kind][0] if kind in TYPES else "uint64_t"


def mask_of(kind: str) -> int:
    """Return the bits of an integer type that C has not, for example i13 of a table that LLVM packs into a number; else 0."""
    found = re.match(r"i(\d+)$", kind)
    return 2 ** int(found[1]) - 1 if found and kind not in TYPES and int(found[1]) < 64 else 0


def split_structure(text: str) -> tuple[str, str]:
    """Return type and value of an operand that is a structure."""
    depth = 0
    for i, character in enumerate(text):
        depth += (character == "{") - (character == "}")
        if depth == 0:
            return text[: i + 1], text[i + 1 :].strip()
    raise unknown(text)


def members_of(kind: str) -> list[str] | None:
    """Return the types of the members of a structure, None for another type."""
    return split(kind[1:-1]) if kind.startswith("{") else None


def suffix_of(kind: str) -> str:
    if kind not in TYPES:
        raise unknown(f"type {kind}")
    return TYPES[kind][2]


def size_of(kind: str) -> int:
    """Return the size of a type in bytes. In a structure each member counts at least 8, which is an upper bound."""
    if kind in TYPES:
        return TYPES[kind][1]
    if found := re.match(r"\[(\d+) x (.*)\]$", kind):
        return int(found[1]) * size_of(found[2])
    if kind.startswith("{"):
        return sum(-(-size_of(part) // 8) * 8 for part in split(kind[1:-1]))
    raise unknown(f"type {kind}")


def split(text: str) -> list[str]:
    """Split at commas outside brackets."""
    parts, depth, start = [], 0, 0
    for i, character in enumerate(text):
        depth += (character in "([{<") - (character in ")]}>")
        if character == "," and depth == 0:
            parts.append(text[start:i].strip())
            start = i + 1
    return [part for part in (*parts, text[start:].strip()) if part]
