"""Run cases of module 3 on the half space: one contact on the file's own grid."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.damage.temperature import flash_temperature
from contact.halfspace import GridSolution, LocalLaw, Normal, Transient, norm
from contact.halfspace.influence import Influence
from contact.halfspace.local_law import Warmth
from contact.halfspace.third_body import ThirdBody
from contact.inp import pressed
from contact.inp.case import Case
from contact.inp.grid import Bed, bed, direction, material
from contact.inp.laws import LAWS
from contact.inp.reasons import refuse, require_digits
from contact.inp.results import PatchResult, Result
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material, Thermal
from contact.results import Status

#: Bytes for each element of the padded grid: fields, transforms and the vectors of GMRES.
_BYTES_PER_ELEMENT = 4200
#: Largest memory of a case without asking [bytes].
MEMORY = 4e9


def require_supported(case: Case, fast: bool = False) -> None:
    """Raise a `RefusedError` for what cannot run."""
    require_digits(case, fast)
    digits = case.digits
    for reason, wrong, what in (
        (
            "rigid slip of each element",
            (fast and digits["E"] != 0)
            or (digits["M"] in pressed.SIMPLIFIED and digits["E"] != 0)
            or (digits["E"] in (2, 3) and digits["T"] == 2),
            f"E = {digits['E']}",
        ),
        ("damping", digits["M2"] == 2 and any(case[name] for name in ("CDAMPN", "CDAMPT")), "M2 = 2"),
        (
            "place of spin",
            digits["T"] in (2, 3) and abs(case["FACPHI"] - 1.0 / 6.0) > 1e-4,
            f"FACPHI = {case.get('FACPHI', 0.0):g}",
        ),
        (
            "step of rolling",
            digits["T"] == 3 and digits["G"] == 2 and digits["M"] == 0 and _other_step(case),
            "DQ",
        ),
    ):
        if wrong:
            raise refuse(case, reason, what)


def _other_step(case: Case) -> bool:
    step = case.get("DX")
    return step is not None and abs(case["DQ"] - step) > 1e-6 * step


def law(case: Case, rows: int, backwards: bool) -> LocalLaw:
    """Return the friction of each element of the grid with a ring around it."""

    def column(name: str) -> Any:
        value = case[name]
        if not isinstance(value, tuple):
            return value
        if len(value) != rows:
            raise refuse(case, "input", f"{len(value)} sets of friction constants for {rows} rows")
        padded = np.pad(np.asarray(value), 1, mode="edge")
        return padded[::-1] if backwards else padded

    kind = case["LAW"]
    if kind == 0:
        return LocalLaw(column("FSTAT"))
    if kind == 6:
        constants = thermal(case)
        if constants is None:
            raise refuse(case, "temperature", "L = 6 with unlike bodies")
        if case["ROWS"] != 0:
            raise refuse(case, "temperature", "L = 6 with V = 3")
        mean = 0.5 * (case["BKTEMP1"] + case["BKTEMP2"])
        warmth = Warmth(case["DFHEAT"], case["TREF"], case["DTHEAT"], mean, constants)
        return LocalLaw(case["FREF"], (), case["MEMDST"], case["MEM_S0"], warmth)
    prefix = LAWS[kind][1]
    names = {2: ("linear", "linear"), 3: ("rational", "rational_square"), 4: ("exponential", "exponential")}[kind]
    terms = tuple(
        (name, column(f"{prefix}{k}"), column(f"SABSH{k}"))
        for k, name in enumerate(names, 1)
        if np.any(np.asarray(case[f"{prefix}{k}"]) != 0.0)
    )
    for _, _, half in terms:
        if not np.all(np.asarray(half) > 0.0):
            raise refuse(case, "input", "SABSH = 0 with a coefficient that is not 0")
    return LocalLaw(column("FKIN"), terms, case["MEMDST"], case["MEM_S0"])


def layer(case: Case) -> ThirdBody | None:
    """Return the third body of M = 4."""
    if case.digits["M"] != 4:
        return None
    stress = case["TAU_C0"]
    plastic = 0.0 < stress < 1e16
    return ThirdBody(case["LAYTHK"] / case["GG3"], stress if plastic else math.inf, case["K_TAU"] if plastic else 0.0)


class Single:
    """Runs the cases of one contact in order, with what they leave behind."""

    def __init__(self, memory: float = MEMORY, fields: bool = False) -> None:
        self._memory, self._fields = memory, fields
        self._contact: Transient | None = None
        self._before: Any = None
        self._key: Any = None
        self._backwards = False
        self._now: Any = None

    def solve(self, case: Case) -> Result:
        """Return the result of the next case."""
        require_supported(case)
        needed = _BYTES_PER_ELEMENT * (case["MX"] + 2.0) * (case["MY"] + 2.0)
        if needed > self._memory:
            raise refuse(
                case,
                "memory",
                f"{case['MX']} × {case['MY']} elements need about {needed / 1e9:.1f} GB; allowed: {self._memory / 1e9:g}",
            )
        bodies = material(case)
        ground, backwards = bed(case, bodies), direction(case)
        if case.digits["M"] in pressed.SIMPLIFIED:
            self._contact = None
            return pressed.solve(case, ground, bodies, backwards)
        self._now = case, ground, backwards
        contact = self._prepared(case, ground, bodies, backwards)
        solution = self._step(case, contact, ground, bodies, backwards)
        return _result(case, contact, ground, solution, -1.0 if backwards else 1.0, self._fields)

    def _press(self, h: Array, dx: float, dy: float, bodies: Material, **to: Any) -> Normal:
        """Return the normal solution of the case in work, by the half space or with the pressure that it gives."""
        case, ground, backwards = self._now
        if case.digits["B"] == 0:
            return norm(h, dx, dy, bodies, **to)
        found = pressed.normal(case, ground, bodies)
        turn = slice(None, None, -1 if backwards else 1)
        return replace(found, p=np.pad(found.p, 1)[turn, turn])

    def _prepared(self, case: Case, ground: Bed, bodies: Material, backwards: bool) -> Transient:
        """Return the contact with the state of the last case, or a fresh one."""
        gap, between = ground.gap(backwards), layer(case)
        friction = law(case, ground.y.size, backwards)
        amount = {"load": case["FN"]} if case.digits["N"] == 1 else {"approach": case["PEN"]}
        speed = case["VELOC"] if case.digits["T"] in (2, 3) else 1.0
        turns = case["MAXOUT"] if bodies.coupling != 0.0 else 1
        key = bodies, between, turns
        last, follows = self._contact, case.digits["P"] != 2 and case.digits["T"] in (1, 2)
        if follows and last is not None:
            if key != self._key:
                raise refuse(case, "input", "P = 0 with other bodies than the case before")
            if backwards != self._backwards and case.digits["T"] == 2:
                raise refuse(case, "direction", "a step that rolls backwards")
            last.change(friction=friction, speed=speed)
            if case.digits["P"] == 3 and self._before is not None:
                last.restore(self._before)
            elif case.digits["P"] == 1:
                last.forget(keep_pressure=True)
            self._before = last.state
            last.take(gap=gap, **amount)
            return last
        to: dict[str, Any] = {
            "friction": friction,
            "material": bodies,
            "speed": speed,
            "layer": between,
            "turns": turns,
            "normal": self._press,
        }
        if amount.get("load", 1.0) <= 0.0:
            raise refuse(case, "input", f"FN = {case['FN']:g} in a first step")
        self._contact = Transient(gap, **amount, **to)
        self._key, self._backwards, self._before = key, backwards, self._contact.state
        return self._contact

    def _step(self, case: Case, contact: Transient, ground: Bed, bodies: Material, backwards: bool) -> GridSolution:
        """Return the solution of the case's step, in our signs and axes."""
        digits, sign = case.digits, 1.0 if backwards else -1.0
        contact.change(slip=_extra_slip(case, ground, sign))
        if digits["T"] == 0:
            contact.change(friction=0.0)
            return contact.shift()
        spin = case["CPHI"]
        xi = case.get("CKSI", 0.0) + spin * case["SPINYO"]
        eta = case.get("CETA", 0.0) - spin * case["SPINXO"]
        force = self._force(case, contact, ground, bodies, sign)
        if digits["T"] == 1:
            return contact.shift(-xi, -eta, -spin, force=force)
        creepage = Creepage(sign * xi, sign * eta, -spin)
        if digits["T"] == 2:
            sliding = digits["G"] in (2, 3, 4) and case["INISLP"] < 0
            return contact.roll(creepage, distance=case["DQ"], force=force, sliding=sliding)
        return contact.roll_on(creepage, force=force)

    @staticmethod
    def _force(case: Case, contact: Transient, ground: Bed, bodies: Material, sign: float) -> Any:
        """Return the given forces on the wheel [N], None without."""
        if case.digits["F"] == 0:
            return None
        if case.digits["N"] == 1:
            load = case["FN"]
        else:
            grid = ground.gap(False)
            load = float(norm(grid.h, grid.dx, grid.dy, bodies, approach=case["PEN"]).p.sum()) * grid.dx * grid.dy
        static = float(contact.law.static.max()) if case["ROWS"] == 0 else 1.0
        scale = sign * static * load
        return scale * case["FXREL"], (scale * case["FYREL"] if case.digits["F"] == 2 else None)


