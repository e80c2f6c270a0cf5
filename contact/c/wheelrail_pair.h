/* The part of wheelrail.c for a wheel on a rail.  Included there once. */

#define MOST_NUMBERS 2000000

/* Call the entry for profiles or for surfaces. */
#define CALL_PAIR(entry, head, ...)                                             \
    ((head)->kind == SURFACES ? CALL(surfaces_##entry, (head)->sizes, __VA_ARGS__) \
                              : CALL(pair_##entry, (head)->sizes, __VA_ARGS__))

static int check_pair(const void *memory) {
    TRY(aligned(memory, A_memory));
    return check_memory(memory, ((const Head *)memory)->kind == SURFACES ? SURFACES : PAIR);
}

static int check_pair_options(const wr_pair_options *o) {
    TRY(aligned(o, A_options));
    if (o->size != (int64_t)sizeof *o) return bad(A_options, R_STRUCT);
    if (o->patch.size != (int64_t)sizeof o->patch) return bad(A_options, R_STRUCT);
    TRY(check_members(o, A_patch_normal, A_pair_reference_speed));
    return check_damage(&o->damage, o, A_damage_speed);
}

int wr_pair_default(wr_pair_options *o) {
    TRY(aligned(o, A_options));
    *o = (wr_pair_options){.size = sizeof *o,
                           .side = 1,
                           .most_patches = WR_MAX_PATCHES,
                           .wheel_radius = 0.46,
                           .gauge = 1.435,
                           .flange_back = 1.36,
                           .gauge_point = 0.014,
                           .combine_distance = 8e-3,
                           .combine_angle = 0.17453292519943295,
                           .bin_width = 1e-3,
                           .damage = WR_DAMAGE_DEFAULTS,
                           .reach = 0.06,
                           .reference_speed = WR_SLOWEST};
    TRY(wr_contact_default(&o->patch));
    o->patch.n_samples = 81;
    return 0;
}

/* Numbers before `work`: the head.  After it: room for profiles while they are prepared. */
static int64_t staging(int64_t n_wheel, int64_t n_rail) {
    int64_t most = n_wheel > n_rail ? n_wheel : n_rail;
    return 3 * (n_wheel + n_rail) + 6 * most;
}

int wr_pair_size(const wr_pair_options *o, int64_t n_wheel, int64_t n_rail, size_t *bytes) {
    double sizes[N_SIZES];
    TRY(check_pair_options(o));
    TRY(check_whole(n_wheel, A_n_wheel));
    TRY(check_whole(n_rail, A_n_rail));
    TRY(aligned(bytes, A_bytes));
    set_sizes(sizes, &o->patch);
    sizes[4] = sizes[7] = (double)n_wheel;
    sizes[5] = sizes[8] = (double)n_rail;
    sizes[6] = (double)o->n_bins;
    *bytes = 8 * (size_t)(head_numbers() + CALL(pair_size, sizes) + staging(n_wheel, n_rail));
    return 0;
}

static int check_profile(const wr_profile *p, const int arguments[4]) {
    TRY(aligned(p, arguments[0]));
    TRY(among(p->n, 4, MOST_NODES, arguments[0]));
    TRY(aligned(p->y, arguments[1]));
    TRY(aligned(p->z, arguments[2]));
    TRY(finite_all(p->y, p->n, arguments[1]));
    TRY(finite_all(p->z, p->n, arguments[2]));
    for (int64_t i = 1; i < p->n; i++)
        if (!(hypot(p->y[i] - p->y[i - 1], p->z[i] - p->z[i - 1]) > 0.0)) return bad(arguments[1], R_COINCIDE);
    if (p->angle == NULL) return 0;
    TRY(aligned(p->angle, arguments[3]));
    return finite_all(p->angle, p->n, arguments[3]);
}

/* Whether z points down and the flange lies at negative y, as Python's reader asks of a file
 * (contact.geometry.inspection.misplaced).  Most of a wheel's width is tread, and of a rail's width crown, at small z.  A shape
 * that is flat, or as deep at both ends, is not judged. */
static int check_place(const wr_profile *p, int is_wheel, const int arguments[4]) {
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
static void place_profile(const wr_profile *p, double *rows, double *scratch) {
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

static Head *begin_pair(const wr_pair_options *o, int64_t kind, void *memory, size_t needed) {
    Head *head = memory;
    memset(memory, 0, needed);
    head->abi = WR_ABI, head->kind = kind, head->bytes = (int64_t)needed;
    head->patch = o->patch, head->n_bins = o->n_bins, head->at_work = head_numbers();
    set_sizes(head->sizes, &o->patch);
    return head;
}

/* From here on the memory holds a solver. */
static void finish(Head *head) {
    head->magic = MAGIC;
    head->sum = sum_of(head);
}

int wr_pair_init(const wr_pair_options *options, const wr_profile *wheel, const wr_profile *rail, void *memory,
                 size_t bytes) {
    static const int of_wheel[] = {A_wheel, A_wheel_y, A_wheel_z, A_wheel_angle};
    static const int of_rail[] = {A_rail, A_rail_y, A_rail_z, A_rail_angle};
    TRY(check_pair_options(options));
    TRY(check_profile(wheel, of_wheel));
    TRY(check_profile(rail, of_rail));
    TRY(check_place(wheel, 1, of_wheel));
    TRY(check_place(rail, 0, of_rail));
    size_t needed;
    TRY(wr_pair_size(options, wheel->n, rail->n, &needed));
    TRY(room(memory, bytes, needed));
    wr_pair_options o = *options;
    Head *head = begin_pair(&o, PAIR, memory, needed);
    head->sizes[4] = head->sizes[7] = (double)wheel->n;
    head->sizes[5] = head->sizes[8] = (double)rail->n;
    head->sizes[6] = (double)o.n_bins;
    double *stage = numbers(memory, (int64_t)(needed / 8) - staging(wheel->n, rail->n));
    double *wheel_rows = stage, *rail_rows = wheel_rows + 3 * wheel->n, *scratch = rail_rows + 3 * rail->n, ends[4];
    place_profile(wheel, wheel_rows, scratch);
    place_profile(rail, rail_rows, scratch);
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
    finish(head);
    return 0;
}

static int check_surface_numbers(const wr_surface *s, const int arguments[3]) {
    double sizes[N_SIZES] = {0};
    sizes[WIDE] = is_wide();
    TRY(aligned(s, arguments[0]));
    TRY(among(s->n, 6, MOST_NUMBERS, arguments[1]));
    TRY(aligned(s->numbers, arguments[2]));
    TRY(finite_all(s->numbers, s->n, arguments[2]));
    return CALL(surfaces_check, sizes, (void *)s->numbers, s->n) ? 0 : bad(arguments[2], R_NO_SURFACE);
}

static int set_surface_sizes(const wr_pair_options *o, const wr_surface *wheel, const wr_surface *rail,
                             double sizes[N_SIZES]) {
    static const int of_wheel[] = {A_wheel, A_wheel_n, A_wheel_numbers};
    static const int of_rail[] = {A_rail, A_rail_n, A_rail_numbers};
    TRY(check_pair_options(o));
    if (o->n_bins) return bad(A_pair_n_bins, R_NO_BINS);
    TRY(check_surface_numbers(wheel, of_wheel));
    TRY(check_surface_numbers(rail, of_rail));
    set_sizes(sizes, &o->patch);
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
    TRY(room(memory, bytes, needed));
    wr_pair_options o = *options;
    wr_surface of_wheel = *wheel, of_rail = *rail;
    Head *head = begin_pair(&o, SURFACES, memory, needed);
    head->sizes[4] = (double)of_wheel.n;
    head->sizes[5] = (double)of_rail.n;
    Number motion[WR_MOTION_NUMBERS];
    set_motion(&o, motion);
    wr_case problem;
    TRY(wr_contact_case(&o.patch, 0.0, 0.0, &problem));
    head->at_strips = CALL(surfaces_init, head->sizes, work_of(memory), (void *)of_wheel.numbers,
                           (void *)of_rail.numbers, motion, &problem, &o.damage);
    finish(head);
    return 0;
}

int wr_pair_input_default(const wr_pair_options *o, double mu, double speed, double load, wr_pair_input *input) {
    TRY(check_pair_options(o));
    TRY(check_number(load, A_load));
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
    TRY(check_surface(&in->surface, o, in, A_surface_normal));
    TRY(check_members(in, A_input_height, A_springs_preload_z));
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
static int solve_pair(void *memory, int cold, const wr_pair_input *in, wr_pair_answer *answer) {
    Head *head = memory;
    wr_case surface = in->surface;
    wr_elastic_rail rail = in->rail, deflected;
    wr_motion motion = in->motion;
    wr_wheel_offset offset = in->offset;
    wr_pair_answer made = {.size = sizeof made};
    if (head->kind == SURFACES && motion.vx < 0.0) return bad(A_motion_vx, R_BACKWARDS);
    surface.speed = fabs(motion.vx);
    rail.dy = rail.dz = 0.0;
    rail.balanced = 0;
    head->answered = 0;
    double *work = work_of(memory);
    int64_t n = head->kind == SURFACES
                    ? CALL(surfaces_solve, head->sizes, work, cold, in->height, in->amount, in->station, in->rotation,
                           &motion, &surface, &rail, &offset, &made.total, made.patches, &deflected)
                    : CALL(pair_solve, head->sizes, work, cold, in->height, in->amount, in->distance, &motion, &surface,
                           &rail, &offset, &made.total, made.patches, &deflected);
    if (n < 0) return failure(n, in->height);
    made.deflection_y = deflected.dy, made.deflection_z = deflected.dz;
    head->answered = 1, head->n_patches = n, head->problem = surface;
    *answer = made;
    return 0;
}

static int check_answer_struct(const wr_pair_answer *answer) {
    TRY(aligned(answer, A_answer));
    return answer->size == (int64_t)sizeof *answer ? 0 : bad(A_answer, R_STRUCT);
}

int wr_pair_solve(void *memory, const wr_pair_input *input, wr_pair_answer *answer) {
    TRY(check_pair(memory));
    TRY(check_input(input, &((Head *)memory)->patch));
    TRY(check_answer_struct(answer));
    TRY(solve_pair(memory, 0, input, answer));
    return code_of(answer->total.status);
}

int wr_pair_accept(void *memory) {
    TRY(check_pair(memory));
    TRY(check_answer(memory));
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
    wr_motion motion = input->motion;
    TRY(solve_pair(memory, 0, input, &answer));
    CALL_PAIR(derivatives, head, work_of(memory), input->height, &motion, jacobian);
    return code_of(answer.total.status);
}

int wr_pair_patch(void *memory, int64_t k, wr_result *result, wr_fields *fields) {
    TRY(check_pair(memory));
    Head *head = memory;
    TRY(check_answer(head));
    TRY(among(k, 0, head->n_patches - 1, A_k));
    TRY(aligned(result, A_result));
    if (fields != NULL) TRY(check_fields(fields));
    int64_t n = CALL_PAIR(patch, head, work_of(memory), k, result);
    if (fields != NULL) TRY(copy_fields(head, work_of(memory) + head->at_strips, n, fields));
    return code_of(result->status);
}

int wr_pair_surface_load(void *memory, int64_t k, wr_surface_load *l) {
    TRY(check_pair(memory));
    Head *head = memory;
    TRY(check_answer(head));
    TRY(among(k, 0, head->n_patches - 1, A_k));
    TRY(check_load(l));
    wr_result result;
    int64_t n = CALL_PAIR(patch, head, work_of(memory), k, &result);
    return fill_load(head, n, &result, l);
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
