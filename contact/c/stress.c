/* Loads on the surface, and the stress that they cause below it. */
#include <math.h>

#include "internal.h"

int wri_check_load(const wr_surface_load *l) {
    TRY(aligned(l, A_surface_load));
    if (l->size != (int64_t)sizeof *l) return bad(A_surface_load, R_STRUCT);
    TRY(wri_check_members(l, A_load_nx, A_load_ny));
    TRY(aligned(l->x, A_load_x));
    TRY(aligned(l->y, A_load_y));
    TRY(aligned(l->p, A_load_p));
    TRY(aligned(l->qx, A_load_qx));
    return aligned(l->qy, A_load_qy);
}

static int check_even(const double *values, int64_t n, int argument) {
    TRY(wri_finite_all(values, n, argument));
    double step = (values[n - 1] - values[0]) / (double)(n - 1);
    for (int64_t i = 1; i < n; i++) {
        double here = values[i] - values[i - 1];
        if (!(here > 0.0)) return bad(argument, R_ORDER);
        if (!(fabs(here - step) <= 1e-6 * step)) return bad(argument, R_UNEVEN);
    }
    return 0;
}

/* Fill a checked load from `n` strips, which were solved with the methods and the pressure limit of head->problem. */
int wri_fill_load(const Head *head, int64_t n, const wr_result *result, wr_surface_load *l) {
    const Method *rolling = wri_tangential_method(head->problem.tangential);
    if (n <= 0) return bad(A_memory, R_NO_CONTACT);
    if (rolling == NULL || !rolling->fields) return bad(A_memory, R_NO_FIELDS);
    int64_t made = CALL(load_fill, (double *)head->sizes, (double *)read_numbers(head, head->at_work + head->at_strips), n,
                        head->problem.pressure_limit, (void *)result, l->nx, l->ny, l->x, l->y, l->p, l->qx, l->qy);
    return made ? 0 : bad(A_surface_load, R_COARSE);
}

int wr_contact_surface_load(const void *memory, wr_surface_load *l) {
    TRY(wri_check_memory(memory, CONTACT));
    const Head *head = memory;
    TRY(wri_check_answer(head));
    TRY(wri_check_load(l));
    return wri_fill_load(head, head->n_strips, &head->result, l);
}

int wr_stress(const wr_surface_load *l, int64_t body, double poisson_ratio, int64_t n, const double *x, const double *y,
              const double *z, double *stress) {
    TRY(wri_check_load(l));
    TRY(check_even(l->x, l->nx, A_load_x));
    TRY(check_even(l->y, l->ny, A_load_y));
    TRY(wri_finite_all(l->p, l->nx * l->ny, A_load_p));
    TRY(wri_finite_all(l->qx, l->nx * l->ny, A_load_qx));
    TRY(wri_finite_all(l->qy, l->nx * l->ny, A_load_qy));
    TRY(wri_check_whole(body, A_body));
    TRY(wri_check_number(poisson_ratio, A_poisson));
    TRY(among(n, 0, INT64_MAX / 64, A_n));
    TRY(aligned(x, A_x));
    TRY(aligned(y, A_y));
    TRY(aligned(z, A_z));
    TRY(aligned(stress, A_stress));
    TRY(wri_finite_all(x, n, A_x));
    TRY(wri_finite_all(y, n, A_y));
    for (int64_t i = 0; i < n; i++) TRY(wri_check_number(z[i], A_z));
    double sizes[N_SIZES] = {0}, one[18];
    int wheel = body == WR_BODY_WHEEL;
    sizes[WIDE] = is_wide();
    CALL(stress_at, sizes, l->nx, l->ny, l->x, l->y, l->p, l->qx, l->qy, wheel ? 1.0 : -1.0, poisson_ratio, n, (void *)x,
         (void *)y, (void *)z, one, stress);
    for (int64_t i = 0; wheel && i < n; i++) /* its half space lies on the other side */
        for (int k = 4; k < 6; k++) stress[6 * i + k] = -stress[6 * i + k];
    return 0;
}
