"""Generate C code from a variable table: model.h, model.c and records.h. The wrapper in `c/` is compiled with them."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Iterable, Iterator
from pathlib import Path

from fmu_src.description_fmi3 import value_references
from fmu_src.native import records
from fmu_src.native.component import Component
from fmu_src.variables import Causality, Scalar, Table, Variable, identifier

#: Ends of the names of the files of kernels in C and of their data. Their names for each other are in kernels.h.
_KERNELS = ("data.c", "kernels.c")


def write(component: Component, guid: str, folder: Path, *, kernels_in_c: bool = False) -> list[Path]:
    """Write model.h, model.c and records.h into a folder. Return their paths."""
    texts = {
        "records.h": records.header(),
        "model.h": header(component, guid, kernels_in_c=kernels_in_c),
        "model.c": body(component),
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return [folder / name for name in texts]


def write_whole(component: Component, guid: str, others: Iterable[Path], folder: Path) -> list[Path]:
    """Write all that a C compiler needs into a new folder: these files, and copies of the others. Return the paths.

    All names that one file uses of another begin with the name of the FMU, so that several can be linked into one program.
    """
    folder.mkdir()
    written = write(component, guid, folder, kernels_in_c=True)
    names = {path.name for path in written}
    copies = [Path(shutil.copy(path, folder)) for path in others if path.name not in names]
    for path in copies:
        if path.name.endswith(_KERNELS):
            path.write_text('#include "kernels.h"\n' + path.read_text(encoding="utf-8"), encoding="utf-8")
    return [*written, *copies]


def header(component: Component, guid: str, *, kernels_in_c: bool = False) -> str:
    """Return model.h: sizes, the guid, and the value references of fields, of time and of the first scalar of every row."""
    table = component.table
    parameters = sum(s.row.causality is Causality.PARAMETER for s in table.scalars)
    if any(s.row.causality is not Causality.PARAMETER for s in table.scalars[:parameters]):
        raise ValueError(
            f"{table.name}: the parameters must come first, because the wrapper compares them as one block"
        )
    accumulated = sum(table.row[name].size for name in component.accumulated)
    if tuple(row.name for row in table.rows)[len(table.rows) - len(component.accumulated) :] != component.accumulated:
        raise ValueError(
            f"{table.name}: the rows that accumulate must come last, because they are not part of the values"
        )
    accumulates = f"((values)[{c_name(component.accumulates)}] > 1.0)" if accumulated else "false"
    references = "\n".join(f"    {c_name(name)} = {reference}," for name, reference in value_references(table).items())
    return f"""/* Generated from the variable table of {table.name}. */
#ifndef MODEL_H
#define MODEL_H
{"#define KERNELS_IN_C" if kernels_in_c else "/* The kernels are objects. */"}
#define MODEL_GUID "{guid}"
#define OWN(name) {table.name}_##name
#define ENTRY(name, cpu) {component.prefix}_##name##_##cpu
#define N_VALUES {len(table.scalars) - accumulated}
#define N_ACCUMULATED {accumulated}
#define ACCUMULATES(values) {accumulates}
#define N_PARAMETERS {parameters}
#define N_STATES {len(table.states)}
#define N_MESSAGES {int(max([0, *component.warnings, *component.failures]))}
#define N_TOTALS {len(component.totals)}
#define N_CHOICES {sum(row.is_given for row in table.twins)}
#define N_MIRRORS {sum(not row.is_given for row in table.twins)}
#define N_FIELDS {len(table.fields)}
#define N_RESOURCES {len(component.resources)}
#define FIELD_SIZE(values) {_field_size(table)}
enum {{
{references}
}};
#endif
"""


def body(component: Component) -> str:
    """Return model.c: the table with start values and ranges, the continuous states, the messages and the totals."""
    table = component.table
    rows = [_variable(scalar, first, component) for row in table.rows for first, scalar in _marked(row.scalars())]
    nothing = "false, false, 0.0, 0.0, 0.0, {{0, 0u}}"
    rows += [f"{{{_string(row.name)}, {row.kind.name}, FIELD, 0, {nothing}}}" for row in table.fields]
    rows += [f'{{"time", REAL, TIME, 1, {nothing}}}']
    listed = "\n".join(f"    {row}," for row in rows)
    states = ", ".join(
        f"{{{c_name(state.name)}, {c_name(derivative.name)}, {_number(state.nominal or 1.0)}}}"
        for state, derivative in zip(table.states, table.derivatives, strict=True)
    )
    texts = {i: f"{{LOG_WARNING, {_string(text)}}}" for i, text in component.warnings.items()}
    texts |= {i: f"{{LOG_DISCARD, {_string(text)}}}" for i, text in component.failures.items()}
    messages = ", ".join(f"[{records.enumerator(i)}] = {text}" for i, text in texts.items())
    sums = ", ".join(
        f"{{{c_name(total)}, {c_name(rates[0])}, {c_name(rates[1]) if len(rates) > 1 else 'ALONE'}}}"
        for total, rates in component.totals.items()
    )
    choices, mirrors = (
        ", ".join(f"{{{c_name(row.name)}, {c_name(row.twin_of)}}}" for row in table.twins if row.is_given is given)
        for given in (True, False)
    )
    files = ", ".join(
        f"{{{_string(file.name)}, {_string(file.magic.rstrip(bytes(1)).decode())}, {file.rows}, {file.most}}}"
        for file in component.resources
    )
    return f"""/* Generated from the variable table of {table.name}. */
