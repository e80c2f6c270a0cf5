/* An attacker's host: every function with every class of wrong argument.  It must get an error each time and never crash. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wheelrail.h"

static int failures;
#define REFUSED(call, name)                                                                     \
    do {                                                                                        \
        int code = (call);                                                                      \
        if (code >= 0 || strcmp(wr_argument(code), name) != 0) {                                \
            printf("%d: %s -> %d %s\n", __LINE__, #call, code, wr_argument(code)), failures++;  \
        }                                                                                       \
    } while (0)
#define FINE(call) do { int code = (call); if (code < 0) printf("%d: %s -> %s %s\n", __LINE__, #call, wr_argument(code), wr_message(code)), failures++; } while (0)
/* Change a member, expect a refusal, put it back. */
#define WITH(member, value, call, name) do { __typeof__(member) kept_ = member; member = value; REFUSED(call, name); member = kept_; } while (0)

enum { N = 61 };
static double y[N], g[N], A[N], wy[N], wz[N], ry[N], rz[N];

static void attack_contact(void) {
    wr_contact_options o;
    wr_case c;
    wr_result r;
    wr_separation s = {N, y, g, A, NULL, NULL};
    wr_damage d;
    wr_damage_parameters p;
    double jacobian[30], out[80 * 20];
    wr_fields f = {.size = sizeof f, .n_strips_most = 80, .x = out};
    size_t bytes;
    REFUSED(wr_contact_default(NULL), "options");
    FINE(wr_contact_default(&o));
    REFUSED(wr_contact_size(NULL, &bytes), "options");
    REFUSED(wr_contact_size(&o, NULL), "bytes");
    WITH(o.size, 0, wr_contact_size(&o, &bytes), "options");
    WITH(o.normal, 14, wr_contact_size(&o, &bytes), "options.normal");
    WITH(o.normal, INT64_MIN, wr_contact_size(&o, &bytes), "options.normal");
    WITH(o.tangential, 99, wr_contact_size(&o, &bytes), "options.tangential");
    WITH(o.n_strips, 3, wr_contact_size(&o, &bytes), "options.n_strips");
    WITH(o.n_strips, INT64_MAX, wr_contact_size(&o, &bytes), "options.n_strips");
    WITH(o.n_elements, -1, wr_contact_size(&o, &bytes), "options.n_elements");
    WITH(o.n_samples, 2, wr_contact_size(&o, &bytes), "options.n_samples");
    WITH(o.shear_modulus, NAN, wr_contact_size(&o, &bytes), "options.shear_modulus");
    WITH(o.shear_modulus, 0.0, wr_contact_size(&o, &bytes), "options.shear_modulus");
    WITH(o.poisson_ratio, 0.6, wr_contact_size(&o, &bytes), "options.poisson_ratio");
    WITH(o.pressure_limit, NAN, wr_contact_size(&o, &bytes), "options.pressure_limit");
    FINE(wr_contact_size(&o, &bytes));
    char *memory = malloc(bytes); /* exactly: the sanitizer sees one byte more */
    memset(memory, 0, bytes);
    REFUSED(wr_contact_init(&o, NULL, bytes), "memory");
    REFUSED(wr_contact_init(&o, memory + 1, bytes), "memory");
    REFUSED(wr_contact_init(&o, memory, bytes - 1), "bytes");
    REFUSED(wr_contact_solve(memory, &s, &c, &r), "memory");
    FINE(wr_contact_init(&o, memory, bytes));
    REFUSED(wr_contact_case(&o, -1.0, 20.0, &c), "mu");
    REFUSED(wr_contact_case(&o, 0.3, INFINITY, &c), "speed");
    REFUSED(wr_contact_case(&o, 0.3, 20.0, NULL), "case");
    FINE(wr_contact_case(&o, 0.3, 20.0, &c));
    c.amount = 80e3, c.vx = 1e-3;
    REFUSED(wr_contact_fields(memory, &f), "memory");
    REFUSED(wr_contact_accept(memory), "memory");
    REFUSED(wr_pair_accept(memory), "memory");
    REFUSED(wr_contact_solve(NULL, &s, &c, &r), "memory");
    REFUSED(wr_contact_solve(memory, NULL, &c, &r), "separation");
    REFUSED(wr_contact_solve(memory, &s, NULL, &r), "case");
    REFUSED(wr_contact_solve(memory, &s, &c, NULL), "result");
    WITH(s.n, 2, wr_contact_solve(memory, &s, &c, &r), "separation.n");
    WITH(s.n, 102, wr_contact_solve(memory, &s, &c, &r), "separation.n");
    WITH(s.y, NULL, wr_contact_solve(memory, &s, &c, &r), "separation.y");
    WITH(s.g, NULL, wr_contact_solve(memory, &s, &c, &r), "separation.g");
    WITH(s.A, NULL, wr_contact_solve(memory, &s, &c, &r), "separation.A");
    WITH(y[5], NAN, wr_contact_solve(memory, &s, &c, &r), "separation.y");
    WITH(y[5], y[4], wr_contact_solve(memory, &s, &c, &r), "separation.y");
    WITH(g[5], INFINITY, wr_contact_solve(memory, &s, &c, &r), "separation.g");
    WITH(A[5], 0.0, wr_contact_solve(memory, &s, &c, &r), "separation.A");
    /* every number of the case as NaN, every integer far out */
    for (size_t i = 0; i < sizeof c / 8; i++) {
        wr_case forged = c;
        double nan = NAN;
        int64_t far = INT64_MAX;
        memcpy((char *)&forged + 8 * i, &nan, 8);
        if (wr_contact_solve(memory, &s, &forged, &r) >= 0) printf("case member %zu: NaN accepted\n", i), failures++;
        memcpy((char *)&forged + 8 * i, &far, 8); /* as a double this is NaN too */
        if (wr_contact_solve(memory, &s, &forged, &r) >= 0) printf("case member %zu: far accepted\n", i), failures++;
    }
    REFUSED(wr_contact_doubts(NULL, &c), "separation");
    REFUSED(wr_contact_doubts(&s, NULL), "case");
    WITH(s.n, 0, wr_contact_doubts(&s, &c), "separation.n");
    WITH(s.y, NULL, wr_contact_doubts(&s, &c), "separation.y");
    WITH(s.A, NULL, wr_contact_doubts(&s, &c), "separation.A");
    if (wr_contact_doubts(&s, &c)) printf("a usual case is doubted\n"), failures++;
    WITH(c.amount, -1.0, wr_contact_solve(memory, &s, &c, &r), "case.amount");
    WITH(c.vx, 2e6, wr_contact_solve(memory, &s, &c, &r), "case.vx");
    WITH(c.nu, 0.3, wr_contact_solve(memory, &s, &c, &r), "case.nu");
    FINE(wr_contact_solve(memory, &s, &c, &r));
    wr_case under = c;
    REFUSED(wr_contact_solve_force(NULL, &s, 3, 1e3, 1e3, &under, &r), "memory");
    REFUSED(wr_contact_solve_force(memory, NULL, 3, 1e3, 1e3, &under, &r), "separation");
    REFUSED(wr_contact_solve_force(memory, &s, 0, 1e3, 1e3, &under, &r), "which");
    REFUSED(wr_contact_solve_force(memory, &s, 4, 1e3, 1e3, &under, &r), "which");
    REFUSED(wr_contact_solve_force(memory, &s, INT64_MIN, 1e3, 1e3, &under, &r), "which");
    REFUSED(wr_contact_solve_force(memory, &s, WR_FORCE_X, NAN, 1e3, &under, &r), "Fx");
    REFUSED(wr_contact_solve_force(memory, &s, 3, 1e3, -INFINITY, &under, &r), "Fy");
    REFUSED(wr_contact_solve_force(memory, &s, 3, 1e3, 1e3, NULL, &r), "case");
    REFUSED(wr_contact_solve_force(memory, &s, 3, 1e3, 1e3, &under, NULL), "result");
    WITH(under.mu, NAN, wr_contact_solve_force(memory, &s, 3, 1e3, 1e3, &under, &r), "case.mu");
    WITH(s.A, NULL, wr_contact_solve_force(memory, &s, 3, 1e3, 1e3, &under, &r), "separation.A");
    if (memcmp(&under, &c, sizeof c)) printf("a refused case has changed\n"), failures++;
    FINE(wr_contact_solve_force(memory, &s, WR_FORCE_Y, NAN, 1e3, &under, &r));
    for (int64_t which = 1; which <= 3; which++) { /* extreme forces, starts and gaps end in finite time */
        const double extreme[] = {0.0, 5e-324, 1.0, 1e300, -1.7e308};
        for (int i = 0; i < 25; i++) {
            under = c, under.vx = i % 2 ? WR_LARGEST_CREEPAGE : 0.0, under.mu = under.kinetic = i % 3 ? 0.3 : 0.0;
            FINE(wr_contact_solve_force(memory, &s, which, extreme[i / 5], extreme[i % 5], &under, &r));
            under = c, under.amount = i % 2 ? 0.0 : 1e15;
            FINE(wr_contact_solve_force(memory, &s, which, extreme[i / 5], extreme[i % 5], &under, &r));
        }
    }
    REFUSED(wr_contact_derivatives(memory, &s, &c, NULL), "jacobian");
    FINE(wr_contact_derivatives(memory, &s, &c, jacobian));
    REFUSED(wr_contact_fields(memory, NULL), "fields");
    WITH(f.size, 1, wr_contact_fields(memory, &f), "fields");
    WITH(f.n_strips_most, 19, wr_contact_fields(memory, &f), "fields.n_strips_most");
    FINE(wr_contact_fields(memory, &f));
    static double lx[8], ly[4], lp[32], lq[32], lr[32], px[3] = {0.0, 1e-3, 1e300}, pz[3] = {0.0, 1e-3, 1e300}, t[18];
    wr_surface_load l = {sizeof l, 8, 4, lx, ly, lp, lq, lr};
    REFUSED(wr_contact_surface_load(NULL, &l), "memory");
    REFUSED(wr_contact_surface_load(memory, NULL), "load");
    WITH(l.size, 3, wr_contact_surface_load(memory, &l), "load");
    WITH(l.nx, 3, wr_contact_surface_load(memory, &l), "load.nx");
    WITH(l.ny, INT64_MAX, wr_contact_surface_load(memory, &l), "load.ny");
    WITH(l.x, NULL, wr_contact_surface_load(memory, &l), "load.x");
    WITH(l.y, NULL, wr_contact_surface_load(memory, &l), "load.y");
    WITH(l.p, NULL, wr_contact_surface_load(memory, &l), "load.p");
    WITH(l.qx, NULL, wr_contact_surface_load(memory, &l), "load.qx");
    WITH(l.qy, (double *)((char *)lr + 1), wr_contact_surface_load(memory, &l), "load.qy");
    FINE(wr_contact_surface_load(memory, &l));
    wr_case none = c;
    none.amount = 0.0;
    FINE(wr_contact_solve(memory, &s, &none, &r));
    REFUSED(wr_contact_surface_load(memory, &l), "memory");
    FINE(wr_contact_solve(memory, &s, &c, &r));
    REFUSED(wr_stress(NULL, 0, 0.28, 3, px, px, pz, t), "load");
    REFUSED(wr_stress(&l, 2, 0.28, 3, px, px, pz, t), "body");
    REFUSED(wr_stress(&l, 0, 0.51, 3, px, px, pz, t), "poisson_ratio");
    REFUSED(wr_stress(&l, 0, 0.28, -1, px, px, pz, t), "n");
    REFUSED(wr_stress(&l, 0, 0.28, 3, NULL, px, pz, t), "x");
    REFUSED(wr_stress(&l, 0, 0.28, 3, px, NULL, pz, t), "y");
    REFUSED(wr_stress(&l, 0, 0.28, 3, px, px, NULL, t), "z");
    REFUSED(wr_stress(&l, 0, 0.28, 3, px, px, pz, NULL), "stress");
    WITH(px[1], NAN, wr_stress(&l, 0, 0.28, 3, px, pz, pz, t), "x");
    WITH(pz[1], -1e-9, wr_stress(&l, 0, 0.28, 3, px, px, pz, t), "z");
    WITH(lx[2], lx[3], wr_stress(&l, 0, 0.28, 3, px, px, pz, t), "load.x");
    WITH(ly[2], NAN, wr_stress(&l, 0, 0.28, 3, px, px, pz, t), "load.y");
    WITH(lp[31], NAN, wr_stress(&l, 0, 0.28, 3, px, px, pz, t), "load.p");
    WITH(lq[31], NAN, wr_stress(&l, 0, 0.28, 3, px, px, pz, t), "load.qx");
    WITH(lr[31], INFINITY, wr_stress(&l, 0, 0.28, 3, px, px, pz, t), "load.qy");
    FINE(wr_stress(&l, 1, 0.28, 3, px, px, pz, t));
    FINE(wr_damage_default(&p));
    REFUSED(wr_contact_damage(memory, NULL, &d), "parameters");
    REFUSED(wr_contact_damage(memory, &p, NULL), "damage");
    WITH(p.hardness, NAN, wr_contact_damage(memory, &p, &d), "parameters.hardness");
    WITH(p.wear_law, 7, wr_contact_damage(memory, &p, &d), "parameters.wear_law");
    FINE(wr_contact_damage(memory, &p, &d));
    int64_t which = 1, failed = -1;
    REFUSED(wr_contact_batch(memory, 1, &s, 1, &which, &c, &r, &failed), "which");
    REFUSED(wr_contact_batch(memory, 0, &s, 1, NULL, &c, &r, NULL), "n_separations");
    REFUSED(wr_contact_batch(memory, 1, &s, -1, NULL, &c, &r, NULL), "n");
    FINE(wr_contact_batch(memory, 1, &s, 1, NULL, &c, &r, NULL));
    for (size_t at = 0; at < 300; at++) { /* forged heads */
        memory[at] ^= 0x55;
        if (wr_contact_solve(memory, &s, &c, &r) >= 0 && at < 200) printf("forged byte %zu accepted\n", at), failures++;
        memory[at] ^= 0x55;
    }
    FINE(wr_contact_solve(memory, &s, &c, &r));
    for (size_t at = bytes - 8; at > bytes / 2; at -= 8) memset(memory + at, 0xFF, 8); /* scratch of NaN */
    wr_contact_solve(memory, &s, &c, &r);
    for (int64_t which = 1; which <= 3; which++) wr_contact_solve_force(memory, &s, which, 1e3, 1e3, &under, &r);
    memset(memory, 0, bytes);
    REFUSED(wr_contact_solve(memory, &s, &c, &r), "memory");
    REFUSED(wr_contact_accept(memory), "memory");
    REFUSED(wr_contact_forget(memory), "memory");
    free(memory);
}

