/* Checks of the structs that one patch and a wheel on a rail share. */
#include <math.h>

#include "internal.h"

int wri_check_contact_options(const wr_contact_options *o) {
    TRY(aligned(o, A_options));
    if (o->size != (int64_t)sizeof *o) return bad(A_options, R_STRUCT);
    return wri_check_members(o, A_options_normal, A_options_pressure_limit);
}

int wri_check_pair_options(const wr_pair_options *o) {
    TRY(aligned(o, A_options));
    if (o->size != (int64_t)sizeof *o) return bad(A_options, R_STRUCT);
    if (o->patch.size != (int64_t)sizeof o->patch) return bad(A_options, R_STRUCT);
    TRY(wri_check_members(o, A_patch_normal, A_pair_reference_speed));
    return wri_check_damage(&o->damage, o, A_damage_speed);
}

/* Methods, material and friction of a case.  `of` is the struct that has it, and `first` the argument of its first member. */
int wri_check_surface(const wr_case *c, const wr_contact_options *o, const void *of, int first) {
#define ARGUMENT_OF(member) (first + A_case_##member - A_case_normal)
    if (c->normal != o->normal) return bad(ARGUMENT_OF(normal), R_DIFFERS);
    if (c->normal_family != wri_normal_method(o->normal)->family) return bad(ARGUMENT_OF(normal_family), R_FAMILY);
    TRY(wri_check_members(of, first, ARGUMENT_OF(conformal)));
    if (c->tangential_family != wri_tangential_method(c->tangential)->family)
        return bad(ARGUMENT_OF(tangential_family), R_FAMILY);
    return c->nu != o->poisson_ratio ? bad(ARGUMENT_OF(nu), R_DIFFERS) : 0;
#undef ARGUMENT_OF
}

/* `of` is the struct that has the parameters. */
int wri_check_damage(const wr_damage_parameters *p, const void *of, int first) {
    TRY(wri_check_members(of, first, first + A_parameters_wear_law - A_parameters_speed));
    const double *all[] = {p->pearce_sherratt, p->burstow, p->usfd, p->archard};
    const size_t n[] = {COUNT(p->pearce_sherratt), COUNT(p->burstow), COUNT(p->usfd), COUNT(p->archard)};
    for (size_t j = 0; j < 4; j++)
        for (size_t i = 0; i < n[j]; i++)
            if (isnan(all[j][i])) return bad(A_p_constants, R_NOT_FINITE);
    return 0;
}

int wri_check_fields(const wr_fields *f) {
    TRY(aligned(f, A_fields));
    if (f->size != (int64_t)sizeof *f) return bad(A_fields, R_STRUCT);
    double *to[] = {f->x, f->y, f->p, f->qx, f->qy, f->sx, f->sy, f->stick};
    for (size_t j = 0; j < COUNT(to); j++)
        if ((uintptr_t)to[j] % 8) return bad(A_fields, R_ALIGNED);
    return among(f->n_strips_most, 0, INT64_MAX, A_n_strips_most);
}

int wri_check_answer_struct(const wr_pair_answer *answer) {
    TRY(aligned(answer, A_answer));
    return answer->size == (int64_t)sizeof *answer ? 0 : bad(A_answer, R_STRUCT);
}
