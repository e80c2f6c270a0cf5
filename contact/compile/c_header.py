"""Write `contact/include/wheelrail_records.h`: ``python -m contact.compile.c_header``.

It has the records, the enumerations and the methods of the C interface. A test compares the file with `header()`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path

import numpy as np

from contact.damage import DamageParameters
from contact.friction import as_friction
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.inputs.material import STEEL
from contact.inputs.plausibility import USUAL
from contact.kernels import records
from contact.kernels.enumerations import FrictionLaw, Height, LoadKind, SlipVelocity, Status, WearLaw
from contact.kernels.given_force import LATERAL, LONGITUDINAL
from contact.kernels.normal.strip_halfspace import MAX_ITERATIONS
from contact.kernels.records import MOTION
from contact.kernels.rows import Bin, Field, Strip
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, methods
from contact.results import ANSWERS

PATH = Path(__file__).parents[2] / "contact" / "include" / "wheelrail_records.h"
#: Record of `contact.kernels.records` → name in C.
_RECORDS = {
    "case": "wr_case",
    "result": "wr_result",
    "given": "wr_motion",
    "elastic_rail": "wr_elastic_rail",
    "wheel_offset": "wr_wheel_offset",
    "contact": "wr_patch",
    "damage": "wr_damage",
    "total": "wr_total",
    "damage_parameters": "wr_damage_parameters",
}
_ENUMERATIONS = {
    LoadKind: "WR_BY",
    Height: "WR_HEIGHT",
    Status: "WR_STATUS",
    FrictionLaw: "WR_FRICTION",
    SlipVelocity: "WR_VELOCITY",
    WearLaw: "WR_WEAR",
}
_TYPES = {np.dtype(np.float64): "double", np.dtype(np.int64): "int64_t"}


def _enumeration(kind: type[IntEnum], prefix: str) -> str:
    about = (kind.__doc__ or "").splitlines()[0]
    values = "\n".join(f"    {prefix}_{value.name} = {int(value)}," for value in kind)
    return f"/* {about} */\nenum {{\n{values}\n}};"


def _record(name: str, of: str) -> str:
    dtype = getattr(records, name.upper())
    members = "\n".join(_members(name, dtype))
    size = f'_Static_assert(sizeof({of}) == {dtype.itemsize}, "{of}");'  # all members are of 8 bytes, so none can move
    checks = f"#if defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L\n{size}\n#endif"
    return f"typedef struct {{\n{members}\n}} {of};\n{checks}"


def _members(name: str, dtype: np.dtype) -> Iterator[str]:
    for member, (kind, *_) in _fields(dtype):
        base, shape = kind.subdtype or (kind, ())
        meaning = records.MEANING[name][member]
        extent = "".join(f"[{n}]" for n in shape)
        yield f"    {_TYPES[base]} {member}{extent};" + (f" /* {meaning} */" if meaning else "")


def _fields(dtype: np.dtype) -> Iterator[tuple[str, tuple]]:
    assert dtype.fields is not None
    return ((name, dtype.fields[name]) for name in dtype.names or ())


def _methods() -> str:
    kinds = []
    for kind, known in methods().batched._asdict().items():
        prefix = f"WR_{kind.upper()}"
        values = "\n".join(f"    {prefix}_{name.upper()} = {int(method.id)}," for name, method in known.items())
        kinds.append(f"/* Methods of the {kind} problem. */\nenum {{\n{values}\n}};")
        rows = " \\\n".join(
            f'    X({int(m.id)}, "{name}", {int(m.family)}, {int(m.interacting)}, {int(m.fields)})'
            for name, m in known.items()
        )
        kinds.append(
            f"/* X(number, name, family, strips interact, has fields) */\n#define {prefix}_METHODS(X) \\\n{rows}"
        )
    return "\n\n".join(kinds)


def _constants() -> str:
    motion = MOTION.names or ()
    constants = {
        "WR_MAX_PATCHES": records.MAX_PATCHES,
        "WR_DEFAULT_NORMAL": f"WR_NORMAL_{DEFAULT_NORMAL.upper()}",
        "WR_DEFAULT_TANGENTIAL": f"WR_TANGENTIAL_{DEFAULT_TANGENTIAL.upper()}",
        "WR_LARGEST_CREEPAGE": records.LARGEST_CREEPAGE,
        "WR_SLOWEST": records.SLOWEST,
        "WR_LARGEST_ANGLE": records.LARGEST_ANGLE,
        "WR_LARGEST_RAIL_ROLL": records.LARGEST_RAIL_ROLL,
        "WR_FORCE_X": LONGITUDINAL,
        "WR_FORCE_Y": LATERAL,
        "WR_BIN_ROWS": len(Bin),
        "WR_STRIP_ROWS": len(Strip),
        "WR_MOTION_NUMBERS": len(motion),
        **{f"WR_MOTION_{n.upper()}": motion.index(n) for n in _MOTION_CONSTANTS},
        **{f"WR_STRIP_{Strip(row).name}": int(row) for row in (Strip.Y, Strip.DY, Strip.PATCH, Strip.A, Strip.P0)},
        **{f"WR_FIELD_{row.name}": int(row) for row in Field},
        "WR_DEFAULT_ITERATIONS": MAX_ITERATIONS,
        "WR_TAPE_FROM_FLANGE_BACK": TAPE_FROM_FLANGE_BACK,
        "WR_STEEL_SHEAR_MODULUS": repr(STEEL.shear_modulus),
        "WR_STEEL_POISSON_RATIO": repr(STEEL.poisson_ratio),
        "WR_STEEL_HARDNESS": repr(STEEL.hardness),
        "WR_STEEL_SHEAR_YIELD": repr(STEEL.shear_yield),
    }
    return "\n".join(f"#define {name} {value}" for name, value in constants.items())


#: Members of MOTION that an options struct sets.
_MOTION_CONSTANTS = (
    "radius",
    "tape",
    "combine_distance",
    "combine_angle",
    "most_patches",
    "mirror",
    "reach",
    "tilted",
    "slowest",
)


def _damage_defaults() -> str:
    made = DamageParameters().record(STEEL, 1.0, 1.0)
    values = []
    for name in made.dtype.names or ():
        value = made[name]
        values.append("{" + ", ".join(repr(float(v)) for v in value) + "}" if value.shape else repr(value.item()))
    text = ", \\\n    ".join(values)
    about = "/* Damage constants of `contact.damage.DamageParameters()` for steel. */"
    return f"{about}\n#define WR_DAMAGE_DEFAULTS {{ \\\n    {text} }}"


def _surface_defaults() -> str:
    members = as_friction(0.0).members()
    rows = " \\\n".join(f"    X({name}, {value!r})" for name, value in members.items() if name not in ("mu", "kinetic"))
    return f"/* X(member of wr_case, value without a friction law) */\n#define WR_SURFACE_DEFAULTS(X) \\\n{rows}"


def _doubts() -> str:
    """Return the rules of `contact.inputs.plausibility` as bits, with their limits and texts."""
    every = {**USUAL, **ANSWERS}
    names = {name: re.sub(r"\W", "_", name).upper() for name in every}
    values = "\n".join(f"    WR_DOUBT_{c_name} = {1 << k}," for k, c_name in enumerate(names.values()))
    rows = " \\\n".join(
        f'    X({names[name]}, "{name}", {usual.largest!r}, {usual.least!r}, "{usual.hint}")'
        for name, usual in every.items()
    )
    return (
        f"/* Values that no wheel on a rail has, and answers that leave something out. */\nenum {{\n{values}\n}};\n\n"
        f"/* X(name, its text, largest and least usual magnitude, what is usual) */\n#define WR_DOUBTS(X) \\\n{rows}"
    )


def header() -> str:
    """Return the text of the header."""
    enumerations = "\n\n".join(_enumeration(kind, prefix) for kind, prefix in _ENUMERATIONS.items())
    structs = "\n\n".join(_record(name, of) for name, of in _RECORDS.items())
    text = f"""/* Generated by contact/compile/c_header.py. Do not edit. All units are SI. */
#ifndef WHEELRAIL_RECORDS_H
#define WHEELRAIL_RECORDS_H
#include <stddef.h>
#include <stdint.h>

{_constants()}

{enumerations}

{_methods()}

{structs}

{_damage_defaults()}

{_surface_defaults()}

{_doubts()}

#endif
"""
    return re.sub(r"\binf\b(?=[,} ])(?=[^*]*\\\n)", "INFINITY", text)


if __name__ == "__main__":
    PATH.write_text(header())
