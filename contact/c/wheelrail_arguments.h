/* The part of wheelrail.c with the names of arguments, their ranges and the checks of single numbers.  Included there once.
 *
 * A range stands here and nowhere else: the checks and wr_explain read it. */

/* What a number may be.  None may be NaN. */
enum {
    ANY,      /* not checked here */
    REAL,     /* finite, from low to high */
    POSITIVE, /* finite, above 0, up to high */
    LIMIT,    /* from low on; infinity too */
    WHOLE,    /* int64_t, from low to high */
    SIGN,     /* int64_t, -1 or 1 */
};

/* Lists of members, M(member, kind, low, high, ...). */
#define OF_CONTACT_OPTIONS(M, least, most, ...)                                                               \
    M(normal, WHOLE, 0, COUNT(NORMAL) - 1, __VA_ARGS__) M(tangential, WHOLE, 0, COUNT(TANGENTIAL) - 1, __VA_ARGS__) \
    M(n_strips, WHOLE, 4, 1000, __VA_ARGS__) M(n_elements, WHOLE, 4, 1000, __VA_ARGS__)                       \
    M(n_samples, WHOLE, least, most, __VA_ARGS__) M(max_iterations, WHOLE, 1, 1000, __VA_ARGS__)              \
    M(conformal, WHOLE, 0, 1, __VA_ARGS__) M(shear_modulus, POSITIVE, 0.0, INFINITY, __VA_ARGS__)             \
    M(poisson_ratio, REAL, 0.0, 0.5, __VA_ARGS__) M(pressure_limit, LIMIT, 0.0, INFINITY, __VA_ARGS__)
#define OF_PAIR_OPTIONS(M, ...)                                                                              \
    M(side, SIGN, -1, 1, __VA_ARGS__) M(most_patches, WHOLE, 1, WR_MAX_PATCHES, __VA_ARGS__)                 \
    M(wheel_radius, REAL, 0.05, 2.0, __VA_ARGS__) M(gauge, REAL, 0.1, 3.0, __VA_ARGS__)                      \
    M(flange_back, REAL, 0.1, 3.0, __VA_ARGS__) M(gauge_point, POSITIVE, 0.0, INFINITY, __VA_ARGS__)         \
    M(combine_distance, REAL, 0.0, INFINITY, __VA_ARGS__) M(combine_angle, REAL, 0.0, INFINITY, __VA_ARGS__) \
    M(n_bins, WHOLE, 0, 100000, __VA_ARGS__) M(bin_start, REAL, -1e6, 1e6, __VA_ARGS__)                      \
    M(bin_width, REAL, 1e-9, 1e6, __VA_ARGS__) M(reach, REAL, 0.01, 0.3, __VA_ARGS__)                        \
    M(tilted, WHOLE, 0, 1, __VA_ARGS__) M(reference_speed, REAL, 1e-6, 10.0, __VA_ARGS__)
#define OF_DAMAGE(M, ...)                                                                                   \
    M(speed, REAL, 0.0, INFINITY, __VA_ARGS__) M(wheel_radius, POSITIVE, 0.0, INFINITY, __VA_ARGS__)        \
    M(hardness, POSITIVE, 0.0, INFINITY, __VA_ARGS__) M(shear_yield, POSITIVE, 0.0, INFINITY, __VA_ARGS__)  \
    M(rail_wear, REAL, 0.0, 1e3, __VA_ARGS__) M(with_spin, WHOLE, 0, 1, __VA_ARGS__)                        \
    M(wear_law, WHOLE, WR_WEAR_ARCHARD, WR_WEAR_PEARCE_SHERRATT, __VA_ARGS__)