static void attack_pair(void) {
    wr_pair_options o;
    wr_pair_input in;
    wr_pair_answer a = {.size = sizeof a};
    wr_profile wheel = {N, wy, wz, NULL}, rail = {N, ry, rz, NULL};
    wr_result r;
    double jacobian[6 * 17], bins[20];
    size_t bytes;
    REFUSED(wr_pair_default(NULL), "options");
    FINE(wr_pair_default(&o));
    WITH(o.side, 0, wr_pair_size(&o, N, N, &bytes), "options.side");
    WITH(o.wheel_radius, NAN, wr_pair_size(&o, N, N, &bytes), "options.wheel_radius");
    WITH(o.n_bins, INT64_MAX, wr_pair_size(&o, N, N, &bytes), "options.n_bins");
    WITH(o.bin_width, 0.0, wr_pair_size(&o, N, N, &bytes), "options.bin_width");
    REFUSED(wr_pair_size(&o, 3, N, &bytes), "n_wheel");
    REFUSED(wr_pair_size(&o, N, INT64_MAX, &bytes), "n_rail");
    REFUSED(wr_pair_size(&o, N, N, NULL), "bytes");
    FINE(wr_pair_size(&o, N, N, &bytes));
    char *memory = calloc(1, bytes);
    REFUSED(wr_pair_init(&o, NULL, &rail, memory, bytes), "wheel");
    REFUSED(wr_pair_init(&o, &wheel, NULL, memory, bytes), "rail");
    REFUSED(wr_pair_init(&o, &wheel, &rail, NULL, bytes), "memory");
    REFUSED(wr_pair_init(&o, &wheel, &rail, memory, bytes - 8), "bytes");
    WITH(wheel.y, NULL, wr_pair_init(&o, &wheel, &rail, memory, bytes), "wheel.y");
    WITH(rz[3], NAN, wr_pair_init(&o, &wheel, &rail, memory, bytes), "rail.z");
    WITH(o.gauge_point, 1.0, wr_pair_init(&o, &wheel, &rail, memory, bytes), "options.gauge_point");
    REFUSED(wr_pair_forget(memory), "memory");
    double junk[64] = {2.0, 2.0, 1.0};
    wr_surface of_wheel = {64, junk}, of_rail = {64, junk};
    REFUSED(wr_pair_size_surfaces(NULL, &of_wheel, &of_rail, &bytes), "options");
    REFUSED(wr_pair_size_surfaces(&o, NULL, &of_rail, &bytes), "wheel");
    WITH(of_wheel.n, -1, wr_pair_size_surfaces(&o, &of_wheel, &of_rail, &bytes), "wheel.n");
    WITH(of_wheel.numbers, NULL, wr_pair_size_surfaces(&o, &of_wheel, &of_rail, &bytes), "wheel.numbers");
    REFUSED(wr_pair_size_surfaces(&o, &of_wheel, &of_rail, &bytes), "wheel.numbers");
    WITH(junk[0], NAN, wr_pair_init_surfaces(&o, &of_wheel, &of_rail, memory, bytes), "wheel.numbers");
    WITH(junk[0], 1e300, wr_pair_init_surfaces(&o, &of_wheel, &of_rail, memory, bytes), "wheel.numbers");
    WITH(o.n_bins, 3, wr_pair_size_surfaces(&o, &of_wheel, &of_rail, &bytes), "options.n_bins");
    WITH(o.reach, 1.0, wr_pair_size_surfaces(&o, &of_wheel, &of_rail, &bytes), "options.reach");
    REFUSED(wr_pair_forget(memory), "memory");
    FINE(wr_pair_init(&o, &wheel, &rail, memory, bytes));
    REFUSED(wr_pair_input_default(&o, NAN, 20.0, 8e4, &in), "mu");
    REFUSED(wr_pair_input_default(&o, 0.3, 20.0, -1.0, &in), "load");
    FINE(wr_pair_input_default(&o, 0.3, 20.0, 8e4, &in));
    REFUSED(wr_pair_accept(memory), "memory");
    REFUSED(wr_pair_patch(memory, 0, &r, NULL), "memory");
    REFUSED(wr_pair_solve(memory, NULL, &a), "input");
    REFUSED(wr_pair_solve(memory, &in, NULL), "answer");
    WITH(a.size, 3, wr_pair_solve(memory, &in, &a), "answer");
    WITH(in.size, 3, wr_pair_solve(memory, &in, &a), "input");
    WITH(in.height, 4, wr_pair_solve(memory, &in, &a), "input.height");
    WITH(in.amount, NAN, wr_pair_solve(memory, &in, &a), "input.amount");
    WITH(in.motion.yaw, 0.2, wr_pair_solve(memory, &in, &a), "input.motion.yaw");
    WITH(in.motion.y, NAN, wr_pair_solve(memory, &in, &a), "input.motion.y");
    WITH(in.motion.y, 1.0, wr_pair_solve(memory, &in, &a), "input.motion");
    WITH(in.rail.ky, -1.0, wr_pair_solve(memory, &in, &a), "input.rail.ky");
    WITH(in.offset.x, INFINITY, wr_pair_solve(memory, &in, &a), "input.offset.x");
    WITH(in.station, NAN, wr_pair_solve(memory, &in, &a), "input.station");
    WITH(in.rotation, 1e9, wr_pair_solve(memory, &in, &a), "input.rotation");
    WITH(in.distance, -1.0, wr_pair_solve(memory, &in, &a), "input.distance");
    WITH(in.surface.mu, NAN, wr_pair_solve(memory, &in, &a), "input.surface.mu");
    REFUSED(wr_pair_doubts(NULL, &in), "options");
    REFUSED(wr_pair_doubts(&o, NULL), "input");
    WITH(in.size, 3, wr_pair_doubts(&o, &in), "input");
    WITH(o.wheel_radius, NAN, wr_pair_doubts(&o, &in), "options.wheel_radius");
    /* every number as NaN, which is no doubt and does no harm */
    for (size_t i = 1; i < sizeof in / 8; i++) {
        wr_pair_input forged = in;
        double nan = NAN;
        memcpy((char *)&forged + 8 * i, &nan, 8);
        if (wr_pair_doubts(&o, &forged) < 0) failures++;
    }
    REFUSED(wr_pair_answer_doubts(NULL, &a), "options");
    REFUSED(wr_pair_answer_doubts(&o, NULL), "answer");
    WITH(a.size, 3, wr_pair_answer_doubts(&o, &a), "answer");
    WITH(o.patch.normal, 1000, wr_pair_answer_doubts(&o, &a), "options.patch.normal");
    REFUSED(wr_contact_answer_doubts(NULL, &r), "options");
    REFUSED(wr_contact_answer_doubts(&o.patch, NULL), "result");
    in.motion.vx = 40.0; /* its spin belongs to 20 m/s */
    if (wr_pair_doubts(&o, &in) != WR_DOUBT_SLIP) printf("a spin is not doubted\n"), failures++;
    in.motion.vx = 20.0;
    FINE(wr_pair_solve(memory, &in, &a));
    REFUSED(wr_pair_patch(memory, 4, &r, NULL), "k");
    REFUSED(wr_pair_patch(memory, -1, &r, NULL), "k");
    FINE(wr_pair_patch(memory, 0, &r, NULL));
    static double lx[4], ly[4], lp[16], lq[16], lr[16];
    wr_surface_load l = {sizeof l, 4, 4, lx, ly, lp, lq, lr};
    REFUSED(wr_pair_surface_load(NULL, 0, &l), "memory");
    REFUSED(wr_pair_surface_load(memory, 4, &l), "k");
    REFUSED(wr_pair_surface_load(memory, INT64_MIN, &l), "k");
    REFUSED(wr_pair_surface_load(memory, 0, NULL), "load");
    WITH(l.ny, 1001, wr_pair_surface_load(memory, 0, &l), "load.ny");
    FINE(wr_pair_surface_load(memory, 0, &l));
    REFUSED(wr_pair_derivatives(memory, &in, NULL), "jacobian");
    FINE(wr_pair_derivatives(memory, &in, jacobian));
    REFUSED(wr_pair_bins(memory, NULL, 0), "bins");
    FINE(wr_pair_bins(memory, bins, 0));
    FINE(wr_pair_accept(memory));
    memset(memory, 0, bytes);
    REFUSED(wr_pair_solve(memory, &in, &a), "memory");
    free(memory);
}

