"""The arrays of a vehicle in the memory of an FMU, for the kernels of `models.vehicle.kernels`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numba import carray

from contact.kernels.block import ahead, cube, matrix, records, vector
from contact.kernels.records import GIVEN, MOTION
from fmu_src.native.memory import compiled, integers_of
from models.vehicle.assembly import Assembly, assemble
from models.vehicle.course import BEYOND, SPACING
from models.vehicle.declared import read
from models.vehicle.kernels.layout import (
    BODY,
    ELEMENT,
    LINK,
    SEAT,
    WHEEL,
    Book,
    Frame,
    Model,
    Row,
    Scratch,
    State,
    Sum,
)

#: Texts of failures.
ENDED = "the vehicle is not on the track: it ends here (fmu_src.track), or initial.distance is not on it"
LOST = "the motion has no finite value"
#: Number of `arrays`, and the place of the links among them.
_N_ARRAYS, _LINKS = 6, 1
_INTEGER = np.dtype([("value", "i8")])


class Parts(NamedTuple):
    """A vehicle in working memory. `begun` is not zero after it was placed on its rails."""

    begun: Any
    model: Any
    state: Any
    scratch: Any
    motions: Any


class Layout(NamedTuple):
    """Compiled functions of a vehicle in memory, and the number of values that carry over from step to step."""

    kept: int
    arrange: Callable[..., Any]
    fill: Callable[..., Any]


def arrays(vehicle: str) -> tuple[Assembly, tuple[np.ndarray, ...]]:
    """Return the arrays of a vehicle, and the same as the constants of its kernels."""
    made = assemble(read(vehicle))
    parts = (made.bodies, made.links, made.elements, made.table, made.wheelsets, made.rail)
    return made, tuple(np.ascontiguousarray(part).view(np.float64).ravel() for part in parts)


def layout_of(made: Assembly) -> Layout:
    """Return the functions for a vehicle of this size."""
    n_bodies, n_links, n_elements = len(made.names), made.links.size, made.elements.size
    n_axles, n_table = made.wheelsets.size, made.table.shape[1]
    n_wheels = 2 * n_axles
    kept = 1 + (3 * 6 * n_bodies) + 3 * n_elements + 8 * n_axles + 2 * n_axles + n_wheels * len(Sum) + len(Book)
    n_frame, n_sum, n_book, n_row = len(Frame), len(Sum), len(Book), len(Row)
    spacing, first = SPACING, -BEYOND

    @compiled
    def arrange(work, end, track, n_track, constants):
        """Lay out a vehicle: what carries over at the beginning of `work`, the rest from index `end` on.

        `track` points to the rows of the track, with `n_track` places, `constants` to those of `arrays`. Returns the vehicle
        and the new end.
        """
        bodies, _, elements, table, wheelsets, rail = constants[:_N_ARRAYS]
        begun, at = vector(work, 0, 1)
        q, at = matrix(work, at, n_bodies, 6)
        u, at = matrix(work, at, n_bodies, 6)
        inner, at = matrix(work, at, n_elements, 3)
        rails, at = cube(work, at, n_axles, 2, 4)
        loads, at = matrix(work, at, n_axles, 2)
        sums, at = matrix(work, at, n_wheels, n_sum)
        books, at = vector(work, at, n_book)
        forces, at = matrix(work, at, n_bodies, 6)  # of the last step, for the work of what holds the bodies
        own_links, end = records(work, end, n_links, LINK)
        frames, end = matrix(work, end, n_bodies, n_frame)
        given, end = records(work, end, n_wheels, GIVEN)
        seats, end = records(work, end, n_wheels, SEAT)
        wheels, end = records(work, end, n_wheels, WHEEL)
        power, end = vector(work, end, 3)
        motions, end = records(work, end, n_wheels, MOTION)
        surface, end = vector(work, end, 2)
        places, end = vector(work, end, 2)
        model = Model(
            records(bodies, 0, n_bodies, BODY)[0],
            own_links,
            records(elements, 0, n_elements, ELEMENT)[0],
            carray(table, (2, n_table)),
            carray(integers_of(records(wheelsets, 0, n_axles, _INTEGER)[0]), (n_axles,)),
            carray(track, (n_row, n_track)),
            carray(rail, (5,)),
            surface,
            places,
        )
        state = State(q, u, inner, rails, loads, sums, books)
        return Parts(begun, model, state, Scratch(frames, forces, given, seats, wheels, power), motions), end

    @compiled
    def fill(parts, constants, radius, origin_y, origin_z):
        """Fill what depends only on the parameters."""
        own = parts.model.links
        declared = records(constants[_LINKS], 0, n_links, LINK)[0]  # without rotations and offsets
        for k in range(n_links):
            own[k].a, own[k].b = declared[k].a, declared[k].b
        parts.model.spacing[0], parts.model.spacing[1] = spacing, first
        for w in range(n_wheels):
            here = parts.motions[w]
            here.radius, here.mirror = radius, 1.0 if w % 2 == 0 else -1.0
            here.origin_y, here.origin_z = origin_y, origin_z

    return Layout(kept, arrange, fill)


@compiled
def track_after(resources, n_files):
    """Return the pointer to the rows of the track, which comes after `n_files` profiles, and its number of places."""
    at = 0
    for _ in range(n_files):
        at += 1 + 3 * int(carray(ahead(resources, at), (1,))[0])
    return ahead(resources, at + 1), int(carray(ahead(resources, at), (1,))[0])


@compiled
def has_ended(parts):
    """Return whether the vehicle has reached the end of the track, or has no finite place."""
    s = parts.state.books[Book.DISTANCE]
    return not 0.0 <= s + BEYOND <= SPACING * (parts.model.track.shape[1] - 1) - BEYOND


@compiled
def is_finite(parts):
    """Return whether all coordinates and velocities are finite."""
    total = parts.state.q.sum() + parts.state.u.sum() + parts.state.rails.sum()
    return total - total == 0.0


@compiled
def write_motion(v, distance, body, parts):
    """Write the place, and the coordinates of all bodies from reference `body` on."""
    v[distance] = parts.state.books[Book.DISTANCE]
    n = parts.state.q.shape[0]
    for j in range(6):
        for i in range(n):
            v[body + j * n + i] = parts.state.q[i, j]