/* Methods, material and friction of a case.  The first three depend on options. */
#define OF_SURFACE(M, ...)                                                                                    \
    M(normal, ANY, 0, 0, __VA_ARGS__) M(normal_family, ANY, 0, 0, __VA_ARGS__)                                \
    M(tangential_family, ANY, 0, 0, __VA_ARGS__) M(tangential, WHOLE, 0, COUNT(TANGENTIAL) - 1, __VA_ARGS__)  \
    M(speed, REAL, 0.0, INFINITY, __VA_ARGS__) M(G, POSITIVE, 0.0, INFINITY, __VA_ARGS__)                     \
    M(nu, REAL, 0.0, 0.5, __VA_ARGS__) M(pressure_limit, LIMIT, 0.0, INFINITY, __VA_ARGS__)                   \
    M(max_iterations, WHOLE, 1, 1000, __VA_ARGS__) M(tolerance, REAL, 0.0, 1e-2, __VA_ARGS__)                 \
    M(mu, REAL, 0.0, 1e6, __VA_ARGS__) M(law, WHOLE, WR_FRICTION_COULOMB, WR_FRICTION_EXPONENTIAL, __VA_ARGS__) \
    M(kinetic, REAL, 0.0, 1e6, __VA_ARGS__) M(half_speed, POSITIVE, 0.0, INFINITY, __VA_ARGS__)               \
    M(velocity, WHOLE, WR_VELOCITY_GLOBAL, WR_VELOCITY_GREATEST, __VA_ARGS__)                                 \
    M(slope, POSITIVE, 0.0, 1.0, __VA_ARGS__) M(slope_far, REAL, 0.0, 1.0, __VA_ARGS__)                       \
    M(slope_rate, REAL, 0.0, INFINITY, __VA_ARGS__) M(gauge_factor, REAL, 0.0, 100.0, __VA_ARGS__)            \
    M(border, REAL, -INFINITY, INFINITY, __VA_ARGS__) M(border_width, REAL, -INFINITY, INFINITY, __VA_ARGS__) \
    M(k_A, POSITIVE, 0.0, 1.0, __VA_ARGS__) M(k_S, POSITIVE, 0.0, 1.0, __VA_ARGS__)                           \
    M(drop, REAL, 0.0, 1.0, __VA_ARGS__) M(warm, REAL, -1e5, 1e5, __VA_ARGS__)                                \
    M(warm_range, POSITIVE, 0.0, INFINITY, __VA_ARGS__) M(heating, REAL, 0.0, INFINITY, __VA_ARGS__)          \
    M(conformal, WHOLE, 0, 1, __VA_ARGS__)
#define OF_CASE(M, ...)                                                                                      \
    M(load_kind, WHOLE, WR_BY_LOAD, WR_BY_APPROACH, __VA_ARGS__) M(amount, REAL, -INFINITY, INFINITY, __VA_ARGS__) \
    M(vx, REAL, -WR_LARGEST_CREEPAGE, WR_LARGEST_CREEPAGE, __VA_ARGS__)                                      \
    M(vy, REAL, -WR_LARGEST_CREEPAGE, WR_LARGEST_CREEPAGE, __VA_ARGS__)                                      \
    M(phi, REAL, -WR_LARGEST_CREEPAGE, WR_LARGEST_CREEPAGE, __VA_ARGS__) M(rolling, REAL, -1e3, 1e3, __VA_ARGS__)
#define OF_INPUT(M, ...)                                                                                     \
    M(height, WHOLE, WR_HEIGHT_GIVEN, WR_HEIGHT_VERTICAL, __VA_ARGS__) M(amount, REAL, 0.0, INFINITY, __VA_ARGS__) \
    M(distance, REAL, 0.0, INFINITY, __VA_ARGS__) M(station, REAL, -1e7, 1e7, __VA_ARGS__)                   \
    M(rotation, REAL, -1e8, 1e8, __VA_ARGS__)
