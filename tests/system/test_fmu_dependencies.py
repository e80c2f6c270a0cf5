"""What ModelStructure says of dependencies, tried: every parameter and input is changed, and the outputs that move are noted.

A master trusts it: it finds algebraic loops by it and does not ask for an output again that cannot have changed.
"""

import math
from collections.abc import Iterator

import pytest
from fmpy.fmi1 import FMICallException
from fmu_instance import Instance

import contact
from contact_fmu.catalogue import models, vehicles
from contact_fmu.tables.wheel_rail_contact import POINTS
from contact_fmu.variables import Kind, Table
from reference.native import SCENARIO

#: As coarse as a contact can be with sense: as many pairs of variables and outputs move as at 20 x 20, in a fifth of the time.
COARSE = {"resolution.n_strips": 6, "resolution.n_elements": 5}
FRICTION = {"friction.law": 3, "friction.velocity": 2, "friction.kinetic": 0.1, "friction.gauge_factor": 0.5,
            "friction.hot_factor": 0.6, "friction.slope": 0.6, "friction.slope_far": 0.5}  # fmt: skip
CONTACT = {"creepage.longitudinal": 1e-3, "creepage.lateral": 5e-4, "creepage.spin": 0.1}
BENT = {"geometry.surface": 2, **{f"geometry.tilt[{i}]": 1e-2 * (i - 21) for i in range(1, 42)}}
_NORMAL, _TANGENTIAL = (len(kind) for kind in contact.methods().batched)
#: FMU → cases about which every parameter and input is changed.
CASES = {
    "WheelRailContact": [
        CONTACT,
        {**CONTACT, **FRICTION},
        {**CONTACT, **BENT},
        {**CONTACT, "geometry.kind": 2},
        {**CONTACT, "load.kind": 2},
        {**CONTACT, "material.pressure_limit": 6e8},
        *({**CONTACT, "method.normal": k} for k in range(2, _NORMAL + 1)),
        *({**CONTACT, **FRICTION, "method.tangential": k} for k in range(2, _TANGENTIAL + 1)),
    ],
    "WheelRailPair": [
        {"pose.y": 4e-3, "velocity.y": 0.02},
        {"pose.y": 4e-3, "velocity.y": 0.02, **FRICTION, "patches.surface": 2},
        {"pose.y": 4e-3, "velocity.y": 0.02, "load.kind": 2, "pose.z": 1.2e-4},
        {"pose.y": 6.6e-3, "velocity.y": 0.02, "load.kind": 3, "material.pressure_limit": 6e8},
    ],
}
CASES["EllipticContact"] = [CONTACT, {**CONTACT, **FRICTION}, {**CONTACT, "material.pressure_limit": 6e8}]
CASES["Wheelset"] = [{"initial.y[1]": 4e-3, "wheel[1].force.y": 1e3}]
CASES["Vehicle"] = [{}, {"method.normal": 1, "method.tangential": 2, "initial.distance": 10.0}]
CASES["OpenVehicle"] = [{}, {"initial.distance": 10.0, "wheel[1].force.y": 1e3}]
VEHICLES = ("Vehicle", "OpenVehicle")


def table_of(name: str) -> Table:
    """Return the table of an FMU as the fixtures build it."""
    every = (*models(POINTS, accumulation=True), *(vehicles(SCENARIO) if name in VEHICLES else ()))
    return next(model.table for model in every if model.table.name == name)


def changed(table: Table, name: str, fmu: Instance) -> Iterator[dict[str, float]]:
    """Yield other values of one row, near and far."""
    scalars = table.scalars[table.span[name]]
    if scalars[0].row.kind is not Kind.REAL:
        for step in (1, 2, -1):
            yield {s.name: fmu[s.name] + step for s in scalars}
        return
    values = fmu.read(s.name for s in scalars)
    for factor, less in ((1.01, 1e-5), (1.5, 1e-2), (0.5, -1e-3)):
        yield {n: factor * x if x and math.isfinite(x) else less for n, x in values.items()}
        yield {n: 1.1 * x + less * k for k, (n, x) in enumerate(values.items())}
    if name == "material.pressure_limit":
        yield {name: 5e8}


def outputs(fmu: Instance, values: dict[str, float], read: list[str]) -> dict[str, float] | None:
    """Return outputs at the start, None if the values are refused."""
    fmu.fmu.reset()
    fmu.update(values)
    try:
        fmu.initialize()
    except FMICallException:
        return None
    return fmu.read(read)


@pytest.mark.parametrize("name", CASES)
def test_no_output_moves_with_a_variable_on_which_it_does_not_depend(request, native, unzipped, name):
    """Outputs at the start."""
    folder = request.getfixturevalue("native_vehicles") if name in VEHICLES else native.parent
    fmu = Instance(unzipped(folder / f"{name}.fmu"), kind="CoSimulation")
    table = table_of(name)
    rows = {
        row.name: row for row in table.shown if row.initial == "calculated" and not row.name.startswith("accumulated")
    }
    of = {s.name: s.row.name for s in table.scalars if s.row.name in rows and s.row.name != "creep_stiffness"}
    allowed = {output: {row.name for row in table.knowns(rows[output])} for output in rows}
    wrong = set()
    coarse = {k: v for k, v in COARSE.items() if k in fmu.variables}
    for case in ({**coarse, **case} for case in CASES[name]):
        start = outputs(fmu, case, list(of))
        assert start is not None, case
        for row in table.shown:
            if not row.is_given:
                continue
            outputs(fmu, case, [])
            for values in list(changed(table, row.name, fmu)):
                moved = outputs(fmu, {**case, **values}, list(of)) or start
                for output in {of[n] for n in of if moved[n] != start[n]}:
                    if row.name not in allowed[output]:
                        wrong.add((output, row.name))
    fmu.free()
    assert not wrong, "\n".join(f"{output} moves with {of}" for output, of in sorted(wrong))
