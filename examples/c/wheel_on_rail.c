/* Forces of a wheel on a rail from two profile arrays and a pose.
 * gcc wheel_on_rail.c -Icontact/include -L. -lwheelrail -lm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "wheelrail.h"

#define TRY(call) if ((code = (call)) < 0) { fprintf(stderr, "%s: %s\n", wr_argument(code), wr_message(code)); return 1; }

int main(void) {
    enum { N = 61 };
    double wheel_y[N], wheel_z[N], rail_y[N], rail_z[N];
    int code;
    for (int i = 0; i < N; i++) { /* a cone 1:20 on an arc with a radius of 30 mm */
        wheel_y[i] = -0.030 + 0.001 * i, wheel_z[i] = -0.05 * wheel_y[i];
        double angle = (i - 30) / 30.0 * 1.3;
        rail_y[i] = 0.03 * sin(angle), rail_z[i] = 0.03 * (1.0 - cos(angle));
    }
    if (wr_abi() != WR_ABI) return 2;
    wr_pair_options options;
    wr_pair_input input;
    wr_pair_answer answer = {.size = sizeof answer};
    wr_profile wheel = {N, wheel_y, wheel_z, NULL}, rail = {N, rail_y, rail_z, NULL};
    size_t bytes;
    TRY(wr_pair_default(&options))
    TRY(wr_pair_size(&options, N, N, &bytes))
    void *memory = malloc(bytes);
    TRY(wr_pair_init(&options, &wheel, &rail, memory, bytes))
    TRY(wr_pair_input_default(&options, 0.3, 20.0, 80e3, &input)) /* mu, speed [m/s], load [N] */
    input.motion.y = 0.002, input.motion.yaw = 0.003;             /* pose of the wheelset [m], [rad] */
    for (int doubts = wr_pair_doubts(&options, &input); doubts > 0; doubts &= doubts - 1) /* a wrong unit or sign? */
        fprintf(stderr, "%s\n", wr_doubt(doubts));
    if ((code = wr_pair_solve(memory, &input, &answer)) < 0) { /* such as "input.motion.yaw = 0.2 is outside its ..." */
        char line[200];
        wr_explain(code, &input, line, sizeof line);
        fprintf(stderr, "%s\n", line);
        return 1;
    }
    for (int doubts = wr_pair_answer_doubts(&options, &answer); doubts > 0; doubts &= doubts - 1) /* what strips leave out */
        fprintf(stderr, "%s\n", wr_doubt(doubts));
    printf("%s: Fx %.3f Fy %.3f Fz %.3f N, largest pressure %.1f MPa\n", wr_message(code), answer.total.Fx,
           answer.total.Fy, answer.total.Fz, 1e-6 * answer.total.pmax);
    TRY(wr_pair_accept(memory)) /* the next step starts from here */
    free(memory);
    return 0;
}