#define FINITE(M, member, ...) M(member, REAL, -INFINITY, INFINITY, __VA_ARGS__)
#define ANGLE(M, member, ...) M(member, REAL, -WR_LARGEST_ANGLE, WR_LARGEST_ANGLE, __VA_ARGS__)
#define OF_MOTION(M, ...)                                                                                    \
    FINITE(M, y, __VA_ARGS__) FINITE(M, z, __VA_ARGS__) ANGLE(M, roll, __VA_ARGS__) ANGLE(M, yaw, __VA_ARGS__) \
    FINITE(M, vx, __VA_ARGS__) FINITE(M, vy, __VA_ARGS__) FINITE(M, vz, __VA_ARGS__)                         \
    FINITE(M, roll_rate, __VA_ARGS__) FINITE(M, yaw_rate, __VA_ARGS__) FINITE(M, spin, __VA_ARGS__)          \
    FINITE(M, rail_y, __VA_ARGS__) FINITE(M, rail_z, __VA_ARGS__)                                            \
    M(rail_roll, REAL, -WR_LARGEST_RAIL_ROLL, WR_LARGEST_RAIL_ROLL, __VA_ARGS__)                             \
    FINITE(M, rail_vy, __VA_ARGS__) FINITE(M, rail_vz, __VA_ARGS__) FINITE(M, rail_roll_rate, __VA_ARGS__)
#define OF_OFFSET(M, ...)                                                                                       \
    FINITE(M, x, __VA_ARGS__) FINITE(M, y, __VA_ARGS__) FINITE(M, z, __VA_ARGS__) ANGLE(M, roll, __VA_ARGS__)   \
    ANGLE(M, pitch, __VA_ARGS__) ANGLE(M, yaw, __VA_ARGS__) FINITE(M, x_rate, __VA_ARGS__)                      \
    FINITE(M, y_rate, __VA_ARGS__) FINITE(M, z_rate, __VA_ARGS__) FINITE(M, roll_rate, __VA_ARGS__)             \
    FINITE(M, pitch_rate, __VA_ARGS__) FINITE(M, yaw_rate, __VA_ARGS__)
#define OF_SPRINGS(M, ...)                                                                    \
    M(ky, REAL, 0.0, INFINITY, __VA_ARGS__) M(kz, REAL, 0.0, INFINITY, __VA_ARGS__)           \
    FINITE(M, preload_y, __VA_ARGS__) FINITE(M, preload_z, __VA_ARGS__)
#define OF_LOAD(M, ...) M(nx, WHOLE, 4, 1000, __VA_ARGS__) M(ny, WHOLE, 4, 1000, __VA_ARGS__)

/* M(member, kind, low, high, group, text before the member, struct of the caller, whether it begins with its size, place) */
#define MEMBERS(M)                                                              \
    OF_CONTACT_OPTIONS(M, 3, 100000, options, "options.", wr_contact_options, 1, )    \
    OF_CONTACT_OPTIONS(M, 5, 2001, patch, "options.patch.", wr_pair_options, 1, patch.) \
    OF_PAIR_OPTIONS(M, pair, "options.", wr_pair_options, 1, )                  \
    OF_DAMAGE(M, parameters, "parameters.", wr_damage_parameters, 0, )          \
    OF_DAMAGE(M, damage, "options.damage.", wr_pair_options, 1, damage.)        \
    OF_SURFACE(M, case, "case.", wr_case, 0, )                                  \
    OF_CASE(M, case, "case.", wr_case, 0, )                                     \
    OF_SURFACE(M, surface, "input.surface.", wr_pair_input, 1, surface.)        \
    OF_INPUT(M, input, "input.", wr_pair_input, 1, )                            \
    OF_MOTION(M, motion, "input.motion.", wr_pair_input, 1, motion.)            \
    OF_OFFSET(M, offset, "input.offset.", wr_pair_input, 1, offset.)            \
    OF_SPRINGS(M, springs, "input.rail.", wr_pair_input, 1, rail.)              \
    OF_LOAD(M, load, "load.", wr_surface_load, 1, )

