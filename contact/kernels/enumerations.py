"""Values of the integer members of records (``case.normal == Normal.HERTZ``), and reasons why a search has no answer."""

from enum import IntEnum


class LoadKind(IntEnum):
    """What `case.amount` is: a normal force [N] or a rigid approach [m]."""

    LOAD = 0
    APPROACH = 1


class Normal(IntEnum):
    """Normal methods, in the order of `contact.methods()`."""

    ANALYN = 0
    HERTZ = 1
    STRIP_HALFSPACE = 2
    KIK_PIOTROWSKI = 3
    KIK_PIOTROWSKI_2008 = 4
    LINDER = 5
    STRIPES_A = 6
    STRIPES_AB = 7
    WINKLER = 8
    SRST = 9
    KPEC = 10
    SEMI_WINKLER = 11
    MULTI_HERTZ = 12
    PASCAL_SAUVAGE = 13
    HALFSPACE = 14  # element by element: no kernel of this package


class NormalFamily(IntEnum):
    """The kernel that solves a normal method."""

    ANALYN = 0
    HERTZ = 1
    STRIP_HALFSPACE = 2
    BY_APPROACH = 3  # strips follow from the approach in one go
    NONE = 4


class Tangential(IntEnum):
    """Tangential methods."""

    FASTRIP = 0
    FASTSIM = 1
    FASTRIP_MAPPED = 2
    FASTSIM_ONE = 3
    FASTSIM_ELLIPTIC = 4
    FASTSIM_LINDER = 5
    FASTSIM_STRIPES = 6
    STRIP_THEORY = 7
    CARTER = 8
    JOHNSON = 9
    VERMEULEN_JOHNSON = 10
    LINEAR = 11
    LINEAR_SATURATED = 12
    SHEN_HEDRICK_ELKINS = 13
    POLACH = 14
    TABLE = 15
    HALFSPACE = 16  # element by element: no kernel of this package


class TangentialFamily(IntEnum):
    """The kernel that solves a tangential method."""

    FASTRIP = 0
    FASTRIP_MAPPED = 1
    FASTSIM = 2
    CREEP_FORCE = 3  # forces only, no fields
    NONE = 4


class FrictionLaw(IntEnum):
    """How the coefficient of friction falls with the sliding velocity."""

    COULOMB = 0
    LINEAR = 1
    RATIONAL = 2
    RATIONAL_SQUARE = 3
    EXPONENTIAL = 4


class SlipVelocity(IntEnum):
    """The sliding velocity that a friction law takes."""

    GLOBAL = 0
    LOCAL = 1
    GREATEST = 2


class Status(IntEnum):
    """How a solution came about; the numbers are those of the FMU's `status`. Printed, it is its name.

    Attributes
    ----------
    OK : 1, solved
    NO_CONTACT : 2, the bodies do not touch: all forces are zero
    SATURATED : 3, solved; the whole patch slips
    OUT_OF_RANGE : 4, the patch reaches the end of the separation: data are missing
    NOT_CONVERGED : 5, the iteration stopped at its cap; the last iterate is returned
    UNREACHABLE : 6, no creepage makes the given force

    Examples
    --------
    >>> import contact
    >>> print(contact.Status.SATURATED, int(contact.Status.SATURATED))
    SATURATED 3
    """

    OK = 1
    NO_CONTACT = 2
    SATURATED = 3  # full slip: |F| = mu N up to the effect of spin
    OUT_OF_RANGE = 4  # the patch reaches the end of the separation: data are missing
    NOT_CONVERGED = 5
    UNREACHABLE = 6  # a given tangential force that no creepage makes; the FMUs take creepages

    def __str__(self) -> str:
        return self.name

    @property
    def message(self) -> str:
        """One sentence for a log."""
        return _MESSAGES[self]


_MESSAGES = {
    Status.OK: "solved",
    Status.NO_CONTACT: "the bodies do not touch: all forces are zero",
    Status.SATURATED: "solved; the whole patch slips",
    Status.OUT_OF_RANGE: "the contact patch reaches the end of the given separation; extend y",
    Status.NOT_CONVERGED: "the iteration stopped at its cap; the last iterate is returned",
    Status.UNREACHABLE: "no creepage makes the given force; the solution is that of the creepage in the record",
}


class Height(IntEnum):
    """What the height of a wheel on its rail follows from.

    LOAD is the vertical part of the normal forces, VERTICAL the whole vertical force, with friction [N].
    """

    GIVEN = 0
    PENETRATION = 1
    LOAD = 2
    VERTICAL = 3


class NoAnswer(IntEnum):
    """Why a contact search has no answer."""

    NO_OVERLAP = -1  # the profiles do not lie above each other
    NOT_SETTLED = -2  # no height was found at which the wheel carries the load
    TOO_DEEP = -3  # the wheel lies far inside the rail
    TURNED = -4  # wheelset and offset together turn the wheel beyond LARGEST_ANGLE


class WearLaw(IntEnum):
    """The law by which profiles wear."""

    ARCHARD = 0
    USFD = 1
    USFD_LOCAL = 2
    PEARCE_SHERRATT = 3