int main(void) {
    for (int i = 0; i < N; i++) {
        y[i] = -0.012 + 0.0004 * i, g[i] = 0.8 * y[i] * y[i], A[i] = 1.1;
        wy[i] = -0.030 + 0.001 * i, wz[i] = -0.05 * wy[i];
        double angle = (i - 30) / 30.0 * 1.3;
        ry[i] = 0.03 * sin(angle), rz[i] = 0.03 * (1.0 - cos(angle));
    }
    attack_contact();
    attack_pair();
    char line[200];
    wr_contact_options o;
    FINE(wr_contact_default(&o));
    for (int code = -30000; code < 100; code++) {
        if (wr_message(code) == NULL || wr_argument(code) == NULL || wr_doubt(code) == NULL) failures++;
        FINE(wr_explain(code, NULL, line, sizeof line));
        if (strncmp(wr_argument(code), "options.", 8) == 0) FINE(wr_explain(code, &o, line, sizeof line));
    }
    REFUSED(wr_explain(-203, NULL, NULL, 3), "text");
    REFUSED(wr_explain(-203, NULL, line, 0), "bytes");
    REFUSED(wr_explain(-203, NULL, line, 3), "bytes");
    REFUSED(wr_explain(-203, (char *)&o + 1, line, sizeof line), "given");
    if (strcmp(wr_doubt(0), "") || strcmp(wr_doubt(-1), "") || strcmp(wr_doubt(INT32_MIN), "")) failures++;
    if (wr_method_name("normal", 999) != NULL || wr_method_number(NULL, NULL) != -1) failures++;
    printf("%d failures\n", failures);
    return failures != 0;
}