def counts(case: Case, s: GridSolution) -> dict[str, float]:
    """Return the numbers of elements in contact, in adhesion, in slip and yielding."""
    inside = s.p > 0.0
    plastic = int(s.layer.plastic[inside].sum()) if s.layer is not None else 0
    sticks = int((s.stick & inside).sum()) if case.digits["T"] else int(inside.sum())
    values = {
        "NCON": float(inside.sum()),
        "NADH": float(sticks - (plastic if case.digits["T"] and s.layer is not None and _both(s) else 0)),
        "NSLIP": float(inside.sum() - sticks - (0 if _both(s) else plastic)),
    }
    return values if s.layer is None else values | {"NPLAST": float(plastic)}


def _result(case: Case, contact: Transient, ground: Bed, solution: GridSolution, sign: float, fields: bool) -> Result:
    """Return the result in CONTACT's signs; `sign` is -1 if the contact was turned."""
    s, digits = solution, case.digits
    inside = s.p > 0.0
    values = {
        "FN": case["FN"] if digits["B"] in (2, 3) and digits["N"] == 1 else s.N,
        "FX": -sign * s.Fx,
        "FY": -sign * s.Fy,
        "MZ": -s.Mz,
        "CPHI": case["CPHI"],
        "APPROACH": s.approach,
        "PMAX": s.max_pressure,
        **counts(case, s),
        "ELAST.EN.": _energy(contact, s),
        "FRIC.POWER": -work(s) * (s.speed if digits["T"] in (2, 3) else 1.0),
    }
    turned = -sign if digits["T"] in (2, 3) else -1.0
    values["CKSI"] = turned * s.creepage.longitudinal - case["CPHI"] * case["SPINYO"]
    values["CETA"] = turned * s.creepage.lateral + case["CPHI"] * case["SPINXO"]
    if digits["H"]:
        values |= temperature(case, s)
    status, message, p = s.status, "", contact.pressure[1:-1, 1:-1]
    if (p.shape[0] > 1 and p[[0, -1]].any()) or (p.shape[1] > 1 and p[:, [0, -1]].any()):
        status = Status.OUT_OF_RANGE
        message = f"{case.place}: the contact reaches the end of the grid of MX × MY elements, and is cut off there"
    patch = PatchResult(values, replace(s, status=status), _fields(case, contact, ground, s, sign) if fields else {})
    return Result(case, (patch,) if inside.any() else (), {}, status.name.lower().replace("_", " "), "", message)


