/* Names of arguments, and the ranges of those that are numbers, which the checks and wr_explain read.
 *
 * The ranges of members are those of Python's options (contact.inputs.options), by way of wheelrail_records.h. */
#ifndef WRI_ARGUMENTS_H
#define WRI_ARGUMENTS_H

/* What a number may be.  None may be NaN. */
enum {
    ANY,      /* not checked here */
    REAL,     /* finite, from low to high */
    POSITIVE, /* finite, above 0, up to high */
    LIMIT,    /* from low on; infinity too */
    WHOLE,    /* int64_t, from low to high */
    SIGN,     /* int64_t, -1 or 1 */
};

/* Lists of members, M(member, kind, low, high, default, ...), besides those of wheelrail_records.h. */
#define OF_CONTACT_OPTIONS(M, samples, ...)                                                                     \
    M(normal, WHOLE, 0, N_NORMAL - 1, WR_DEFAULT_NORMAL, __VA_ARGS__)                                           \
    M(tangential, WHOLE, 0, N_TANGENTIAL - 1, WR_DEFAULT_TANGENTIAL, __VA_ARGS__)                               \
    M(n_samples, WHOLE, samples, __VA_ARGS__) WR_CONTACT_OPTIONS_RANGES(M, __VA_ARGS__)
#define OF_CONTACT(M, ...) OF_CONTACT_OPTIONS(M, WR_SEPARATION_SAMPLES, __VA_ARGS__)
#define OF_PATCH(M, ...) OF_CONTACT_OPTIONS(M, WR_PAIR_SAMPLES, __VA_ARGS__)
#define OF_PAIR(M, ...) M(side, SIGN, -1, 1, 1, __VA_ARGS__) WR_PAIR_OPTIONS_RANGES(M, __VA_ARGS__)
/* Methods, material and friction of a case.  The first three depend on options. */
#define OF_SURFACE(M, ...)                                                                                      \
    M(normal, ANY, 0, 0, 0, __VA_ARGS__) M(normal_family, ANY, 0, 0, 0, __VA_ARGS__)                            \
    M(tangential_family, ANY, 0, 0, 0, __VA_ARGS__)                                                             \
    M(tangential, WHOLE, 0, N_TANGENTIAL - 1, 0, __VA_ARGS__) WR_SURFACE_RANGES(M, __VA_ARGS__)
#define OF_LOAD(M, ...) M(nx, WHOLE, 4, 1000, 64, __VA_ARGS__) M(ny, WHOLE, 4, 1000, 64, __VA_ARGS__)

/* M(member, kind, low, high, default, group, text before the member, struct of the caller, whether it begins with its size,
 * place) */
#define MEMBERS(M)                                                                        \
    OF_CONTACT(M, options, "options.", wr_contact_options, 1, )                           \
    OF_PATCH(M, patch, "options.patch.", wr_pair_options, 1, patch.)                      \
    OF_PAIR(M, pair, "options.", wr_pair_options, 1, )                                    \
    WR_DAMAGE_PARAMETERS_RANGES(M, parameters, "parameters.", wr_damage_parameters, 0, )  \
    WR_DAMAGE_PARAMETERS_RANGES(M, damage, "options.damage.", wr_pair_options, 1, damage.) \
    OF_SURFACE(M, case, "case.", wr_case, 0, )                                            \
    WR_CASE_RANGES(M, case, "case.", wr_case, 0, )                                        \
    OF_SURFACE(M, surface, "input.surface.", wr_pair_input, 1, surface.)                  \
    WR_PAIR_INPUT_RANGES(M, input, "input.", wr_pair_input, 1, )                          \
    WR_GIVEN_RANGES(M, motion, "input.motion.", wr_pair_input, 1, motion.)                \
    WR_WHEEL_OFFSET_RANGES(M, offset, "input.offset.", wr_pair_input, 1, offset.)         \
    WR_ELASTIC_RAIL_RANGES(M, springs, "input.rail.", wr_pair_input, 1, rail.)            \
    OF_LOAD(M, load, "load.", wr_surface_load, 1, )

/* Numbers that are no members, and members of arrays: N(argument, name, kind, low, high). */
#define MOST_NODES 100000
#define NUMBERS(N)                                                                                        \
    N(mu, "mu", REAL, 0.0, 1e6) N(speed, "speed", REAL, 0.0, INFINITY) N(load, "load", REAL, 0.0, INFINITY) \
    N(n_wheel, "n_wheel", WHOLE, 4, MOST_NODES) N(n_rail, "n_rail", WHOLE, 4, MOST_NODES)                 \
    N(which_forces, "which", WHOLE, WR_FORCE_X, WR_FORCE_X + WR_FORCE_Y)                                  \
    N(body, "body", WHOLE, WR_BODY_RAIL, WR_BODY_WHEEL) N(poisson, "poisson_ratio", REAL, 0.0, 0.5)       \
    N(sep_A, "separation.A", REAL, WR_LEAST_CURVATURE, WR_LARGEST_CURVATURE)                              \
    N(sep_y, "separation.y", REAL, -WR_LARGEST_LENGTH, WR_LARGEST_LENGTH)                                 \
    N(sep_g, "separation.g", REAL, -WR_LARGEST_LENGTH, WR_LARGEST_LENGTH)                                 \
    N(sep_x_c, "separation.x_c", REAL, -WR_LARGEST_LENGTH, WR_LARGEST_LENGTH)                             \
    N(sep_tilt, "separation.tilt", REAL, -WR_LARGEST_TILT, WR_LARGEST_TILT)                               \
    N(z, "z", REAL, 0.0, INFINITY) N(force_x, "Fx", REAL, -INFINITY, INFINITY)                            \
    N(force_y, "Fy", REAL, -INFINITY, INFINITY)

/* Other arguments. */
#define ARGUMENTS(X)                                                                                                 \
    X(memory, "memory") X(bytes, "bytes") X(options, "options") X(result, "result") X(separation, "separation")      \
    X(n, "n") X(sep_n, "separation.n") X(problem, "case") X(jacobian, "jacobian")                                    \
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
#define M(member, kind, low, high, usual, group, text, type, sized, place) A_##group##_##member,
       MEMBERS(M)
#undef M
       A_end };

#endif
