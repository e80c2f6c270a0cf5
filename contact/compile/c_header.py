"""Write `contact/include/wheelrail_records.h`: ``python -m contact.compile.c_header``.

It has the records, the enumerations and the methods of the C interface. A test compares the file with `header()`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path

import numpy as np

from contact.damage import DamageParameters
from contact.friction import as_friction
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.inputs.material import STEEL
from contact.inputs.options import (
    CURVATURE,
    ITERATIONS,
    LEAST_STEP,
    LENGTH,
    MEMBERS,
    SAMPLES,
    SEPARATION_SAMPLES,
    SURFACE,
    TILT,
    Real,
    Whole,
)
from contact.inputs.plausibility import USUAL
from contact.kernels import records
from contact.kernels.enumerations import FrictionLaw, Height, LoadKind, SlipVelocity, Status, WearLaw
from contact.kernels.given_force import LATERAL, LONGITUDINAL
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
    "pair_input": "wr_pair_input",
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
_TYPES |= {getattr(records, name.upper()): of for name, of in _RECORDS.items()}


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
        "WR_DEFAULT_ITERATIONS": ITERATIONS.usual,
        "WR_LEAST_CURVATURE": CURVATURE.least,
        "WR_LARGEST_CURVATURE": CURVATURE.most,
        "WR_LARGEST_LENGTH": LENGTH.most,
        "WR_LARGEST_TILT": TILT.most,
        "WR_LEAST_STEP": LEAST_STEP,
        "WR_SEPARATION_SAMPLES": _limits(SEPARATION_SAMPLES),
        "WR_PAIR_SAMPLES": _limits(SAMPLES),
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


def _range_in_words(limits: Whole | Real) -> str:
    if (limits.least, limits.most) == (0, 1) and isinstance(limits, Whole):
        return ""
    above = f"above {limits.least:g}" if isinstance(limits, Real) and limits.above else f"from {limits.least:g} on"
    found = above if math.isinf(limits.most) else f"{limits.least:.15g} to {limits.most:.15g}"
    return f"{found}, default {limits.usual:.6g}".replace(", default inf", "")


#: Options of the C interface → their members in order: what each is. `MEMBERS` has default and range of most.
_OPTIONS = {
    "contact_options": {
        "normal": "WR_NORMAL_...",
        "tangential": "WR_TANGENTIAL_...",
        "n_strips": "per patch",
        "n_elements": "per strip",
        "n_samples": f"most of a separation, {_range_in_words(SEPARATION_SAMPLES)}; of a pair's patches "
        + _range_in_words(SAMPLES),
        "max_iterations": "of the strip half space",
        "conformal": "1: the contact angle varies over the patch",
        "shear_modulus": "[Pa]",
        "poisson_ratio": "[-]",
        "pressure_limit": "[Pa]; 0 or infinity: none",
    },
    "pair_options": {
        "patch": "methods, resolution and material",
        "side": "1: right, -1: left",
        "most_patches": "",
        "wheel_radius": "at the tape circle [m]",
        "gauge": "[m]",
        "flange_back": "distance of the flange backs [m]",
        "gauge_point": "depth below the top of the rail at which the gauge is measured [m]",
        "combine_distance": "lobes that are nearer than this [m], or",
        "combine_angle": "whose angles differ by less [rad], share one patch",
        "n_bins": "bins on each profile in which damage adds up; 0: none",
        "bin_start": "arc length where the first bin begins [m]",
        "bin_width": "[m]",
        "damage": "",
        "reach": "surfaces: distance before and behind the axle that is searched [m]",
        "tilted": "surfaces: 1 if the frame of a patch follows the rail's normal in all directions, 0 if it turns about x",
        "reference_speed": "speed below which creepages refer to it [m/s]",
    },
}
_STRUCTS = {"patch": "wr_contact_options", "damage": "wr_damage_parameters"}


def _options(name: str, members: dict[str, str]) -> str:
    """Return the struct of options. `wr_…_default` sets its size and the defaults."""
    lines = [f"    int64_t size; /* sizeof(wr_{name}), set by wr_{name.removesuffix('_options')}_default */"]
    for member, meaning in members.items():
        limits = MEMBERS[name].get(member)
        kind = _STRUCTS.get(member) or ("double" if isinstance(limits, Real) else "int64_t")
        about = "; ".join(filter(None, (meaning, limits and _range_in_words(limits))))
        lines.append(f"    {kind} {member};" + (f" /* {about} */" if about else ""))
    return "typedef struct {\n" + "\n".join(lines) + f"\n}} wr_{name};"


def _ranges() -> str:
    """Return lists of the members that the functions check, each with its range and default."""
    lists = []
    of_case = {name: limits for name, limits in MEMBERS["case"].items() if name not in SURFACE}
    for name, members in {"surface": SURFACE, **MEMBERS, "case": of_case}.items():
        rows = " \\\n".join(
            f"    M({member}, {_kind(limits)}, {_limits(limits)}, __VA_ARGS__)" for member, limits in members.items()
        )
        lists.append(f"#define WR_{name.upper()}_RANGES(M, ...) \\\n{rows}")
    return "/* M(member, kind, least, most, default, ...): ranges of the numbers that a caller gives. */\n" + "\n".join(
        lists
    )


def _limits(limits: Whole | Real) -> str:
    """Return the least, the greatest and the usual value, as the lists of members have them."""
    return f"{limits.least!r}, {limits.most!r}, {limits.usual!r}"


def _kind(limits: Whole | Real) -> str:
    if isinstance(limits, Whole):
        return "WHOLE"
    if limits.above:
        return "POSITIVE"
    return "LIMIT" if limits.endless else "REAL"


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
    structs = "\n\n".join(
        [*(_record(name, of) for name, of in _RECORDS.items()), *(_options(*each) for each in _OPTIONS.items())]
    )
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

{_ranges()}

{_doubts()}

#endif
"""
    return re.sub(r"\binf\b(?=[,} ])(?=[^*]*\\\n)", "INFINITY", text)


if __name__ == "__main__":
    PATH.write_text(header())
