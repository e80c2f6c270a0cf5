"""The methods of `contact.solve` and their abilities. Tests, documentation, command line and FMUs read this registry."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from contact.errors import ContactError, suggestion
from contact.kernels.enumerations import Normal, NormalFamily, Tangential, TangentialFamily
from contact.notebook import table

#: The default methods. The strip half space starts from ANALYN, and mapped FaStrip corrects FaStrip (docs/accuracy.md).
DEFAULT_NORMAL, DEFAULT_TANGENTIAL = "strip_halfspace", "fastrip_mapped"


#: Limits of `gap_error` [-] of strips that do not interact, and of those that do (benchmarks/gap_error.py).
GAP_LIMIT, GAP_LIMIT_INTERACTING = 0.17, 0.03


@dataclass(frozen=True, slots=True)
class Method:
    """A registered method.

    Attributes
    ----------
    name : name for `contact.solve(normal=…, tangential=…)`
    id : member of `Normal` or `Tangential` that identifies the method in kernels
    title, source : for documentation
    non_elliptic : computes a non-elliptic patch or pressure
    several_patches : handles several separate patches
    fields : returns traction, slip and stick over the patch (tangential) or pressure (normal)
    spin : takes spin into account
    lateral : takes lateral creepage into account (tangential)
    saturates : the force never exceeds friction times load (tangential)
    tabulated : reads the half space's table of creep forces or of effective creepages (tangential)
    admissible : the traction nowhere exceeds friction times pressure (tangential)
    interacting : every strip is loaded by the pressure of all other strips (normal)
    batched : has a kernel over strips, which `contact.forces` and the FMUs use too; else it is only in `contact.solve`
    continuous : the load is a continuous function of the approach on every patch (normal)
    calibrated : takes its stiffness from the half space's linear theory on the patch itself (tangential)
    """

    name: str
    id: Normal | Tangential
    title: str
    source: str
    non_elliptic: bool
    several_patches: bool
    fields: bool = True
    spin: bool = True
    lateral: bool = True
    saturates: bool = True
    tabulated: bool = False
    admissible: bool = True
    interacting: bool = False
    batched: bool = True
    continuous: bool = True
    calibrated: bool = False

    @property
    def abilities(self) -> tuple[str, ...]:
        """Names of the abilities and limits in which methods of the same kind differ."""
        tangential = isinstance(self.id, Tangential)
        stated = {
            "non-elliptic": self.non_elliptic,
            "several patches": self.several_patches,
            "spin": tangential and self.spin,
            "slip field": tangential and self.fields,
            "longitudinal creepage only": not self.lateral,
            "no friction": not self.saturates,
            "interacting strips": self.interacting,
            "load may step": not self.continuous,
        }
        return tuple(what for what, true in stated.items() if true)

    @property
    def gap_limit(self) -> float:
        """`gap_error` above which the largest pressure is doubtful (docs/limits.md says how often it then is wrong)."""
        return GAP_LIMIT_INTERACTING if self.interacting else GAP_LIMIT

    @property
    def elementwise(self) -> bool:
        """True for the element-wise half space."""
        return self.family in (NormalFamily.NONE, TangentialFamily.NONE)

    @property
    def kernel(self) -> str:
        """Name of the batched method whose kernel is used: its own name, or "fastsim" for a calibrated method."""
        return "fastsim" if self.calibrated else self.name

    @property
    def family(self) -> NormalFamily | TangentialFamily:
        """Family of methods that share one kernel."""
        by_approach = isinstance(self.id, Normal)
        return _FAMILIES.get(
            (type(self.id), self.id), NormalFamily.BY_APPROACH if by_approach else TangentialFamily.CREEP_FORCE
        )


class Methods(NamedTuple):
    """The registered normal and tangential methods by name, in order of registration."""

    normal: MappingProxyType[str, Method]
    tangential: MappingProxyType[str, Method]

    def __repr__(self) -> str:
        return f"Methods(normal: {', '.join(self.normal)}; tangential: {', '.join(self.tangential)})"

    def _repr_html_(self) -> str:
        """Return an HTML table of the methods and their abilities, for a notebook."""
        return "".join(
            table(
                ("name", "method", "source", "can do"),
                ((method.name, method.title, method.source, ", ".join(method.abilities)) for method in known.values()),
                f"{kind} methods",
            )
            for kind, known in self._asdict().items()
        )

    @property
    def batched(self) -> Methods:
        """The methods that `contact.forces` and the FMUs offer."""
        return Methods(*(MappingProxyType({n: m for n, m in kind.items() if m.batched}) for kind in self))


_FAMILIES: dict[tuple[type, int], NormalFamily | TangentialFamily] = {
    (Normal, Normal.ANALYN): NormalFamily.ANALYN,
    (Normal, Normal.HERTZ): NormalFamily.HERTZ,
    (Normal, Normal.STRIP_HALFSPACE): NormalFamily.STRIP_HALFSPACE,
    (Normal, Normal.HALFSPACE): NormalFamily.NONE,
    (Tangential, Tangential.FASTRIP): TangentialFamily.FASTRIP,
    (Tangential, Tangential.STRIP_THEORY): TangentialFamily.FASTRIP,
    (Tangential, Tangential.FASTRIP_MAPPED): TangentialFamily.FASTRIP_MAPPED,
    (Tangential, Tangential.FASTSIM): TangentialFamily.FASTSIM,
    (Tangential, Tangential.FASTSIM_ONE): TangentialFamily.FASTSIM,
    (Tangential, Tangential.FASTSIM_ELLIPTIC): TangentialFamily.FASTSIM,
    (Tangential, Tangential.FASTSIM_LINDER): TangentialFamily.FASTSIM,
    (Tangential, Tangential.FASTSIM_STRIPES): TangentialFamily.FASTSIM,
    (Tangential, Tangential.HALFSPACE): TangentialFamily.NONE,
}

_NORMAL = (
    Method(
        "analyn", Normal.ANALYN, "ANALYN, approximate surface deformation", "Sichani 2016, ch. 9, Paper B", True, True
    ),
    Method("hertz", Normal.HERTZ, "Hertz's ellipse at the least point", "Hertz 1882; Johnson 1985", False, False),
    Method(
        "strip_halfspace",
        Normal.STRIP_HALFSPACE,
        "interacting strips with semi-elliptic pressure on a half space",
        "this project, after Knothe and Le The 1984",
        True,
        True,
        interacting=True,
    ),
    Method("kik_piotrowski", Normal.KIK_PIOTROWSKI, "virtual penetration", "Kik and Piotrowski 1996", True, True),
    Method(
        "kik_piotrowski_2008",
        Normal.KIK_PIOTROWSKI_2008,
        "virtual penetration with shape correction",
        "Piotrowski and Kik 2008",
        True,
        True,
        continuous=False,
    ),
    Method("linder", Normal.LINDER, "virtual penetration with local ellipses", "Linder 1997", True, True),
    Method("stripes_a", Normal.STRIPES_A, "STRIPES with A correction", "Ayasse and Chollet 2005", True, True),
    Method("stripes_ab", Normal.STRIPES_AB, "STRIPES with AB correction", "Ayasse and Chollet 2005", True, True),
    Method("winkler", Normal.WINKLER, "elastic foundation", "Winkler 1867; Johnson 1985, ch. 4.3", True, True),
    Method("srst", Normal.SRST, "square root of half the overlap", "Alonso and Giménez 2005", True, True),
    Method(
        "kpec",
        Normal.KPEC,
        "virtual penetration with elliptic correction",
        "CONTACT 25.1",
        True,
        False,
        continuous=False,
    ),
    Method("semi_winkler", Normal.SEMI_WINKLER, "elastic foundation with tied springs", "Telliskivi 2004", True, True),
    Method(
        "multi_hertz",
        Normal.MULTI_HERTZ,
        "ellipses at secondary points",
        "Pascal and Sauvage 1993",
        True,
        True,
        continuous=False,
    ),
    Method(
        "pascal_sauvage",
        Normal.PASCAL_SAUVAGE,
        "equivalent ellipse",
        "Pascal and Sauvage 1993",
        False,
        False,
        continuous=False,
    ),
    Method(
        "halfspace",
        Normal.HALFSPACE,
        "NORM, element-wise half space: the reference",
        "Kalker 1990; Polonsky and Keer 1999",
        True,
        True,
        interacting=True,
        batched=False,
    ),
)
_TANGENTIAL = (
    Method(
        "fastrip",
        Tangential.FASTRIP,
        "FaStrip on local ellipses",
        "Sichani 2016, ch. 4 and 9, Papers D and E",
        True,
        True,
    ),
    Method(
        "fastsim",
        Tangential.FASTSIM,
        "FASTSIM, three flexibilities, parabolic bound",
        "Kalker 1982",
        True,
        True,
        admissible=False,
    ),
    Method(
        "fastrip_mapped",
        Tangential.FASTRIP_MAPPED,
        "FaStrip in one march, mapped to the pressure",
        "this project",
        True,
        True,
        tabulated=True,
    ),
    Method(
        "fastsim_one",
        Tangential.FASTSIM_ONE,
        "FASTSIM, one weighted flexibility, parabolic bound",
        "Kalker 1982",
        True,
        True,
        admissible=False,
    ),
    Method(
        "fastsim_elliptic",
        Tangential.FASTSIM_ELLIPTIC,
        "FASTSIM, three flexibilities, elliptic bound",
        "Kalker 1982",
        True,
        True,
    ),
    Method(
        "fastsim_linder",
        Tangential.FASTSIM_LINDER,
        "FASTSIM with the flexibilities of Linder's local ellipses",
        "Linder 1997",
        True,
        True,
        admissible=False,
    ),
    Method(
        "fastsim_stripes",
        Tangential.FASTSIM_STRIPES,
        "FASTSIM with the flexibilities of STRIPES' local ellipses",
        "Ayasse and Chollet 2005",
        True,
        True,
        admissible=False,
    ),
    Method(
        "fastsim_knothe",
        Tangential.FASTSIM,
        "FASTSIM with the flexibilities of linear theory on the patch itself",
        "this project, after Knothe and Le The 1984",
        True,
        True,
        admissible=False,
        batched=False,
        calibrated=True,
    ),
    Method(
        "strip_theory", Tangential.STRIP_THEORY, "strip theory", "Haines and Ollerton 1963; Kalker 1967", True, True
    ),
    Method(
        "carter",
        Tangential.CARTER,
        "two-dimensional rolling contact, on a rectangle",
        "Carter 1926",
        False,
        True,
        fields=False,
        spin=False,
        lateral=False,
    ),
    Method(
        "johnson",
        Tangential.JOHNSON,
        "creepage without spin on the circle of equal area",
        "Johnson 1958",
        False,
        True,
        fields=False,
        spin=False,
    ),
    Method(
        "vermeulen_johnson",
        Tangential.VERMEULEN_JOHNSON,
        "creepage without spin on an ellipse",
        "Vermeulen and Johnson 1964",
        False,
        True,
        fields=False,
        spin=False,
    ),
    Method(
        "linear", Tangential.LINEAR, "Kalker's linear theory", "Kalker 1967", False, True, fields=False, saturates=False
    ),
    Method(
        "linear_saturated",
        Tangential.LINEAR_SATURATED,
        "Kalker's linear theory, limited by friction",
        "thesis, ch. 5",
        False,
        True,
        fields=False,
    ),
    Method(
        "shen_hedrick_elkins",
        Tangential.SHEN_HEDRICK_ELKINS,
        "Kalker's linear theory, saturated by the cubic law",
        "Shen, Hedrick and Elkins 1983",
        False,
        True,
        fields=False,
    ),
    Method("polach", Tangential.POLACH, "creep force with spin", "Polach 1999", False, True, fields=False),
    Method(
        "table",
        Tangential.TABLE,
        "table of the half space's creep forces on ellipses",
        "this project, after Kalker 1996 (USETAB)",
        False,
        True,
        fields=False,
        tabulated=True,
    ),
    Method(
        "halfspace",
        Tangential.HALFSPACE,
        "TANG in steady rolling, element-wise half space: the reference",
        "Kalker 1990",
        True,
        True,
        batched=False,
    ),
)
_METHODS = Methods(
    MappingProxyType({method.name: method for method in _NORMAL}),
    MappingProxyType({method.name: method for method in _TANGENTIAL}),
)


def methods() -> Methods:
    """Return the registered methods: ``methods().normal["analyn"]``, ``methods().tangential["fastrip"]``, …"""
    return _METHODS


def lookup(kind: str, name: str, *, batched: bool = False) -> Method:
    """Return the method `name` of `kind` ("normal" or "tangential"). With `batched`, only batched methods are allowed.

    Raises
    ------
    ContactError
        For any other name. The message lists the allowed names.
    """
    known: MappingProxyType[str, Method] = getattr(_METHODS.batched if batched else _METHODS, kind)
    if name not in known:
        what = "offered here, only by contact.solve" if name in getattr(_METHODS, kind) else "a registered method"
        raise ContactError(f"{kind} = {name!r} is not {what}{suggestion(name, known)}; allowed: {', '.join(known)}")
    return known[name]
