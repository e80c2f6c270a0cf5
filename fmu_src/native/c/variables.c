/* What may be read and set when, and directional derivatives. */
#include <math.h>
#include <string.h>

#include "instance.h"

static Status no_such(const Instance *instance, Reference reference, const char *function)
{
    if (reference < N_VALUES)
        return report(instance, LOG_ERROR, "%s is not a variable for %s now", variables[reference].name, function);
    return report(instance, LOG_ERROR, "%s: there is no value reference %u", function, reference);
}

/* Whether all references are of these kinds and roles. */
static Status check(const Instance *instance, const Reference refs[], size_t n, int kinds, int roles, const char *function)
{
    if (n > 0 && !refs) return report(instance, LOG_ERROR, "%s: no value references are given", function);
    for (size_t k = 0; k < n; k++)
        if (refs[k] >= N_VALUES || !(variables[refs[k]].kind & kinds) || !(variables[refs[k]].role & roles))
            return no_such(instance, refs[k], function);
    return OK;
}

/* Bring what is about to be read up to date; a host may read inputs and parameters at any time. */
Status before_get(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds)
{
    bool output = false, lazy = false;
    Status status;
    REQUIRE(instance, function, ANY & ~INSTANTIATED);
    status = check(instance, refs, n, kinds, PARAMETER | INPUT | ANY_OUTPUT, function);
    if (status != OK) return status;
    for (size_t k = 0; k < n; k++) {
        output |= variables[refs[k]].role & ANY_OUTPUT;
        lazy |= variables[refs[k]].lazy;
    }
    if (output && (instance->is.phase & (INITIALIZATION | EVENT | CONTINUOUS))) status = refresh(instance);
    if (lazy && status <= WARNING) {
        Status later = update_lazy(instance);
        if (later > status) status = later;
    }
    return status;
}

/* Any value is taken; the next computation checks them all and names the one that it cannot do with. */
Status before_set(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds)
{
    int roles = INPUT;
    Status status;
    REQUIRE(instance, function, INSTANTIATED | INITIALIZATION | RUNNING);
    if (instance->is.phase & (INSTANTIATED | INITIALIZATION)) roles |= PARAMETER | TOTAL;
    status = check(instance, refs, n, kinds, roles, function);
    if (status == OK && n > 0) instance->is.is_new = true;
    return status;
}

/* `h`, or 0 if a step of this length along the seed leads out of the range of a known. */
static double reach(const double *values, const double *seeds, double h)
{
    for (size_t i = 0; i < N_VALUES; i++)
        if (seeds[i] != 0.0 && !in_range(&variables[i], values[i] + h * seeds[i])) return 0.0;
    return h;
}

/* Values and outputs at a distance h along the seed. */
static void displaced(Instance *instance, const double *seeds, double h, bool lazy, double *values)
{
    for (size_t i = 0; i < N_VALUES; i++)
        values[i] = seeds[i] != 0.0 ? instance->is.values[i] + h * seeds[i] : instance->is.values[i];
    memset(instance->work, 0, (size_t)instance->memory_size * sizeof(double));
    evaluate(instance, values, 0.0);
    if (lazy) instance->model->lazy(values, instance->work);
}

/* Outputs and derivatives by inputs and states (in initialisation by inputs and parameters), at the present values of
 * these: a central difference over steps that fit each variable, one-sided at the end of a range. In co-simulation too
 * outputs count as functions of the present inputs, as a step makes those of a model without states. */
Status derivative(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
                  const Reference knowns[], size_t n_knowns, const double seed[], double result[])
{
    double seeds[N_VALUES] = {0.0}, ahead[N_VALUES], behind[N_VALUES], up, down /* negative */, h = INFINITY;
    bool lazy = false;
    Status status;
    REQUIRE(instance, function, INITIALIZATION | RUNNING | TERMINATED);
    status = check(instance, unknowns, n_unknowns, REAL, ANY_OUTPUT, function);
    if (status == OK)
        status = check(instance, knowns, n_knowns, REAL, INPUT | (instance->is.phase == INITIALIZATION ? PARAMETER : STATE),
                       function);
    if (status == OK) status = check_ranges(instance);
    if (status == OK) status = prepare(instance);
    if (status != OK) return status;

    for (size_t k = 0; k < n_knowns; k++) {
        if (!isfinite(seed[k])) return report(instance, LOG_ERROR, "a seed of a directional derivative is not finite");
        seeds[knowns[k]] += seed[k];
    }
    memset(result, 0, n_unknowns * sizeof *result);
    for (size_t k = 0; k < n_unknowns; k++) lazy |= variables[unknowns[k]].lazy;
    displaced(instance, seeds, 0.0, false, ahead); /* steps fit the outputs at the present values */
    for (size_t i = 0; i < N_VALUES; i++)
        if (seeds[i] != 0.0) h = fmin(h, instance->model->difference(ahead, (int64_t)i) / fabs(seeds[i]));
    if (isinf(h)) return OK;
    up = reach(instance->is.values, seeds, h);
    down = reach(instance->is.values, seeds, -h);
    if (up == down) return report(instance, LOG_DISCARD, "the directional derivative leads out of the allowed range");
    displaced(instance, seeds, up, lazy, ahead);
    displaced(instance, seeds, down, lazy, behind);
    for (size_t k = 0; k < n_unknowns; k++) {
        result[k] = (ahead[unknowns[k]] - behind[unknowns[k]]) / (up - down);
        if (!isfinite(result[k]))
            return report(instance, LOG_DISCARD, "%s has no finite derivative here", variables[unknowns[k]].name);
    }
    return OK;
}
