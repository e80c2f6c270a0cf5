"""IR written as C gives the numbers that LLVM's own compiler gives for the same IR."""

import ctypes
import re
import struct
from itertools import product

import pytest
from llvmlite import binding as llvm

from contact.compile.ir_to_c import as_c
from contact.compile.linking import compiler, run

NUMBERS = (0.0, -0.0, 1.5, -2.25, 1e300, float("inf"), float("-inf"), float("nan"))
INTEGERS = (0, 1, -1, 7, -8, 2**62, -(2**63), 2**63 - 1)
ORDERS = ("eq", "ne", "gt", "ge", "lt", "le")


@pytest.fixture
def both(tmp_path):
    """Return a function that compiles the functions of IR by LLVM and through C, and returns both of each."""
    alive = []

    def compiled(ir, result, *arguments):
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        machine = llvm.Target.from_default_triple().create_target_machine()
        engine = llvm.create_mcjit_compiler(llvm.parse_assembly(ir), machine)
        engine.finalize_object()
        (tmp_path / "f.c").write_text(as_c(ir))
        flags = ("-std=c11", "-pedantic-errors", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-fPIC")
        run(*compiler("linux64"), *flags, "-shared", tmp_path / "f.c", "-o", tmp_path / "f.so", "-lm")
        library = ctypes.CDLL(str(tmp_path / "f.so"))
        alive.extend((engine, library))
        kind = ctypes.CFUNCTYPE(result, *arguments)
        names = re.findall(r"^define \w+ @(\w+)", ir, re.MULTILINE)
        return [(kind(engine.get_function_address(name)), kind((name, library))) for name in names]

    return compiled


DOUBLE, INT = ctypes.c_double, ctypes.c_int64


def _same(a, b):
    return struct.pack("<d", a) == struct.pack("<d", b) or (a != a and b != b)


def _of_numbers(lines, result="double", name="f"):
    return f"define {result} @{name}(double %a, double %b) {{\n{lines}\n}}\n"


def test_operations_on_floats(both):
    lines = "  %r = {} double %a, %b\n  %n = fneg double %r\n  ret double %n"
    operations = ("fadd", "fsub", "fmul", "fdiv")
    ir = "".join(_of_numbers(lines.format(operation), name=f"of_{operation}") for operation in operations)
    for operation, (one, other) in zip(operations, both(ir, DOUBLE, DOUBLE, DOUBLE), strict=True):
        assert all(_same(one(a, b), other(a, b)) for a, b in product(NUMBERS, NUMBERS)), operation


def test_classes_of_floats(both):
    lines = "  %c = call i1 @llvm.is.fpclass.f64(double %a, i32 {})\n  %r = zext i1 %c to i64\n  ret i64 %r"
    asked = (3, 504, 519, 0x204, 0x198, 0x60, 0x3FF, 0x10, 0x80)
    ir = "declare i1 @llvm.is.fpclass.f64(double, i32 immarg)\n"
    ir += "".join(_of_numbers(lines.format(what), "i64", f"is_{what}") for what in asked)
    for what, (one, other) in zip(asked, both(ir, INT, DOUBLE, DOUBLE), strict=True):
        numbers = (*NUMBERS, 5e-324, -1e-310, 2.2250738585072014e-308)
        assert all(one(a, 0.0) == other(a, 0.0) for a in numbers), what


def test_entries_of_linked_kernels_are_declared():
    """A vehicle calls those of the pair. C refuses a call without a declaration."""
    ir = (
        "declare i64 @model_size_any(ptr, ptr) local_unnamed_addr #1\ndeclare double @exp(double)\n"
        "define i64 @f(ptr %a) {\n  %r = call i64 @model_size_any(ptr %a, ptr %a)\n  ret i64 %r\n}\n"
    )
    code = as_c(ir)
    assert "int64_t model_size_any(char *, char *);" in code
    assert "exp(" not in code
    assert code.index("model_size_any(char") < code.index("model_size_any(v_")


def test_comparisons_of_floats_with_nan(both):
    """Each predicate sets a bit of the result."""
    predicates = [first + order for first in "ou" for order in ORDERS] + ["ord", "uno"]
    lines, last = [], "0"
    for i, predicate in enumerate(predicates):
        lines += [f"  %c{i} = fcmp {predicate} double %a, %b", f"  %s{i} = select i1 %c{i}, i64 {1 << i}, i64 0"]
        lines.append(f"  %t{i} = or i64 {last}, %s{i}")
        last = f"%t{i}"
    ir = _of_numbers("\n".join([*lines, f"  ret i64 {last}"]), "i64")
    ((one, other),) = both(ir, INT, DOUBLE, DOUBLE)
    found = {(a, b): one(a, b) for a, b in product(NUMBERS, NUMBERS)}
    assert len(set(found.values())) > 3
    assert all(other(a, b) == bits for (a, b), bits in found.items())


def test_comparisons_of_integers_with_and_without_sign(both):
    predicates = ["eq", "ne", *(first + order for first in "su" for order in ORDERS[2:])]
    lines, last = [], "0"
    for i, predicate in enumerate(predicates):
        lines += [f"  %c{i} = icmp {predicate} i64 %a, %b", f"  %z{i} = zext i1 %c{i} to i64"]
        lines += [f"  %m{i} = shl i64 %z{i}, {i}", f"  %t{i} = xor i64 {last}, %m{i}"]
        last = f"%t{i}"
    ir = "define i64 @f(i64 %a, i64 %b) {\n" + "\n".join([*lines, f"  ret i64 {last}"]) + "\n}\n"
    ((one, other),) = both(ir, INT, INT, INT)
    assert all(one(a, b) == other(a, b) for a, b in product(INTEGERS, INTEGERS))


SHIFTS = ["sdiv", "srem", "udiv", "urem", "ashr", "lshr", "shl"]


def test_operations_on_integers_wrap_and_division_and_shifts_keep_their_sign(both):
    operations = ("add", "sub", "mul", "and", "or", "xor", *SHIFTS)
    define = "define i64 @of_{0}(i64 %a, i64 %b) {{\n  %r = {0} i64 %a, %b\n  ret i64 %r\n}}\n"
    for operation, (one, other) in zip(
        operations, both("".join(map(define.format, operations)), INT, INT, INT), strict=True
    ):
        second = (1, 3, 7, 62) if operation in SHIFTS else INTEGERS
        assert all(one(a, b) == other(a, b) for a, b in product(INTEGERS, second)), operation


def test_phis_of_one_block_swap_their_values(both):
    """Fibonacci's numbers, with two values that change places each time."""
    ir = """define i64 @f(i64 %n) {
entry:
  br label %loop
loop:
  %a = phi i64 [ 0, %entry ], [ %b, %loop ]
  %b = phi i64 [ 1, %entry ], [ %sum, %loop ]
  %i = phi i64 [ 0, %entry ], [ %next, %loop ]
  %sum = add nuw nsw i64 %a, %b
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  switch i64 %a, label %other [
    i64 13, label %lucky
  ]
lucky:
  ret i64 -1
other:
  ret i64 %a
}
"""
    ((one, other),) = both(ir, INT, INT)
    assert [other(n) for n in range(1, 40)] == [one(n) for n in range(1, 40)]
    assert other(11) == 55
    assert other(8) == -1


def test_memory_structures_and_constants(both):
    """A constant with a backslash and a quote among its bytes, a structure that is stored as a whole."""
    ir = """@data = internal constant [16 x i8] c"\\5C\\\\\\22\\00\\00\\00\\00\\00\\9A\\99\\99\\99\\99\\99\\F1?"
define double @f(double %a, i64 %k) {
  %m = alloca { double, i64, i8 }, align 8
  %one = insertvalue { double, i64, i8 } undef, double %a, 0
  %two = insertvalue { double, i64, i8 } %one, i64 %k, 1
  %three = insertvalue { double, i64, i8 } %two, i8 3, 2
  store { double, i64, i8 } %three, ptr %m, align 8
  %p = getelementptr inbounds nuw i8, ptr %m, i64 8
  %k2 = load i64, ptr %p, align 8
  %q = getelementptr i64, ptr %p, i64 1
  %c = load i8, ptr %q, align 8
  %wide = sext i8 %c to i64
  %x = load double, ptr getelementptr inbounds nuw (i8, ptr @data, i64 8), align 8
  %w = load i64, ptr @data, align 8
  %y = sitofp i64 %w to double
  %sum = add i64 %k2, %wide
  %z = uitofp i64 %sum to double
  %s = fadd double %x, %y
  %t = fadd double %s, %z
  %r = call double @llvm.fabs.f64(double %t)
  ret double %r
}
declare double @llvm.fabs.f64(double)
"""
    ((one, other),) = both(ir, DOUBLE, DOUBLE, INT)
    assert other(0.5, 4) == one(0.5, 4) == 1.1 + 0x225C5C + 7.0


def test_structures_that_a_loop_swaps(both):
    ir = """define double @f(i64 %n) {
entry:
  br label %loop
loop:
  %s = phi { i8, double } [ zeroinitializer, %entry ], [ %u, %loop ]
  %i = phi i64 [ 0, %entry ], [ %next, %loop ]
  %k = extractvalue { i8, double } %s, 0
  %x = extractvalue { i8, double } %s, 1
  %d = sitofp i8 %k to double
  %y = fadd double %x, %d
  %k1 = add i8 %k, 1
  %t = insertvalue { i8, double } %s, i8 %k1, 0
  %u = insertvalue { i8, double } %t, double %y, 1
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  ret double %y
}
"""
    ((one, other),) = both(ir, DOUBLE, INT)
    assert [other(n) for n in range(1, 20)] == [one(n) for n in range(1, 20)]
    assert other(5) == 10.0


def test_tables_of_numbers(both):
    """LLVM makes tables of a switch. What it leaves open may be anything."""
    ir = """@t = private unnamed_addr constant [3 x double] [double 1.25e+00, double 0x3FB999999999999A, double poison], align 8
@k = private constant [3 x i64] [i64 5, i64 -6, i64 7], align 8
define double @f(i64 %i) {
  %p = getelementptr inbounds nuw double, ptr @t, i64 %i
  %q = getelementptr inbounds nuw i64, ptr @k, i64 %i
  %x = load double, ptr %p, align 8
  %n = load i64, ptr %q, align 8
  %y = sitofp i64 %n to double
  %r = fadd double %x, %y
  ret double %r
}
"""
    ((one, other),) = both(ir, DOUBLE, INT)
    assert [other(i) for i in (0, 1)] == [one(i) for i in (0, 1)] == [6.25, 0.1 - 6.0]


def test_integers_of_a_width_that_c_has_not(both):
    """LLVM packs small tables into one number, here thirteen bits."""
    ir = """define i64 @f(i64 %i) {
  %n = trunc i64 %i to i13
  %m = and i13 %n, 15
  %s = lshr i13 -2817, %m
  %w = mul i13 %s, %n
  %b = trunc i13 %s to i1
  %c = icmp ugt i13 %w, 100
  %x = zext i13 %w to i64
  %y = select i1 %b, i64 %x, i64 -1
  %h = trunc i64 %i to i16
  %k = ashr i16 %h, 3
  %l = sext i16 %k to i64
  %z = zext i1 %c to i64
  %t = add i64 %y, %z
  %r = xor i64 %t, %l
  ret i64 %r
}
"""
    ((one, other),) = both(ir, INT, INT)
    cases = [i for i in range(-70000, 70000, 37) if i & 15 < 13]
    assert [other(i) for i in cases] == [one(i) for i in cases]


@pytest.mark.parametrize(
    "line",
    [
        "%r = fadd <2 x double> zeroinitializer, zeroinitializer",
        "%r = call double @llvm.fma.f64(double %a, double %a, double %b)",
        "%r = atomicrmw and ptr %p, i64 1 seq_cst",
        "fence seq_cst",
    ],
)
def test_what_c_cannot_say_is_refused_by_name(line):
    with pytest.raises(ValueError, match="cannot be written as C"):
        as_c(_of_numbers(f"  {line}\n  ret double %a"))


def test_a_name_may_contain_a_word_of_the_language(both):
    """Such words are left out elsewhere: `exact` says that a division has no remainder."""
    ir = _of_numbers(
        "  %exact.2.not = fadd double %a, %b\n  %r.exact = fmul double %exact.2.not, %b\n  ret double %r.exact"
    )
    ((one, other),) = both(ir, DOUBLE, DOUBLE, DOUBLE)
    assert all(_same(one(a, b), other(a, b)) for a, b in product(NUMBERS, NUMBERS))
