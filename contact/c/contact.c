/* One patch, or several in one plane. */
#include <math.h>
#include <string.h>

#include "internal.h"

static int check_all(const double *values, int64_t n, int argument) {
    TRY(aligned(values, argument));
    for (int64_t i = 0; i < n; i++) TRY(wri_check_number(values[i], argument));
    return 0;
}

static int check_separation(const wr_separation *s, int64_t most) {
    TRY(aligned(s, A_separation));
    TRY(among(s->n, 3, most, A_sep_n));
    TRY(check_all(s->y, s->n, A_sep_y));
    TRY(check_all(s->g, s->n, A_sep_g));
    for (int64_t i = 1; i < s->n; i++)
        if (!(s->y[i] - s->y[i - 1] >= WR_LEAST_STEP)) return bad(A_sep_y, R_ORDER);
    TRY(check_all(s->A, s->n, A_sep_A));
    if (s->x_c != NULL) TRY(check_all(s->x_c, s->n, A_sep_x_c));
    if (s->tilt != NULL) TRY(check_all(s->tilt, s->n, A_sep_tilt));
    return 0;
}

static int check_case(const wr_case *c, const wr_contact_options *o) {
    TRY(aligned(c, A_problem));
    TRY(wri_check_surface(c, o, c, A_case_normal));
    if (c->conformal && !wri_tangential_method(c->tangential)->fields) return bad(A_case_tangential, R_PLANE);
    TRY(wri_check_members(c, A_case_load_kind, A_case_rolling));
    return c->load_kind == WR_BY_LOAD && c->amount < 0.0 ? bad(A_case_amount, R_NEGATIVE) : 0;
}

int wr_contact_default(wr_contact_options *o) {
    TRY(aligned(o, A_options));
    o->size = sizeof *o;
#define M(member, kind, low, high, usual, ...) o->member = usual;
    OF_CONTACT(M, )
#undef M
    return 0;
}

int wr_contact_size(const wr_contact_options *o, size_t *bytes) {
    double sizes[N_SIZES];
    TRY(wri_check_contact_options(o));
    TRY(aligned(bytes, A_bytes));
    if (o->conformal && !wri_tangential_method(o->tangential)->fields) return bad(A_options_tangential, R_PLANE);
    wri_set_sizes(sizes, o);
    *bytes = 8 * (size_t)(head_numbers() + (o->n_samples + 7) / 8 * 8 + CALL(contact_size, sizes));
    return 0;
}

int wr_contact_init(const wr_contact_options *o, void *memory, size_t bytes) {
    size_t needed;
    TRY(wr_contact_size(o, &needed));
    TRY(wri_room(memory, bytes, needed));
    Head *head = wri_begin(o, CONTACT, memory, needed);
    head->at_zeros = head_numbers();
    head->at_work = head->at_zeros + (head->patch.n_samples + 7) / 8 * 8;
    head->at_strips = CALL(contact_strips, head->sizes);
    CALL(contact_init, head->sizes, head->patch.poisson_ratio, work_of(memory));
    wri_finish(head);
    return 0;
}

int wr_contact_case(const wr_contact_options *o, double mu, double speed, wr_case *c) {
    TRY(wri_check_contact_options(o));
    TRY(wri_check_number(mu, A_mu));
    TRY(wri_check_number(speed, A_speed));
    TRY(aligned(c, A_problem));
    memset(c, 0, sizeof *c);
    c->normal = o->normal, c->normal_family = wri_normal_method(o->normal)->family;
    c->tangential = o->tangential, c->tangential_family = wri_tangential_method(o->tangential)->family;
    c->G = o->shear_modulus, c->nu = o->poisson_ratio, c->pressure_limit = o->pressure_limit;
    c->max_iterations = o->max_iterations, c->conformal = o->conformal;
    c->mu = c->kinetic = mu, c->speed = speed;
#define X(member, value) c->member = value;
    WR_SURFACE_DEFAULTS(X)
#undef X
    return 0;
}

/* Find the samples that a separation may leave out: zeros. */
static void optional_samples(void *memory, const wr_separation *s, const double **x_c, const double **tilt) {
    double *zeros = numbers(memory, ((Head *)memory)->at_zeros);
    memset(zeros, 0, (size_t)s->n * sizeof *zeros);
    *x_c = s->x_c != NULL ? s->x_c : zeros, *tilt = s->tilt != NULL ? s->tilt : zeros;
}

/* Solve a checked case.  Return the number of strips. */
static int64_t solve_contact(void *memory, int cold, const wr_separation *s, const wr_case *c, wr_result *result) {
    Head *head = memory;
    const double *x_c, *tilt;
    optional_samples(memory, s, &x_c, &tilt);
    head->answered = 0;
    return CALL(contact_solve, head->sizes, work_of(memory), cold, s->n, (void *)s->y, (void *)s->g, (void *)s->A,
                (void *)x_c, (void *)tilt, (void *)c, result);
}

