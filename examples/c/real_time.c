/* A wheelset in real time: replay the motion of a wheelset, both wheels at every step, and tell the times.
 *
 * gcc -O2 real_time.c -Icontact/include -L. -lwheelrail -lm
 * ./a.out MOTION WHEEL RAIL ANSWERS TIMES STEPS PERIOD_US CAP NORMAL TANGENTIAL STRIPS
 *
 * MOTION holds records wr_motion, right and left wheel of each step; WHEEL and RAIL hold the rows y, z, angle of a profile.
 * PERIOD_US 0: as fast as possible.  Otherwise every step waits for its turn, and one that ends after the next turn is a miss;
 * the process then asks for the first place (SCHED_FIFO) and for pages that stay in memory.
 * CAP: max_iterations.  NORMAL, TANGENTIAL: names of methods.  STRIPS: of a patch, and elements of a strip.
 * ANSWERS gets Fx, Fy, Fz, patches and status of every wheel of the first turn through MOTION.  TIMES gets two times [ns] of
 * every step: by the clock, and of the processor.  `python -m benchmarks.real_time` makes the files. */
#define _GNU_SOURCE
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
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

static int64_t now(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return 1000000000LL * t.tv_sec + t.tv_nsec;
}

/* Ask for the first place on a core, and for memory that is never written to a disk. */
static const char *urgent(void) {
    struct sched_param first = {.sched_priority = 50};
    int refused = sched_setscheduler(0, SCHED_FIFO, &first);
    refused |= mlockall(MCL_CURRENT | MCL_FUTURE);
    return refused ? "refused" : "granted";
}

int main(int argc, char **argv) {
    if (argc != 12) { fprintf(stderr, "MOTION WHEEL RAIL ANSWERS TIMES STEPS PERIOD_US CAP NORMAL TANGENTIAL STRIPS\n"); return 2; }
    size_t n_motion, n_wheel, n_rail, bytes;
    const wr_motion *motions = (const wr_motion *)read_all(argv[1], &n_motion);
    double *wheel_rows = read_all(argv[2], &n_wheel), *rail_rows = read_all(argv[3], &n_rail);
    size_t recorded = n_motion * sizeof(double) / sizeof(wr_motion) / 2, nw = n_wheel / 3, nr = n_rail / 3;
    long steps = atol(argv[6]), misses = 0;
    int64_t period = 1000LL * atol(argv[7]), cap = atol(argv[8]), (*taken)[2] = calloc((size_t)steps, sizeof *taken);
    int64_t normal = wr_method_number("normal", argv[9]), tangential = wr_method_number("tangential", argv[10]);
    wr_profile wheel = {(int64_t)nw, wheel_rows, wheel_rows + nw, wheel_rows + 2 * nw};
    wr_profile rail = {(int64_t)nr, rail_rows, rail_rows + nr, rail_rows + 2 * nr};
    void *memory[2];
    wr_pair_input input[2];
    wr_pair_answer answer = {.size = sizeof answer};
    double(*answers)[5] = calloc(2 * recorded, sizeof *answers);
    FILE *answers_file = fopen(argv[4], "wb"), *times_file = fopen(argv[5], "wb");
    int code;
    if (!answers_file || !times_file || !taken || !answers || wr_abi() != WR_ABI) return 2;
    for (int side = 0; side < 2; side++) {
        wr_pair_options options;
        TRY(wr_pair_default(&options))
        options.side = side ? -options.side : options.side;
        options.patch.max_iterations = cap;
        options.patch.normal = normal;
        options.patch.tangential = tangential;
        options.patch.n_strips = options.patch.n_elements = atol(argv[11]);
        TRY(wr_pair_size(&options, (int64_t)nw, (int64_t)nr, &bytes))
        memory[side] = malloc(bytes);
        TRY(wr_pair_init(&options, &wheel, &rail, memory[side], bytes))
        TRY(wr_pair_input_default(&options, 0.3, 20.0, 50e3, &input[side]))
        input[side].height = WR_HEIGHT_GIVEN;
    }
    const char *place = period ? urgent() : "not asked for";
    int64_t turn = now(CLOCK_MONOTONIC) + period;
    for (long k = 0; k < steps; k++) {
        if (period) {
            struct timespec at = {turn / 1000000000LL, turn % 1000000000LL};
            clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL);
        }
        size_t row = 2 * ((size_t)k % recorded);
        int64_t begin = now(CLOCK_MONOTONIC), worked = now(CLOCK_THREAD_CPUTIME_ID);
        for (size_t side = 0; side < 2; side++) {
            input[side].motion = motions[row + side];
            TRY(wr_pair_solve(memory[side], &input[side], &answer))
            if ((size_t)k < recorded) {
                double found[5] = {answer.total.Fx, answer.total.Fy, answer.total.Fz, (double)answer.total.n_patches, code};
                for (int i = 0; i < 5; i++) answers[row + side][i] = found[i];
            }
            TRY(wr_pair_accept(memory[side]))
        }
        taken[k][1] = now(CLOCK_THREAD_CPUTIME_ID) - worked;
        int64_t end = now(CLOCK_MONOTONIC);
        taken[k][0] = end - begin;
        if (period) {
            if (end > turn + period) {
                misses++;
                while (turn + period < end) turn += period; /* the turns that are lost */
            }
            turn += period;
        }
    }
    fwrite(answers, sizeof *answers, 2 * ((size_t)steps < recorded ? (size_t)steps : recorded), answers_file);
    fwrite(taken, sizeof *taken, (size_t)steps, times_file);
    if (fclose(answers_file) || fclose(times_file)) return 2;
    printf("%ld misses, first place %s\n", misses, place);
    return 0;
}
