"""Steps of the strip half space: residuals of half lengths and panel ends mixed over the last iterations (Anderson 1965)."""

from contact._jit import kernel
from contact.normal.strip_system import (
    DEPTH,
    V_A,
    V_CHANGES,
    V_HALF,
    V_LN_A,
    V_P,
    V_Q1,
    V_R,
    V_R_OLD,
    V_STEP,
    V_STEPS,
)

#: Weight of an end in the mixing beside the loads of all strips.
_END_WEIGHT = 1.0


@kernel
def advance(n, n_panels, panels, vectors, load, known, gram):
    """Next half lengths and ends by Anderson's mixing over the last `DEPTH` of the `known` steps, weighted with strip loads.

    The end strips' entries of the residual V_R and of the steps stand for the ends of their panel. Steps and changes of the
    residual are kept in rings of rows.
    """
    total = n * n_panels
    if known > 0:
        row = (known - 1) % DEPTH
        for i in range(total):
            vectors[V_STEPS + row, i] = vectors[V_STEP, i]
            vectors[V_CHANGES + row, i] = vectors[V_R, i] - vectors[V_R_OLD, i]
    depth = min(known, DEPTH)
    for i in range(total):
        weight = vectors[V_P, i] * vectors[V_A, i] * vectors[V_HALF, i] / load
        place = i % n
        if place == 0 or place == n - 1:
            width = panels[2 * (i // n) + 1] - panels[2 * (i // n)]
            weight = _END_WEIGHT / (width * width)
        vectors[V_Q1, i] = weight
        vectors[V_STEP, i] = vectors[V_R, i]
        vectors[V_R_OLD, i] = vectors[V_R, i]
    for k in range(depth):
        for m in range(depth):
            product = 0.0
            for i in range(total):
                product += vectors[V_Q1, i] * vectors[V_CHANGES + k, i] * vectors[V_CHANGES + m, i]
            gram[k, m] = product
        product = 0.0
        for i in range(total):
            product += vectors[V_Q1, i] * vectors[V_CHANGES + k, i] * vectors[V_R, i]
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
            vectors[V_STEP, i] -= gram[k, depth] * (vectors[V_STEPS + k, i] + vectors[V_CHANGES + k, i])
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        for i in range(first + 1, last):
            vectors[V_STEP, i] = min(max(vectors[V_STEP, i], -0.8), 0.8)
            vectors[V_LN_A, i] += vectors[V_STEP, i]
        bound = 0.25 * (panels[2 * p + 1] - panels[2 * p])
        for end in (first, last):
            # beyond its range the end rule says no more than a direction, which mixing must not reverse
            if vectors[V_STEP, end] * vectors[V_R, end] <= 0.0 and abs(vectors[V_R, end]) > 1e-2 * bound:
                vectors[V_STEP, end] = vectors[V_R, end]
            vectors[V_STEP, end] = min(max(vectors[V_STEP, end], -bound), bound)
        panels[2 * p] += vectors[V_STEP, first]
        panels[2 * p + 1] += vectors[V_STEP, last]
        vectors[V_LN_A, first], vectors[V_LN_A, last] = vectors[V_LN_A, first + 1], vectors[V_LN_A, last - 1]
