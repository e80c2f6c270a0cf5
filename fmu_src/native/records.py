"""Write records.h: `contact.kernels.records` and `contact.kernels.enumerations` in C.

Kernels, Python and C share memory with one definition. The header asserts sizes and offsets, so each build of an FMU proves
that the platform's C compiler lays out records as numpy does.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import IntEnum

import numpy as np

from contact.kernels import enumerations, records

#: All enumerations, in the order of their definition.
ENUMERATIONS: tuple[type[IntEnum], ...] = tuple(
    kind for kind in vars(enumerations).values() if isinstance(kind, type) and issubclass(kind, IntEnum) and list(kind)
)
_CONSTANTS = ("MAX_PATCHES", "MAX_LOBES", "LARGEST_CREEPAGE")
_TYPES = {np.dtype(np.float64): "double", np.dtype(np.int64): "int64_t"}


def header() -> str:
    """Return the text of records.h."""
    constants = "\n".join(f"#define CONTACT_{name} {getattr(records, name)!r}" for name in _CONSTANTS)
    enumerations = "\n\n".join(map(_enumeration, ENUMERATIONS))
    structs = "\n\n".join(_record(name, dtype) for name, dtype in RECORDS.items())
    return f"""/* Generated from contact/kernels/records.py and enumerations.py. */
#ifndef RECORDS_H
#define RECORDS_H
#include <stddef.h>
#include <stdint.h>

{constants}

{enumerations}

{structs}

#endif
"""


def enumerator(value: int) -> str:
    """Return the C name of an enumeration member: Status.OK → CONTACT_STATUS_OK. A plain number stays a number."""
    if isinstance(value, ENUMERATIONS):
        return f"{c_name(type(value).__name__).upper()}_{value.name}"
    return str(int(value))


def c_name(name: str) -> str:
    """Return the C name of a type: LoadKind → contact_load_kind, case → contact_case."""
    return "contact_" + re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


#: Record → its numpy type, in the order of the definition.
RECORDS: dict[str, np.dtype] = {name: getattr(records, name.upper()) for name in records.MEANING}


def _enumeration(kind: type[IntEnum]) -> str:
    about = (kind.__doc__ or "").splitlines()[0]
    values = "\n".join(f"    {enumerator(value)} = {int(value)}," for value in kind)
    return f"/* {about} */\nenum {c_name(kind.__name__)} {{\n{values}\n}};"


def _record(name: str, dtype: np.dtype) -> str:
    of = c_name(name)
    members = "\n".join(_members(name, dtype))
    asserts = [f'_Static_assert(sizeof({of}) == {dtype.itemsize}, "{of}");']
    for member, (_, offset, *_) in _fields(dtype):
        asserts.append(f'_Static_assert(offsetof({of}, {member}) == {offset}, "{of}.{member}");')
    return f"typedef struct {{\n{members}\n}} {of};\n" + "\n".join(asserts)


def _members(name: str, dtype: np.dtype) -> Iterator[str]:
    for member, (kind, *_) in _fields(dtype):
        base, shape = kind.subdtype or (kind, ())
        meaning = records.MEANING[name][member]
        extent = "".join(f"[{n}]" for n in shape)
        yield f"    {_TYPES[base]} {member}{extent};" + (f" /* {meaning} */" if meaning else "")


def _fields(dtype: np.dtype) -> Iterator[tuple[str, tuple]]:
    """Yield (name, (type, offset)) of each member."""
    assert dtype.fields is not None
    return ((name, dtype.fields[name]) for name in dtype.names or ())
