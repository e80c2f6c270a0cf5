"""C that a variable table becomes: model.h and model.c, which the wrapper in `c/` is compiled with."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence

from fmu_src.variables import Causality, Kind, Scalar, Table

_KINDS = {Kind.REAL: "REAL", Kind.INTEGER: "INTEGER", Kind.ENUMERATION: "ENUMERATION"}
_ROLES = {Causality.PARAMETER: "PARAMETER", Causality.INPUT: "INPUT", Causality.OUTPUT: "OUTPUT"}


def header(table: Table, guid: str, warnings: Mapping[int, str], totals: Mapping[str, Sequence[str]]) -> str:
    """model.h: sizes, the guid and the value reference of the first scalar of every row."""
    parameters = sum(s.row.causality is Causality.PARAMETER for s in table.scalars)
    if any(s.row.causality is not Causality.PARAMETER for s in table.scalars[:parameters]):
        raise ValueError(f"{table.name}: the parameters must come first, the wrapper compares them in one piece")
    references = "\n".join(f"    {c_name(row.name)} = {table.span[row.name].start}," for row in table.rows)
    return f"""/* Made from the variable table of {table.name}. */
#ifndef MODEL_H
#define MODEL_H
#define MODEL_GUID "{guid}"
#define N_VALUES {len(table.scalars)}
#define N_PARAMETERS {parameters}
#define N_STATUS {max(warnings)}
#define N_TOTALS {len(totals)}
enum {{
{references}
}};
#endif
"""


def body(table: Table, warnings: Mapping[int, str], lazy: Sequence[str], totals: Mapping[str, Sequence[str]]) -> str:
    """model.c: the table with its starts and ranges, what is logged for a status, what adds up."""
    rows = "\n".join(f"    {_variable(scalar, scalar.row.name in lazy)}," for scalar in table.scalars)
    messages = ", ".join(_string(warnings[i]) if i in warnings else "NULL" for i in range(max(warnings) + 1))
    sums = ", ".join(
        f"{{{c_name(total)}, {c_name(rates[0])}, {c_name(rates[1]) if len(rates) > 1 else 'ALONE'}}}"
        for total, rates in totals.items()
    )
    return f"""/* Made from the variable table of {table.name}. */
#include <math.h>
#include <stddef.h>

#include "instance.h"

const Variable variables[N_VALUES] = {{
{rows}
}};
const char *const status_warnings[N_STATUS + 1] = {{{messages}}};
const Total totals[N_TOTALS] = {{{sums}}};
"""


def c_name(row: str) -> str:
    """Enumerator of a row: geometry.kind → V_geometry_kind."""
    return "V_" + row.replace(".", "_")


def _variable(scalar: Scalar, lazy: bool) -> str:
    row = scalar.row
    role = "STATE" if row.causality is Causality.OUTPUT and row.start is not None else _ROLES[row.causality]
    flags = f"{str(lazy).lower()}, {str(row.open_minimum).lower()}"
    numbers = ", ".join(_number(x) for x in (scalar.first, scalar.minimum, scalar.maximum))
    return f"{{{_string(scalar.name)}, {_KINDS[row.kind]}, {role}, {flags}, {numbers}}}"


def _number(value: float) -> str:
    if math.isinf(value):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return float(value).hex()


def _string(text: str) -> str:
    return json.dumps(text)
