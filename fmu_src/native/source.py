"""C that a variable table becomes: model.h and model.c, which the wrapper in `c/` is compiled with."""

from __future__ import annotations

import json
import math

from fmu_src.native.component import Component
from fmu_src.variables import Causality, Kind, Scalar, Variable

_KINDS = {Kind.REAL: "REAL", Kind.INTEGER: "INTEGER", Kind.ENUMERATION: "ENUMERATION"}


def header(component: Component, guid: str) -> str:
    """model.h: sizes, the guid and the value reference of the first scalar of every row."""
    table = component.table
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
#define N_STATES {len(table.states)}
#define N_MESSAGES {max([0, *component.warnings, *component.failures])}
#define N_TOTALS {len(component.totals)}
enum {{
{references}
}};
#endif
"""


def body(component: Component) -> str:
    """model.c: the table with its starts and ranges, its continuous states, what the model may say, what adds up."""
    table = component.table
    rows = "\n".join(f"    {_variable(scalar, component)}," for scalar in table.scalars)
    states = ", ".join(
        f"{{{c_name(state.name)}, {c_name(derivative.name)}, {_number(state.nominal or 1.0)}}}"
        for state, derivative in zip(table.states, table.derivatives, strict=True)
    )
    texts = {i: f"{{LOG_WARNING, {_string(text)}}}" for i, text in component.warnings.items()}
    texts |= {i: f"{{LOG_DISCARD, {_string(text)}}}" for i, text in component.failures.items()}
    messages = ", ".join(texts.get(i, "{0}") for i in range(max([0, *texts]) + 1))
    sums = ", ".join(
        f"{{{c_name(total)}, {c_name(rates[0])}, {c_name(rates[1]) if len(rates) > 1 else 'ALONE'}}}"
        for total, rates in component.totals.items()
    )
    return f"""/* Made from the variable table of {table.name}. */
#include <math.h>
#include <stddef.h>

#include "instance.h"

const Variable variables[N_VALUES] = {{
{rows}
}};
const Continuous states[N_STATES] = {{{states}}};
const Message messages[N_MESSAGES + 1] = {{{messages}}};
const Total totals[N_TOTALS] = {{{sums}}};
"""


def c_name(row: str) -> str:
    """Enumerator of a row: geometry.kind → V_geometry_kind."""
    return "V_" + row.replace(".", "_")


def _variable(scalar: Scalar, component: Component) -> str:
    row = scalar.row
    flags = f"{str(row.name in component.lazy).lower()}, {str(row.open_minimum).lower()}"
    numbers = ", ".join(_number(x) for x in (scalar.first, scalar.minimum, scalar.maximum))
    return f"{{{_string(scalar.name)}, {_KINDS[row.kind]}, {_role(row, component)}, {flags}, {numbers}}}"


def _role(row: Variable, component: Component) -> str:
    if row in component.table.states:
        return "STATE"
    return "TOTAL" if row.name in component.totals else row.causality.name


def _number(value: float) -> str:
    if math.isinf(value):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return float(value).hex()


def _string(text: str) -> str:
    return json.dumps(text)