int wr_contact_solve(void *memory, const wr_separation *s, const wr_case *c, wr_result *result) {
    TRY(wri_check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_separation(s, head->patch.n_samples));
    TRY(check_case(c, &head->patch));
    TRY(aligned(result, A_result));
    head->problem = *c;
    head->n_strips = solve_contact(memory, 0, s, &head->problem, &head->result);
    head->answered = 1;
    *result = head->result;
    return code_of(result->status);
}

int wr_contact_solve_force(void *memory, const wr_separation *s, int64_t which, double Fx, double Fy, wr_case *c,
                           wr_result *result) {
    TRY(wri_check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_separation(s, head->patch.n_samples));
    TRY(wri_check_whole(which, A_which_forces));
    if (which & WR_FORCE_X) TRY(wri_check_number(Fx, A_force_x));
    if (which & WR_FORCE_Y) TRY(wri_check_number(Fy, A_force_y));
    TRY(check_case(c, &head->patch));
    TRY(aligned(result, A_result));
    wr_result results[2];
    const double *x_c, *tilt;
    optional_samples(memory, s, &x_c, &tilt);
    head->problem = *c;
    head->n_strips = CALL(contact_force, head->sizes, work_of(memory), which, Fx, Fy, s->n, (void *)s->y, (void *)s->g,
                          (void *)s->A, (void *)x_c, (void *)tilt, &head->problem, results);
    head->result = results[0], head->answered = 1;
    *c = head->problem, *result = head->result;
    return code_of(result->status);
}

int wr_contact_accept(void *memory) {
    TRY(wri_check_memory(memory, CONTACT));
    TRY(wri_check_answer(memory));
    CALL(contact_accept, ((Head *)memory)->sizes, work_of(memory));
    return 0;
}

int wr_contact_forget(void *memory) {
    TRY(wri_check_memory(memory, CONTACT));
    CALL(contact_forget, ((Head *)memory)->sizes, work_of(memory));
    ((Head *)memory)->answered = 0;
    return 0;
}

int wr_contact_derivatives(void *memory, const wr_separation *s, const wr_case *c, double *jacobian) {
    TRY(wri_check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_separation(s, head->patch.n_samples));
    TRY(check_case(c, &head->patch));
    TRY(aligned(jacobian, A_jacobian));
    wr_case problems[2] = {*c, *c};
    wr_result results[2];
    const double *x_c, *tilt;
    optional_samples(memory, s, &x_c, &tilt);
    head->n_strips = CALL(contact_derivatives, head->sizes, work_of(memory), s->n, (void *)s->y, (void *)s->g,
                          (void *)s->A, (void *)x_c, (void *)tilt, problems, results, jacobian);
    head->problem = *c, head->result = results[0], head->answered = 1;
    return code_of(head->result.status);
}

int wr_contact_fields(const void *memory, wr_fields *fields) {
    TRY(wri_check_memory(memory, CONTACT));
    const Head *head = memory;
    TRY(wri_check_answer(head));
    TRY(wri_check_fields(fields));
    return wri_copy_fields(head, read_numbers(memory, head->at_work + head->at_strips), head->n_strips, fields);
}

int wr_damage_default(wr_damage_parameters *parameters) {
    TRY(aligned(parameters, A_parameters));
    *parameters = (wr_damage_parameters)WR_DAMAGE_DEFAULTS;
    return 0;
}

int wr_contact_damage(void *memory, const wr_damage_parameters *parameters, wr_damage *damage) {
    TRY(wri_check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(wri_check_answer(head));
    TRY(aligned(parameters, A_parameters));
    TRY(wri_check_damage(parameters, parameters, A_parameters_speed));
    TRY(aligned(damage, A_damage));
    CALL(contact_damage, head->sizes, work_of(memory), head->n_strips, &head->problem, &head->result, (void *)parameters,
         damage);
    return 0;
}

int wr_contact_batch(void *memory, int64_t n_separations, const wr_separation *separations, int64_t n,
                     const int64_t *which, const wr_case *cases, wr_result *results, int64_t *failed) {
    TRY(wri_check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(among(n_separations, 1, INT64_MAX / (int64_t)sizeof *separations, A_n_separations));
    TRY(among(n, 0, INT64_MAX / (int64_t)sizeof *cases, A_n));
    TRY(aligned(separations, A_separation));
    TRY(aligned(cases, A_cases));
    TRY(aligned(results, A_results));
    if ((uintptr_t)which % 8) return bad(A_which, R_ALIGNED);
    for (int64_t i = 0; i < n; i++) {
        int64_t of = which != NULL ? which[i] : 0;
        int code = among(of, 0, n_separations - 1, A_which);
        if (!code) code = check_separation(&separations[of], head->patch.n_samples);
        if (!code) code = check_case(&cases[i], &head->patch);
        if (code) {
            if (failed != NULL) *failed = i;
            return code;
        }
        solve_contact(memory, 1, &separations[of], &cases[i], &results[i]);
    }
    return 0;
}
