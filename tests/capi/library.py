"""The library by ctypes, with numpy records as its structs."""

import ctypes
from pathlib import Path

import numpy as np

from contact.compile.c_header import header  # noqa: F401 - the tests of the header use it
from contact.kernels.records import CASE, CONTACT, DAMAGE_PARAMETERS, ELASTIC_RAIL, GIVEN, TOTAL, WHEEL_OFFSET

ROOT = Path(__file__).parents[2]


def _struct(*members):
    return np.dtype([(name, *kind) if isinstance(kind, tuple) else (name, kind) for name, kind in members], align=True)


_INTEGERS = ("size", "normal", "tangential", "n_strips", "n_elements", "n_samples", "max_iterations", "conformal")
OPTIONS = _struct(
    *((n, np.int64) for n in _INTEGERS), *((n, float) for n in ("shear_modulus", "poisson_ratio", "pressure_limit"))
)
SEPARATION = _struct(*((n, np.int64) for n in ("n", "y", "g", "A", "x_c", "tilt")))
SURFACE = _struct(*((n, np.int64) for n in ("n", "numbers")))
PROFILE = _struct(*((n, np.int64) for n in ("n", "y", "z", "angle")))
_FIELDS = ("x", "y", "p", "qx", "qy", "sx", "sy", "stick")
FIELDS = _struct(*((n, np.int64) for n in ("size", "n_strips_most", "n_strips", *_FIELDS)))
LOAD = _struct(*((n, np.int64) for n in ("size", "nx", "ny", "x", "y", "p", "qx", "qy")))
_LENGTHS = ("wheel_radius", "gauge", "flange_back", "gauge_point", "combine_distance", "combine_angle")
PAIR_OPTIONS = _struct(
    ("size", np.int64), ("patch", OPTIONS), ("side", np.int64), ("most_patches", np.int64),
    *((n, float) for n in _LENGTHS),
    ("n_bins", np.int64), ("bin_start", float), ("bin_width", float), ("damage", DAMAGE_PARAMETERS),
    ("reach", float), ("tilted", np.int64), ("reference_speed", float),
)  # fmt: skip
INPUT = _struct(
    ("size", np.int64), ("height", np.int64), ("amount", float), ("motion", GIVEN), ("surface", CASE),
    ("rail", ELASTIC_RAIL), ("offset", WHEEL_OFFSET), ("distance", float), ("station", float), ("rotation", float),
)  # fmt: skip
ANSWER = _struct(
    ("size", np.int64), ("total", TOTAL), ("patches", (CONTACT, (4,))), ("deflection_y", float), ("deflection_z", float)
)


def pointer(array):
    return None if array is None else ctypes.c_void_p(array.ctypes.data)


class Library:
    def __init__(self, folder):
        self.c = ctypes.CDLL(str(folder / "libwheelrail.so"))
        for name in ("wr_message", "wr_argument", "wr_doubt"):
            getattr(self.c, name).restype = ctypes.c_char_p

    def call(self, name, *arguments):
        """Call a function; arrays are passed by address. Return its code."""
        given = [pointer(a) if isinstance(a, np.ndarray) else a for a in arguments]
        return getattr(self.c, name)(*given)

    def need(self, name, *arguments):
        """Call a function that must succeed."""
        code = self.call(name, *arguments)
        assert code >= 0, (name, self.c.wr_argument(code), self.c.wr_message(code))
        return code

    def about(self, code):
        return self.c.wr_argument(code).decode()


def memory_of(n):
    block = np.zeros(n // 8 + 8)
    first = -(block.ctypes.data // 8) % 8
    return block[first : first + n // 8]


class Patch:
    def __init__(self, library, **options):
        self.library, self.options, self.case = library, np.zeros(1, OPTIONS), np.zeros(1, CASE)
        library.need("wr_contact_default", self.options)
        for name, value in options.items():
            self.options[name] = value
        size = ctypes.c_size_t()
        library.need("wr_contact_size", self.options, ctypes.byref(size))
        self.memory = memory_of(size.value)
        library.need("wr_contact_init", self.options, self.memory, size)
        library.need("wr_contact_case", self.options, ctypes.c_double(0.3), ctypes.c_double(20.0), self.case)

    def separation(self, sep):
        made = np.zeros(1, SEPARATION)
        made["n"] = sep.y.size
        for name in ("y", "g", "A", "x_c", "tilt"):
            made[name] = getattr(sep, name).ctypes.data
        return made


def _surface(numbers):
    made = np.zeros(1, SURFACE)
    made["n"], made["numbers"] = numbers.size, numbers.ctypes.data
    return made


class Pair:
    """A pair on profiles; on surfaces if `wheel` and `rail` are arrays of numbers."""

    def __init__(self, library, wheel, rail, angles=True, load=80e3, **options):
        self.library, self.options, self.input = library, np.zeros(1, PAIR_OPTIONS), np.zeros(1, INPUT)
        self.answer = np.zeros(1, ANSWER)
        self.answer["size"] = ANSWER.itemsize
        library.need("wr_pair_default", self.options)
        for name, value in options.items():
            self.options[name] = value
        size = ctypes.c_size_t()
        if isinstance(wheel, np.ndarray):
            bodies, end = [_surface(wheel), _surface(rail)], "_surfaces"
            counts = bodies
        else:
            bodies, end = [self._profile(given, angles) for given in (wheel, rail)], ""
            counts = [ctypes.c_int64(given.y.size) for given in (wheel, rail)]
        library.need(f"wr_pair_size{end}", self.options, *counts, ctypes.byref(size))
        self.memory = memory_of(size.value)
        library.need(f"wr_pair_init{end}", self.options, *bodies, self.memory, size)
        values = (ctypes.c_double(value) for value in (0.3, 20.0, load))
        library.need("wr_pair_input_default", self.options, *values, self.input)

    @staticmethod
    def _profile(given, angles):
        made = np.zeros(1, PROFILE)
        made["n"], made["y"], made["z"] = given.y.size, given.y.ctypes.data, given.z.ctypes.data
        made["angle"] = given.angle.ctypes.data if angles else 0
        return made

    def solve(self):
        return self.library.need("wr_pair_solve", self.memory, self.input, self.answer)
