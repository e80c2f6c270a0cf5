/* A wheelset with the contacts inside an implicit integrator: the implicit midpoint rule and Newton's method.
 *
 * gcc implicit_wheelset.c -Icontact/include -L. -lwheelrail -lm
 * ./a.out STEP SECONDS [late]
 *
 * Cones 1:20 on round rails at 20 m/s, 2 mm beside the centre.  wr_pair_derivatives gives forces and Jacobian in one call.
 * With `late` the forces are those of the begin of the step instead, as between two programs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wheelrail.h"

#define TRY(call) if ((code = (call)) < 0) { fprintf(stderr, "%s: %s\n", wr_argument(code), wr_message(code)); exit(1); }

enum { N = 61, STATES = 9 }; /* y, z, roll, yaw, their rates, spin */
static const double SPEED = 20.0, RADIUS = 0.46, LOAD = 160e3, MASS[4] = {1800.0, 1800.0, 1000.0, 1000.0}, ABOUT_AXLE = 100.0;
static const double SPRING[4] = {2e6, 0.0, 4e6, 4e6}, DAMPER[4] = {2e4, 0.0, 2e4, 2e4};
static void *wheels[2];
static wr_pair_input input;

/* Rates of the states and, if wanted, their derivatives [STATES][STATES]. */
static void rates(const double *x, double *f, double *slopes) {
    double force[6] = {0}, by[6][STATES] = {{0}}, jacobian[6][17];
    int code;
    wr_motion *m = &input.motion; /* its first ten members are y, z, roll, yaw, vx, then the rates and the spin */
    m->y = x[0], m->z = x[1], m->roll = x[2], m->yaw = x[3], m->vx = SPEED;
    m->vy = x[4], m->vz = x[5], m->roll_rate = x[6], m->yaw_rate = x[7], m->spin = x[8];
    for (int side = 0; side < 2; side++) {
        wr_pair_answer answer = {.size = sizeof answer};
        TRY(wr_pair_solve(wheels[side], &input, &answer))
        for (int i = 0; i < 6; i++) force[i] += (&answer.total.Fx)[i];
        if (!slopes) continue;
        TRY(wr_pair_derivatives(wheels[side], &input, jacobian[0]))
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < STATES; j++) by[i][j] += jacobian[i][j < 4 ? j : j + 1];
    }
    const int row[4] = {1, 2, 3, 5};
    for (int i = 0; i < 4; i++) {
        f[i] = x[4 + i];
        f[4 + i] = (force[row[i]] - SPRING[i] * x[i] - DAMPER[i] * x[4 + i] + (i == 1 ? LOAD : 0.0)) / MASS[i];
    }
    f[8] = (force[4] - x[3] * force[3] + x[2] * force[5]) / ABOUT_AXLE; /* about the axle, direction (-yaw, 1, roll) */
    if (!slopes) return;
    memset(slopes, 0, STATES * STATES * sizeof *slopes);
    for (int i = 0; i < 4; i++) {
        slopes[STATES * i + 4 + i] = 1.0;
        for (int j = 0; j < STATES; j++) slopes[STATES * (4 + i) + j] = by[row[i]][j] / MASS[i];
        slopes[STATES * (4 + i) + i] -= SPRING[i] / MASS[i];
        slopes[STATES * (4 + i) + 4 + i] -= DAMPER[i] / MASS[i];
    }
    for (int j = 0; j < STATES; j++) slopes[STATES * 8 + j] = (by[4][j] - x[3] * by[3][j] + x[2] * by[5][j]) / ABOUT_AXLE;
    slopes[STATES * 8 + 3] -= force[3] / ABOUT_AXLE;
    slopes[STATES * 8 + 2] += force[5] / ABOUT_AXLE;
}

