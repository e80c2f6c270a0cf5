"""Sixteen strips side by side: the data layout in which compilers vectorise the march.

A march is a recurrence along x with square roots and divisions, so one strip keeps the processor waiting. Here sixteen
strips advance together. Their state lies in one flat array, lanes[ROW·LANES + l], with constant rows. Only then does
LLVM see that no two rows overlap, and vectorise. So the inner loops over l read and write nothing else. The output of
an element is copied to `trace` afterwards. The loops are free of branches (every value is computed, then selected) and
of calls into libm; the exponential is a rational function.

One strip after the other took 17 ns per element, eight lanes 7. Sixteen take four fifths of that, because one vector
works while another waits. 32 are no faster and leave more lanes empty.
"""

from enum import IntEnum, auto

from contact.core import kernel

LANES = 16


class Row(IntEnum):
    """Rows of `lanes`. The value of a row is the index of its first lane, so lane l is ``lanes[Now.X + l]``."""

    @staticmethod
    def _generate_next_value_(name, start, count, last_values):
        return last_values[-1] + LANES


def after(rows: type[Row]) -> int:
    """Return the value of the first row after `rows`."""
    return max(rows) + LANES


class Now(Row):
    """Output of the present element, which is copied to the first columns of a row of `trace`."""

    X = 0
    Y = auto()
    SLIP = auto()
    SLIDES = auto()
    STICK = auto()


class Trace(Row):
    """Columns of `trace` after the output, for friction that varies along the strips."""

    HEAT = after(Now)  # of an element
    FALL = auto()  # its coefficient over that at rest


#: Number of rows of `lanes`. The largest user needs 50 and those for friction that varies.
N_LANE_ROWS = 61
TRACE_WIDTH = after(Trace)


class Varying(Row):
    """The last rows of `lanes`: friction that varies along the strips (`varying`)."""

    SLIP = (N_LANE_ROWS - 11) * LANES
    FLUX = auto()
    HEATING = auto()
    SLOWED = auto()
    WARM = auto()
    FALL = auto()
    UNIT = auto()  # of slip over V
    LACK_X = auto()  # sums over the slip zone behind a stick zone (`falling`)
    LACK_Y = auto()
    SHED_X = auto()
    SHED_Y = auto()


#: A block of fewer strips marches in so many lanes, or a multiple of it: whole vectors of any processor.
_VECTOR = 8
#: Upper limit of the normalised distance over which a direction turns in one step. At it, the turn is complete.
FAR = 1e3
_OUTPUT = after(Now)  # length of the output of an element


@kernel
def room_for(n):
    """Return the size of a view of `lanes` from which `marching` knows that at most the first n > 0 strips are left.

    The rest of a patch, often four strips of 20, then takes half a block. The compiler does not know the number of lanes. It
    would unroll so short a loop instead of using vectors.
    """
    return (N_LANE_ROWS - 1) * LANES + min((n + _VECTOR - 1) // _VECTOR * _VECTOR, LANES)


@kernel
def marching(lanes):
    """Return the number of lanes that march."""
    return lanes.size - (N_LANE_ROWS - 1) * LANES


@kernel
def decay_and_lag(z):
    """Return exp(-z) for z >= 0, and the share of a step, from its start, whose rigid slip turns a direction that decays so.

    exp(-z) is the eighth power of an exponential series. Its error is 2e-6 (of 1), and it is positive and monotone for
    every z. For a rigid slip that changes linearly the share is 1/(1 - exp(-z)) - 1/z, from 1/2 to 1 - 1/z. Here it is
    (1 + L(z/2))/2 with a rational L(x) = coth x - 1/x, to .025. Both take one division.
    """
    u = 0.125 * z
    p = 1.0 + u * (1.0 + u * (0.5 + u * (1.0 / 6.0 + u * (1.0 / 24.0))))
    p *= p
    p *= p
    p *= p
    x = 0.5 * z
    below = 6.0 + x * (3.0 + x)
    inverse = 1.0 / (p * below)
    return below * inverse, 0.5 + 0.5 * x * (2.0 + x) * p * inverse


@kernel
def small_exp(z):
    """Return exp(z) for |z| <= 1 with a relative error of 2e-11.

    It is the eighth power of a Taylor series, which needs no libm.
    """
    u = 0.125 * z
    p = 1.0 / 6.0 + u * (1.0 / 24.0 + u * (1.0 / 120.0 + u * (1.0 / 720.0 + u * (1.0 / 5040.0))))
    p = 1.0 + u * (1.0 + u * (0.5 + u * p))
    p *= p
    p *= p
    return p * p


@kernel
def turned(ex, ey, wx, wy, w, rest):
    """Return the unit vector (ex, ey) turned towards -(wx, wy), where |w| = w > 0.

    The tangent of half the angle is multiplied by `rest`. A direction exactly opposite to the aim is an unstable
    equilibrium. It is kept, to round-off.
    """
    along = w - (wx * ex + wy * ey)
    across = (wy * ex - wx * ey) * rest
    scale = 1.0 / (w * (along * along + across * across) + 1e-300)
    c, d = (along * along - across * across) * scale, 2.0 * along * across * scale
    new_x, new_y = wy * d - wx * c, -wy * c - wx * d
    opposite = along < 1e-14 * w
    return ex if opposite else new_x, ey if opposite else new_y


@kernel
def keep(lanes, row):
    """Copy the output of the present element from `lanes` to its row of the trace."""
    for j in range(_OUTPUT):
        row[j] = lanes[j]


@kernel
def recall(lanes, row):
    """Copy a row of the trace back to `lanes`."""
    for j in range(_OUTPUT):
        lanes[j] = row[j]