#include <math.h>
#include <stddef.h>

#include "instance.h"
#include "records.h"

const Variable variables[N_VALUES + N_ACCUMULATED + N_FIELDS + 1] = {{
{listed}
}};
const Continuous states[N_STATES] = {{{states}}};
const Message messages[N_MESSAGES + 1] = {{{messages}}};
const Total totals[N_TOTALS] = {{{sums}}};
const Twin choices[N_CHOICES] = {{{choices}}};
const Twin mirrors[N_MIRRORS] = {{{mirrors}}};
const Resource resources[N_RESOURCES] = {{{files}}};
"""


def c_name(row: str) -> str:
    """Return the enumerator of a row: geometry.kind → V_geometry_kind."""
    return "V_" + identifier(row)


def _marked(scalars: Iterable[Scalar]) -> Iterator[tuple[bool, Scalar]]:
    """Yield (whether the scalar is the first of its row, scalar)."""
    return ((i == 0, scalar) for i, scalar in enumerate(scalars))


def _variable(scalar: Scalar, first: bool, component: Component) -> str:
    row = scalar.row
    kind = "COUNT" if row.name in component.table.structural else row.kind.name
    size = row.size if first else 0
    flags = f"{str(row.name in component.lazy).lower()}, {str(row.open_minimum).lower()}"
    numbers = ", ".join(_number(x) for x in (scalar.first, scalar.minimum, scalar.maximum))
    used = ", ".join(_use(component.table, name, items) for name, items in row.used.items()) or "{0, 0u}"
    return f"{{{_string(scalar.name)}, {kind}, {_role(row, component)}, {size}, {flags}, {numbers}, {{{used}}}}}"


def _use(table: Table, name: str, items: tuple[str, ...]) -> str:
    """Return the initialiser of a condition: the enumeration, and a bit for each of its items with which a row is used."""
    enumeration = table.row[name].enumeration
    assert enumeration is not None
    return f"{{{c_name(name)}, {sum(1 << enumeration.number(item) for item in items)}u}}"


def _field_size(table: Table) -> str:
    """Return the C expression for the number of elements of a field."""
    shape = table.fields[0].shape if table.fields else (0,)
    factors = (str(n) if isinstance(n, int) else f"(size_t)(values)[{c_name(n)}]" for n in shape)
    return f"({' * '.join(factors)})"


def _role(row: Variable, component: Component) -> str:
    if row in component.table.states:
        return "STATE"
    if row.name in component.accumulated:
        return "ACCUMULATED"
    if row.causality is Causality.LOCAL:
        return "OUTPUT"
    if row.name in component.totals:
        return "TOTAL"
    return row.causality.name + (" | TUNABLE" if row.tunable else "")


def _number(value: float) -> str:
    if math.isinf(value):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return float(value).hex()


def _string(text: str) -> str:
    return json.dumps(text)
