"""An error about a number is told with its name, its value and its range, for every member that has a range."""

import ctypes
import math
import re

import numpy as np

import contact
from contact.damage import DamageParameters
from contact.geometry import profile
from contact.kernels.records import CASE, DAMAGE, DAMAGE_PARAMETERS, ELASTIC_RAIL, GIVEN, RESULT, WHEEL_OFFSET
from tests.capi.library import INPUT, LOAD, OPTIONS, PAIR_OPTIONS, Pair, Patch

NOT_FINITE, RANGE = 2, 3
OUTSIDE = re.compile(r" is outside its allowed range ([\[\]])(.+), (.+)([\[\]])$")
Y = np.linspace(-12e-3, 12e-3, 101)
SEPARATION = contact.Separation(Y, 0.8 * Y**2, 1.1)


def explain(library, code, given=None, size=200):
    """Return the code and the line of wr_explain."""
    text = ctypes.create_string_buffer(b"?" * (size + 8), size + 8)
    told = library.call("wr_explain", code, given, text, ctypes.c_size_t(size))
    assert text.raw[size:] == b"?" * 8
    return told, text.value.decode()


def ranges(library):
    """Return the name of each member that has a range → its argument, smallest and largest value, and whether 0 is excluded."""
    found = {}
    for argument in range(1, 400):
        told, line = explain(library, -(100 * argument + RANGE))
        assert told == 0
        name = library.about(-(100 * argument + RANGE))
        if "." not in name or name.startswith("separation"):
            continue
        if match := OUTSIDE.search(line):
            found[name] = argument, float(match[2]), float(match[3]), match[1] == "]" and float(match[2]) == 0.0
        elif line.endswith("is not finite"):
            found[name] = argument, -math.inf, math.inf, False
        elif line.endswith("is neither 1 nor -1"):
            found[name] = argument, -1.0, 1.0, False
    return found


class Doors:
    """For each struct an instance, and the function that takes it."""

    def __init__(self, library):
        self.library = library
        self.pair, self.patch = Pair(library, profile.s1002(), profile.rail_60e1()), Patch(library)
        self.patch.case["amount"], self.result = 80e3, np.zeros(1, RESULT)
        self.separation = self.patch.separation(SEPARATION)
        library.need("wr_contact_solve", self.patch.memory, self.separation, self.patch.case, self.result)
        self.parameters, self.load = np.zeros(1, DAMAGE_PARAMETERS), np.zeros(1, LOAD)
        library.need("wr_damage_default", self.parameters)
        self.numbers = np.zeros(16)
        self.load["size"], self.load["nx"], self.load["ny"] = LOAD.itemsize, 4, 4
        for name in LOAD.names[3:]:
            self.load[name] = self.numbers.ctypes.data
        self.size = ctypes.byref(ctypes.c_size_t())

    def of(self, name):
        """Return the struct in which a member of this name lies, and a function that returns the code for it."""
        first, member, *_ = name.split(".")
        call, patch = self.library.call, self.patch
        if first == "options" and member in OPTIONS.names:
            return patch.options, lambda given: call("wr_contact_size", given, self.size)
        n = ctypes.c_int64(61)
        return {
            "options": (self.pair.options, lambda given: call("wr_pair_size", given, n, n, self.size)),
            "case": (
                patch.case,
                lambda given: call("wr_contact_solve", patch.memory, self.separation, given, self.result),
            ),
            "input": (self.pair.input, lambda given: call("wr_pair_solve", self.pair.memory, given, self.pair.answer)),
            "parameters": (
                self.parameters,
                lambda given: call("wr_contact_damage", patch.memory, given, np.zeros(1, DAMAGE)),
            ),
            "load": (self.load, lambda given: call("wr_contact_surface_load", patch.memory, given)),
        }[first]


def place(given, name):
    """Return the array of one member."""
    for part in name.split(".")[1:]:
        given = given[part]
    return given


def refused(member, low, high, no_zero):
    """Yield values just outside the range and far outside, none that is allowed."""
    if member.dtype == np.int64:
        yield from (int(low) - 1, int(high) + 1, -(2**63), 2**63 - 1)
        return
    yield math.nan
    if no_zero:
        yield 0.0
    yield from (end for end in (np.nextafter(low, -math.inf), -math.inf) if end < low)
    if high < math.inf:
        yield from (np.nextafter(high, math.inf), math.inf)


