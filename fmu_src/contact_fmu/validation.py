"""A validation set of an FMU, in the form of the FMI Cross-Check: inputs, reference, options, tolerances and a README.

The reference is what the FMU answers in fmpy on the machine that packs it. It is held against what physics says, and only then
written. `contact fmu-check` compares what another tool wrote with it.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.errors import ContactError
from . import validation_mirror as mirror
from .tables.solver import LEAST_LOAD
from .validation_cases import SCENES, Case, case, columns
from .validation_momentum import momentum
from .variables import Causality, Table

KINDS = {"cs": "CoSimulation", "me": "ModelExchange"}
#: Tolerance of an output as a share of its largest value, on another processor; and that of some outputs by their names. Rates
#: add up in another way. One element sticks or slips: another start of the iteration may decide that (.004). Slopes are steep
#: where a stick zone ends: the last digit of an input may decide on which side (.002).
_RELATIVE = 1e-3
_SHARES = {r"total\.": 2e-2, r"(_max|slip\.ratio)$": 1e-2, r"^creep_stiffness": 1e-2}
_README = """# Validation set of {name}

FMI {version}, {kind}. File of the FMU: {file}

1. Import the FMU in your tool. Leave all parameters at their starts.
2. Drive it by {files} with a communication step of {step:g} s from 0 to {stop:g} s. Inputs are held over a step.
3. Write all outputs at these {n} times to a file and compare:

       contact fmu-check RESULT.csv --reference .

`{name}_ref.csv` is what the FMU answers in fmpy {fmpy}: in co-simulation the outputs at the end of a step belong to the inputs
at its beginning, in model exchange to those of the same time. `tolerances.csv` has the tolerance of each output.

The run visits: {scenes}.

