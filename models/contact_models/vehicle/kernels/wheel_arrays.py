"""Arrays of the contacts of all wheels: `contact.kernels.arrays.PairArrays` of each wheel, made of shared and of own parts.

A step solves one wheel after the other, so scratch memory is shared. What carries over, and what a wheel is made of, is not.
Arrays of different length lie in one pool, so that the kernels are the same for any number of wheels and any profiles.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Annotated, Any, Generic, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.core import Shape, arranging, kernel
from contact.errors import ContactError
from contact.kernels.arrays import Cases, Kind, Ledger, Matrix, Motions, Numbers, PairArrays, Search, Settings, Totals
from contact.kernels.block import part
from contact.kernels.records import CASE, CONTACT, LEDGER, MAX_PATCHES, MOTION, TOTAL
from contact.kernels.rows import N_LINE_ROWS, N_PROFILE_ROWS
from contact.pair import WheelRailPair
from .between import LastSolution

Array = NDArray[np.float64]
IntegerRows = Annotated[Any, Shape(np.int64, 2)]
ContactRows = Annotated[Any, Shape(CONTACT, 2)]


class Size(IntEnum):
    """Numbers of nodes or bins of a wheel's arrays, and their first place in the pool."""

    WHEEL = 0
    RAIL = 1
    BINS = 2
    ROWS_WHEEL = 3  # nodes of the whole profiles, of a ledger
    ROWS_RAIL = 4
    WHEEL_AT = 5
    RAIL_AT = 6
    BINS_AT = 7
    ROWS_WHEEL_AT = 8
    ARC_WHEEL_AT = 9
    ROWS_RAIL_AT = 10
    ARC_RAIL_AT = 11


class WheelArrays(NamedTuple, Generic[Kind]):
    """Parts of the arrays of all wheels."""

    shared: PairArrays[Kind]
    cases: Cases  # one each
    motions: Motions  # one each
    settings: Settings  # one each
    contacts: ContactRows  # shape (wheels, MAX_PATCHES)
    totals: Totals  # one each
    memories: Matrix  # starts of the next call, shape (wheels, size)
    pool: Numbers
    scratch: Numbers  # trace line, placed rail and both in the plane of a patch
    sizes: IntegerRows  # shape (wheels, len(Size))
    rows: int  # of the bins of a ledger
    last: LastSolution


def gather(pairs: Sequence[WheelRailPair], last: LastSolution) -> WheelArrays:
    """Return the arrays of pairs that differ in profiles, sides and ledgers alone. `last` holds nothing.

    Raises
    ------
    ContactError
        If only some of the pairs have a ledger. All write into the scratch memory of the first one's.
    """
    without = [k for k, pair in enumerate(pairs) if pair.arrays.ledger.bins.shape[2] == 0]
    if 0 < len(without) < len(pairs):
        raise ContactError(f"pairs {without} of {len(pairs)} have no ledger; all or none have one")
    n, first = len(pairs), pairs[0].arrays
    sizes = np.zeros((n, len(Size)), np.int64)
    pool: list[Array] = []
    for size, pair in zip(sizes, pairs, strict=True):
        arrays, end = pair.arrays, sum(array.size for array in pool)
        ledger = arrays.ledger
        size[Size.WHEEL], size[Size.RAIL] = arrays.search.wheel.shape[1], arrays.search.rail.shape[1]
        size[Size.BINS] = ledger.bins.shape[2]
        size[Size.ROWS_WHEEL], size[Size.ROWS_RAIL] = ledger.wheel.shape[1], ledger.rail.shape[1]
        parts = (
            arrays.search.wheel, arrays.search.rail, ledger.bins, ledger.wheel, ledger.wheel_arc, ledger.rail, ledger.rail_arc,
        )  # fmt: skip
        for at, array in zip(range(Size.WHEEL_AT, Size.ARC_RAIL_AT + 1), parts, strict=True):
            size[at] = end
            pool.append(array.ravel())
            end += array.size
    most = int(sizes[:, : Size.RAIL + 1].max())
    made = WheelArrays(
        shared=first,
        cases=np.zeros(n, CASE),
        motions=np.zeros(n, MOTION),
        settings=np.zeros(n, LEDGER),
        contacts=np.zeros((n, MAX_PATCHES), CONTACT),
        totals=np.zeros(n, TOTAL),
        memories=np.zeros((n, first.memory.size)),
        pool=np.concatenate(pool),
        scratch=np.zeros(2 * (N_LINE_ROWS + N_PROFILE_ROWS) * most),
        sizes=sizes,
        rows=first.ledger.bins.shape[1],
        last=last,
    )
    for k, pair in enumerate(pairs):
        made.cases[k], made.motions[k] = pair.arrays.case[0], pair.arrays.search.motion[0]
        made.settings[k] = pair.arrays.ledger.settings[0]
    return made


