/* wheelrail.h with numbers and arrays only, for languages that do not read C structs.  Default methods and dimensions. */
#include "wheelrail.h"

int simple_pair_bytes(int64_t n_wheel, int64_t n_rail, size_t *bytes) {
    wr_pair_options o;
    int code = wr_abi() == WR_ABI ? wr_pair_default(&o) : -1;
    return code < 0 ? code : wr_pair_size(&o, n_wheel, n_rail, bytes);
}

int simple_pair_init(int64_t n_wheel, const double *wheel_y, const double *wheel_z, int64_t n_rail, const double *rail_y,
                     const double *rail_z, void *memory, size_t bytes) {
    wr_pair_options o;
    wr_profile wheel = {n_wheel, wheel_y, wheel_z, NULL}, rail = {n_rail, rail_y, rail_z, NULL};
    int code = wr_pair_default(&o);
    return code < 0 ? code : wr_pair_init(&o, &wheel, &rail, memory, bytes);
}

/* pose: y, z, roll, yaw; force: Fx, Fy, Fz, Mx, My, Mz.  The wheel carries `load` [N] by its normal forces. */
int simple_pair_solve(void *memory, double mu, double speed, double load, const double *pose, double *force) {
    wr_pair_options o;
    wr_pair_input in;
    wr_pair_answer a = {.size = sizeof a};
    int code = wr_pair_default(&o);
    if (code < 0 || (code = wr_pair_input_default(&o, mu, speed, load, &in)) < 0) return code;
    in.motion.y = pose[0], in.motion.z = pose[1], in.motion.roll = pose[2], in.motion.yaw = pose[3];
    code = wr_pair_solve(memory, &in, &a);
    if (code < 0) return code;
    const double made[] = {a.total.Fx, a.total.Fy, a.total.Fz, a.total.Mx, a.total.My, a.total.Mz};
    for (int i = 0; i < 6; i++) force[i] = made[i];
    return code;
}
