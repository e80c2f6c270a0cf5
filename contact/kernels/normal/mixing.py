"""Steps of the strip half space: Anderson's mixing of half lengths and panel ends over the last iterations (1965)."""

from contact.core import kernel
from contact.kernels.rows import DEPTH, Vector

#: Weight of an end in the mixing. The loads of all strips together have the weight 1.
_END_WEIGHT = 1.0
#: Largest step of the offset of a strip along x over its half length.
_FARTHEST = 0.8
#: Share of the load from which on the change of one strip counts.
_FELT = 2e-5


@kernel
def largest_step(n, total, load, vectors):
    """Return the largest step of ln a in Vector.R, of strips in which it changes the load by more than `_FELT`."""
    largest = 0.0
    for i in range(total):
        if 0 < i % n < n - 1:
            step = abs(vectors[Vector.R, i])
            weight = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
            if step > largest and weight * step > _FELT * load:
                largest = step
    return largest


@kernel
def _product(total, weights, one, other):
    """Return the weighted sum of the products of two rows."""
    product = 0.0
    for i in range(total):
        product += weights[i] * one[i] * other[i]
    return product


@kernel
def mix(n, n_panels, panels, vectors, load, known, skewed, gram):
    """Fill Vector.STEP with the next step of half lengths and ends. Return the size of the residual that the mixing leaves.

    If strips are `skewed`, their offsets along x over their half lengths are mixed with them.

    Anderson's mixing uses the last `DEPTH` of the `known` steps. The weights are strip loads. In the residual Vector.R
    and in the steps, the entries of the end strips belong to the ends of their panel. Steps and changes of the residual
    are kept in rings of rows. The returned size is the weighted mean for half lengths or the largest over the width for
    ends, whichever is larger.
    """
    total = n * n_panels
    if known > 0:
        row = (known - 1) % DEPTH
        for i in range(total):
            vectors[Vector.STEPS + row, i] = vectors[Vector.STEP, i]
            vectors[Vector.CHANGES + row, i] = vectors[Vector.R, i] - vectors[Vector.R_OLD, i]
        for i in range(total if skewed else 0):
            vectors[Vector.OFFSET_STEPS + row, i] = vectors[Vector.OFFSET_STEP, i]
            vectors[Vector.OFFSET_CHANGES + row, i] = vectors[Vector.OFFSET_R, i] - vectors[Vector.OFFSET_R_OLD, i]
    depth = min(known, DEPTH)
    for i in range(total):
        weight = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i] / load
        place = i % n
        if place == 0 or place == n - 1:
            width = panels[2 * (i // n) + 1] - panels[2 * (i // n)]
            weight = _END_WEIGHT / (width * width)
        vectors[Vector.Q1, i] = weight
        vectors[Vector.STEP, i] = vectors[Vector.R, i]
        vectors[Vector.R_OLD, i] = vectors[Vector.R, i]
    for i in range(total if skewed else 0):
        vectors[Vector.OFFSET_STEP, i] = vectors[Vector.OFFSET_R_OLD, i] = vectors[Vector.OFFSET_R, i]
        inner = 0 < i % n < n - 1
        # Compilers divide before they choose, so the divisor must not be 0: that would be a trap.
        square = vectors[Vector.A, i] ** 2 + 1e-300
        vectors[Vector.Q2, i] = vectors[Vector.Q1, i] / square if inner else 0.0
    for k in range(depth):
        for m in range(depth):
            product = 0.0
            for i in range(total):
                product += vectors[Vector.Q1, i] * vectors[Vector.CHANGES + k, i] * vectors[Vector.CHANGES + m, i]
            if skewed:
                product += _product(
                    total, vectors[Vector.Q2], vectors[Vector.OFFSET_CHANGES + k], vectors[Vector.OFFSET_CHANGES + m]
                )
            gram[k, m] = product
        product = 0.0
        for i in range(total):
            product += vectors[Vector.Q1, i] * vectors[Vector.CHANGES + k, i] * vectors[Vector.R, i]
        if skewed:
            product += _product(total, vectors[Vector.Q2], vectors[Vector.OFFSET_CHANGES + k], vectors[Vector.OFFSET_R])
        gram[k, depth] = product
        gram[k, k] *= 1.0 + 1e-8
        gram[k, k] += 1e-30
    for k in range(depth):
        for m in range(k + 1, depth):
            factor = gram[m, k] / gram[k, k]
            for c in range(k, depth + 1):
                gram[m, c] -= factor * gram[k, c]
    for k in range(depth - 1, -1, -1):
        for m in range(k + 1, depth):
            gram[k, depth] -= gram[k, m] * gram[m, depth]
        gram[k, depth] /= gram[k, k]
    for k in range(depth):
        for i in range(total):
            vectors[Vector.STEP, i] -= gram[k, depth] * vectors[Vector.CHANGES + k, i]
        for i in range(total if skewed else 0):
            vectors[Vector.OFFSET_STEP, i] -= gram[k, depth] * vectors[Vector.OFFSET_CHANGES + k, i]
    lengths, ends = 0.0, 0.0
    for i in range(total):
        if i % n in (0, n - 1):
            ends = max(ends, abs(vectors[Vector.STEP, i]) / (panels[2 * (i // n) + 1] - panels[2 * (i // n)]))
        else:
            lengths += vectors[Vector.Q1, i] * abs(vectors[Vector.STEP, i])
            if skewed:
                lengths += vectors[Vector.Q1, i] * abs(vectors[Vector.OFFSET_STEP, i]) / vectors[Vector.A, i]
    for k in range(depth):
        for i in range(total):
            vectors[Vector.STEP, i] -= gram[k, depth] * vectors[Vector.STEPS + k, i]
        for i in range(total if skewed else 0):
            vectors[Vector.OFFSET_STEP, i] -= gram[k, depth] * vectors[Vector.OFFSET_STEPS + k, i]
    return max(lengths, ends)


@kernel
def advance(n, n_panels, panels, vectors, skewed):
    """Change half lengths and ends, and the offsets if strips are `skewed`, by the step that `mix` has found."""
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        for i in range(first + 1, last):
            vectors[Vector.STEP, i] = min(max(vectors[Vector.STEP, i], -0.8), 0.8)
            vectors[Vector.LN_A, i] += vectors[Vector.STEP, i]
            if skewed:
                bound = _FARTHEST * vectors[Vector.A, i]
                vectors[Vector.OFFSET_STEP, i] = min(max(vectors[Vector.OFFSET_STEP, i], -bound), bound)
                vectors[Vector.OFFSET, i] += vectors[Vector.OFFSET_STEP, i]
        bound = 0.25 * (panels[2 * p + 1] - panels[2 * p])
        for end in (first, last):
            # beyond its range the end rule gives only a direction, which mixing must not reverse
            if vectors[Vector.STEP, end] * vectors[Vector.R, end] <= 0.0 and abs(vectors[Vector.R, end]) > 1e-2 * bound:
                vectors[Vector.STEP, end] = vectors[Vector.R, end]
            vectors[Vector.STEP, end] = min(max(vectors[Vector.STEP, end], -bound), bound)
        panels[2 * p] += vectors[Vector.STEP, first]
        panels[2 * p + 1] += vectors[Vector.STEP, last]
        vectors[Vector.LN_A, first], vectors[Vector.LN_A, last] = (
            vectors[Vector.LN_A, first + 1],
            vectors[Vector.LN_A, last - 1],
        )
