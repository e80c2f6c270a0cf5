/* MEX: force = wheel_on_rail(wheel, rail, pose, mu, speed, load), for Octave and MATLAB.
 * wheel, rail: n x 2 with columns y, z [m]; pose: [y z roll yaw]; force: [Fx Fy Fz Mx My Mz]. */
#include "mex.h"
#include "wheelrail.h"

static void stop_at(int code) {
    if (code < 0) mexErrMsgIdAndTxt("wheelrail:argument", "%s: %s", wr_argument(code), wr_message(code));
}

void mexFunction(int n_out, mxArray *out[], int n_in, const mxArray *in[]) {
    const int sizes[] = {0, 0, 4, 1, 1, 1};
    wr_pair_options options;
    wr_pair_input input;
    wr_pair_answer answer = {.size = sizeof answer};
    size_t bytes;
    (void)n_out;
    if (n_in != 6) mexErrMsgIdAndTxt("wheelrail:argument", "wheel, rail, pose, mu, speed, load are needed");
    for (int i = 0; i < 6; i++)
        if (!mxIsDouble(in[i]) || mxIsComplex(in[i]) || (sizes[i] ? (int)mxGetNumberOfElements(in[i]) != sizes[i] : mxGetN(in[i]) != 2))
            mexErrMsgIdAndTxt("wheelrail:argument", "argument %d has a wrong type or size", i + 1);
    wr_profile wheel = {(int64_t)mxGetM(in[0]), mxGetPr(in[0]), mxGetPr(in[0]) + mxGetM(in[0]), NULL};
    wr_profile rail = {(int64_t)mxGetM(in[1]), mxGetPr(in[1]), mxGetPr(in[1]) + mxGetM(in[1]), NULL};
    const double *pose = mxGetPr(in[2]);
    if (wr_abi() != WR_ABI) mexErrMsgIdAndTxt("wheelrail:abi", "header and library are of different versions");
    stop_at(wr_pair_default(&options));
    stop_at(wr_pair_size(&options, wheel.n, rail.n, &bytes));
    mxArray *block = mxCreateDoubleMatrix(bytes / 8, 1, mxREAL);
    stop_at(wr_pair_init(&options, &wheel, &rail, mxGetPr(block), bytes));
    stop_at(wr_pair_input_default(&options, mxGetScalar(in[3]), mxGetScalar(in[4]), mxGetScalar(in[5]), &input));
    input.motion.y = pose[0], input.motion.z = pose[1], input.motion.roll = pose[2], input.motion.yaw = pose[3];
    stop_at(wr_pair_solve(mxGetPr(block), &input, &answer));
    const wr_total *t = &answer.total;
    const double made[] = {t->Fx, t->Fy, t->Fz, t->Mx, t->My, t->Mz};
    out[0] = mxCreateDoubleMatrix(1, 6, mxREAL);
    for (int i = 0; i < 6; i++) mxGetPr(out[0])[i] = made[i];
    mxDestroyArray(block);
}
