"""What is doubted of an answer: one table of limits and words for Python, C and FMUs."""

from __future__ import annotations

import functools
import math

from contact.errors import ModelWarning, PlausibilityWarning, warn
from contact.inputs.plausibility import Usual
from contact.kernels.tangential.table import LOG_ASPECT_MAX, LOG_ASPECT_MIN
from contact.registry import GAP_LIMIT, GAP_LIMIT_INTERACTING

#: Change of the contact angle over a patch above which a plane contact may be wrong [rad] (docs/check/limits.md).
BEND = 0.4
#: Share of the load on shapes beyond the table of creep forces above which forces are doubtful [-].
BEYOND = 0.01


@functools.cache
def _gap(limit: float) -> Usual:
    return Usual(
        limit,
        "the pressure leaves gaps or overlaps inside the patch, strips do not see short waves of a profile (smooth it, or take "
        "more strips), or surfaces are no parabolas along x; "
        f"above {limit:g} the largest pressure may be more than 5 % wrong (limits.md)",
    )


_CARRIED = Usual(1e6, "a wheel carries 20 to 150 kN; do wheel and rail overlap by millimetres?")
#: Largest usual value of a number of an answer, and what is wrong above it.
ANSWERS = {
    "bend": Usual(
        BEND,
        f"the contact angle changes by more than {math.degrees(BEND):.0f} degrees over the patch, which strips take as "
        "plane: a lateral force of the pressure of up to 0.1 of the load is left out, and creep forces change by 0.03 of "
        "friction times load in the median. A conformal surface has both, but the influence numbers of a plane: 0.02 to 0.06 "
        "of friction times load in the median (limits.md)",
    ),
    "beyond": Usual(
        BEYOND,
        f"more than {BEYOND:g} of the load is on shapes with a/b beyond {math.exp(LOG_ASPECT_MIN):.3g} to "
        f"{math.exp(LOG_ASPECT_MAX):.3g}, the ends of the half space's table of creep forces ('fastrip_mapped', 'table'), "
        "or beyond 0.02 to 50, those of Kalker's coefficients (other methods), which count for them: "
        "forces may be more than 0.01 of friction times load off, above 50 more than 0.1 (limits.md)",
    ),
    "gap_error": _gap(GAP_LIMIT),
    "gap_error interacting": _gap(GAP_LIMIT_INTERACTING),
    "N": _CARRIED,
}
#: The same of numbers that only Python has.
_OTHERS = {
    "Q": _CARRIED,
    "fit_error": Usual(
        GAP_LIMIT_INTERACTING,
        "the wheel's rows along x are no parabolas, as the separation takes them: above "
        f"{GAP_LIMIT_INTERACTING:g} the largest pressure may be more than 5 % wrong, and creep forces by 0.02 of friction "
        "times load (limits.md); HalfspacePair of a SurfacePair takes the surfaces as they are",
    ),
}
#: Longest step of transient rolling that is not told, over the length of the contact (other_contacts.md).
LONGEST_STEP = 0.1
_BETTER = {"bend", "gap_error"}


def doubt_answer(
    told: set[str], gap_limit: float = GAP_LIMIT_INTERACTING, conformal: bool = False, many: str = "", **found: float
) -> None:
    """Warn of numbers of an answer above their limits, each once: the names of those that were told are in `told`.

    The text has a number that changes from call to call, so Python would show it at every call of a loop.

    Parameters
    ----------
    told : set of str
        Of the object that has the answer.
    gap_limit : float
        Limit of `gap_error` of the method.
    conformal : bool
        The strips lie on a bent surface.
    many : str
        Says that a `gap_error` is that of an array, which does not tell of a single one.
    **found
        Some of N, Q [N], `gap_error`, `bend`, `beyond`, `fit_error`.
    """
    for name, value in found.items():
        usual = _gap(gap_limit) if name == "gap_error" else ANSWERS.get(name) or _OTHERS[name]
        reason = name + {"gap_error": many, "bend": ", conformal" * conformal}.get(name, "")
        if value > usual.largest and reason not in told:
            better = "; normal = tangential = 'halfspace' does without this" if name in _BETTER else ""
            warn(
                f"{name} = {value:.3g}: {usual.hint}{better}",
                PlausibilityWarning if usual is _CARRIED else ModelWarning,
            )
            told.add(reason)  # not before: a warning may be an error


def doubt_step(told: set[str], distance: float, dx: float, length: int) -> None:
    """Warn once of a step [m] of more than one element of dx [m] and `LONGEST_STEP` of the contact of `length` elements."""
    elements, allowed = distance / dx, max(1.0, LONGEST_STEP * length)
    if "distance" in told or length == 0 or elements <= 1.001 * allowed:
        return
    warn(
        f"distance = {distance:g} m is {elements:.3g} of the {length} elements of the contact's length; with more than "
        f"{allowed:.3g} forces may be more than 0.05 of friction times load off (other_contacts.md); take one element",
        ModelWarning,
    )
    told.add("distance")