/* Numbers that are no members, and members of arrays: N(argument, name, kind, low, high). */
#define MOST_NODES 100000
#define NUMBERS(N)                                                                                        \
    N(mu, "mu", REAL, 0.0, 1e6) N(speed, "speed", REAL, 0.0, INFINITY) N(load, "load", REAL, 0.0, INFINITY) \
    N(n_wheel, "n_wheel", WHOLE, 4, MOST_NODES) N(n_rail, "n_rail", WHOLE, 4, MOST_NODES)                 \
    N(which_forces, "which", WHOLE, WR_FORCE_X, WR_FORCE_X + WR_FORCE_Y)                                  \
    N(body, "body", WHOLE, WR_BODY_RAIL, WR_BODY_WHEEL) N(poisson, "poisson_ratio", REAL, 0.0, 0.5)       \
    N(sep_A, "separation.A", POSITIVE, 0.0, INFINITY) N(sep_tilt, "separation.tilt", REAL, -1e3, 1e3)     \
    N(z, "z", REAL, 0.0, INFINITY) N(force_x, "Fx", REAL, -INFINITY, INFINITY)                            \
    N(force_y, "Fy", REAL, -INFINITY, INFINITY)

/* Other arguments. */
#define ARGUMENTS(X)                                                                                                 \
    X(memory, "memory") X(bytes, "bytes") X(options, "options") X(result, "result") X(separation, "separation")      \
    X(n, "n") X(sep_n, "separation.n") X(sep_y, "separation.y") X(sep_g, "separation.g")                             \
    X(sep_x_c, "separation.x_c") X(problem, "case") X(jacobian, "jacobian")                                          \
    X(fields, "fields") X(parameters, "parameters") X(damage, "damage") X(n_separations, "n_separations")            \
    X(which, "which") X(cases, "cases") X(results, "results") X(wheel, "wheel") X(rail, "rail")                      \
    X(wheel_y, "wheel.y") X(wheel_z, "wheel.z") X(wheel_angle, "wheel.angle") X(rail_y, "rail.y")                    \
    X(rail_z, "rail.z") X(rail_angle, "rail.angle") X(input, "input") X(answer, "answer") X(k, "k") X(bins, "bins")  \
    X(count, "count") X(motion, "input.motion") X(offset, "input.offset")                                            \
    X(p_constants, "parameters: constants of a law") X(n_strips_most, "fields.n_strips_most") X(wheel_n, "wheel.n")  \
    X(rail_n, "rail.n") X(wheel_numbers, "wheel.numbers") X(rail_numbers, "rail.numbers") X(surface_load, "load")    \
    X(load_x, "load.x") X(load_y, "load.y") X(load_p, "load.p") X(load_qx, "load.qx") X(load_qy, "load.qy")          \
    X(x, "x") X(y, "y") X(stress, "stress") X(given, "given") X(text, "text")

enum { A_none,
#define X(name, text) A_##name,
       ARGUMENTS(X)
#undef X
#define N(name, text, kind, low, high) A_##name,
       NUMBERS(N)
#undef N
#define M(member, kind, low, high, group, text, type, sized, place) A_##group##_##member,
       MEMBERS(M)
#undef M
       A_end };

typedef struct {
    const char *name;
    int kind;
    double low, high;
    size_t at, size; /* of a member: its place in the struct of the caller, and the size with which this begins, or 0 */
    int is_member;
} Argument;

