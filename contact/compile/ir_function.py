"""One function of LLVM IR in C (see `ir_to_c`).

A value of the IR becomes a variable of the C function, a structure one for each member. A block becomes a label. A phi takes
its value from a variable that each block before it sets, so that the phis of one block may swap values.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from contact.compile.ir_text import (
    GLOBAL,
    LOCAL,
    TYPES,
    blocks_of,
    double_in_c,
    identifier,
    mask_of,
    members_of,
    phis_of,
    size_of,
    split,
    split_structure,
    suffix_of,
    type_in_c,
    unknown,
)

#: Words that do not change the result: promises to the optimiser, and how a function is called. They are no part of a name.
_MARKS = re.compile(
    r"(?<![%@.\"])\b"
    r"(?:nuw|nsw|nneg|exact|disjoint|inbounds|nusw|samesign|tail|notail|musttail|fastcc|volatile|noundef|nonnull|noalias"
    r"|readonly|writeonly|readnone|local_unnamed_addr|unnamed_addr|dso_local|nocapture|zeroext|signext|immarg|internal|hidden"
    r"|dead_on_unwind|writable|returned)\b"
    r"|captures\([^)]*\)|initializes\((?:[^()]|\([^()]*\))*\)|range\([^)]*\)|align \d+|dereferenceable\(\d+\)"
)
_OF_FLOATS = {"fadd": "+", "fsub": "-", "fmul": "*", "fdiv": "/"}
#: Operation on integers → operator in C, and whether the operands count as unsigned, so that sums may wrap.
_OF_INTEGERS = {
    "add": ("+", True), "sub": ("-", True), "mul": ("*", True), "shl": ("<<", True), "lshr": (">>", True),
    "udiv": ("/", True), "urem": ("%", True), "and": ("&", True), "or": ("|", True), "xor": ("^", True),
    "ashr": (">>", False), "sdiv": ("/", False), "srem": ("%", False),
}  # fmt: skip
_COMPARED = {"eq": "==", "ne": "!=", "gt": ">", "ge": ">=", "lt": "<", "le": "<="}
_OPPOSITE = {"gt": "<=", "ge": "<", "lt": ">=", "le": ">"}
_CONVERSIONS = {"sitofp", "uitofp", "fptosi", "zext", "sext", "trunc", "inttoptr", "ptrtoint"}
#: Classes of floats, bits of `llvm.is.fpclass` → test of x in C. It does not tell apart zeros, nor kinds of NaN.
_CLASSES = {
    0x003: "!(x == x)",
    0x004: "x == -INFINITY",
    0x008: "(x > -INFINITY && x <= -0x1p-1022)",
    0x010: "(x > -0x1p-1022 && x < 0.0)",
    0x060: "x == 0.0",
    0x080: "(x > 0.0 && x < 0x1p-1022)",
    0x100: "(x >= 0x1p-1022 && x < INFINITY)",
    0x200: "x == INFINITY",
}
#: Intrinsics that C has under the same name, or `ir_to_c` defines.
_INTRINSICS = {
    *("fabs", "sqrt", "exp", "log", "pow", "sin", "cos", "tan", "copysign", "floor", "ceil"),
    *("memset", "memcpy", "memmove", "smin", "smax", "umin", "umax"),
}


class Function:
    """One function. `head` is its C declaration without the semicolon."""

    def __init__(self, lines: Sequence[str]) -> None:
        found = re.match(rf"define\s+(\w+)\s+({GLOBAL})\((.*)\)\s*(?:#\d+\s*)?\{{", _MARKS.sub("", lines[0]))
        if not found:
            raise unknown(lines[0])
        result, name, given = found.groups()
        self._names: dict[str, str] = {}
        self._taken: set[str] = set()
        self._variables: dict[str, str] = {}
        arguments = (argument.split() for argument in split(given))
        declared = ", ".join(f"{type_in_c(words[0])} {self._local(words[-1])}" for words in arguments)
        self._arguments = list(self._names.values())
        linkage = "static " if re.search(r"\binternal\b", lines[0]) else ""
        self._nothing = "return;" if result == "void" else "return 0;"
        self.head = f"{linkage}{type_in_c(result)} {identifier(name)}({declared or 'void'})"
        self._blocks = dict(blocks_of(lines[1:]))
        self._phis = {label: dict(phis_of(body)) for label, body in self._blocks.items()}

    def code(self) -> str:
        """Return the function in C."""
        lines: list[str] = []
        for i, (label, body) in enumerate(self._blocks.items()):
            if i > 0:  # nothing jumps to the first block
                lines.append(f"{self._label(label)}:;")
            for name, (kind, _) in self._phis[label].items():
                for own, of_member in self._declare(name, kind):
                    self._variables[f"{own}_in"] = type_in_c(of_member)
                    lines.append(f"    {own} = {own}_in;")
            for text in body:
                if " = phi " not in text:
                    lines += [f"    {line}" for line in self._statements(text, label)]
        declared = [f"    {kind} {name};" for name, kind in self._variables.items()]
        used = set(re.findall(r"\bv_\w+\b(?! = )", "\n".join(lines)))
        unused = [
            f"    (void){name};"
            for name in (*self._arguments, *self._variables)
            if name not in used and "[" not in name
        ]
        return "\n".join((self.head, "{", *declared, *unused, *lines, "}"))

    def _local(self, name: str) -> str:
        """Return the C name of a value, unique in the function."""
        if name not in self._names:
            plain = "v_" + re.sub(r"\W+", "_", name.strip('%"')).strip("_")
            unique, i = plain, 1
            while unique in self._taken:
                i += 1
                unique = f"{plain}_{i}x"
            self._taken.add(unique)
            self._names[name] = unique
        return self._names[name]

    def _label(self, name: str) -> str:
        return self._local("%to " + name)[2:]

    def _declare(self, name: str, kind: str) -> list[tuple[str, str]]:
        """Declare the variables of a value: its own, or those of its members. Return (variable, type)."""
        own, kinds = self._local(name), members_of(kind)
        listed = [(own, kind)] if kinds is None else [(f"{own}_m{i}", k) for i, k in enumerate(kinds)]
        self._variables.update({variable: type_in_c(k) for variable, k in listed})
        return listed

    def _values(self, text: str, kind: str) -> list[str]:
        """Return the C expressions of an operand: one, or those of its members."""
        kinds = members_of(kind)
        if kinds is None:
            return [self._value(text, kind)]
        if text.startswith("{"):
            return [self._typed(member) for member in split(text[1:-1])]
        known = text.startswith("%")
        if not known and text not in ("poison", "undef", "zeroinitializer"):
            raise unknown(f"{kind} {text}")
        return [f"{self._local(text)}_m{i}" if known else "0" for i in range(len(kinds))]

    def _value(self, text: str, kind: str) -> str:
        """Return the C expression of an operand."""
        if text.startswith("%"):
            return self._local(text)
        if text.startswith("@"):
            return f"(char *){identifier(text)}"
        if found := re.match(rf"getelementptr\s+\((\w+), ptr ({GLOBAL}), i64 (-?\d+)\)", text):
            return f"((char *){identifier(found[2])} + {int(found[3]) * size_of(found[1])})"
        if text in ("poison", "undef", "null", "zeroinitializer", "false"):
            return "0"
        if text == "true":
            return "1"
        if kind == "double":
            return double_in_c(text)
        if not re.fullmatch(r"-?\d+", text):
            raise unknown(f"{kind} {text}")
        if mask := mask_of(kind):
            return f"UINT64_C({int(text) & mask})"
        if kind == "i64":
            return f"INT64_C({text})" if int(text) > -(2**63) else "INT64_MIN"
        return text

    def _pointer(self, operand: str) -> str:
        return self._value(operand.removeprefix("ptr "), "ptr")

    def _typed(self, operand: str) -> str:
        """Return the C expression of an operand that its type precedes."""
        kind, _, text = operand.partition(" ")
        return self._value(text, kind)

    def _statements(self, text: str, label: str) -> list[str]:
        """Return the C statements of one instruction in the block `label`."""
        found = re.match(rf"(?:({LOCAL}) = )?(.*)$", text)
        assert found is not None
        name, rest = found[1], re.sub(r"\s+", " ", _MARKS.sub("", found[2])).strip().rstrip(", ")
        word, _, operands = rest.partition(" ")
        if word == "insertvalue":
            return self._insert(name, operands)
        if word == "extractvalue":
            structure, index = split(operands)
            kind, value = split_structure(structure)
            ((own, _),) = self._declare(name, split(kind[1:-1])[int(index)])
            return [f"{own} = {self._values(value, kind)[int(index)]};"]
        if word == "call" and re.search(r"@llvm\.(?:lifetime|experimental)", operands):
            return []
        if name is None:
            return self._effect(word, operands, label)
        kind, expression = self._expression(word, operands, name)
        ((own, _),) = self._declare(name, kind)
        return [f"{own} = {expression};"]

    def _effect(self, word: str, operands: str, label: str) -> list[str]:
        """Return the C statements of an instruction without a value."""
        if word == "br":
            if found := re.match(rf"i1 (.*), label ({LOCAL}), label ({LOCAL})$", operands):
                yes, no = (self._jump(found[i], label) for i in (2, 3))
                return [f"if ({self._value(found[1], 'i1')}) {{ {yes} }}", no]
            return [self._jump(operands.removeprefix("label "), label)]
        if word == "switch" and (found := re.match(rf"(\w+) (\S+), label ({LOCAL}) \[(.*)\]", operands)):
            kind, value, default, listed = found.groups()
            lines = [f"switch ({self._value(value, kind)}) {{"]
            for case, block in re.findall(rf"\w+ (\S+), label ({LOCAL})", listed):
                lines.append(f"case {self._value(case, kind)}: {self._jump(block, label)}")
            return [*lines, f"default: {self._jump(default, label)}", "}"]
        if word == "store":
            return self._store(operands)
        if word == "ret":
            return ["return;" if operands == "void" else f"return {self._typed(operands)};"]
        if word == "unreachable":
            return [self._nothing]
        if word == "call":
            return [f"{self._call(operands)[1]};"]
        raise unknown(f"{word} {operands}")

    def _jump(self, target: str, label: str) -> str:
        """Return the statements that go from the block `label` to `target`."""
        moves = [
            f"{own}_in = {value};"
            for name, (kind, values) in self._phis[target].items()
            for (own, _), value in zip(self._declare(name, kind), self._values(values[label], kind), strict=True)
        ]
        return " ".join((*moves, f"goto {self._label(target)};"))

    def _store(self, operands: str) -> list[str]:
        """Return the statements that store a value, or each member of a structure."""
        what, where = split(operands)[:2]
        place = self._pointer(where)
        if not what.startswith("{"):
            return [f"store_{suffix_of(what.split()[0])}({place}, {self._typed(what)});"]
        structure, name = split_structure(what)
        offset, lines = 0, []
        for kind, value in zip(split(structure[1:-1]), self._values(name, structure), strict=True):
            offset = -(-offset // size_of(kind)) * size_of(kind)
            lines.append(f"store_{suffix_of(kind)}({place} + {offset}, {value});")
            offset += size_of(kind)
        return lines

    def _insert(self, name: str, operands: str) -> list[str]:
        """Return the statements for a structure of which one member is set."""
        before, member, index = split(operands)
        structure, old = split_structure(before)
        values = self._values(old, structure)
        values[int(index)] = self._typed(member)
        return [f"{own} = {value};" for (own, _), value in zip(self._declare(name, structure), values, strict=True)]

    def _expression(self, word: str, operands: str, name: str) -> tuple[str, str]:
        """Return type and C expression of an instruction with a value."""
        kind, _, more = operands.partition(" ")
        parts = split(operands)
        if word in _OF_FLOATS:
            return kind, f" {_OF_FLOATS[word]} ".join(self._value(part, kind) for part in split(more))
        if word == "fneg":
            return kind, f"-{self._value(more, kind)}"
        if word in _OF_INTEGERS:
            operator, unsigned = _OF_INTEGERS[word]
            if mask := mask_of(kind):
                if not unsigned:
                    raise unknown(f"{word} {operands}")
                return kind, f"({f' {operator} '.join(self._value(part, kind) for part in split(more))}) & {mask:#x}"
            to = f"({'u' if unsigned and kind != 'i1' else ''}{type_in_c(kind)})"
            left, right = (to + self._value(part, kind) for part in split(more))
            if operator in ("<<", ">>"):  # of a shift by more than the width LLVM uses no bit, and C has no such shift
                right = f"({right} & {8 * size_of(kind) - 1})"
            return kind, f"({type_in_c(kind)})({left} {operator} {right})"
        if word in ("icmp", "fcmp"):
            kind, _, more = more.partition(" ")
            return "i1", _compared(operands.split()[0], kind, *(self._value(part, kind) for part in split(more)))
        if word == "select":
            condition, yes, no = parts
            return yes.split()[0], f"{self._typed(condition)} ? {self._typed(yes)} : {self._typed(no)}"
        if word == "load" and (found := re.match(r"atomic i64, (ptr \S+) seq_cst", operands)):
            return "i64", f"__atomic_load_n((int64_t *){self._pointer(found[1])}, __ATOMIC_SEQ_CST)"
        if word == "load":
            return parts[0], f"load_{suffix_of(parts[0])}({self._pointer(parts[1])})"
        if word == "getelementptr" and len(parts) == 3:
            return "ptr", f"{self._pointer(parts[1])} + {self._typed(parts[2])} * {size_of(parts[0])}"
        if word == "alloca":
            memory = f"{self._local(name)}_memory"
            self._variables[f"{memory}[{-(-size_of(parts[0]) // 8)}]"] = "uint64_t"
            return "ptr", f"(char *){memory}"
        if word in _CONVERSIONS:
            return self._converted(word, operands)
        if word == "freeze":
            return kind, self._value(more, kind)
        if word == "call":
            return self._call(operands)
        if word == "atomicrmw" and (found := re.match(r"(add|xchg) (ptr \S+), (i64 \S+) seq_cst", operands)):
            function = {"add": "__atomic_fetch_add", "xchg": "__atomic_exchange_n"}[found[1]]
            return "i64", f"{function}((int64_t *){self._pointer(found[2])}, {self._typed(found[3])}, __ATOMIC_SEQ_CST)"
        raise unknown(f"{word} {operands}")

    def _converted(self, word: str, operands: str) -> tuple[str, str]:
        found = re.match(r"(\w+) (.*) to (\w+)$", operands)
        if not found:
            raise unknown(operands)
        source, text, target = found.groups()
        value = self._value(text, source)
        if word in ("uitofp", "zext") and source in TYPES and source != "i1":
            value = f"(u{type_in_c(source)}){value}"
        if word in ("inttoptr", "ptrtoint"):
            return target, f"({type_in_c(target)})(intptr_t){value}"
        if word == "sext" and source == "i1":
            value = f"-(int){value}"
        if word == "trunc" and (mask := 1 if target == "i1" else mask_of(target)):
            return target, f"{value} & {mask:#x}"
        if mask_of(source) and word in ("sitofp", "sext"):
            raise unknown(f"{word} {operands}")
        return target, f"({type_in_c(target)}){value}"

    def _call(self, operands: str) -> tuple[str, str]:
        """Return type and C expression of a call."""
        found = re.match(rf"(\w+) ({GLOBAL})\((.*)\)", operands)
        if not found:
            raise unknown(f"call {operands}")
        kind, name, given = found.groups()
        arguments = [self._typed(argument) for argument in split(given)]
        if not name.startswith("@llvm."):
            return kind, f"{identifier(name)}({', '.join(arguments)})"
        if name == "@llvm.is.fpclass.f64":
            return kind, _is_of_class(arguments[0], int(split(given)[1].split()[-1]))
        word = name.split(".")[1]
        if word not in _INTRINSICS:
            raise unknown(name)
        if word.startswith("mem"):
            arguments = [*arguments[:2], f"(size_t){arguments[2]}"]  # the fourth says whether the memory is volatile
        return kind, f"{word}({', '.join(arguments)})"


def _is_of_class(value: str, asked: int) -> str:
    """Return the C expression of whether a float is of one of the classes that are `asked` for, bits of LLVM's."""
    found = [(bits, test) for bits, test in _CLASSES.items() if asked & bits]
    if sum(bits for bits, _ in found) != asked:
        raise unknown(f"llvm.is.fpclass {asked}")
    return " || ".join(re.sub(r"\bx\b", value, test) for _, test in found) or "0"


def _compared(predicate: str, kind: str, a: str, b: str) -> str:
    """Return the C expression of a comparison of floats (oeq, une …) or integers and pointers (eq, slt …)."""
    if predicate in _COMPARED:
        return f"{a} {_COMPARED[predicate]} {b}"
    first, rest = predicate[0], predicate[1:]
    if kind != "double":
        if first == "s" and mask_of(kind):
            raise unknown(f"icmp {predicate} {kind}")
        to = f"({'u' if first == 'u' else ''}{type_in_c(kind)})" if kind in TYPES and kind != "ptr" else ""
        return f"{to}{a} {_COMPARED[rest]} {to}{b}"
    if predicate in ("ord", "uno"):
        return f"{'' if predicate == 'ord' else '!'}({a} == {a} && {b} == {b})"
    if predicate in ("oeq", "une"):
        return f"{a} {_COMPARED[rest]} {b}"
    if predicate in ("one", "ueq"):
        return f"{'' if predicate == 'one' else '!'}({a} < {b} || {a} > {b})"
    # `u`: or one of them is not a number
    return f"{a} {_COMPARED[rest]} {b}" if first == "o" else f"!({a} {_OPPOSITE[rest]} {b})"
