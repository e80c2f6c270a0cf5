"""The methods of `contact.solve` and their abilities. Tests, documentation, command line and FMUs read this registry."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

from contact.errors import ContactError, suggestion
from contact.kernels.enumerations import Normal, NormalFamily, Tangential, TangentialFamily
from contact.view.notebook import table

#: The default methods. The strip half space starts from ANALYN, and mapped FaStrip corrects FaStrip (docs/check/accuracy.md).
DEFAULT_NORMAL, DEFAULT_TANGENTIAL = "strip_halfspace", "fastrip_mapped"

T = TypeVar("T")

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
    non_elliptic: bool = True
    several_patches: bool = True
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


class ReadOnly(Mapping[str, T]):
    """A mapping that cannot be changed. Unlike `types.MappingProxyType` it can be copied and pickled."""

    def __init__(self, items: Mapping[str, T]) -> None:
        self._items = dict(items)

    def __getitem__(self, name: str) -> T:
        return self._items[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __repr__(self) -> str:
        return repr(self._items)


class Methods(NamedTuple):
    """The registered normal and tangential methods by name, in order of registration.

    Examples
    --------
    >>> import contact
    >>> sorted(set(contact.methods().normal) - set(contact.methods().batched.normal))
    ['halfspace']
    """

    normal: ReadOnly[Method]
    tangential: ReadOnly[Method]

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
        return Methods(*(ReadOnly({n: m for n, m in kind.items() if m.batched}) for kind in self))


def _normal(name: str, family: NormalFamily, title: str, source: str, **abilities: bool) -> Method:
    """Return a normal method, whose `id` has its name."""
    return Method(name=name, id=Normal[name.upper()], family=family, title=title, source=source, **abilities)


def _tangential(
    name: str, family: TangentialFamily, title: str, source: str, *, of: str = "", **abilities: bool
) -> Method:
    """Return a tangential method, whose `id` has its name or that of the method `of` whose kernel it uses."""
    return Method(
        name=name, id=Tangential[(of or name).upper()], family=family, title=title, source=source, **abilities
    )


def _force_law(name: str, title: str, source: str, **abilities: Any) -> Method:
    """Return a law of the creep force on an ellipse."""
    return _tangential(name, TangentialFamily.CREEP_FORCE, title, source, non_elliptic=False, fields=False, **abilities)


_NORMAL = (
    _normal("analyn", NormalFamily.ANALYN, "ANALYN, approximate surface deformation", "Sichani 2016, ch. 9, Paper B"),
    _normal(
        "hertz",
        NormalFamily.HERTZ,
        "Hertz's ellipse at the least point",
        "Hertz 1882; Johnson 1985",
        several_patches=False,
        non_elliptic=False,
    ),
    _normal(
        "strip_halfspace",
        NormalFamily.STRIP_HALFSPACE,
        "interacting strips with semi-elliptic pressure on a half space",
        "this project, after Knothe and Le The 1984",
        interacting=True,
    ),
    _normal("kik_piotrowski", NormalFamily.BY_APPROACH, "virtual penetration", "Kik and Piotrowski 1996"),
    _normal(
        "kik_piotrowski_2008",
        NormalFamily.BY_APPROACH,
        "virtual penetration with shape correction",
        "Piotrowski and Kik 2008",
        continuous=False,
    ),
    _normal("linder", NormalFamily.BY_APPROACH, "virtual penetration with local ellipses", "Linder 1997"),
    _normal("stripes_a", NormalFamily.BY_APPROACH, "STRIPES with A correction", "Ayasse and Chollet 2005"),
    _normal("stripes_ab", NormalFamily.BY_APPROACH, "STRIPES with AB correction", "Ayasse and Chollet 2005"),
    _normal("winkler", NormalFamily.BY_APPROACH, "elastic foundation", "Winkler 1867; Johnson 1985, ch. 4.3"),
    _normal("srst", NormalFamily.BY_APPROACH, "square root of half the overlap", "Alonso and Giménez 2005"),
    _normal(
        "kpec",
        NormalFamily.BY_APPROACH,
        "virtual penetration with elliptic correction",
        "CONTACT 25.1",
        several_patches=False,
        continuous=False,
    ),
    _normal("semi_winkler", NormalFamily.BY_APPROACH, "elastic foundation with tied springs", "Telliskivi 2004"),
    _normal(
        "multi_hertz",
        NormalFamily.BY_APPROACH,
        "ellipses at secondary points",
        "Pascal and Sauvage 1993",
        continuous=False,
    ),
    _normal(
        "pascal_sauvage",
        NormalFamily.BY_APPROACH,
        "equivalent ellipse",
        "Pascal and Sauvage 1993",
        several_patches=False,
        non_elliptic=False,
        continuous=False,
    ),
    _normal(
        "halfspace",
        NormalFamily.NONE,
        "NORM, element-wise half space: the reference",
        "Kalker 1990; Polonsky and Keer 1999",
        interacting=True,
        batched=False,
    ),
)
_TANGENTIAL = (
    _tangential(
        "fastrip", TangentialFamily.FASTRIP, "FaStrip on local ellipses", "Sichani 2016, ch. 4 and 9, Papers D and E"
    ),
    _tangential(
        "fastsim",
        TangentialFamily.FASTSIM,
        "FASTSIM, three flexibilities, parabolic bound",
        "Kalker 1982",
        admissible=False,
    ),
    _tangential(
        "fastrip_mapped",
        TangentialFamily.FASTRIP_MAPPED,
        "FaStrip in one march, mapped to the pressure",
        "this project",
        tabulated=True,
    ),
    _tangential(
        "fastsim_one",
        TangentialFamily.FASTSIM,
        "FASTSIM, one weighted flexibility, parabolic bound",
        "Kalker 1982",
        admissible=False,
    ),
    _tangential(
        "fastsim_elliptic", TangentialFamily.FASTSIM, "FASTSIM, three flexibilities, elliptic bound", "Kalker 1982"
    ),
    _tangential(
        "fastsim_linder",
        TangentialFamily.FASTSIM,
        "FASTSIM with the flexibilities of Linder's local ellipses",
        "Linder 1997",
        admissible=False,
    ),
    _tangential(
        "fastsim_stripes",
        TangentialFamily.FASTSIM,
        "FASTSIM with the flexibilities of STRIPES' local ellipses",
        "Ayasse and Chollet 2005",
        admissible=False,
    ),
    _tangential(
        "fastsim_knothe",
        TangentialFamily.FASTSIM,
        "FASTSIM with the flexibilities of linear theory on the patch itself",
        "this project, after Knothe and Le The 1984",
        of="fastsim",
        admissible=False,
        batched=False,
        calibrated=True,
    ),
    _tangential("strip_theory", TangentialFamily.FASTRIP, "strip theory", "Haines and Ollerton 1963; Kalker 1967"),
    _force_law("carter", "two-dimensional rolling contact, on a rectangle", "Carter 1926", spin=False, lateral=False),
    _force_law("johnson", "creepage without spin on the circle of equal area", "Johnson 1958", spin=False),
    _force_law("vermeulen_johnson", "creepage without spin on an ellipse", "Vermeulen and Johnson 1964", spin=False),
    _force_law("linear", "Kalker's linear theory", "Kalker 1967", saturates=False),
    _force_law("linear_saturated", "Kalker's linear theory, limited by friction", "thesis, ch. 5"),
    _force_law(
        "shen_hedrick_elkins", "Kalker's linear theory, saturated by the cubic law", "Shen, Hedrick and Elkins 1983"
    ),
    _force_law("polach", "creep force with spin", "Polach 1999"),
    _force_law(
        "table",
        "table of the half space's creep forces on ellipses",
        "this project, after Kalker 1996 (USETAB)",
        tabulated=True,
    ),
    _tangential(
        "halfspace",
        TangentialFamily.NONE,
        "TANG in steady rolling, element-wise half space: the reference",
        "Kalker 1990",
        batched=False,
    ),
)
_METHODS = Methods(
    ReadOnly({method.name: method for method in _NORMAL}),
    ReadOnly({method.name: method for method in _TANGENTIAL}),
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
    known: ReadOnly[Method] = getattr(_METHODS.batched if batched else _METHODS, kind)
    if not isinstance(name, str) or name not in known:
        what = "offered here, only by contact.solve" if name in list(getattr(_METHODS, kind)) else "a registered method"
        raise ContactError(f"{kind} = {name!r} is not {what}{suggestion(name, known)}; allowed: {', '.join(known)}")
    return known[name]