def test_every_number_outside_its_range_is_told_with_name_value_and_range(library):
    doors, tried = Doors(library), 0
    for name, (argument, low, high, no_zero) in ranges(library).items():
        original, door = doors.of(name)
        values = [*refused(place(original, name), low, high, no_zero)]
        if name == "options.side":
            values.append(0)
        for value in values:
            given = original.copy()
            place(given, name)[0] = value
            code = door(given)
            assert -code // 100 == argument, (name, value, code)
            told, line = explain(library, code, given)
            assert told == 0
            about, equals, rest = line.partition(" = ")
            assert (about, equals) == (name, " = ")
            number, rest = rest.split(" ", 1)
            same = (
                int(number) == value if isinstance(value, int) else np.array_equal(float(number), value, equal_nan=True)
            )
            assert same, line
            assert f"{name} {rest}" == explain(library, code)[1]
            tried += 1
    assert tried > 400


def test_every_number_of_the_structs_has_a_range(library):
    names = {
        *(f"options.{n}" for n in OPTIONS.names),
        *(f"options.{n}" for n in PAIR_OPTIONS.names),
        *(f"options.patch.{n}" for n in OPTIONS.names),
        *(f"{of}.{n}" for of in ("options.damage", "parameters") for n in DAMAGE_PARAMETERS.names),
        *(f"{of}.{n}" for of in ("case", "input.surface") for n in CASE.names),
        *(f"input.{n}" for n in INPUT.names),
        *(f"input.motion.{n}" for n in GIVEN.names),
        *(f"input.rail.{n}" for n in ELASTIC_RAIL.names),
        *(f"input.offset.{n}" for n in WHEEL_OFFSET.names),
    }
    structs = {"options.patch", "options.damage", "input.motion", "input.surface", "input.rail", "input.offset"}
    sizes = {"options.size", "options.patch.size", "input.size"}
    constants = DamageParameters().record(contact.STEEL, 0.46, 20.0).dtype
    arrays = {f"{of}.{n}" for of in ("options.damage", "parameters") for n in constants.names if constants[n].shape}
    by_method = {
        f"{of}.{n}" for of in ("case", "input.surface") for n in ("normal", "normal_family", "tangential_family")
    }
    ignored = {f"input.surface.{n}" for n in ("load_kind", "amount", "vx", "vy", "phi", "rolling")}
    results = {f"input.rail.{n}" for n in ("dy", "dz", "balanced")}
    without = structs | sizes | arrays | by_method | ignored | results
    assert without < names
    assert names - without == {name for name in ranges(library) if not name.startswith("load.")}


def test_other_errors_about_a_member_have_its_value(library):
    doors = Doors(library)
    for name, value, words in (
        ("case.amount", -1.0, "case.amount = -1: a load is not negative"),
        ("case.nu", 0.3, "case.nu = 0.3: the value differs from that of the options"),
        ("case.normal", 99, "case.normal = 99: the value differs"),
        ("input.surface.normal_family", 7, "input.surface.normal_family = 7: the family is not that of the method"),
        ("case.tangential_family", 7, "case.tangential_family = 7: the family is not that of the method"),
    ):
        original, door = doors.of(name)
        given = original.copy()
        place(given, name)[0] = value
        assert explain(library, door(given), given)[1].startswith(words)
    given = doors.pair.input.copy()
    given["height"], given["amount"] = 1, 0.0021
    code = library.call("wr_pair_solve", doors.pair.memory, given, doors.pair.answer)
    assert explain(library, code, given) == (0, "input.amount = 0.0021: a penetration is at most 0.002 m")


def test_another_struct_gives_no_false_value(library):
    doors = Doors(library)
    given = doors.pair.input.copy()
    given["motion"]["yaw"] = 0.2
    code = library.call("wr_pair_solve", doors.pair.memory, given, doors.pair.answer)
    line = "input.motion.yaw = 0.2 is outside its allowed range [-0.1, 0.1]"
    assert explain(library, code, given) == (0, line)
    without = line.replace(" = 0.2", "")
    assert explain(library, code) == (0, without)
    assert explain(library, code, doors.pair.options) == (0, without)  # begins with another size
    assert explain(library, code, doors.pair.input) == (0, without)  # its yaw is allowed


def test_short_and_missing_texts_are_told(library):
    code = -(100 * ranges(library)["case.mu"][0] + RANGE)
    told, line = explain(library, code, size=8)
    assert (library.about(told), line) == ("bytes", "case.mu")
    assert library.about(explain(library, code, size=0)[0]) == "bytes"
    assert library.about(library.call("wr_explain", code, None, None, ctypes.c_size_t(8))) == "text"
    assert library.about(library.call("wr_explain", code, ctypes.c_void_p(4), b"....", ctypes.c_size_t(4))) == "given"


def test_every_code_has_a_line(library):
    for code in (0, 2, 5, -1, -(2**31), 2**31 - 1):
        assert explain(library, code) == (0, library.c.wr_message(code).decode())
    for code in range(-30000, 100, 7):
        assert explain(library, code)[0] == 0
