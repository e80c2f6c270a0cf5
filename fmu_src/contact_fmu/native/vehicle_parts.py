"""The arrays of a vehicle in the memory of an FMU, for the kernels of `contact_models.vehicle.kernels`."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import carray

from contact.compile.pointers import integers_of
from contact.core import arranging, group
from contact.kernels.block import ahead, cube, matrix, records, vector
from contact.kernels.records import GIVEN, MOTION
from contact_models.vehicle.kernels.layout import (
    BODY,
    ELEMENT,
    LINK,
    SEAT,
    WHEEL,
    Book,
    Model,
    Scratch,
    State,
    Sum,
    TrackFrame,
    TrackRow,
)

_INTEGER = np.dtype([("value", "i8")])
_N_WHEEL = WHEEL.itemsize // 8
_N_BODY, _N_LINK, _N_ELEMENT = BODY.itemsize // 8, LINK.itemsize // 8, ELEMENT.itemsize // 8
_N_FRAME, _N_SUM, _N_BOOK, _N_ROW = len(TrackFrame), len(Sum), len(Book), len(TrackRow)


@group
class Parts(NamedTuple):
    """A vehicle in working memory. `begun` is not zero after it was placed on its rails."""

    begun: Any
    model: Any
    state: Any
    scratch: Any
    motions: Any


@group
class Constants(NamedTuple):
    """Pointers to the arrays of a vehicle in its numbers (`components`), and the wheels' radius."""

    bodies: Any
    links: Any
    elements: Any
    table: Any
    wheelsets: Any
    rail: Any
    radius: Any


@arranging
def constants_of(own, at, begin):
    """Return the constants, which begin at index `begin` of the numbers, after `at`."""
    links = begin + at.n_bodies * _N_BODY
    elements = links + at.n_links * _N_LINK
    table = elements + at.n_elements * _N_ELEMENT
    wheelsets = table + 2 * at.n_table
    rail = wheelsets + at.n_axles
    radius, _ = vector(own, rail + 5, 1)
    return Constants(
        ahead(own, begin), ahead(own, links), ahead(own, elements), ahead(own, table), ahead(own, wheelsets),
        ahead(own, rail), radius[0],
    )  # fmt: skip


@arranging
def kept_by(at):
    """Return the number of values that carry over from step to step."""
    of_bodies = 1 + (3 * 6 * at.n_bodies) + 3 * at.n_elements
    return of_bodies + (8 + 2 + 6) * at.n_axles + 2 * at.n_axles * (_N_SUM + _N_WHEEL) + _N_BOOK


@arranging
def arrange(work, end, track, n_track, at, constants):
    """Lay out a vehicle: what carries over at the beginning of `work`, the rest from index `end` on.

    `track` points to the rows of the track, with `n_track` places. Returns the vehicle and the new end.
    """
    n_bodies, n_elements, n_axles, n_wheels = at.n_bodies, at.n_elements, at.n_axles, 2 * at.n_axles
    begun, to = vector(work, 0, 1)
    q, to = matrix(work, to, n_bodies, 6)
    u, to = matrix(work, to, n_bodies, 6)
    inner, to = matrix(work, to, n_elements, 3)
    rails, to = cube(work, to, n_axles, 2, 4)
    loads, to = matrix(work, to, n_axles, 2)
    sums, to = matrix(work, to, n_wheels, _N_SUM)
    books, to = vector(work, to, _N_BOOK)
    gains, to = matrix(work, to, n_axles, 6)
    forces, to = matrix(work, to, n_bodies, 6)  # of the last step, for the work of what holds the bodies
    wheels, to = records(work, to, n_wheels, WHEEL)  # of the last step, for the next one that solves no contact
    own_links, end = records(work, end, at.n_links, LINK)
    frames, end = matrix(work, end, n_bodies, _N_FRAME)
    given, end = records(work, end, n_wheels, GIVEN)
    seats, end = records(work, end, n_wheels, SEAT)
    power, end = vector(work, end, 3)
    motions, end = records(work, end, n_wheels, MOTION)
    surface, end = vector(work, end, 2)
    model = Model(
        records(constants.bodies, 0, n_bodies, BODY)[0],
        own_links,
        records(constants.elements, 0, n_elements, ELEMENT)[0],
        carray(constants.table, (2, at.n_table)),
        carray(integers_of(records(constants.wheelsets, 0, n_axles, _INTEGER)[0]), (n_axles,)),
        carray(track, (_N_ROW, n_track)),
        carray(constants.rail, (5,)),
        surface,
    )
    state = State(q, u, inner, rails, loads, sums, books, gains)
    return Parts(begun, model, state, Scratch(frames, forces, given, seats, wheels, power), motions), end


@arranging
def fill(parts, constants, radius, origin_y, origin_z, slowest):
    """Fill what depends only on the parameters."""
    own = parts.model.links
    declared = records(constants.links, 0, own.size, LINK)[0]  # without rotations and offsets
    for k in range(own.size):
        own[k].a, own[k].b = declared[k].a, declared[k].b
    for w in range(parts.motions.size):
        here = parts.motions[w]
        here.radius, here.mirror = radius, 1.0 if w % 2 == 0 else -1.0
        here.origin_y, here.origin_z, here.slowest = origin_y, origin_z, slowest


@arranging
def track_after(resources, n_files):
    """Return the pointer to the rows of the track, which comes after `n_files` profiles, and its number of places."""
    at = 0
    for _ in range(n_files):
        at += 1 + 3 * int(carray(ahead(resources, at), (1,))[0])
    return ahead(resources, at + 1), int(carray(ahead(resources, at), (1,))[0])


@arranging
def write_motion(v, distance, body, parts):
    """Write the place, and the coordinates of all bodies from reference `body` on."""
    v[distance] = parts.state.books[Book.DISTANCE]
    n = parts.state.q.shape[0]
    for j in range(6):
        for i in range(n):
            v[body + j * n + i] = parts.state.q[i, j]