def bins(wheel_arrays: WheelArrays, wheel: int) -> Array:
    """Return the bins of one wheel's ledger, shape (2, rows, bins); a view."""
    n, at = wheel_arrays.sizes[wheel, Size.BINS], wheel_arrays.sizes[wheel, Size.BINS_AT]
    return wheel_arrays.pool[at : at + 2 * wheel_arrays.rows * n].reshape(2, wheel_arrays.rows, n)


@arranging
def _cut(pool, at, rows, columns):
    return part(pool, at, 1, rows, columns)[0]


@arranging
def _bins(wheel_arrays, w):
    size = wheel_arrays.sizes[w]
    return part(wheel_arrays.pool, size[Size.BINS_AT], 2, wheel_arrays.rows, size[Size.BINS])


@kernel
def arrays_of(wheel_arrays, given, w):
    """Return the arrays of wheel `w`, of which there are `given` motions."""
    t, s, size, pool = wheel_arrays.shared, wheel_arrays.shared.search, wheel_arrays.sizes[w], wheel_arrays.pool
    n_wheel, n_rail = size[Size.WHEEL], size[Size.RAIL]
    placed_at = N_LINE_ROWS * n_wheel
    plane_at = placed_at + N_PROFILE_ROWS * n_rail
    rail_plane_at = plane_at + N_LINE_ROWS * n_wheel
    search = Search(
        wheel=_cut(pool, size[Size.WHEEL_AT], N_PROFILE_ROWS, n_wheel),
        rail=_cut(pool, size[Size.RAIL_AT], N_PROFILE_ROWS, n_rail),
        motion=wheel_arrays.motions[w : w + 1],
        grid=s.grid,
        patches=s.patches,
        separations=s.separations,
        line=_cut(wheel_arrays.scratch, 0, N_LINE_ROWS, n_wheel),
        placed=_cut(wheel_arrays.scratch, placed_at, N_PROFILE_ROWS, n_rail),
        lobes=s.lobes,
        wheel_plane=_cut(wheel_arrays.scratch, plane_at, N_LINE_ROWS, n_wheel),
        rail_plane=_cut(wheel_arrays.scratch, rail_plane_at, N_PROFILE_ROWS, n_rail),
        case=s.case,
        across=s.across,
        work=s.work,
        strips=s.strips,
        result=s.result,
    )
    of_wheel, of_rail = size[Size.ROWS_WHEEL], size[Size.ROWS_RAIL]
    ledger = Ledger(
        wheel=_cut(pool, size[Size.ROWS_WHEEL_AT], 2, of_wheel),
        wheel_arc=pool[size[Size.ARC_WHEEL_AT] : size[Size.ARC_WHEEL_AT] + of_wheel],
        rail=_cut(pool, size[Size.ROWS_RAIL_AT], 2, of_rail),
        rail_arc=pool[size[Size.ARC_RAIL_AT] : size[Size.ARC_RAIL_AT] + of_rail],
        settings=wheel_arrays.settings[w : w + 1],
        rates=t.ledger.rates,
        edges=t.ledger.edges,
        bins=_bins(wheel_arrays, w),
    )
    return PairArrays(
        search=search,
        workspace=t.workspace,
        case=wheel_arrays.cases[w : w + 1],
        patch_case=t.patch_case,
        result=t.result,
        memory=wheel_arrays.memories[w],
        damage_parameters=t.damage_parameters,
        damage_fields=t.damage_fields,
        damage=t.damage,
        contacts=wheel_arrays.contacts[w],
        total=wheel_arrays.totals[w : w + 1],
        ledger=ledger,
        rail=t.rail,
        roots=t.roots,
        moved=t.moved,
        given=given[w : w + 1],
        offset=t.offset,
        displaced=t.displaced,
    )
