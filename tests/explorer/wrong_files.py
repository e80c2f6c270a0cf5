"""Thirty files that are no profile of a wheel or a rail as they lie, and what the page must say of each."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from contact.geometry import profile

WHEEL, RAIL = profile.s1002(), profile.rail_60e1(inclination=0.0)


def _rows(y, z, unit=1e-3, between=" ", decimals=6) -> bytes:
    return "\n".join(
        f"{a / unit:.{decimals}f}{between}{b / unit:.{decimals}f}" for a, b in zip(y, z, strict=True)
    ).encode()


def _files() -> dict[str, tuple[bytes, str, str | None]]:
    w, r, mixed = (WHEEL.y, WHEEL.z), (RAIL.y, RAIL.z), np.random.default_rng(5).permutation(WHEEL.y.size)
    noisy = tuple(each + np.random.default_rng(6).normal(0.0, 1e-5, each.size) for each in r)
    lines = _rows(*w).splitlines()
    return {  # name → content, what is said, the kind that is taken; None: refused
        "empty.txt": (b"", "at least ten rows", None),
        "text.txt": (b"hello\nworld\n" * 20, "at least ten rows", None),
        "two.txt": (b"1 2\n3 4\n", "at least ten rows", None),
        "zip.whl": (b"PK\x03\x04" + bytes(900), "at least ten rows", None),
        "png.ban": (b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 4, "at least ten rows", None),
        "resource.bin": (b"wr-wheel" + b"\x7f" * 40, "", None),
        "huge_numbers.txt": (b"1e400 2\n" * 30, "", None),
        "one_point.txt": (b"1 2\n" * 30, "", None),
        "line.txt": (_rows(np.linspace(0, 0.1, 50), np.zeros(50)), "could be a wheel or a rail", None),
        "circle.txt": (
            _rows(0.05 * np.cos(np.linspace(0, 6, 90)), 0.05 * np.sin(np.linspace(0, 6, 90))),
            "comes back",
            "rail",
        ),
        "shuffled.txt": (_rows(w[0][mixed], w[1][mixed]), "not in order", None),
        "centimetre.txt": (_rows(0.1 * w[0], 0.1 * w[1]), "unit taken as cm", "wheel"),
        "thousand.txt": (_rows(1e3 * w[0], 1e3 * w[1]), "no unit of m, mm, cm, inch", None),
        "five.txt": (_rows(w[0][:5], w[1][:5]), "at least ten rows", None),
        "one_column.txt": (b"\n".join(b"%d" % i for i in range(50)), "at least ten rows", None),
        "swapped.txt": (_rows(w[1], w[0]), "", None),
        "upright.txt": (_rows(-r[1], r[0]), "", None),
        "json.json": (b'{"y": [1, 2, 3], "z": [1, 2, 3]}' * 20, "at least ten rows", None),
        "nulls.txt": (bytes(2000), "at least ten rows", None),
        "inch.txt": (_rows(*w, 0.0254), "unit taken as inch", "wheel"),
        "metre.txt": (_rows(*r, 1.0, decimals=9), "unit taken as m", "rail"),
        "up.txt": (_rows(w[0], -w[1]), "z pointed up", "wheel"),
        "mirrored.txt": (_rows(-w[0][::-1], w[1][::-1]), "y pointed to the inside", "wheel"),
        "back_of_flange.txt": (_rows(w[0] + 0.07, w[1]), "moved by -70 mm", "wheel"),
        "twice.txt": (_rows(np.tile(w[0], 2), np.tile(w[1], 2)), "2 times", "wheel"),
        "there_and_back.txt": (_rows(np.r_[w[0], w[0][::-1]], np.r_[w[1], w[1][::-1]]), "comes back", "wheel"),
        "noise.txt": (_rows(*noisy), "noise of", "rail"),
        "nan.txt": (
            b"\n".join([*lines[:60], b"nan nan", b"1.0 NaN", *lines[60:]]),
            "2 lines without two numbers",
            "wheel",
        ),
        "comma.csv": (_rows(*w, between=";").replace(b".", b","), "nothing found", "wheel"),
        "header.txt": (b"12 3\nnot a number\n" + _rows(*r), "", "rail"),
    }


FILES = _files()


def written(folder: Path) -> dict[str, Path]:
    """Write the files. Return name → path."""
    for name, (content, *_) in FILES.items():
        (folder / name).write_bytes(content)
    return {name: folder / name for name in FILES}
