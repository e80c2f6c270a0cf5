"""Layouts of a vehicle's arrays in a block of memory, as `contact.kernels.memory`: for Python, and in the memory of an FMU."""

from __future__ import annotations

from contact.core import shared
from contact.kernels.arrays import Array
from contact.kernels.block import cube, matrix, records, vector
from contact.kernels.records import GIVEN
from .between import LastSolution, Load
from .layout import SEAT, WHEEL, Book, Scratch, State, Sum, TrackFrame


@shared
def lay_state(block: Array, end: int, n_bodies: int, n_elements: int, n_axles: int) -> tuple[State, int]:
    """Return what carries over from one step to the next, and the new end."""
    q, end = matrix(block, end, n_bodies, 6)
    u, end = matrix(block, end, n_bodies, 6)
    inner, end = matrix(block, end, n_elements, 3)
    rails, end = cube(block, end, n_axles, 2, 4)
    loads, end = matrix(block, end, n_axles, 2)
    sums, end = matrix(block, end, 2 * n_axles, len(Sum))
    books, end = vector(block, end, len(Book))
    gains, end = matrix(block, end, n_axles, 6)
    return State(q, u, inner, rails, loads, sums, books, gains), end


@shared
def lay_scratch(block: Array, end: int, n_bodies: int, n_wheels: int) -> tuple[Scratch, int]:
    """Return the arrays of one step, and the new end. Forces and wheels are those of the last step for the next one."""
    frames, end = matrix(block, end, n_bodies, len(TrackFrame))
    forces, end = matrix(block, end, n_bodies, 6)
    given, end = records(block, end, n_wheels, GIVEN)
    seats, end = records(block, end, n_wheels, SEAT)
    wheels, end = records(block, end, n_wheels, WHEEL)
    power, end = vector(block, end, 3)
    return Scratch(frames, forces, given, seats, wheels, power), end


@shared
def lay_last(block: Array, end: int, n_wheels: int) -> tuple[LastSolution, int]:
    """Return the last solution of every wheel, which is none where all is zero, and the new end."""
    asked, end = records(block, end, n_wheels, GIVEN)
    answers, end = matrix(block, end, n_wheels, len(Load))
    drifts, end = matrix(block, end, n_wheels, len(Load))
    expected, end = matrix(block, end, n_wheels, len(Load))
    ages, end = vector(block, end, n_wheels)
    paces, end = vector(block, end, n_wheels)
    noises, end = vector(block, end, n_wheels)
    powers, end = vector(block, end, n_wheels)
    slopes, end = vector(block, end, n_wheels)
    loads, end = vector(block, end, n_wheels)
    solutions, end = vector(block, end, n_wheels)
    pending, end = vector(block, end, n_wheels)
    limits, end = vector(block, end, 2)
    last = LastSolution(
        asked, answers, drifts, expected, ages, paces, noises, powers, slopes, loads, solutions, pending, limits
    )
    return last, end
