/* Names of arguments, and the ranges of those that are numbers.
 *
 * A range stands here and nowhere else: the checks and wr_explain read it. */
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

/* Lists of members, M(member, kind, low, high, ...). */
#define OF_CONTACT_OPTIONS(M, least, most, ...)                                                               \
    M(normal, WHOLE, 0, N_NORMAL - 1, __VA_ARGS__) M(tangential, WHOLE, 0, N_TANGENTIAL - 1, __VA_ARGS__) \
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
    M(tangential_family, ANY, 0, 0, __VA_ARGS__) M(tangential, WHOLE, 0, N_TANGENTIAL - 1, __VA_ARGS__)  \
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

#endif