What physics says of the reference, each checked when it was written: {physics}.
"""


def write(
    fmu: Path, table: Table, folder: Path, *, exchange: bool, force: bool, vehicle: str | None = None
) -> list[Path]:
    """Write the sets of an FMU file below `folder` and return their folders. `vehicle` is that of the FMU of one.

    Raises
    ------
    ContactError
        If there is a set already and not `force`, or if the answers of the FMU contradict physics.
    """
    from fmpy import read_model_description

    version = read_model_description(str(fmu)).fmiVersion.split(".")[0]
    packaging = "python" if "python" in fmu.parts[-3:] else "native"
    made = []
    for short in KINDS if exchange else ("cs",):
        place = folder / packaging / f"fmi{version}" / short / table.name
        if place.exists() and any(place.iterdir()) and not force:
            raise ContactError(f"{place} exists; --force overwrites it")
        _write(fmu, table, place, short, version, vehicle or "")
        made.append(place)
    return made


def _write(fmu: Path, table: Table, place: Path, short: str, version: str, vehicle: str) -> None:
    import fmpy

    given, answer = _run(fmu, table, short, vehicle)
    wrong, physics = contradictions(table, answer), laws(table)
    if mirror.has_mirror(table):
        turned = given._replace(inputs=mirror.mirrored(given.inputs))
        wrong += mirror.unlike(answer, _simulated(fmu, table, turned, short, mirror.starts(table)), tolerance)
        physics = [*physics, "mirrored inputs have mirrored answers"]
    if table.name in ("OpenVehicle", "Wheelset") and (found := momentum(fmu, vehicle, given, answer)) is not None:
        wrong += found
        physics = [*physics, "the momentum of all bodies grows by the forces and the weight"]
    if wrong:
        raise ContactError(f"{fmu.name}, {KINDS[short]}: {wrong[0]}")
    place.mkdir(parents=True, exist_ok=True)
    name, scalar = table.name, _scalars(fmu)
    names = [one for one in columns(table, Causality.OUTPUT) if one in answer and one in scalar and "," not in one]
    arrays = {one: values for one, values in answer.items() if one not in (*names, "time")}
    _csv(place / f"{name}_in.csv", given.time, _inputs(table, given, scalar))
    files, driven = [f"`{name}_in.csv`"], _driven(table, given, scalar)
    if driven:
        files.append(f"`{name}_in_arrays.csv` (elements of arrays)")
        elements = [one for of_array in driven.values() for one in of_array]
        values = dict(zip(elements, _stacked(table, given, elements).T, strict=True))
        _csv(place / f"{name}_in_arrays.csv", given.time, values, ";")
    _csv(place / f"{name}_ref.csv", answer["time"], {one: answer[one] for one in names})
    if arrays:
        _csv(place / f"{name}_arrays.csv", answer["time"], arrays, ";")
    options = {"StartTime": 0.0, "StopTime": given.time[-1], "StepSize": given.step, "RelTol": 1e-6}
    (place / f"{name}_ref.opt").write_text("".join(f"{k},{float(v)!r}\n" for k, v in options.items()), encoding="utf-8")
    rows = [f'"{one}",{tolerance(one, answer[one])!r}\n' for one in (*names, *arrays)]
    (place / "tolerances.csv").write_text("output,tolerance\n" + "".join(rows), encoding="utf-8")
    text = _README.format(
        name=name, version=version, kind=KINDS[short], file=fmu.name, files=" and ".join(files),
        step=given.step, stop=given.time[-1],
        n=len(given.time), fmpy=fmpy.__version__, scenes=_scenes(table, given), physics="; ".join(physics),
    )  # fmt: skip
    (place / "README.md").write_text(text, encoding="utf-8")


def _scenes(table: Table, given: Case) -> str:
    if "load.normal_force" not in given.inputs:
        return "changing inputs"
    return ", ".join(f"{name} ({a * given.time[-1]:g} to {b * given.time[-1]:g} s)" for name, (a, b) in SCENES.items())


def _inputs(table: Table, given: Case, scalar: set[str]) -> dict[str, Array]:
    """Return all inputs that are scalars in the FMU; those that do not vary are at their starts."""
    starts = {one.name: float(one.first) for one in table.scalars}
    names = [name for name in columns(table, Causality.INPUT) if name in scalar]
    return {name: given.inputs.get(name, np.full(len(given.time), starts[name])) for name in names}


def _driven(table: Table, given: Case, scalar: set[str]) -> dict[str, list[str]]:
    """Return the inputs that are arrays in the FMU and vary: name → names of the elements. Only FMI 3.0 has any."""
    found = _elements([name for name in columns(table, Causality.INPUT) if name not in scalar])
    return {array: names for array, names in found.items() if any(name in given.inputs for name in names)}


def _elements(names: list[str]) -> dict[str, list[str]]:
    """Return the names of the elements of each array by its name."""
    found: dict[str, list[str]] = {}
    for name in names:
        found.setdefault(re.sub(r"\[[\d,]*\]", "", name), []).append(name)
    return found


def _stacked(table: Table, given: Case, names: list[str]) -> Array:
    """Return the values of these inputs over time, a column each; those that do not vary are at their starts."""
    starts = {one.name: float(one.first) for one in table.scalars}
    return np.stack([given.inputs.get(name, np.full(len(given.time), starts[name])) for name in names], axis=1)


def _scalars(fmu: Path) -> set[str]:
    """Return the names of the variables that are no arrays; in FMI 2.0 these are all."""
    from fmpy import read_model_description

    return {v.name for v in read_model_description(str(fmu)).modelVariables if not v.dimensions}


def _run(fmu: Path, table: Table, short: str, vehicle: str) -> tuple[Case, dict[str, Array]]:
    """Return the inputs and the answers. On profiles whose flange lies nearer the way to it is shorter."""
    for amplitude in (1.0, 0.7, 0.4, 0.1):
        given = case(table, amplitude, vehicle)
        answer = _simulated(fmu, table, given, short)
        if len(answer["time"]) == len(given.time):
            return given, answer
    raise ContactError(f"{fmu.name}: the validation run ended at {answer['time'][-1]:g} s of {given.time[-1]:g} s")


def _simulated(
    fmu: Path, table: Table, given: Case, short: str, starts: dict[str, float] | None = None
) -> dict[str, Array]:
    """Return the answers with these starts: all outputs that are Reals, those of arrays by the names of their elements."""
    from fmpy import simulate_fmu

    scalar = _scalars(fmu)
    driven = _driven(table, given, scalar)
    # fmpy takes either numbers or arrays of one length; where arrays vary the numbers are at their starts
    varied = {one: _stacked(table, given, names) for one, names in driven.items()} or _inputs(table, given, scalar)
    kinds = [(name, float, values.shape[1:]) for name, values in varied.items()]
    signals = np.zeros(len(given.time), dtype=[("time", float), *kinds])
    signals["time"] = given.time
    for name, values in varied.items():
        signals[name] = values
    names = columns(table, Causality.OUTPUT)
    arrays = _elements([name for name in names if name not in scalar])
    result = simulate_fmu(
        str(fmu), fmi_type=KINDS[short], input=signals, output=[*(n for n in names if n in scalar), *arrays], start_time=0.0,
        stop_time=given.time[-1], step_size=given.step, output_interval=given.step, solver="Euler", start_values=starts or {},
    )  # fmt: skip
    found = {name: np.asarray(result[name], float) for name in result.dtype.names if name not in arrays}
    for array, elements in arrays.items():
        found |= zip(elements, np.asarray(result[array], float).reshape(len(result), -1).T, strict=True)
    return found


def _csv(path: Path, time: Array, rows: dict[str, Array], separator: str = ",") -> None:
    lines = [separator.join(f'"{name}"' for name in ("time", *rows))]
    lines += [separator.join(repr(float(x)) for x in row) for row in zip(time, *rows.values(), strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def tolerance(name: str, values: Array) -> float:
    """Return the absolute tolerance of an output with these values. The tolerance of a number that is always 0 is 1e-9."""
    share = next((share for pattern, share in _SHARES.items() if re.search(pattern, name)), _RELATIVE)
    return float(max(share * np.max(np.abs(values)), 1e-9))


# ---------------------------------------------------------------- what physics says


def laws(table: Table) -> list[str]:
    """Return what is checked of an answer, in words."""
    found = ["friction never gives power"] if "power.friction" in table.row else []
    if "total.energy" in table.row:
        found.append("energy and worn volume never fall")
    if "wheel.Q" in table.row:
        found.append(
            "Q and Y are the vertical and the outward force on the rail, and no friction exceeds its coefficient"
        )
    if "load.normal_force" in table.row:
        found.append("without a load all forces are 0")
    return found or ["all numbers are finite"]


def contradictions(table: Table, answer: dict[str, Array]) -> list[str]:
    """Return what physics says against an answer."""
    found = [f"{name} is not finite" for name, values in answer.items() if not np.isfinite(values).all()]

    def check(law: str, holds: NDArray[np.bool_]) -> None:
        if not np.all(holds):
            at = answer["time"][int(np.argmin(holds))]
            found.append(f"{law}: not at {at:g} s")

    for name in ("total.energy", "total.worn_volume", "total.distance", "total.T_gamma"):
        if name in answer:
            check(f"{name} falls", np.diff(answer[name], prepend=answer[name][0]) >= 0.0)
    if "power.friction" in answer:
        check("friction gives power", answer["power.friction"] >= -1e-9)
    if "used_friction" in answer:
        largest = float(table.scalars[table.references("friction.coefficient")[0]].first)  # no case varies it
        check("friction exceeds its coefficient", answer["used_friction"] <= largest + 1e-6)
    if "wheel.Q" in answer:
        largest = 1e-9 * max(float(np.max(np.abs(answer["wheel.Q"]))), 1.0)
        check("Q is not the vertical force", np.abs(np.abs(answer["wheel.Q"]) - np.abs(answer["force.z"])) <= largest)
        check("Y is not the lateral force", np.abs(np.abs(answer["wheel.Y"]) - np.abs(answer["force.y"])) <= largest)
    if "status_real" in answer and "force.x" in answer:
        free = answer["status_real"] == 2.0
        check("a wheel without contact has a force", ~free | (np.abs(answer["force.x"]) < abs(LEAST_LOAD) * 1e-9))
    return found
