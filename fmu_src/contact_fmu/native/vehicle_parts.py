"""The arrays of a vehicle in the memory of an FMU, for the kernels of `contact_models.vehicle.kernels`."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import carray

from contact.compile.pointers import integers_of
from contact.core import arranging, group
from contact.kernels.block import ahead, matrix, records, vector
from contact.kernels.records import MOTION
from contact_models.vehicle.kernels.layout import BODY, ELEMENT, LINK, Book, Model, TrackRow, lay_scratch, lay_state

_INTEGER = np.dtype([("value", "i8")])
_N_ROW = len(TrackRow)


@group
class Parts(NamedTuple):
    """A vehicle in working memory. `begun` is not zero after it was placed on its rails."""

    begun: Any
    model: Any
    state: Any
    scratch: Any
    motions: Any
    links: Any  # as declared, without rotations and offsets
    radius: Any  # of the wheels [m]


@arranging
def lay_kept(work, at):
    """Return what carries over of a vehicle, at the beginning of `work`: `begun`, state, scratch; and its end."""
    begun, end = vector(work, 0, 1)
    state, end = lay_state(work, end, at.n_bodies, at.n_elements, at.n_axles)
    scratch, end = lay_scratch(work, end, at.n_bodies, 2 * at.n_axles)
    return begun, state, scratch, end


@arranging
def arrange(work, end, begun, state, scratch, track, n_track, own, begin, at):
    """Lay out the rest of a vehicle from index `end` on; return the vehicle and the new end.

    `begun`, `state` and `scratch` are those of `lay_kept`. `track` points to the rows of the track, with `n_track` places. The
    arrays of the vehicle (`components`) begin at index `begin` of the numbers `own`.
    """
    links, end = records(work, end, at.n_links, LINK)
    motions, end = records(work, end, 2 * at.n_axles, MOTION)
    surface, end = vector(work, end, 2)
    bodies, to = records(own, begin, at.n_bodies, BODY)
    declared, to = records(own, to, at.n_links, LINK)
    elements, to = records(own, to, at.n_elements, ELEMENT)
    table, to = matrix(own, to, 2, at.n_table)
    wheelsets, to = records(own, to, at.n_axles, _INTEGER)
    rail, to = vector(own, to, 5)
    radius, _ = vector(own, to, 1)
    numbers = carray(integers_of(wheelsets), (at.n_axles,))
    model = Model(bodies, links, elements, table, numbers, carray(track, (_N_ROW, n_track)), rail, surface)
    return Parts(begun, model, state, scratch, motions, declared, radius), end


@arranging
def fill(parts, origin_y, origin_z, slowest):
    """Fill what depends only on the parameters."""
    own = parts.model.links
    for k in range(own.size):
        own[k].a, own[k].b = parts.links[k].a, parts.links[k].b
    for w in range(parts.motions.size):
        here = parts.motions[w]
        here.radius, here.mirror = parts.radius[0], 1.0 if w % 2 == 0 else -1.0
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
