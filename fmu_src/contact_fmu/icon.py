"""Pictures of the FMUs, model.png, in which tools show them as blocks. They are drawn from the same profiles as the kernels."""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from contact.geometry import profile

SIZE, _FINER = 128, 4  # pixels, and points of a pixel in each direction
_INK, _STEEL, _HOT = np.array([30, 40, 55.0]), np.array([196, 205, 214.0]), np.array([214, 69, 48.0])
_WHITE = np.array([255, 255, 255.0])
Mask = NDArray[np.bool_]


def png(name: str) -> bytes:
    """Return the picture of the FMU with this name. The same name gives the same bytes."""
    x, y = np.meshgrid(*2 * [(np.arange(SIZE * _FINER) + 0.5) / (SIZE * _FINER)])  # from the upper left corner
    picture = np.empty((*x.shape, 3))
    picture[:] = _WHITE
    if name == "Wheelset":
        _wheelset(picture, x, y)
    elif name in ("WheelRailPair", "WheelRailSurfaces"):
        _pair(picture, x, y)
    else:
        _contact(picture, x, y, elliptic=name == "EllipticContact")
    pixels = picture.reshape(SIZE, _FINER, SIZE, _FINER, 3).mean(axis=(1, 3)).round().astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    head = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
        for kind, content in parts
    )


def _contact(picture: NDArray, x: NDArray, y: NDArray, elliptic: bool) -> None:
    """Draw a patch with its pressure: an ellipse, or two that have grown together."""
    lobes = [(0.5, 0.5, 0.36, 0.24)] if elliptic else [(0.36, 0.52, 0.24, 0.30), (0.66, 0.48, 0.22, 0.19)]
    left = np.max([1.0 - ((x - at) / a) ** 2 - ((y - middle) / b) ** 2 for at, middle, a, b in lobes], axis=0)
    heat = np.sqrt(np.clip(left, 0.0, 1.0))[..., None]
    inside = left > 0.0
    picture[inside] = (_STEEL + heat * (_HOT - _STEEL))[inside]
    picture[(left > -0.09) & ~inside] = _INK


def _pair(picture: NDArray, x: NDArray, y: NDArray) -> None:
    """Draw the wheel S1002 on the rail 60E1."""
    rail, wheel, scale = profile.rail_60e1(inclination=0.0), profile.s1002(), 0.18  # [m] over the picture
    top, across = 0.52, scale * (x - 0.5)
    down = scale * (y - top)
    rail_top = np.interp(across, rail.y, rail.z - rail.z.min(), left=1.0, right=1.0)
    gap = np.interp(rail.y, wheel.y, wheel.z) - (rail.z - rail.z.min())
    tread = np.interp(across, wheel.y, wheel.z - gap.max(), left=-1.0, right=-1.0)
    _fill(picture, down > rail_top)
    _fill(picture, (down < tread) & (down > -0.085))


def _wheelset(picture: NDArray, x: NDArray, y: NDArray) -> None:
    """Draw two wheels, their axle and two rails, seen from the front."""
    side = np.abs(x - 0.5)
    _fill(picture, (np.abs(y - 0.45) < 0.04) & (side < 0.44))
    _fill(picture, (np.abs(side - 0.32) < 0.045) & (np.abs(y - 0.45) < 0.36))
    _fill(picture, (np.abs(side - 0.265) < 0.02) & (np.abs(y - 0.45) < 0.40))
    _fill(picture, (np.abs(side - 0.335) < 0.045) & (y > 0.81) & (y < 0.96))


def _fill(picture: NDArray, inside: Mask) -> None:
    """Fill a shape with steel and draw its edge."""
    width = 6
    edge = np.zeros_like(inside)
    for axis in (0, 1):
        for step in (-width, width):
            edge |= inside & ~np.roll(inside, step, axis)
    picture[inside] = _STEEL
    picture[edge] = _INK