def _fields(case: Case, contact: Transient, ground: Bed, s: GridSolution, sign: float) -> dict[str, Any]:
    """Return the fields of the file's grid, with CONTACT's signs and axes."""
    axis = slice(None, None, int(sign))

    def inner(field: Array) -> Array:
        return field[1:-1, 1:-1][axis, axis]

    x, y = contact.grid
    whole = np.zeros((4, *contact.pressure.shape))
    if s.p.size:
        rows = np.searchsorted(y, s.y[:, 0] - 0.5 * ground.dy)
        columns = np.searchsorted(x, s.x[0] - 0.5 * ground.dx)
        box = np.ix_(rows, columns)
        whole[0][box], whole[1][box], whole[2][box] = np.hypot(s.sx, s.sy), s.stick, s.p > 0.0
        whole[3][box] = 0.0 if s.layer is None else s.layer.plastic
    slip, stick, inside, plastic = (inner(field) for field in whole)
    state = np.where(inside > 0, np.where(plastic > 0, 3, np.where(stick > 0, 1, 2)), 0)
    un = Influence(contact.pressure.shape, ground.dx, ground.dy, contact.material).normal(contact.pressure)
    (ux, uy), (qx, qy), kept = contact.displacement, contact.traction, contact.state
    found = {"x": ground.x, "y": ground.y, "h": ground.h, "mu": inner(kept.mu), "p": inner(contact.pressure)}
    found |= {"px": -sign * inner(qx), "py": -sign * inner(qy), "un": inner(un), "slip": slip, "state": state}
    found |= {"ux": -sign * inner(ux), "uy": -sign * inner(uy), "tau": inner(kept.tau)}
    shear = -sign * kept.shear
    return found | {"shear_x": inner(shear[0]), "shear_y": inner(shear[1])}


