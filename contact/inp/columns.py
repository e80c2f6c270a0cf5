"""Columns of results: CONTACT's names, units and signs, or ours in SI."""

from __future__ import annotations

from typing import NamedTuple


class Column(NamedTuple):
    """A quantity: CONTACT's name and unit, the factor from SI, our name and unit, and the factor from CONTACT's sign to ours.

    Values are kept in SI with CONTACT's signs: forces and tractions act on the rail, creepages are rail minus wheel.
    """

    name: str
    unit: str
    per_si: float
    ours: str
    ours_unit: str
    sign: float = 1.0

    @property
    def title(self) -> str:
        """Name and unit, as CONTACT's."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    @property
    def our_title(self) -> str:
        """Our name and unit."""
        return f"{self.ours} [{self.ours_unit}]" if self.ours_unit else self.ours


def _force(name: str, ours: str) -> Column:
    return Column(name, "N", 1.0, ours, "N", -1.0)


#: Of a whole case (patch 0).
TOTALS: tuple[Column, ...] = (
    _force("FX(TR)", "X"),
    _force("FY(TR)", "Y"),
    _force("FZ(TR)", "Z"),
    _force("FX(WS)", "X in wheelset axes"),
    _force("FY(WS)", "Y in wheelset axes"),
    _force("FZ(WS)", "Z in wheelset axes"),
    Column("Z_WS", "mm", 1e3, "z of the wheelset", "m"),
)
#: Of a patch.
PATCH: tuple[Column, ...] = (
    Column("FN", "N", 1.0, "N", "N"),
    _force("FX", "Fx"),
    _force("FY", "Fy"),
    Column("MZ", "N mm", 1e3, "Mz", "N m", -1.0),
    Column("CKSI", "", 1.0, "longitudinal", "", -1.0),
    Column("CETA", "", 1.0, "lateral", "", -1.0),
    Column("CPHI", "rad/mm", 1e-3, "spin", "1/m", -1.0),
    Column("APPROACH", "mm", 1e3, "approach", "m"),
    Column("PMAX", "MPa", 1e-6, "max_pressure", "Pa"),
    Column("NCON", "", 1.0, "n_contact", ""),
    Column("NADH", "", 1.0, "n_stick", ""),
    Column("NSLIP", "", 1.0, "n_slip", ""),
    Column("NPLAST", "", 1.0, "n_plastic", ""),
    Column("XCP(TR)", "mm", 1e3, "x", "m"),
    Column("YCP(TR)", "mm", 1e3, "y", "m"),
    Column("ZCP(TR)", "mm", 1e3, "z", "m"),
    Column("DELTCP(TR)", "rad", 1.0, "angle", "rad"),
    Column("YCP(R)", "mm", 1e3, "y on the rail", "m"),
    Column("ZCP(R)", "mm", 1e3, "z on the rail", "m"),
    Column("YCP(W)", "mm", 1e3, "y on the wheel", "m"),
    Column("MAX(T1,T2)", "°C", 1.0, "temperature", "°C"),
    Column("ELAST.EN.", "J", 1.0, "elastic_energy", "J"),
    Column("FRIC.POWER", "W", 1.0, "friction_power", "W"),
)
SIGNS = ("ours", "contact")
