/* Values that are allowed but that no wheel on a rail has, and answers that leave something out.
 *
 * The rules are those of contact.inputs.plausibility, by way of wheelrail_records.h. */
#include <math.h>

#include "internal.h"

typedef struct {
    double largest, least;
    const char *text;
} Usual;

static const Usual USUAL[] = {
#define X(name, called, largest, least, hint) {largest, least, called ": " hint},
    WR_DOUBTS(X)
#undef X
};

enum {
#define X(name, called, largest, least, hint) U_##name,
    WR_DOUBTS(X)
#undef X
};

static int doubt(int usual, double value) {
    const double size = fabs(value);
    return size > USUAL[usual].largest || (size > 0.0 && size < USUAL[usual].least) ? 1 << usual : 0;
}

static int doubt_surface(const wr_case *c) {
    return doubt(U_FRICTION, c->mu) | doubt(U_SHEAR_MODULUS, c->G) | doubt(U_PRESSURE_LIMIT, c->pressure_limit);
}

const char *wr_doubt(int doubts) {
    for (size_t k = 0; k < COUNT(USUAL); k++)
        if (doubts > 0 && doubts >> k & 1) return USUAL[k].text;
    return "";
}

int wr_contact_doubts(const wr_separation *s, const wr_case *c) {
    TRY(aligned(s, A_separation));
    TRY(among(s->n, 3, INT64_MAX / 8, A_sep_n));
    TRY(aligned(s->y, A_sep_y));
    TRY(aligned(s->A, A_sep_A));
    TRY(aligned(c, A_problem));
    return doubt(c->load_kind == WR_BY_LOAD ? U_LOAD : U_APPROACH, c->amount) | doubt(U_CREEPAGE_LONGITUDINAL, c->vx) |
           doubt(U_CREEPAGE_LATERAL, c->vy) | doubt(U_CREEPAGE_SPIN, c->phi) | doubt(U_SPEED, c->speed) | doubt_surface(c) |
           doubt(U_A, s->A[s->n / 2]) | doubt(U_EXTENT_OF_Y, s->y[s->n - 1] - s->y[0]);
}

int wr_pair_doubts(const wr_pair_options *o, const wr_pair_input *in) {
    TRY(wri_check_pair_options(o));
    TRY(aligned(in, A_input));
    if (in->size != (int64_t)sizeof *in) return bad(A_input, R_STRUCT);
    const wr_motion *m = &in->motion;
    const int under_load = in->height == WR_HEIGHT_LOAD || in->height == WR_HEIGHT_VERTICAL;
    return doubt(U_POSE_Y, m->y) | doubt(U_POSE_ROLL, m->roll) | doubt(U_POSE_YAW, m->yaw) | doubt(U_SPEED, m->vx) |
           doubt(U_VELOCITY_Y, m->vy) | doubt(U_VELOCITY_Z, m->vz) | doubt(U_VELOCITY_ROLL, m->roll_rate) |
           doubt(U_VELOCITY_YAW, m->yaw_rate) |
           doubt(U_SLIP, fabs(m->vx) > WR_SLOWEST ? 1.0 + m->spin * o->wheel_radius / m->vx : 0.0) |
           doubt(U_WHEEL_LOAD, under_load ? in->amount : 0.0) | doubt(U_WHEEL_RADIUS, o->wheel_radius) |
           doubt_surface(&in->surface);
}

/* Doubts about an answer with this normal force and, of strips, with this largest change of the contact angle, this share of the
 * load beyond the table of creep forces, and this error of the gap. */
static int doubt_answer(const wr_contact_options *o, double N, double bend, double beyond, double gap_error) {
    const int interacting = wri_normal_method(o->normal)->interacting;
    return doubt(U_N, N) | doubt(U_BEND, bend) | doubt(U_BEYOND, beyond) |
           doubt(interacting ? U_GAP_ERROR_INTERACTING : U_GAP_ERROR, gap_error);
}

int wr_contact_answer_doubts(const wr_contact_options *o, const wr_result *result) {
    TRY(wri_check_contact_options(o));
    TRY(aligned(result, A_result));
    return doubt_answer(o, result->N, result->bend, result->beyond, result->gap_error);
}

int wr_pair_answer_doubts(const wr_pair_options *o, const wr_pair_answer *answer) {
    TRY(wri_check_pair_options(o));
    TRY(wri_check_answer_struct(answer));
    return doubt_answer(&o->patch, answer->total.Q, answer->total.bend, answer->total.beyond, answer->total.gap_error);
}
