/* A wheel on a rail. */
#include <math.h>
#include <string.h>

#include "internal.h"

#define MOST_NUMBERS 2000000

/* Call the entry for profiles or for surfaces. */
#define CALL_PAIR(entry, head, ...)                                             \
    ((head)->kind == SURFACES ? CALL(surfaces_##entry, (head)->sizes, __VA_ARGS__) \
                              : CALL(pair_##entry, (head)->sizes, __VA_ARGS__))

static int check_pair(const void *memory) {
    TRY(aligned(memory, A_memory));
    return wri_check_memory(memory, ((const Head *)memory)->kind == SURFACES ? SURFACES : PAIR);
}

int wr_pair_default(wr_pair_options *o) {
    TRY(aligned(o, A_options));
    *o = (wr_pair_options){.size = sizeof *o, .damage = WR_DAMAGE_DEFAULTS};
    o->patch.size = sizeof o->patch;
#define M(member, kind, low, high, usual, place, ...) o->place member = usual;
    OF_PATCH(M, patch., )
    OF_PAIR(M, , )
#undef M
    return 0;
}

/* Numbers before `work`: the head.  After it: room for profiles while they are prepared. */
static int64_t staging(int64_t n_wheel, int64_t n_rail) {
    int64_t most = n_wheel > n_rail ? n_wheel : n_rail;
    return 3 * (n_wheel + n_rail) + 6 * most;
}

int wr_pair_size(const wr_pair_options *o, int64_t n_wheel, int64_t n_rail, size_t *bytes) {
    double sizes[N_SIZES];
    TRY(wri_check_pair_options(o));
    TRY(wri_check_whole(n_wheel, A_n_wheel));
    TRY(wri_check_whole(n_rail, A_n_rail));
    TRY(aligned(bytes, A_bytes));
    wri_set_sizes(sizes, &o->patch);
    sizes[4] = sizes[7] = (double)n_wheel;
    sizes[5] = sizes[8] = (double)n_rail;
    sizes[6] = (double)o->n_bins;
    *bytes = 8 * (size_t)(head_numbers() + CALL(pair_size, sizes) + staging(n_wheel, n_rail));
    return 0;
}

/* A member of a record. */
typedef union {
    double f;
    int64_t i;
} Number;

static void set_motion(const wr_pair_options *o, Number motion[WR_MOTION_NUMBERS]) {
    memset(motion, 0, WR_MOTION_NUMBERS * sizeof *motion);
    motion[WR_MOTION_RADIUS].f = o->wheel_radius;
    motion[WR_MOTION_TAPE].f = 0.5 * o->flange_back + WR_TAPE_FROM_FLANGE_BACK;
    motion[WR_MOTION_COMBINE_DISTANCE].f = o->combine_distance;
    motion[WR_MOTION_COMBINE_ANGLE].f = o->combine_angle;
    motion[WR_MOTION_MOST_PATCHES].i = o->most_patches;
    motion[WR_MOTION_MIRROR].f = (double)o->side;
    motion[WR_MOTION_REACH].f = o->reach;
    motion[WR_MOTION_TILTED].i = o->tilted;
    motion[WR_MOTION_SLOWEST].f = o->reference_speed;
}

int wr_pair_init(const wr_pair_options *options, const wr_profile *wheel, const wr_profile *rail, void *memory,
                 size_t bytes) {
    static const int of_wheel[] = {A_wheel, A_wheel_y, A_wheel_z, A_wheel_angle};
    static const int of_rail[] = {A_rail, A_rail_y, A_rail_z, A_rail_angle};
    TRY(wri_check_pair_options(options));
    TRY(wri_check_profile(wheel, of_wheel));
    TRY(wri_check_profile(rail, of_rail));
    TRY(wri_check_place(wheel, 1, of_wheel));
    TRY(wri_check_place(rail, 0, of_rail));
    size_t needed;
    TRY(wr_pair_size(options, wheel->n, rail->n, &needed));
    TRY(wri_room(memory, bytes, needed));
    wr_pair_options o = *options;
    Head *head = wri_begin(&o.patch, PAIR, memory, needed);
    head->n_bins = o.n_bins;
    head->sizes[4] = head->sizes[7] = (double)wheel->n;
    head->sizes[5] = head->sizes[8] = (double)rail->n;
    head->sizes[6] = (double)o.n_bins;
    double *stage = numbers(memory, (int64_t)(needed / 8) - staging(wheel->n, rail->n));
    double *wheel_rows = stage, *rail_rows = wheel_rows + 3 * wheel->n, *scratch = rail_rows + 3 * rail->n, ends[4];
    wri_place_profile(wheel, wheel_rows, scratch);
    wri_place_profile(rail, rail_rows, scratch);
    CALL(pair_facing, head->sizes, wheel_rows, rail_rows, ends);
    if (ends[1] - ends[0] < 3.0) return bad(A_wheel, R_STEEP);
    if (ends[3] - ends[2] < 3.0) return bad(A_rail, R_STEEP);
    head->sizes[7] = ends[1] - ends[0];
    head->sizes[8] = ends[3] - ends[2];
    Number motion[WR_MOTION_NUMBERS];
    set_motion(&o, motion);
    wr_case problem;
    TRY(wr_contact_case(&o.patch, 0.0, 0.0, &problem));
    head->at_strips = CALL(pair_strips, head->sizes);
    head->at_bins = CALL(pair_bins, head->sizes);
    if (CALL(pair_init, head->sizes, work_of(memory), wheel_rows, rail_rows, motion, &problem, &o.damage, o.gauge,
             o.gauge_point, o.bin_start, o.bin_width))
        return bad(A_pair_gauge_point, R_GAUGE);
    wri_finish(head);
    return 0;
}

static int check_surface_numbers(const wr_surface *s, const int arguments[3]) {
    double sizes[N_SIZES] = {0};
    sizes[WIDE] = is_wide();
    TRY(aligned(s, arguments[0]));
    TRY(among(s->n, 6, MOST_NUMBERS, arguments[1]));
    TRY(aligned(s->numbers, arguments[2]));
    TRY(wri_finite_all(s->numbers, s->n, arguments[2]));
    return CALL(surfaces_check, sizes, (void *)s->numbers, s->n) ? 0 : bad(arguments[2], R_NO_SURFACE);
}

static int set_surface_sizes(const wr_pair_options *o, const wr_surface *wheel, const wr_surface *rail,
                             double sizes[N_SIZES]) {
    static const int of_wheel[] = {A_wheel, A_wheel_n, A_wheel_numbers};
    static const int of_rail[] = {A_rail, A_rail_n, A_rail_numbers};
    TRY(wri_check_pair_options(o));
    if (o->n_bins) return bad(A_pair_n_bins, R_NO_BINS);
    TRY(check_surface_numbers(wheel, of_wheel));
    TRY(check_surface_numbers(rail, of_rail));
    wri_set_sizes(sizes, &o->patch);
    sizes[4] = (double)wheel->n;
    sizes[5] = (double)rail->n;
    return 0;
}

int wr_pair_size_surfaces(const wr_pair_options *o, const wr_surface *wheel, const wr_surface *rail, size_t *bytes) {
    double sizes[N_SIZES];
    TRY(set_surface_sizes(o, wheel, rail, sizes));
    TRY(aligned(bytes, A_bytes));
    *bytes = 8 * (size_t)(head_numbers() + CALL(surfaces_size, sizes, (void *)wheel->numbers, (void *)rail->numbers));
    return 0;
}

int wr_pair_init_surfaces(const wr_pair_options *options, const wr_surface *wheel, const wr_surface *rail, void *memory,
                          size_t bytes) {
    size_t needed;
    TRY(wr_pair_size_surfaces(options, wheel, rail, &needed));
    TRY(wri_room(memory, bytes, needed));
    wr_pair_options o = *options;
    wr_surface of_wheel = *wheel, of_rail = *rail;
    Head *head = wri_begin(&o.patch, SURFACES, memory, needed);
    head->sizes[4] = (double)of_wheel.n;
    head->sizes[5] = (double)of_rail.n;
    Number motion[WR_MOTION_NUMBERS];
    set_motion(&o, motion);
    wr_case problem;
    TRY(wr_contact_case(&o.patch, 0.0, 0.0, &problem));
    head->at_strips = CALL(surfaces_init, head->sizes, work_of(memory), (void *)of_wheel.numbers,
                           (void *)of_rail.numbers, motion, &problem, &o.damage);
    wri_finish(head);
    return 0;
}

int wr_pair_input_default(const wr_pair_options *o, double mu, double speed, double load, wr_pair_input *input) {
    TRY(wri_check_pair_options(o));
    TRY(wri_check_number(load, A_load));
    TRY(aligned(input, A_input));
    wr_case surface;
    TRY(wr_contact_case(&o->patch, mu, fabs(speed), &surface));
    *input = (wr_pair_input){.size = sizeof *input, .height = WR_HEIGHT_LOAD, .amount = load};
    input->surface = surface;
    input->motion.vx = speed;
    input->motion.spin = -speed / o->wheel_radius;
    return 0;
}

static int check_input(const wr_pair_input *in, const wr_contact_options *o) {
    TRY(aligned(in, A_input));
    if (in->size != (int64_t)sizeof *in) return bad(A_input, R_STRUCT);
    TRY(wri_check_surface(&in->surface, o, in, A_surface_normal));
    TRY(wri_check_members(in, A_input_height, A_springs_preload_z));
    return in->height == WR_HEIGHT_PENETRATION && in->amount > LARGEST_PENETRATION ? bad(A_input_amount, R_PENETRATION) : 0;
}

static int failure(int64_t code, int64_t height) {
    switch (code) {
    case -1: return bad(A_motion, R_NO_OVERLAP);
    case -2: return bad(A_input_amount, R_NOT_SETTLED);
    case -3: return bad(height == WR_HEIGHT_GIVEN ? A_motion : A_input_amount, R_TOO_DEEP);
    case -4: return bad(A_offset, R_TURNED);
    default: return bad(A_input_distance, R_ENDLESS);
    }
}

/* Solve checked input.  Return 0 or an error. */
static int solve_pair(void *memory, const wr_pair_input *input, wr_pair_answer *answer) {
    Head *head = memory;
    wr_pair_input in = *input;
    wr_pair_answer made = {.size = sizeof made};
    if (head->kind == SURFACES && in.motion.vx < 0.0) return bad(A_motion_vx, R_BACKWARDS);
    in.surface.speed = fabs(in.motion.vx);
    in.rail.dy = in.rail.dz = 0.0;
    in.rail.balanced = 0;
    head->answered = 0;
    int64_t n = CALL_PAIR(solve, head, work_of(memory), &in, &made);
    if (n < 0) return failure(n, in.height);
    head->answered = 1, head->n_patches = n, head->problem = in.surface;
    *answer = made;
    return 0;
}

int wr_pair_solve(void *memory, const wr_pair_input *input, wr_pair_answer *answer) {
    TRY(check_pair(memory));
    TRY(check_input(input, &((Head *)memory)->patch));
    TRY(wri_check_answer_struct(answer));
    TRY(solve_pair(memory, input, answer));
    return code_of(answer->total.status);
}

int wr_pair_accept(void *memory) {
    TRY(check_pair(memory));
    TRY(wri_check_answer(memory));
    CALL_PAIR(accept, (Head *)memory, work_of(memory));
    ((Head *)memory)->answered = 0; /* its damage is booked once */
    return 0;
}

int wr_pair_forget(void *memory) {
    TRY(check_pair(memory));
    CALL_PAIR(forget, (Head *)memory, work_of(memory));
    ((Head *)memory)->answered = 0;
    return 0;
}

int wr_pair_derivatives(void *memory, const wr_pair_input *input, double *jacobian) {
    TRY(check_pair(memory));
    Head *head = memory;
    TRY(check_input(input, &head->patch));
    TRY(aligned(jacobian, A_jacobian));
    wr_pair_answer answer;
    TRY(solve_pair(memory, input, &answer));
    CALL_PAIR(derivatives, head, work_of(memory), input->height, jacobian);
    return code_of(answer.total.status);
}

int wr_pair_patch(void *memory, int64_t k, wr_result *result, wr_fields *fields) {
    TRY(check_pair(memory));
    Head *head = memory;
    TRY(wri_check_answer(head));
    TRY(among(k, 0, head->n_patches - 1, A_k));
    TRY(aligned(result, A_result));
    if (fields != NULL) TRY(wri_check_fields(fields));
    int64_t n = CALL_PAIR(patch, head, work_of(memory), k, result);
    if (fields != NULL) TRY(wri_copy_fields(head, work_of(memory) + head->at_strips, n, fields));
    return code_of(result->status);
}

int wr_pair_surface_load(void *memory, int64_t k, wr_surface_load *l) {
    TRY(check_pair(memory));
    Head *head = memory;
    TRY(wri_check_answer(head));
    TRY(among(k, 0, head->n_patches - 1, A_k));
    TRY(wri_check_load(l));
    wr_result result;
    int64_t n = CALL_PAIR(patch, head, work_of(memory), k, &result);
    return wri_fill_load(head, n, &result, l);
}

int wr_pair_bins(const void *memory, double *bins, int64_t count) {
    TRY(check_pair(memory));
    const Head *head = memory;
    TRY(aligned(bins, A_bins));
    int64_t n = 2 * WR_BIN_ROWS * head->n_bins;
    if (count < n) return bad(A_count, R_SMALL);
    memcpy(bins, read_numbers(memory, head->at_work + head->at_bins), (size_t)n * sizeof(double));
    return 0;
}