/* Solve A x = b by elimination with pivots; the answer is in b. */
static void eliminate(double A[STATES][STATES], double *b) {
    for (int k = 0; k < STATES; k++) {
        int best = k;
        for (int i = k + 1; i < STATES; i++) best = fabs(A[i][k]) > fabs(A[best][k]) ? i : best;
        for (int j = 0; j < STATES; j++) { double t = A[k][j]; A[k][j] = A[best][j], A[best][j] = t; }
        double t = b[k]; b[k] = b[best], b[best] = t;
        for (int i = k + 1; i < STATES; i++) {
            double factor = A[i][k] / A[k][k];
            for (int j = k; j < STATES; j++) A[i][j] -= factor * A[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (int k = STATES - 1; k >= 0; k--) {
        for (int j = k + 1; j < STATES; j++) b[k] -= A[k][j] * b[j];
        b[k] /= A[k][k];
    }
}

/* Take a step of the implicit midpoint rule.  Return how many solutions of the contacts it took. */
static int midpoint(double *x, double h) {
    double middle[STATES], f[STATES], slopes[STATES * STATES], A[STATES][STATES], change[STATES];
    memcpy(middle, x, sizeof middle);
    for (int iteration = 1; iteration <= 10; iteration++) {
        rates(middle, f, slopes);
        double largest = 0.0;
        for (int i = 0; i < STATES; i++) {
            change[i] = x[i] + 0.5 * h * f[i] - middle[i];
            for (int j = 0; j < STATES; j++) A[i][j] = (i == j) - 0.5 * h * slopes[STATES * i + j];
        }
        eliminate(A, change);
        for (int i = 0; i < STATES; i++) {
            middle[i] += change[i];
            largest = fmax(largest, fabs(change[i]) / (i < 4 ? 1e-3 : 1e-1));
        }
        if (largest < 1e-6 || iteration == 10) {
            for (int i = 0; i < STATES; i++) x[i] = 2.0 * middle[i] - x[i];
            return iteration;
        }
    }
    return 0;
}

int main(int argc, char **argv) {
    double wheel_y[N], wheel_z[N], rail_y[N], rail_z[N], x[STATES] = {0.002}, f[STATES];
    int code, solutions = 0, late = argc > 3;
    if (argc < 3 || wr_abi() != WR_ABI) return 2;
    for (int i = 0; i < N; i++) {
        wheel_y[i] = -0.030 + 0.001 * i, wheel_z[i] = -0.05 * wheel_y[i];
        double angle = (i - 30) / 30.0 * 0.12;
        rail_y[i] = 0.3 * sin(angle), rail_z[i] = 0.3 * (1.0 - cos(angle));
    }
    wr_pair_options options;
    wr_pair_answer answer = {.size = sizeof answer};
    wr_profile wheel = {N, wheel_y, wheel_z, NULL}, rail = {N, rail_y, rail_z, NULL};
    size_t bytes;
    for (int side = 0; side < 2; side++) {
        TRY(wr_pair_default(&options))
        options.side = side ? 1 : -1, options.wheel_radius = RADIUS, options.gauge_point = 0.0015;
        TRY(wr_pair_size(&options, N, N, &bytes))
        wheels[side] = aligned_alloc(64, (bytes + 63) / 64 * 64);
        TRY(wr_pair_init(&options, &wheel, &rail, wheels[side], bytes))
    }
    TRY(wr_pair_input_default(&options, 0.3, SPEED, 0.5 * LOAD, &input))
    TRY(wr_pair_solve(wheels[1], &input, &answer)) /* height under the load */
    const double height = x[1] = answer.total.z;
    x[8] = -SPEED / RADIUS;
    input.height = WR_HEIGHT_GIVEN;
    double h = atof(argv[1]);
    long steps = lround(atof(argv[2]) / h);
    for (long step = 0; step < steps; step++) {
        if (late) {
            rates(x, f, NULL);
            for (int i = 0; i < 4; i++) x[i] += h * x[4 + i] + 0.5 * h * h * f[4 + i];
            for (int i = 4; i < STATES; i++) x[i] += h * f[i];
            solutions++;
        } else {
            solutions += midpoint(x, h);
        }
        for (int side = 0; side < 2; side++) TRY(wr_pair_accept(wheels[side]))
        if (!(fabs(x[1] - height) < 5e-4)) { /* the wheels leave the rails */
            printf("gone after %.4f s\n", (double)(step + 1) * h);
            return 0;
        }
    }
    printf("y %.7e yaw %.7e solutions %d steps %ld\n", x[0], x[3], solutions, steps);
    return 0;
}
