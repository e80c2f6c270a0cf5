/* wheelrail.h - wheel-rail contact: forces, pressures, slip and damage.  C99, C++.
 *
 * Units are SI: m, N, Pa, rad, s.  Forces act on the wheel.  x points forward, y to the right, z down.
 * The library has no global state.  It allocates no memory, opens no file and prints nothing.
 *
 * Use:   options -> size -> memory from the caller -> init -> solve, accept, solve, accept, ...
 *
 * solve   changes nothing that a later call sees.  An integrator may try a step as often as it wants.
 * accept  makes the last answer the start of the following solutions.
 * forget  lets the following solutions start from nothing.
 *
 * Without accept every solution starts from nothing and depends on its arguments alone.
 *
 * Memory: aligned to 8 bytes; to 64 bytes it is a little faster.  One block serves one thread at a time.  Any number of
 * blocks may be in use in any number of threads.  A block may be copied, for example to keep a state.
 *
 * Codes: every function returns an int.
 *    0            solved
 *    2, 3         answers too: the bodies do not touch; the whole patch slips (WR_STATUS_NO_CONTACT, _SATURATED)
 *    4, 5         an answer that cannot be trusted (WR_STATUS_OUT_OF_RANGE, _NOT_CONVERGED)
 *    6            no creepage up to 1 makes the given force (WR_STATUS_UNREACHABLE)
 *    below 0      an error.  wr_message(code) says which, wr_argument(code) names the argument.  Results are unchanged.
 */
#ifndef WHEELRAIL_H
#define WHEELRAIL_H
#include "wheelrail_records.h"

#if defined(_WIN32) && !defined(WR_STATIC)
#ifdef WR_BUILD
#define WR_API __declspec(dllexport)
#else
#define WR_API __declspec(dllimport)
#endif
#elif defined(WR_BUILD)
#define WR_API __attribute__((visibility("default")))
#else
#define WR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Number of this interface.  Compare it with wr_abi() before any other call. */
#define WR_ABI 1
WR_API int wr_abi(void);
WR_API const char *wr_version(void);

/* One English sentence for any code. */
WR_API const char *wr_message(int code);
/* Name of the argument that an error is about, for example "case.mu"; "" for codes that are no error. */
WR_API const char *wr_argument(int code);
/* Write one line about a code into the caller's text of this many bytes; 200 are enough.  An error about a number names it, its
 * value and its range: "input.motion.yaw = 0.2 is outside its allowed range [-0.1, 0.1]".
 * given: the struct that begins the name of the argument, as the refused function got it: wr_contact_options or wr_pair_options
 * for "options", wr_case for "case", wr_pair_input for "input", wr_damage_parameters for "parameters", wr_surface_load for
 * "load".  NULL: the line has no value. */
WR_API int wr_explain(int code, const void *given, char *text, size_t bytes);

/* Names of methods.  kind: "normal" or "tangential".  The name is NULL and the number -1 for an unknown method. */
WR_API const char *wr_method_name(const char *kind, int number);
WR_API int wr_method_number(const char *kind, const char *name);

/* ---------------------------------------------------------------- one patch, or several in one plane */

/* Undeformed gap between wheel and rail over the lateral coordinate of the contact plane. */
typedef struct {
    int64_t n;         /* number of samples, at least 3 */
    const double *y;   /* increasing by WR_LEAST_STEP at least [m]; y, g and x_c within WR_LARGEST_LENGTH */
    const double *g;   /* gap [m]; the approach is measured from g = 0 */
    const double *A;   /* half curvature along the rolling direction [1/m], WR_LEAST_CURVATURE to WR_LARGEST_CURVATURE */
    const double *x_c; /* longitudinal position of the least gap [m]; NULL: 0 */
    const double *tilt; /* slope of the bent surface within WR_LARGEST_TILT; NULL: 0 */
} wr_separation;

/* Arrays of the caller for fields, each of n_strips_most * n_elements numbers; NULL: not wanted.
 * Value k of strip i is [i * n_elements + k].  Element 0 is at the leading edge. */
typedef struct {
    int64_t size;          /* sizeof(wr_fields) */
    int64_t n_strips_most; /* strips for which the arrays have room; 4 * options.n_strips is always enough */
    int64_t n_strips;      /* out: strips of the answer */
    double *x, *y;         /* position [m] */
    double *p;             /* pressure [Pa] */
    double *qx, *qy;       /* traction on the wheel [Pa] */
    double *sx, *sy;       /* relative slip [-] */
    double *stick;         /* 1 where the element sticks, 0 where it slips */
} wr_fields;

