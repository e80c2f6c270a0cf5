"""Files in resources/ of a native FMU: rows of numbers over points, which the FMU reads when an instance is made.

A resource is little-endian and holds, in this order: 8 bytes that identify its kind, a checksum of everything that follows
(FNV-1a, 64 bits), the number n of points (64 bits), then n doubles of each row.
"""

from __future__ import annotations

import struct

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError

#: Greatest number of points that an FMU reads, unless its component says otherwise (`native.component.Resource`).
MOST_POINTS = 100_000


def pack(magic: bytes, rows: Array, most: int = MOST_POINTS) -> bytes:
    """Return the resource with these rows of at most `most` points.

    Raises
    ------
    ContactError
        If there are more points than an FMU reads.
    """
    if rows.shape[1] > most:
        raise ContactError(f"{rows.shape[1]} points: an FMU reads at most {most}")
    content = struct.pack("<q", rows.shape[1]) + rows.astype("<f8").tobytes()
    return magic + struct.pack("<Q", checksum(content)) + content


def unpack(resource: bytes, rows: int, fault: str) -> Array:
    """Return the rows of a resource, of at most `MOST_POINTS` points.

    Raises
    ------
    ContactError
        If the bytes are no such resource. The message begins with `fault`.
    """
    content = resource[16:]
    if len(content) < 8 or struct.unpack("<Q", resource[8:16]) != (checksum(content),):
        raise ContactError(f"{fault}: it is damaged or was not made by contact_fmu.resources")
    (n,) = struct.unpack("<q", content[:8])
    if not 4 <= n <= MOST_POINTS or len(content) != 8 + 8 * rows * n:
        raise ContactError(f"{fault}: it says {n} points")
    numbers = np.frombuffer(content[8:], "<f8").reshape(rows, -1)
    if not np.isfinite(numbers).all():
        raise ContactError(f"{fault}: a number in it is not finite")
    return numbers


def checksum(content: bytes) -> int:
    """Return the FNV-1a hash of 64 bits."""
    value = 14695981039346656037
    for byte in content:
        value = (value ^ byte) * 1099511628211 & (1 << 64) - 1
    return value
