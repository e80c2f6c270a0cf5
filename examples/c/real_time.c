/* A wheelset in real time: replay the motion of a wheelset, both wheels at every step, and tell the times.
 *
 * gcc -O2 real_time.c -Icontact/include -L. -lwheelrail -lm
 * ./a.out MOTION WHEEL RAIL FORCES STEPS PERIOD_US CAP
 *
 * MOTION holds records wr_motion, right and left wheel of each step; WHEEL and RAIL hold the rows y, z, angle of a profile.
 * PERIOD_US 0: as fast as possible.  Otherwise every step waits for its turn, and one that ends after the next turn is a miss.
 * CAP: max_iterations.  FORCES gets Fx, Fy, Fz of every wheel of the first turn through MOTION.  `python -m benchmarks.real_time`
 * makes the files. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "wheelrail.h"

#define TRY(call) if ((code = (call)) < 0) { fprintf(stderr, "%s: %s\n", wr_argument(code), wr_message(code)); return 1; }

static double *read_all(const char *path, size_t *count) {
    FILE *file = fopen(path, "rb");
    if (!file) { perror(path); exit(2); }
    fseek(file, 0, SEEK_END);
    *count = (size_t)ftell(file) / sizeof(double);
    rewind(file);
    double *numbers = malloc(*count * sizeof(double));
    if (fread(numbers, sizeof(double), *count, file) != *count) { perror(path); exit(2); }
    fclose(file);
    return numbers;
}

static int64_t now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1000000000LL * t.tv_sec + t.tv_nsec;
}

static int rising(const void *a, const void *b) {
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    if (argc != 8) { fprintf(stderr, "MOTION WHEEL RAIL FORCES STEPS PERIOD_US CAP\n"); return 2; }
    size_t n_motion, n_wheel, n_rail, bytes;
    const wr_motion *motions = (const wr_motion *)read_all(argv[1], &n_motion);
    double *wheel_rows = read_all(argv[2], &n_wheel), *rail_rows = read_all(argv[3], &n_rail);
    size_t recorded = n_motion * sizeof(double) / sizeof(wr_motion) / 2, nw = n_wheel / 3, nr = n_rail / 3;
    long steps = atol(argv[5]), misses = 0;
    int64_t period = 1000LL * atol(argv[6]), *taken = calloc((size_t)steps, sizeof(int64_t));
    wr_profile wheel = {(int64_t)nw, wheel_rows, wheel_rows + nw, wheel_rows + 2 * nw};
    wr_profile rail = {(int64_t)nr, rail_rows, rail_rows + nr, rail_rows + 2 * nr};
    void *memory[2];
    wr_pair_input input[2];
    wr_pair_answer answer = {.size = sizeof answer};
    FILE *forces = fopen(argv[4], "wb");
    int code;
    if (!forces || !taken || wr_abi() != WR_ABI) return 2;
    for (int side = 0; side < 2; side++) {
        wr_pair_options options;
        TRY(wr_pair_default(&options))
        options.side = side ? -options.side : options.side;
        options.patch.max_iterations = atol(argv[7]);
        TRY(wr_pair_size(&options, (int64_t)nw, (int64_t)nr, &bytes))
        memory[side] = malloc(bytes);
        TRY(wr_pair_init(&options, &wheel, &rail, memory[side], bytes))
        TRY(wr_pair_input_default(&options, 0.3, 20.0, 50e3, &input[side]))
        input[side].surface.max_iterations = atol(argv[7]);
        input[side].height = WR_HEIGHT_GIVEN;
    }
    int64_t turn = now() + period;
    for (long k = 0; k < steps; k++) {
        if (period) {
            struct timespec at = {turn / 1000000000LL, turn % 1000000000LL};
            clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL);
        }
        int64_t begin = now();
        for (int side = 0; side < 2; side++) {
            input[side].motion = motions[2 * ((size_t)k % recorded) + (size_t)side];
            TRY(wr_pair_solve(memory[side], &input[side], &answer))
            TRY(wr_pair_accept(memory[side]))
            if ((size_t)k < recorded) fwrite(&answer.total.Fx, sizeof(double), 3, forces);
        }
        int64_t end = now();
        taken[k] = end - begin;
        if (period) {
            if (end > turn + period) {
                misses++;
                while (turn + period < end) turn += period; /* the turns that are lost */
            }
            turn += period;
        }
    }
    fclose(forces);
    qsort(taken, (size_t)steps, sizeof *taken, rising);
    printf("steps %ld median %.1f us 99.9 %% %.1f us largest %.1f us misses %ld\n", steps, 1e-3 * taken[steps / 2],
           1e-3 * taken[(long)(0.999 * steps)], 1e-3 * taken[steps - 1], misses);
    return 0;
}
