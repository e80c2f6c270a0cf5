"""Reasons for which native FMUs discard a step. `components` has their texts."""

from __future__ import annotations

from enum import IntEnum, auto

from contact import Status


class Failure(IntEnum):
    """Reasons to discard a step of a pair. Their numbers follow those of the statuses."""

    NO_OVERLAP = max(Status) + 1
    NOT_SETTLED = auto()
    TOO_DEEP = auto()
    ENDLESS = auto()
    TURNED = auto()
    GAUGE_POINT = auto()
    STEEP = auto()
    WHEEL = auto()
    RAIL = auto()
    ENDED = auto()  # of a vehicle
    LOST = auto()


class OpenFailure(IntEnum):
    """Reasons to discard a step of a vehicle without contacts."""

    ENDED = 1
    LOST = 2