static const Argument ARGUMENT[] = {
    {"", ANY, 0.0, 0.0, 0, 0, 0},
#define X(name, text) {text, ANY, 0.0, 0.0, 0, 0, 0},
    ARGUMENTS(X)
#undef X
#define N(name, text, kind, low, high) {text, kind, low, high, 0, 0, 0},
    NUMBERS(N)
#undef N
#define M(member, kind, low, high, group, text, type, sized, place) \
    {text #member, kind, low, high, offsetof(type, place member), sized ? sizeof(type) : 0, 1},
    MEMBERS(M)
#undef M
};

static int bad(int argument, int reason) { return -(100 * argument + reason); }

static int check_number(double value, int argument) {
    const Argument *a = &ARGUMENT[argument];
    if (isnan(value) || (isinf(value) && a->kind != LIMIT)) return bad(argument, R_NOT_FINITE);
    return value < a->low || value > a->high || (a->kind == POSITIVE && value == 0.0) ? bad(argument, R_RANGE) : 0;
}

static int check_whole(int64_t value, int argument) {
    const Argument *a = &ARGUMENT[argument];
    if (value < (int64_t)a->low || value > (int64_t)a->high) return bad(argument, R_RANGE);
    return a->kind == SIGN && value == 0 ? bad(argument, R_RANGE) : 0;
}

static int is_whole(int argument) { return ARGUMENT[argument].kind >= WHOLE; }

/* Check one member of a struct, and members that follow each other in MEMBERS.  `of` is the struct of the caller. */
static int check_member(const void *of, int argument) {
    const char *at = (const char *)of + ARGUMENT[argument].at;
    if (ARGUMENT[argument].kind == ANY) return 0;
    return is_whole(argument) ? check_whole(*(const int64_t *)at, argument) : check_number(*(const double *)at, argument);
}

static int check_members(const void *of, int first, int last) {
    for (int argument = first; argument <= last; argument++) TRY(check_member(of, argument));
    return 0;
}

/* ---------------------------------------------------------------- text */

#define WORDS 40

/* Few digits where they are the number, all of them otherwise. */
static void put_number(char text[WORDS], double value) {
    snprintf(text, WORDS, "%.6g", value);
    if (isfinite(value) && strtod(text, NULL) != value) snprintf(text, WORDS, "%.17g", value);
}

static void put_range(char text[3 * WORDS], const Argument *a) {
    char low[WORDS], high[WORDS];
    put_number(low, a->low), put_number(high, a->high);
    snprintf(text, 3 * WORDS, "%s%s, %s%s", a->kind == POSITIVE || isinf(a->low) ? "]" : "[", low, high,
             isinf(a->high) && a->kind != LIMIT ? "[" : "]");
}

/* Whether `of` has the member, and for a range whether this is what was refused.  If not, another struct was given. */
static int has_value(int argument, int reason, const void *of) {
    const Argument *a = &ARGUMENT[argument];
    if (of == NULL || !a->is_member || (a->size && *(const int64_t *)of != (int64_t)a->size)) return 0;
    return (reason != R_RANGE && reason != R_NOT_FINITE) || check_member(of, argument) || a->kind == ANY;
}

static void put_value(char text[WORDS], int argument, const void *of) {
    const char *at = (const char *)of + ARGUMENT[argument].at;
    const int whole = is_whole(argument) || ARGUMENT[argument].kind == ANY; /* those not checked are methods */
    if (whole) snprintf(text, WORDS, "%" PRId64, *(const int64_t *)at);
    else put_number(text, *(const double *)at);
}

int wr_explain(int code, const void *given, char *text, size_t bytes) {
    if (text == NULL) return bad(A_text, R_IS_NULL);
    if ((uintptr_t)given % 8) return bad(A_given, R_ALIGNED);
    const int known = code < 0 && code > -100 * A_end, argument = known ? -code / 100 : A_none, reason = known ? -code % 100 : 0;
    const Argument *a = &ARGUMENT[argument];
    const int of_range = reason == R_RANGE || reason == R_NOT_FINITE, finite = isinf(a->low) && isinf(a->high);
    char value[WORDS + 3] = "", range[3 * WORDS], line[400];
    if (has_value(argument, reason, given)) {
        memcpy(value, " = ", 4);
        put_value(value + 3, argument, given);
    }
    put_range(range, a);
    if (argument == A_none) snprintf(line, sizeof line, "%s", wr_message(code));
    else if (of_range && a->kind == SIGN) snprintf(line, sizeof line, "%s%s is neither 1 nor -1", a->name, value);
    else if (of_range && a->kind != ANY && finite) snprintf(line, sizeof line, "%s%s is not finite", a->name, value);
    else if (of_range && a->kind != ANY)
        snprintf(line, sizeof line, "%s%s is outside its allowed range %s", a->name, value, range);
    else snprintf(line, sizeof line, "%s%s: %s", a->name, value, wr_message(code));
    const size_t length = strlen(line);
    if (bytes == 0) return bad(A_bytes, R_SMALL);
    memcpy(text, line, length < bytes ? length : bytes - 1);
    text[length < bytes ? length : bytes - 1] = '\0';
    return length < bytes ? 0 : bad(A_bytes, R_SMALL);
}
