"""The methods of `contact.solve` and their abilities. Tests, documentation, command line and FMUs read this registry."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from contact.errors import ContactError, suggestion
from contact.kernels.enumerations import Normal, NormalFamily, Tangential, TangentialFamily
from contact.notebook import table

#: The default methods. The strip half space starts from ANALYN, and mapped FaStrip corrects FaStrip (docs/check/accuracy.md).
DEFAULT_NORMAL, DEFAULT_TANGENTIAL = "strip_halfspace", "fastrip_mapped"


#: Limits of `gap_error` [-] of strips that do not interact, and of those that do (benchmarks/gap_error.py).
GAP_LIMIT, GAP_LIMIT_INTERACTING = 0.17, 0.03


@dataclass(frozen=True, slots=True, kw_only=True)
class Method:
    """A registered method.

    Attributes
    ----------
    name : name for `contact.solve(normal=…, tangential=…)`
    id : member of `Normal` or `Tangential` that identifies the method in kernels
    family : family of methods that share one kernel
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

    Examples
    --------
    >>> import contact
    >>> contact.methods().tangential["polach"].fields  # a law that gives forces only
    False
    """

    name: str
    id: Normal | Tangential
    family: NormalFamily | TangentialFamily
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
        """`gap_error` above which the largest pressure is doubtful (docs/check/limits.md says how often it then is wrong)."""
        return GAP_LIMIT_INTERACTING if self.interacting else GAP_LIMIT

    @property
    def elementwise(self) -> bool:
        """True for the element-wise half space."""
        return self.family in (NormalFamily.NONE, TangentialFamily.NONE)

    @property
    def kernel(self) -> str:
        """Name of the batched method whose kernel is used: its own name, or "fastsim" for a calibrated method."""
        return "fastsim" if self.calibrated else self.name


class Methods(NamedTuple):
    """The registered normal and tangential methods by name, in order of registration.

    Examples
    --------
    >>> import contact
    >>> sorted(set(contact.methods().normal) - set(contact.methods().batched.normal))
    ['halfspace']
    """

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


_NORMAL = (
    Method(
        name="analyn",
        id=Normal.ANALYN,
        family=NormalFamily.ANALYN,
        title="ANALYN, approximate surface deformation",
        source="Sichani 2016, ch. 9, Paper B",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="hertz",
        id=Normal.HERTZ,
        family=NormalFamily.HERTZ,
        title="Hertz's ellipse at the least point",
        source="Hertz 1882; Johnson 1985",
        non_elliptic=False,
        several_patches=False,
    ),
    Method(
        name="strip_halfspace",
        id=Normal.STRIP_HALFSPACE,
        family=NormalFamily.STRIP_HALFSPACE,
        title="interacting strips with semi-elliptic pressure on a half space",
        source="this project, after Knothe and Le The 1984",
        non_elliptic=True,
        several_patches=True,
        interacting=True,
    ),
    Method(
        name="kik_piotrowski",
        id=Normal.KIK_PIOTROWSKI,
        family=NormalFamily.BY_APPROACH,
        title="virtual penetration",
        source="Kik and Piotrowski 1996",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="kik_piotrowski_2008",
        id=Normal.KIK_PIOTROWSKI_2008,
        family=NormalFamily.BY_APPROACH,
        title="virtual penetration with shape correction",
        source="Piotrowski and Kik 2008",
        non_elliptic=True,
        several_patches=True,
        continuous=False,
    ),
    Method(
        name="linder",
        id=Normal.LINDER,
        family=NormalFamily.BY_APPROACH,
        title="virtual penetration with local ellipses",
        source="Linder 1997",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="stripes_a",
        id=Normal.STRIPES_A,
        family=NormalFamily.BY_APPROACH,
        title="STRIPES with A correction",
        source="Ayasse and Chollet 2005",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="stripes_ab",
        id=Normal.STRIPES_AB,
        family=NormalFamily.BY_APPROACH,
        title="STRIPES with AB correction",
        source="Ayasse and Chollet 2005",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="winkler",
        id=Normal.WINKLER,
        family=NormalFamily.BY_APPROACH,
        title="elastic foundation",
        source="Winkler 1867; Johnson 1985, ch. 4.3",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="srst",
        id=Normal.SRST,
        family=NormalFamily.BY_APPROACH,
        title="square root of half the overlap",
        source="Alonso and Giménez 2005",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="kpec",
        id=Normal.KPEC,
        family=NormalFamily.BY_APPROACH,
        title="virtual penetration with elliptic correction",
        source="CONTACT 25.1",
        non_elliptic=True,
        several_patches=False,
        continuous=False,
    ),
    Method(
        name="semi_winkler",
        id=Normal.SEMI_WINKLER,
        family=NormalFamily.BY_APPROACH,
        title="elastic foundation with tied springs",
        source="Telliskivi 2004",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="multi_hertz",
        id=Normal.MULTI_HERTZ,
        family=NormalFamily.BY_APPROACH,
        title="ellipses at secondary points",
        source="Pascal and Sauvage 1993",
        non_elliptic=True,
        several_patches=True,
        continuous=False,
    ),
    Method(
        name="pascal_sauvage",
        id=Normal.PASCAL_SAUVAGE,
        family=NormalFamily.BY_APPROACH,
        title="equivalent ellipse",
        source="Pascal and Sauvage 1993",
        non_elliptic=False,
        several_patches=False,
        continuous=False,
    ),
    Method(
        name="halfspace",
        id=Normal.HALFSPACE,
        family=NormalFamily.NONE,
        title="NORM, element-wise half space: the reference",
        source="Kalker 1990; Polonsky and Keer 1999",
        non_elliptic=True,
        several_patches=True,
        interacting=True,
        batched=False,
    ),
)
_TANGENTIAL = (
    Method(
        name="fastrip",
        id=Tangential.FASTRIP,
        family=TangentialFamily.FASTRIP,
        title="FaStrip on local ellipses",
        source="Sichani 2016, ch. 4 and 9, Papers D and E",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="fastsim",
        id=Tangential.FASTSIM,
        family=TangentialFamily.FASTSIM,
        title="FASTSIM, three flexibilities, parabolic bound",
        source="Kalker 1982",
        non_elliptic=True,
        several_patches=True,
        admissible=False,
    ),
    Method(
        name="fastrip_mapped",
        id=Tangential.FASTRIP_MAPPED,
        family=TangentialFamily.FASTRIP_MAPPED,
        title="FaStrip in one march, mapped to the pressure",
        source="this project",
        non_elliptic=True,
        several_patches=True,
        tabulated=True,
    ),
    Method(
        name="fastsim_one",
        id=Tangential.FASTSIM_ONE,
        family=TangentialFamily.FASTSIM,
        title="FASTSIM, one weighted flexibility, parabolic bound",
        source="Kalker 1982",
        non_elliptic=True,
        several_patches=True,
        admissible=False,
    ),
    Method(
        name="fastsim_elliptic",
        id=Tangential.FASTSIM_ELLIPTIC,
        family=TangentialFamily.FASTSIM,
        title="FASTSIM, three flexibilities, elliptic bound",
        source="Kalker 1982",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="fastsim_linder",
        id=Tangential.FASTSIM_LINDER,
        family=TangentialFamily.FASTSIM,
        title="FASTSIM with the flexibilities of Linder's local ellipses",
        source="Linder 1997",
        non_elliptic=True,
        several_patches=True,
        admissible=False,
    ),
    Method(
        name="fastsim_stripes",
        id=Tangential.FASTSIM_STRIPES,
        family=TangentialFamily.FASTSIM,
        title="FASTSIM with the flexibilities of STRIPES' local ellipses",
        source="Ayasse and Chollet 2005",
        non_elliptic=True,
        several_patches=True,
        admissible=False,
    ),
    Method(
        name="fastsim_knothe",
        id=Tangential.FASTSIM,
        family=TangentialFamily.FASTSIM,
        title="FASTSIM with the flexibilities of linear theory on the patch itself",
        source="this project, after Knothe and Le The 1984",
        non_elliptic=True,
        several_patches=True,
        admissible=False,
        batched=False,
        calibrated=True,
    ),
    Method(
        name="strip_theory",
        id=Tangential.STRIP_THEORY,
        family=TangentialFamily.FASTRIP,
        title="strip theory",
        source="Haines and Ollerton 1963; Kalker 1967",
        non_elliptic=True,
        several_patches=True,
    ),
    Method(
        name="carter",
        id=Tangential.CARTER,
        family=TangentialFamily.CREEP_FORCE,
        title="two-dimensional rolling contact, on a rectangle",
        source="Carter 1926",
        non_elliptic=False,
        several_patches=True,
        fields=False,
        spin=False,
        lateral=False,
    ),
    Method(
        name="johnson",
        id=Tangential.JOHNSON,
        family=TangentialFamily.CREEP_FORCE,
        title="creepage without spin on the circle of equal area",
        source="Johnson 1958",
        non_elliptic=False,
        several_patches=True,
        fields=False,
        spin=False,
    ),
    Method(
        name="vermeulen_johnson",
        id=Tangential.VERMEULEN_JOHNSON,
        family=TangentialFamily.CREEP_FORCE,
        title="creepage without spin on an ellipse",
        source="Vermeulen and Johnson 1964",
        non_elliptic=False,
        several_patches=True,
        fields=False,
        spin=False,
    ),
    Method(
        name="linear",
        id=Tangential.LINEAR,
        family=TangentialFamily.CREEP_FORCE,
        title="Kalker's linear theory",
        source="Kalker 1967",
        non_elliptic=False,
        several_patches=True,
        fields=False,
        saturates=False,
    ),
    Method(
        name="linear_saturated",
        id=Tangential.LINEAR_SATURATED,
        family=TangentialFamily.CREEP_FORCE,
        title="Kalker's linear theory, limited by friction",
        source="thesis, ch. 5",
        non_elliptic=False,
        several_patches=True,
        fields=False,
    ),
    Method(
        name="shen_hedrick_elkins",
        id=Tangential.SHEN_HEDRICK_ELKINS,
        family=TangentialFamily.CREEP_FORCE,
        title="Kalker's linear theory, saturated by the cubic law",
        source="Shen, Hedrick and Elkins 1983",
        non_elliptic=False,
        several_patches=True,
        fields=False,
    ),
    Method(
        name="polach",
        id=Tangential.POLACH,
        family=TangentialFamily.CREEP_FORCE,
        title="creep force with spin",
        source="Polach 1999",
        non_elliptic=False,
        several_patches=True,
        fields=False,
    ),
    Method(
        name="table",
        id=Tangential.TABLE,
        family=TangentialFamily.CREEP_FORCE,
        title="table of the half space's creep forces on ellipses",
        source="this project, after Kalker 1996 (USETAB)",
        non_elliptic=False,
        several_patches=True,
        fields=False,
        tabulated=True,
    ),
    Method(
        name="halfspace",
        id=Tangential.HALFSPACE,
        family=TangentialFamily.NONE,
        title="TANG in steady rolling, element-wise half space: the reference",
        source="Kalker 1990",
        non_elliptic=True,
        several_patches=True,
        batched=False,
    ),
)
_METHODS = Methods(
    MappingProxyType({method.name: method for method in _NORMAL}),
    MappingProxyType({method.name: method for method in _TANGENTIAL}),
)


def methods() -> Methods:
    """Return the registered methods: ``methods().normal["analyn"]``, ``methods().tangential["fastrip"]``, …

    Examples
    --------
    >>> import contact
    >>> contact.methods().normal["analyn"].title
    'ANALYN, approximate surface deformation'
    """
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
