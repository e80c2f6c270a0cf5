"""Damaged copies of files, the same in every run; ten times as many in `make soak`."""

import os
import re
from collections.abc import Iterator

import numpy as np

_WRONG = (b"nan", b"inf", b"-inf", b"1e999", b"-1e-320", b"-1", b"0", b"9" * 400, b"", b"x", b"\xff", b"[" * 3000)


def of_bytes(content: bytes, number: int) -> list[bytes]:
    """Return copies with changed bytes, cut off, or with a piece that stands twice."""
    number *= 10 if "SOAK" in os.environ else 1
    rng, copies = np.random.default_rng(number), []
    for k in range(number):
        copy = bytearray(content)
        at = int(rng.integers(len(copy)))
        if k % 3 == 0:
            copy[at] ^= 1 << int(rng.integers(8))
        elif k % 3 == 1:
            del copy[at:]
        else:
            copy[at:at] = copy[at : at + int(rng.integers(1, 64))]
        copies.append(bytes(copy))
    return copies


def of_text(content: bytes, number: int) -> Iterator[bytes]:
    """Yield the same copies, then others with a word or a line replaced, left out, repeated or exchanged."""
    yield from of_bytes(content, number)
    rng = np.random.default_rng(number)
    for k in range(number * (10 if "SOAK" in os.environ else 1)):
        lines = content.splitlines(keepends=True)
        i, j = (int(n) for n in rng.integers(len(lines), size=2))
        if k % 4 == 0:
            words = re.split(rb"([^\s,=\[\]]+)", lines[i])
            if len(words) > 1:
                words[1 + 2 * int(rng.integers(len(words) // 2))] = _WRONG[int(rng.integers(len(_WRONG)))]
            lines[i] = b"".join(words)
        elif k % 4 == 1:
            del lines[i]
        elif k % 4 == 2:
            lines[i:i] = lines[i : i + 1] * 3
        else:
            lines[i], lines[j] = lines[j], lines[i]
        yield b"".join(lines)