def _extra_slip(case: Case, ground: Bed, sign: float) -> Array | float:
    """Return the rigid slip of E = 2, 3, 9 besides that of the creepages, on our grid and in our signs."""
    kind = case.digits["E"]
    slip = np.zeros((2, ground.y.size, ground.x.size))
    if "EXRHS" in case.values and kind in (1, 9):
        numbers = np.asarray(case["EXRHS"])
        if numbers.size != slip.size:
            raise refuse(case, "input", f"EXRHS has {numbers.size} numbers; {slip.size} are needed")
        slip[:] = numbers.reshape(ground.y.size, ground.x.size, 2).transpose(2, 0, 1)
    elif kind == 2:  # the spin acts along x only
        ahead = -sign * ground.dx / 6.0 if case.digits["T"] == 3 else 0.0
        slip[1] = -case["CPHI"] * (ground.x - case["SPINXO"] + ahead)
    elif kind == 3:
        slip[0] = case["CPHI"] * (ground.y - case["SPINYO"])[:, None]
    if not slip.any():
        return 0.0
    turn = slice(None, None, -1 if sign > 0.0 else 1)
    ours = -1.0 if case.digits["T"] == 1 else sign
    return ours * np.pad(slip, ((0, 0), (1, 1), (1, 1)))[:, turn, turn]


def work(solution: GridSolution) -> float:
    """Return the work of friction and of plastic shear, per metre rolled [N] or of a shift [J]."""
    layer = solution.layer
    return solution.power_per_metre + (0.0 if layer is None else layer.power_per_metre)


def _both(solution: GridSolution) -> bool:
    """Return whether elements that yield are counted as sticking."""
    layer = solution.layer
    return layer is not None and bool((solution.stick & layer.plastic).any())


def _energy(contact: Transient, solution: GridSolution) -> float:
    """Return the elastic energy [J]."""
    p, dA = contact.pressure, float(solution.dA.flat[0]) if solution.dA.size else 0.0
    if not p.any():
        return 0.0
    x, y = contact.grid
    steps = float(x[1] - x[0]), float(y[1] - y[0])
    un = Influence(p.shape, *steps, contact.material).normal(p)
    q = contact.traction
    if contact.coupling is not None:
        un = un + contact.coupling.opening(*q)
    ux, uy = contact.displacement
    return 0.5 * dA * float((p * un + q[0] * ux + q[1] * uy).sum())


def temperature(case: Case, solution: GridSolution) -> dict[str, float]:
    """Return the highest temperature [°C] if both bodies have the same thermal constants."""
    constants = thermal(case)
    if constants is None or not solution.p.any():
        return {}
    mean = 0.5 * (case["BKTEMP1"] + case["BKTEMP2"])
    return {"MAX(T1,T2)": mean + float(flash_temperature(solution, constants).max(initial=0.0))}


def thermal(case: Case) -> Thermal | None:
    """Return the thermal constants of both bodies; None if they differ."""
    pairs = [(case[f"{name}1"], case[f"{name}2"]) for name in ("HEATCP", "LAMBDA", "DENS")]
    if any(not math.isclose(one, other, rel_tol=1e-6) for one, other in pairs):
        return None
    return Thermal(pairs[1][0], pairs[2][0], pairs[0][0])