WR_API int wr_contact_default(wr_contact_options *options);
WR_API int wr_contact_size(const wr_contact_options *options, size_t *bytes);
WR_API int wr_contact_init(const wr_contact_options *options, void *memory, size_t bytes);
/* Fill a case with the options, a constant coefficient of friction and the speed [m/s].  Then set load_kind, amount
 * (load [N] or approach [m]), vx, vy, phi; for a friction law its members too. */
WR_API int wr_contact_case(const wr_contact_options *options, double mu, double speed, wr_case *problem);
WR_API int wr_contact_solve(void *memory, const wr_separation *separation, const wr_case *problem, wr_result *result);
/* The creepages under a given force on the wheel [N].  which: WR_FORCE_X for Fx, WR_FORCE_Y for Fy, their sum for both; the
 * force that is not given is not read, and its creepage stays.  The search starts at vx, vy of the problem, which become the
 * answer.  The forces of the result are always those at these creepages. */
WR_API int wr_contact_solve_force(void *memory, const wr_separation *separation, int64_t which, double Fx, double Fy,
                                  wr_case *problem, wr_result *result);
WR_API int wr_contact_accept(void *memory);
WR_API int wr_contact_forget(void *memory);
/* Also a solution: the last answer is then that of this problem.  d(Fx, Fy, Mz, N, approach, power per metre)/
 * d(vx, vy, phi, amount, mu) as jacobian[6][5], row by row; to the side of larger values where a force has a kink.
 * `mu` scales the whole friction law: kinetic changes in the same ratio. */
WR_API int wr_contact_derivatives(void *memory, const wr_separation *separation, const wr_case *problem, double *jacobian);
/* Values that are allowed but that no wheel on a rail has, as from a wrong unit or sign: a sum of WR_DOUBT_..., 0 for none.
 * Arguments are not checked otherwise. */
WR_API int wr_contact_doubts(const wr_separation *separation, const wr_case *problem);
/* What is usual, for the first of these doubts; "" for none.  for (; doubts > 0; doubts &= doubts - 1) puts(wr_doubt(doubts)); */
WR_API const char *wr_doubt(int doubts);
/* The same of an answer: what strips leave out where the contact angle changes much over a patch, and a gap_error above the limit
 * of the method.  Unlike bodies are the caller's: G and nu are those of two alike, and what couples their normal and tangential
 * displacements is left out (forces up to 0.08 of friction times load). */
WR_API int wr_contact_answer_doubts(const wr_contact_options *options, const wr_result *result);
/* Fields of the last answer. */
WR_API int wr_contact_fields(const void *memory, wr_fields *fields);
/* Pressure and traction on equal rectangles, in arrays of the caller.  Element (i, j) is [i * nx + j]. */
typedef struct {
    int64_t size;        /* sizeof(wr_surface_load) */
    int64_t nx, ny;      /* 4 to 1000 elements */
    double *x, *y;       /* nx and ny centres, increasing in equal steps [m] */
    double *p, *qx, *qy; /* pressure and traction on the wheel [Pa] */
} wr_surface_load;

enum { WR_BODY_RAIL, WR_BODY_WHEEL };

/* Fill the arrays with the load of the last answer on nx * ny elements over its patches; 64 * 64 is usual. */
WR_API int wr_contact_surface_load(const void *memory, wr_surface_load *load);
/* Stresses xx, yy, zz, xy, xz, yz [Pa] of a half space at n points as stress[n][6]: x, y in the plane of the load, z the depth
 * below the surface, not negative [m].  Axes are those of the patch; its z points out of the wheel, into the rail. */
WR_API int wr_stress(const wr_surface_load *load, int64_t body, double poisson_ratio, int64_t n, const double *x,
                     const double *y, const double *z, double *stress);
/* Constants of the damage models for steel. */
WR_API int wr_damage_default(wr_damage_parameters *parameters);
/* Damage of the last answer, per metre rolled. */
WR_API int wr_contact_damage(void *memory, const wr_damage_parameters *parameters, wr_damage *damage);
/* Solve n cases, each from nothing, case i with separations[which[i]]; which NULL: all with the first.  Stops at the first
 * error; failed (or NULL) then is its number.  For several threads give each one its memory and its part of the arrays. */
