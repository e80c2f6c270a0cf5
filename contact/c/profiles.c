/* Profiles of a wheel and a rail: their checks, and the angles of those that have none. */
#include <math.h>
#include <string.h>

#include "internal.h"

int wri_check_profile(const wr_profile *p, const int arguments[4]) {
    TRY(aligned(p, arguments[0]));
    TRY(among(p->n, 4, MOST_NODES, arguments[0]));
    TRY(aligned(p->y, arguments[1]));
    TRY(aligned(p->z, arguments[2]));
    TRY(wri_finite_all(p->y, p->n, arguments[1]));
    TRY(wri_finite_all(p->z, p->n, arguments[2]));
    for (int64_t i = 1; i < p->n; i++)
        if (!(hypot(p->y[i] - p->y[i - 1], p->z[i] - p->z[i - 1]) > 0.0)) return bad(arguments[1], R_COINCIDE);
    if (p->angle == NULL) return 0;
    TRY(aligned(p->angle, arguments[3]));
    return wri_finite_all(p->angle, p->n, arguments[3]);
}

/* Whether z points down and the flange lies at negative y, as Python's reader asks of a file
 * (contact.geometry.inspection.misplaced).  Most of a wheel's width is tread, and of a rail's width crown, at small z.  A shape
 * that is flat, or as deep at both ends, is not judged. */
int wri_check_place(const wr_profile *p, int is_wheel, const int arguments[4]) {
    double low = p->z[0], high = p->z[0], area = 0.0, width = 0.0;
    int64_t deepest = 0;
    for (int64_t i = 1; i < p->n; i++) {
        const double dy = fabs(p->y[i] - p->y[i - 1]);
        area += 0.5 * dy * (p->z[i] + p->z[i - 1]);
        width += dy;
        if (p->z[i] < low) low = p->z[i];
        if (p->z[i] > high) high = p->z[i], deepest = i;
    }
    const double depth = high - low, extent = fabs(p->y[p->n - 1] - p->y[0]);
    if (depth < 0.08 * extent) return 0;
    if (area > 0.5 * (low + high) * width) return bad(arguments[2], R_UPSIDE_DOWN);
    if (!is_wheel) return 0;
    const int ascending = p->y[p->n - 1] > p->y[0];
    const double gauge_end = p->z[ascending ? 0 : p->n - 1], field_end = p->z[ascending ? p->n - 1 : 0];
    const double middle = 0.5 * (p->y[0] + p->y[p->n - 1]);
    if (p->y[deepest] > middle && gauge_end < low + 0.5 * depth && field_end > gauge_end) return bad(arguments[1], R_MIRRORED);
    return 0;
}

/* Slopes of the C2 cubic spline through (u, f); the end segments are parabolas.  As contact.geometry.outline. */
static void spline_slopes(int64_t n, const double *h, const double *f, double *middle, double *right, double *slopes) {
#define D(i) ((f[(i) + 1] - f[i]) / h[i])
#define LOWER(i) ((i) == n - 2 ? 1.0 : h[(i) + 1])
#define UPPER(i) ((i) == 0 ? 1.0 : h[(i) - 1])
    for (int64_t i = 0; i < n; i++) {
        int inside = i > 0 && i < n - 1;
        middle[i] = inside ? 2.0 * (h[i] + h[i - 1]) : 1.0;
        right[i] = inside ? 3.0 * (h[i] * D(i - 1) + h[i - 1] * D(i)) : 2.0 * (i == 0 ? D(0) : D(n - 2));
    }
    for (int64_t i = 1; i < n; i++) {
        double factor = LOWER(i - 1) / middle[i - 1];
        middle[i] -= factor * UPPER(i - 1);
        right[i] -= factor * right[i - 1];
    }
    slopes[n - 1] = right[n - 1] / middle[n - 1];
    for (int64_t i = n - 2; i >= 0; i--) slopes[i] = (right[i] - UPPER(i) * slopes[i + 1]) / middle[i];
#undef D
#undef LOWER
#undef UPPER
}

/* Write the rows y, z, angle of a profile to `rows`; `scratch` has room for 6 n numbers. */
void wri_place_profile(const wr_profile *p, double *rows, double *scratch) {
    int64_t n = p->n;
    size_t row = (size_t)n * sizeof(double);
    memcpy(rows, p->y, row);
    memcpy(rows + n, p->z, row);
    if (p->angle != NULL) {
        memcpy(rows + 2 * n, p->angle, row);
        return;
    }
    double *h = scratch, *middle = h + n, *right = middle + n, *dy = right + n, *dz = dy + n, *u = dz + n;
    const double pi = 3.141592653589793;
    u[0] = 0.0;
    for (int64_t i = 0; i + 1 < n; i++) u[i + 1] = u[i] + hypot(p->y[i + 1] - p->y[i], p->z[i + 1] - p->z[i]);
    for (int64_t i = 0; i + 1 < n; i++) h[i] = u[i + 1] - u[i];
    spline_slopes(n, h, p->y, middle, right, dy);
    spline_slopes(n, h, p->z, middle, right, dz);
    double turns = 0.0, before = 0.0;
    for (int64_t i = 0; i < n; i++) {
        double angle = atan2(dz[i], dy[i]);
        if (i > 0 && angle - before > pi) turns -= 2.0 * pi;
        if (i > 0 && angle - before < -pi) turns += 2.0 * pi;
        before = angle;
        rows[2 * n + i] = angle + turns;
    }
}
