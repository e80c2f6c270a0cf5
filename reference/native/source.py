"""model.h for the C hosts: sizes and value references of one FMU. The FMU itself reads them from its resources."""

from __future__ import annotations

from contact_fmu.description_fmi3 import value_references
from contact_fmu.native.component import Component
from contact_fmu.rows import identifier
from contact_fmu.variables import Causality, Table


def header(component: Component, guid: str) -> str:
    """Return model.h: sizes, the guid, and the value references of fields, of time and of the first scalar of every row."""
    table = component.table
    parameters = sum(s.row.causality is Causality.PARAMETER for s in table.scalars)
    accumulated = sum(table.row[name].size for name in component.accumulated)
    accumulates = f"((values)[{c_name(component.accumulates)}] > 1.0)" if accumulated else "false"
    references = "\n".join(f"    {c_name(name)} = {reference}," for name, reference in value_references(table).items())
    return f"""/* Generated from the variable table of {table.name}. */
#ifndef MODEL_H
#define MODEL_H
#define MODEL_GUID "{guid}"
#define N_VALUES {len(table.scalars) - accumulated}
#define N_ACCUMULATED {accumulated}
#define ACCUMULATES(values) {accumulates}
#define N_PARAMETERS {parameters}
#define N_MESSAGES {int(max([0, *component.warnings, *component.failures]))}
#define N_TOTALS {len(component.totals)}
#define N_CHOICES {sum(row.is_given for row in table.twins)}
#define N_MIRRORS {sum(not row.is_given for row in table.twins)}
#define N_FIELDS {len(table.fields)}
#define N_RESOURCES {1 + len(component.resources)}
#define FIELD_SIZE(values) {_field_size(table)}
enum {{
{references}
}};
#endif
"""


def c_name(row: str) -> str:
    """Return the enumerator of a row: geometry.kind → V_geometry_kind."""
    return "V_" + identifier(row)


def _field_size(table: Table) -> str:
    """Return the C expression for the number of elements of a field."""
    shape = table.fields[0].shape if table.fields else (0,)
    factors = (str(n) if isinstance(n, int) else f"(size_t)(values)[{c_name(n)}]" for n in shape)
    return f"({' * '.join(factors)})"
