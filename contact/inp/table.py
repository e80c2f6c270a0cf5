"""The blocks of CONTACT's input files in the order in which they are read, declared once.

Reading, writing and messages follow from it, with `contact.inp.controls` the table of digits of the page "If you come from
CONTACT" too. Values are kept in SI units: `factor` is what a number of the file is multiplied by. Facts after the sources of
CONTACT 25.1.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from contact.inp.fields import Array, Block, Field, Group, Now, Subsurface, a, d, i, maybe

MM, PER_MM, MPA = 1e-3, 1e3, 1e6

CONTROL = (Group((i("PSFLCIN"), maybe(i("READLN"), 0)), lambda n: n["X"] == 1),)
SOLVER = (
    Group(
        (
            i("MAXGS", 1, 9999),
            i("MAXIN", 1, 999999),
            i("MAXNR", 1, 9999),
            i("MAXOUT", 1, 9999),
            d("EPS", low=0.0, above=True),
            maybe(i("NPOT_MAX", 100, 1_000_000), 20000),
        ),
        lambda n: n["G"] != 1,
    ),
    Group((d("OMEGAH"), d("OMEGAS"), i("INISLP"), d("OMGSLP")), lambda n: n["G"] in (2, 3)),
    Group((i("INISLP"), d("OMGSLP")), lambda n: n["G"] == 4),
    Group(
        (d("FDECAY"), d("BETATH"), i("KDOWFB"), d("D_IFC"), d("D_LIN"), d("D_CNS"), d("D_SLP"), d("POW_S")),
        lambda n: n["G"] == 5,
    ),
)


def _law(n: Now) -> int:
    return int(n["L"])


def _laws(when: Callable[[Now], bool], repeat: Callable[[Now], int] | None, key: tuple[Field, ...] = ()) -> Group:
    """Return the group of one set of friction constants, whose fields depend on the law."""
    of = {2: "LIN", 3: "RAT", 4: "EXP"}
    terms = tuple(
        field
        for law, name in of.items()
        for k in "12"
        for field in (
            d(f"F{name}{k}", when=lambda n, law=law: n["L"] == law),
            d(f"SABSH{k}", MM, 0.0, when=lambda n, law=law: n["L"] == law),
        )
    )
    fields = (
        *key,
        d("FSTAT", low=1e-4, when=lambda n: n["L"] == 0),
        d("FKIN", low=0.0, when=lambda n: n["L"] in (0, 2, 3, 4)),
        *terms,
        d("FREF", low=1e-4, when=lambda n: n["L"] == 6),
        d("TREF", when=lambda n: n["L"] == 6),
        d("DFHEAT", when=lambda n: n["L"] == 6),
        d("DTHEAT", low=0.0, above=True, when=lambda n: n["L"] == 6),
    )
    return Group(fields, when, repeat, (("LAW", _law), ("ROWS", lambda n: int(n["V"]))))


_MEMORY = (d("MEMDST", MM, 0.0), d("MEM_S0", MM, 0.0))


def _reads_law(n: Now) -> bool:
    return bool(n["L"] != 1)


_FRICTION_1 = (
    Group((i("NVF", 1, 10),), lambda n: _reads_law(n) and n["V"] in (1, 2)),
    _laws(lambda n: _reads_law(n) and n["V"] == 0, None),
    _laws(lambda n: _reads_law(n) and n["V"] == 1, lambda n: int(n["NVF"]), (a("ALPHA"),)),
    _laws(lambda n: _reads_law(n) and n["V"] == 2, lambda n: int(n["NVF"]), (d("SVF", MM),)),
    Group(_MEMORY, lambda n: n["L"] in (2, 3, 4, 6)),
)
#: Names that a new law of friction forgets.
OF_FRICTION = frozenset(field.name for group in _FRICTION_1 for field in group.fields) - {"NVF"}


def _new_numbers(n: Now) -> bool:
    return bool(n["C3"] in (2, 3, 4, 9))


_MATERIAL = (
    Group(
        (
            d("POISS1", low=0.0, high=0.5),
            d("POISS2", low=0.0, high=0.5),
            d("GG1", MPA, 1e-5),
            d("GG2", MPA, 1e-5),
        ),
        _new_numbers,
        kept=(("INFLUENCE", lambda n: int(n["C3"])),),
    ),
    Group((d("FLXZ", 1e-9, 0.0, above=True),), lambda n: _new_numbers(n) and n["B"] == 1),
    Group((d("FG1"), d("FG2"), d("TC1", low=0.0), d("TC2", low=0.0)), lambda n: _new_numbers(n) and n["M"] == 1),
    Group(
        (d("FLX", 1e-9, 0.0, above=True), d("K0_MF", low=0.0, above=True), d("ALFAMF", low=0.0), d("BETAMF", low=0.0)),
        lambda n: _new_numbers(n) and n["M"] == 2,
    ),
    Group(
        (d("K0_MF", low=0.0, above=True), d("ALFAMF", low=0.0), d("BETAMF", low=0.0)),
        lambda n: _new_numbers(n) and n["M"] in (3, 5),
    ),
    Group(
        (d("GG3", MPA, 0.0, above=True), d("LAYTHK", MM, 0.0), d("TAU_C0", MPA), d("K_TAU", 1e9)),
        lambda n: _new_numbers(n) and n["M"] == 4,
    ),
)
_THERMAL = tuple(
    Group(
        (
            d(f"BKTEMP{k}"),
            d(f"HEATCP{k}", low=0.0, above=True),
            d(f"LAMBDA{k}", 1e3, 0.0, above=True),
            d(f"DENS{k}", 1e9, 0.0, above=True),
        ),
        lambda n: n["H"] == 3,
    )
    for k in (1, 2)
)
_REST = (
    Group((d("CDAMPN"), d("CDAMPT"), d("DFNMAX"), d("DFTMAX")), lambda n: n["M2"] == 2),
    *_THERMAL,
    Group((d("BETAPL", low=0.0, high=1.0),), lambda n: n["H"] == 3 and n["M"] == 4),
)
_STRESS = (
    Group((i("A_S"), i("O_S")), lambda n: n["S"] >= 2),
    Subsurface(lambda n: n["S"] == 3),
)


def _shift(n: Now) -> float:
    return MM if n["T"] == 1 else 1.0


def _spin(n: Now) -> float:
    return PER_MM if n["T"] in (2, 3) else 1.0


#: Names of the numbers of a potential contact by IPOTCN, after MX and MY, with their factors.
POTENTIAL: dict[int, tuple[tuple[str, float], ...]] = {
    -1: (("A1", PER_MM), ("B1", PER_MM), ("SCALE", 1.0)),
    -2: (("A1", PER_MM), ("AOB", 1.0), ("SCALE", 1.0)),
    -3: (("AA", MM), ("BB", MM), ("SCALE", 1.0)),
    -4: (("A1", PER_MM), ("BB", MM), ("SCALE", 1.0)),
    -5: (("AA", MM), ("BB", MM), ("SCALE", 1.0)),
    -6: (("AA", MM), ("BNEG", MM), ("BPOS", MM), ("SCALE", 1.0)),
    1: (("XL", MM), ("YL", MM), ("DX", MM), ("DY", MM)),
    2: (("XL", MM), ("YL", MM), ("XH", MM), ("YH", MM)),
    3: (("XC1", MM), ("YC1", MM), ("DX", MM), ("DY", MM)),
    4: (("XC1", MM), ("YC1", MM), ("XCM", MM), ("YCM", MM)),
}
#: Numbers that must be positive.
_POSITIVE = {"SCALE", "AA", "BB", "AOB", "DX", "DY"}


def _potential(name: str, factor: float, kind: int) -> Field:
    positive = name in _POSITIVE
    return d(name, factor, 0.0 if positive else -math.inf, above=positive, when=lambda n: n["IPOTCN"] == kind)


def _elements(n: Now) -> int:
    return int(n["MX"]) * int(n["MY"])


def _new_gap(n: Now) -> bool:
    return bool(n["Z"] >= 2 and n.get("IPOTCN", 1) > 0)


def _gap_factors(n: Now) -> tuple[float, ...]:
    if n["IBASE"] == 1:
        return PER_MM, PER_MM, PER_MM, 1.0, 1.0, MM
    if n["IBASE"] == 3:
        return MM, PER_MM, MM, MM, PER_MM, MM, MM, MM
    return (MM,)


def _gap_count(n: Now) -> int:
    return {1: 6, 2: int(n.get("NN", 0)), 3: 8}.get(n["IBASE"], _elements(n))


MODULE_3: tuple[Block, ...] = (
    *CONTROL,
    *SOLVER,
    Group(
        (
            d("PEN", MM, when=lambda n: n["N"] == 0),
            d("FN", when=lambda n: n["N"] == 1),
            d("CKSI", _shift, when=lambda n: n["F"] == 0),
            d("FXREL", low=-1.0, high=1.0, when=lambda n: n["F"] >= 1),
            d("CETA", _shift, when=lambda n: n["F"] <= 1),
            d("FYREL", low=-1.0, high=1.0, when=lambda n: n["F"] == 2),
            d("CPHI", _spin),
            maybe(d("SPINXO", MM), 0.0),
            maybe(d("SPINYO", MM), 0.0),
        )
    ),
    _laws(lambda n: _reads_law(n) and n["V"] == 0, None),
    Group(_MEMORY, lambda n: n["L"] in (2, 3, 4, 6) and n["V"] == 0),
    Group(
        (
            a("CHI"),
            d("DQ", MM, 0.0, above=True),
            d("VELOC", MM, 0.0, above=True),
            maybe(d("FACPHI"), 1.0 / 6.0),
        ),
        lambda n: _new_numbers(n) and n["T"] in (2, 3),
    ),
    Group((i("IF_METH", 0, 1), i("VARIANT", 1, 4), i("NN_ANGLE", 1, 9999)), lambda n: n["C3"] == 4),
    Array("ANGLES", lambda n: 2 * n["NN_ANGLE"], lambda n: (MM, 1.0), "a", lambda n: n["C3"] == 4),
    Group((Field("CFNAME", "s"),), lambda n: n["C3"] == 9),
    *_MATERIAL,
    *_REST,
    Group((i("IPOTCN", -6, 4),), lambda n: n["D"] == 2),
    Group(
        (
            i("MX", 1, 1_000_000),
            i("MY", 1, 1_000_000),
            *(_potential(name, factor, kind) for kind, row in POTENTIAL.items() for name, factor in row),
        ),
        lambda n: n["D"] == 2,
    ),
    Group((i("IBASE"), i("IPLAN", 1, 4)), _new_gap),
    Group(
        (i("NN", 2, 1_000_000), d("XM", MM), d("RM", MM), d("Y1", MM), d("DY1", MM, 0.0, above=True)),
        lambda n: _new_gap(n) and n["IBASE"] == 2,
    ),
    Array("UDB", _gap_count, _gap_factors, when=_new_gap),
    Array(
        "PLANFORM",
        lambda n: 6 if n["IPLAN"] == 2 else 8,
        lambda n: (PER_MM, PER_MM, PER_MM, 1.0, 1.0, MM) if n["IPLAN"] == 2 else (MM,),
        when=lambda n: _new_gap(n) and n["IPLAN"] in (2, 3),
    ),
    Group((i("NPATCH", 1, 100),), lambda n: _new_gap(n) and n["IPLAN"] == 4),
    Array("XYLIM", lambda n: 4 * n["NPATCH"], lambda n: (MM,), when=lambda n: _new_gap(n) and n["IPLAN"] == 4),
    Array(
        "FAC",
        lambda n: n["NPATCH"] * (n["NPATCH"] - 1) // 2,
        lambda n: (1.0,),
        when=lambda n: _new_gap(n) and n["IPLAN"] == 4 and n["NPATCH"] > 1,
    ),
    _laws(lambda n: _reads_law(n) and n["V"] == 3, lambda n: int(n["MY"])),
    Group(_MEMORY, lambda n: n["L"] in (2, 3, 4, 6) and n["V"] == 3),
    Array("EXRHS", lambda n: 2 * _elements(n), lambda n: (_shift(n),), when=lambda n: n["E"] == 9),
    *_STRESS,
)


def _profile(side: str, when: Callable[[Now], bool]) -> tuple[Block, ...]:
    def option(low: int) -> Callable[[Now], bool]:
        return lambda n: when(n) and n[f"{side}PRFOPT"] >= low

    return (
        Group(
            (
                Field(f"{side}FNAME", "s"),
                i(f"{side}MIRRORY", -1, 1),
                d(f"{side}SCALE", low=0.0, above=True),
                d(f"{side}SMOOTH", low=0.0),
                maybe(i(f"{side}MIRRORZ", -1, 1), 0),
                maybe(i(f"{side}PRFOPT", 0, 2), 0),
            ),
            when,
        ),
        Group(
            (
                i(f"{side}ISMOOTH", 0, 2),
                a(f"{side}ZIGTHRS"),
                a(f"{side}KINKHIGH"),
                a(f"{side}KINKLOW"),
                d(f"{side}KINKWID", MM),
            ),
            option(1),
        ),
        Group((i(f"{side}ERRHND"), d(f"{side}MAXOMIT")), option(2)),
    )


def _roller(n: Now) -> bool:
    return bool(n["C1"] >= 4)


def _rail(n: Now) -> bool:
    return not _roller(n)


def _new_wheel(n: Now) -> bool:
    return bool(n["E"] in (3, 5))


def _flexible(n: Now) -> bool:
    return bool(n["E"] in (4, 5))


def _placed(n: Now) -> bool:
    return bool(n["GAUGHT"] > 0.0)


MODULE_1: tuple[Block, ...] = (
    *CONTROL,
    *SOLVER,
    *_FRICTION_1,
    Group((i("IF_METH", 0, 1), i("VARIANT", 1, 4)), lambda n: n["C3"] == 4),
    *_MATERIAL,
    *_REST,
    Group(
        (
            d("DX", MM, 0.0, above=True),
            d("DS", MM, 0.0, above=True),
            d("DQREL", low=0.0, above=True),
            a("A_SEP"),
            d("D_SEP", MM),
            d("D_COMB", MM),
            maybe(d("D_TURN", MM), lambda n: 2.0 * n["D_SEP"] - n["D_COMB"]),
            maybe(d("G_MISS", MM), -MM),
        ),
        lambda n: n["D"] >= 2,
        kept=(("SEARCH", lambda n: int(n["D"])),),
    ),
    Group(
        (
            d("GAUGHT", MM),
            d("GAUGSQ", when=_placed),
            d("GAUGWD", MM, when=_placed),
            d("RAILY0", MM, when=lambda n: not _placed(n)),
            d("RAILZ0", MM, when=lambda n: not _placed(n)),
            a("CANT", when=_rail),
            d("NOMRADR", MM, 0.0, above=True, when=_roller),
            maybe(d("CURV", PER_MM), 0.0),
        ),
        lambda n: n["Z"] in (1, 3),
    ),
    *_profile("R", lambda n: bool(n["Z"] == 3)),
    Group(
        (d("DYRAIL", MM), d("DZRAIL", MM), a("DROLLR"), d("VYRAIL", MM), d("VZRAIL", MM), a("VROLLR")),
        lambda n: n["Z"] in (2, 3),
    ),
    Group(
        (d("KYRAIL", 1e3, 0.0), d("FYRAIL"), d("KZRAIL", 1e3, 0.0), d("FZRAIL"), maybe(d("DYSTEP0", MM), MM)),
        lambda n: n["Z"] in (2, 3) and n["F"] == 3,
    ),
    Group(
        (d("FBDIST", MM), d("FBPOS", MM), d("NOMRADW", MM, 0.0, above=True), maybe(d("YTAPE", MM), 1.0)),
        _new_wheel,
    ),
    *_profile("W", _new_wheel),
    Group(
        (
            d("S_WS", MM, when=_rail),
            d("X_WS", MM, when=_roller),
            d("Y_WS", MM),
            d("Z_WS", MM, when=lambda n: n["N"] == 0),
            d("FZ", when=lambda n: n["N"] == 1),
            a("ROLL"),
            a("YAW"),
            a("PITCH"),
        ),
        lambda n: n["E"] >= 1,
    ),
    Group(
        (
            d("VS", MM, when=_rail),
            a("RPITCH", when=_roller),
            d("VY", MM),
            d("VZ", MM),
            a("VROLL"),
            a("VYAW"),
            a("VPITCH", when=lambda n: n["F"] in (0, 3)),
            d("FX_WS", when=lambda n: n["F"] == 1),
        ),
        lambda n: n["E"] >= 2,
    ),
    Group(
        (d("DXWHL", MM), d("DYWHL", MM), d("DZWHL", MM), a("DROLLW"), a("DYAWW"), a("DPITCHW")),
        _flexible,
    ),
    Group(
        (d("VXWHL", MM), d("VYWHL", MM), d("VZWHL", MM), a("VROLLW"), a("VYAWW"), a("VPITCHW")),
        _flexible,
    ),
    *_STRESS,
)
BLOCKS: dict[int, tuple[Block, ...]] = {1: MODULE_1, 3: MODULE_3}
