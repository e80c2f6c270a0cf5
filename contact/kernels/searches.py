"""Records of searches under way: a root, creepages of a given force, strips that iterate (`contact.kernels.records`)."""

from contact.kernels.records import record

_ROOT = """
    x               next point to evaluate
    before          previous point
    value           last value of the function
    slope           slope of the last secant, at first as expected
    first           begin of the range
    last            end of the range
    low             lower end of the bracket
    high            upper end of the bracket
    longest         largest step
    evaluations:int number of evaluations
    beyond:int      1 if there is no change of sign up to an end of the range
    """

#: A search for the root of a rising function.
ROOT = record("root", _ROOT)

#: A search for the creepages under a given force. Residuals and their derivatives are those of `contact.kernels.given_force`.
FORCE_SEARCH = record(
    "force_search",
    _ROOT
    + """
    given:int       1 for the longitudinal force, 2 for the lateral one, 3 for both
    vx              next longitudinal creepage to evaluate [-]
    vy              next lateral creepage to evaluate [-]
    wanted_x        given longitudinal force [N]; 0 where none is given
    wanted_y        given lateral force [N]; 0 where none is given
    limit           friction times normal force [N]
    unit            creepage at which the force comes near the limit, roughly [-]
    bounded:int     1 where the force never exceeds the limit
    status:int      0, or Status
    stage:int       what the next force is for
    solutions:int   number of solutions
    trials:int      number of trials of this step
    fresh:int       1 where the Jacobian is that of differences at the best creepages
    best_x          longitudinal creepage with the smallest residual [-]
    best_y          lateral creepage with the smallest residual [-]
    rx              its longitudinal residual [-]
    ry              its lateral residual [-]
    error           error of its force over the limit [-]
    jacobian:4      derivatives of the residual, row by row
    """,
)

#: State of the iteration of interacting strips (`contact.kernels.normal.iteration`).
ITERATION = record(
    "iteration",
    """
    number:int      of this iteration, from 0
    begun:int       number of the first iteration from the present start
    warm:int        1 if this start is the last solution
    patience:int    number of the iteration in which a warm start is given up
    n_panels:int
    approach        above first touch [m]
    error           sum of the residuals, weighted by the strips' loads
    load            sum of these weights
    at_peak         residual of the panel with the largest pressure
    at_strip        largest step of ln a of a strip that counts
    last_error      error over load of the last iteration
    moved           largest move of an end over the width of its panel
    left            what the mixing leaves of the step
    mixed:int       number of iterations that the mixing knows
    cut:int         1 if idle parts of panels are cut off, so that this iteration has no residuals
    anew:int        1 if a panel was lost or the ends are fixed from here on, so that the best iterate no longer counts
    descending:int  1 if panels step by the Jacobian of an ellipse
    stuck:int       1 while they do not, since its steps did not make the residuals smaller
    searched:int    1 once the gap outside the panels was searched
    found:int       1 if there was missed contact
    parted:int      number of iterations after which panels were parted
    stiff:int       1 if the middles of skewed strips are straightened more from here on
    events:int      of this iteration, bits of Event
    last:int        1 if the pressures are those of the final unknowns
    converged:int   1 at rest
    best            error over load of the best iterate since the ends were fixed
    """,
)