WR_API int wr_contact_batch(void *memory, int64_t n_separations, const wr_separation *separations, int64_t n,
                            const int64_t *which, const wr_case *cases, wr_result *results, int64_t *failed);

/* ---------------------------------------------------------------- a wheel on a rail */

/* A profile in the convention of the right side, for either side: y is negative on the gauge side, where the flange lies, and
 * positive on the field side; z points down.  A wheel or a rail that is upside down and a mirrored wheel are refused.
 * Wheel: origin at the tape circle.  Rail: already inclined.  docs: profiles.md. */
typedef struct {
    int64_t n;           /* 3 to 100000 */
    const double *y;     /* [m] */
    const double *z;     /* [m], down */
    const double *angle; /* of the tangent [rad]; NULL: that of a cubic spline through the points */
} wr_profile;

/* A surface that changes along the track or around the wheel, for either side.  Python writes its numbers:
 * contact.geometry.surfaces.compiled.numbers.  docs: c_interface.md. */
typedef struct {
    int64_t n; /* at most 2000000 */
    const double *numbers;
} wr_surface;

/* A wr_pair_input (wheelrail_records.h) with vx < 0 rolls backwards: fields and strips of its patches are then those of its mirror
 * image in x. */
typedef struct {
    int64_t size;                     /* sizeof(wr_pair_answer), set by the caller */
    wr_total total;                   /* forces and moments in track coordinates, Y, Q, damage ... */
    wr_patch patches[WR_MAX_PATCHES]; /* the first total.n_patches of them */
    double deflection_y, deflection_z; /* of an elastic rail [m] */
} wr_pair_answer;

WR_API int wr_pair_default(wr_pair_options *options);
WR_API int wr_pair_size(const wr_pair_options *options, int64_t n_wheel, int64_t n_rail, size_t *bytes);
/* The profiles are copied. */
WR_API int wr_pair_init(const wr_pair_options *options, const wr_profile *wheel, const wr_profile *rail, void *memory,
                        size_t bytes);
/* The same for surfaces.  All functions below serve both.  Surfaces have no bins; gauge, gauge_point and
 * combine_angle are not used, since a rail's surface has its place. */
WR_API int wr_pair_size_surfaces(const wr_pair_options *options, const wr_surface *wheel, const wr_surface *rail,
                                 size_t *bytes);
WR_API int wr_pair_init_surfaces(const wr_pair_options *options, const wr_surface *wheel, const wr_surface *rail,
                                 void *memory, size_t bytes);
/* Steady rolling of a centred wheelset at this speed [m/s], negative to roll backwards, under a load [N] that the normal forces carry. */
WR_API int wr_pair_input_default(const wr_pair_options *options, double mu, double speed, double load,
                                 wr_pair_input *input);
/* As wr_contact_doubts, of pose, speed, spin, load, radius, friction and material.  A spin that does not belong to the speed is one. */
WR_API int wr_pair_doubts(const wr_pair_options *options, const wr_pair_input *input);
WR_API int wr_pair_answer_doubts(const wr_pair_options *options, const wr_pair_answer *answer);
WR_API int wr_pair_solve(void *memory, const wr_pair_input *input, wr_pair_answer *answer);
/* Also books the damage of the last answer, once.  Call wr_pair_patch before it. */
WR_API int wr_pair_accept(void *memory);
/* The bins stay. */
WR_API int wr_pair_forget(void *memory);
/* Also a solution, as wr_pair_solve: the last answer is then that of this input.  d(Fx, Fy, Fz, Mx, My, Mz)/d(members of
 * wr_motion in their order, amount) as jacobian[6][17], row by row.  Under a load or on springs, height and deflection
 * follow. */
WR_API int wr_pair_derivatives(void *memory, const wr_pair_input *input, double *jacobian);
/* Result and fields of patch k of the last answer, on the right side.  The patch is solved once more, from the last answer,
 * so the numbers agree with it within the tolerance of the method.  fields may be NULL. */
WR_API int wr_pair_patch(void *memory, int64_t k, wr_result *result, wr_fields *fields);
/* As wr_contact_surface_load, for patch k of the last answer, on the right side; solved once more, as by wr_pair_patch. */
WR_API int wr_pair_surface_load(void *memory, int64_t k, wr_surface_load *load);
/* Copy the bins that accept has booked: bins[2][WR_BIN_ROWS][n_bins], first the wheel's. */
WR_API int wr_pair_bins(const void *memory, double *bins, int64_t count);

#ifdef __cplusplus
}
#endif
#endif
