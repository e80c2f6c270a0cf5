/* Get and set by value reference, and directional derivatives. */
#include <math.h>
#include <string.h>

#include "instance.h"

static fmi2Status no_such(const Instance *instance, fmi2ValueReference reference, const char *function)
{
    if (reference < N_VALUES)
        return report(instance, LOG_ERROR, "%s is not a variable for %s now", variables[reference].name, function);
    return report(instance, LOG_ERROR, "%s: there is no value reference %u", function, reference);
}

/* Whether all references are of these kinds and roles. */
static fmi2Status check(const Instance *instance, const fmi2ValueReference refs[], size_t n, int kinds, int roles,
                        const char *function)
{
    if (n > 0 && !refs) return report(instance, LOG_ERROR, "%s: no value references are given", function);
    for (size_t k = 0; k < n; k++)
        if (refs[k] >= N_VALUES || !(variables[refs[k]].kind & kinds) || !(variables[refs[k]].role & roles))
            return no_such(instance, refs[k], function);
    return fmi2OK;
}

/* Bring what is about to be read up to date; a host may read inputs and parameters at any time. */
static fmi2Status before_get(Instance *instance, const fmi2ValueReference refs[], size_t n, int kinds, const char *function)
{
    bool output = false, lazy = false;
    fmi2Status status;
    REQUIRE(instance, function, ANY & ~INSTANTIATED);
    status = check(instance, refs, n, kinds, PARAMETER | INPUT | ANY_OUTPUT, function);
    if (status != fmi2OK) return status;
    for (size_t k = 0; k < n; k++) {
        output |= variables[refs[k]].role & ANY_OUTPUT;
        lazy |= variables[refs[k]].lazy;
    }
    if (output && (instance->is.phase & (INITIALIZATION | EVENT | CONTINUOUS))) status = refresh(instance);
    if (lazy && status <= fmi2Warning) {
        fmi2Status later = update_lazy(instance);
        if (later > status) status = later;
    }
    return status;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference refs[], size_t n, fmi2Real values[])
{
    Instance *instance = c;
    fmi2Status status = before_get(instance, refs, n, REAL, "fmi2GetReal");
    if (status > fmi2Warning) return status;
    for (size_t k = 0; k < n; k++) values[k] = instance->is.values[refs[k]];
    return status;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference refs[], size_t n, fmi2Integer values[])
{
    Instance *instance = c;
    fmi2Status status = before_get(instance, refs, n, INTEGER | ENUMERATION, "fmi2GetInteger");
    if (status > fmi2Warning) return status;
    for (size_t k = 0; k < n; k++) values[k] = (fmi2Integer)instance->is.values[refs[k]];
    return status;
}

/* No table has Booleans or Strings. */
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference refs[], size_t n, fmi2Boolean values[])
{
    (void)values;
    return before_get(c, refs, n, 0, "fmi2GetBoolean");
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference refs[], size_t n, fmi2String values[])
{
    (void)values;
    return before_get(c, refs, n, 0, "fmi2GetString");
}

static fmi2Status before_set(Instance *instance, const fmi2ValueReference refs[], size_t n, int kinds, const char *function)
{
    int roles = INPUT;
    fmi2Status status;
    REQUIRE(instance, function, INSTANTIATED | INITIALIZATION | RUNNING);
    if (instance->is.phase & (INSTANTIATED | INITIALIZATION)) roles |= PARAMETER | TOTAL;
    status = check(instance, refs, n, kinds, roles, function);
    if (status == fmi2OK && n > 0) instance->is.is_new = true;
    return status;
}

/* Any value is taken; the next computation checks them all and names the one that it cannot do with. */
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference refs[], size_t n, const fmi2Real values[])
{
    Instance *instance = c;
    fmi2Status status = before_set(instance, refs, n, REAL, "fmi2SetReal");
    if (status != fmi2OK) return status;
    for (size_t k = 0; k < n; k++) instance->is.values[refs[k]] = values[k];
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference refs[], size_t n, const fmi2Integer values[])
{
    Instance *instance = c;
    fmi2Status status = before_set(instance, refs, n, INTEGER | ENUMERATION, "fmi2SetInteger");
    if (status != fmi2OK) return status;
    for (size_t k = 0; k < n; k++) instance->is.values[refs[k]] = values[k];
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference refs[], size_t n, const fmi2Boolean values[])
{
    (void)values;
    return before_set(c, refs, n, 0, "fmi2SetBoolean");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference refs[], size_t n, const fmi2String values[])
{
    (void)values;
    return before_set(c, refs, n, 0, "fmi2SetString");
}

/* `h`, or 0 if a step of this length along the seed leads out of the range of a known. */
static double reach(const double *values, const fmi2ValueReference knowns[], size_t n, const fmi2Real seed[], double h)
{
    for (size_t k = 0; k < n; k++)
        if (!in_range(&variables[knowns[k]], values[knowns[k]] + h * seed[k])) return 0.0;
    return h;
}

/* Values and outputs at a distance h along the seed. */
static void displaced(Instance *instance, const fmi2ValueReference knowns[], size_t n, const fmi2Real seed[], double h,
                            bool lazy, double *values)
{
    memcpy(values, instance->is.values, sizeof instance->is.values);
    for (size_t k = 0; k < n; k++) values[knowns[k]] += h * seed[k];
    memset(instance->work, 0, (size_t)instance->memory_size * sizeof(double));
    evaluate(instance, values, 0.0);
    if (lazy) instance->model->lazy(values, instance->work);
}

/* Outputs and derivatives by inputs and states (in initialisation by inputs and parameters), at the present values of
 * these: a central difference over steps that fit each variable, one-sided at the end of a range. In co-simulation too
 * outputs count as functions of the present inputs, as a step makes those of a model without states. */
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns, const fmi2Real seed[],
                                        fmi2Real result[])
{
    Instance *instance = c;
    double ahead[N_VALUES], behind[N_VALUES], up, down /* negative */, h = INFINITY;
    bool lazy = false;
    fmi2Status status;
    REQUIRE(instance, "fmi2GetDirectionalDerivative", INITIALIZATION | RUNNING | TERMINATED);
    status = check(instance, unknowns, n_unknowns, REAL, ANY_OUTPUT, "fmi2GetDirectionalDerivative");
    if (status == fmi2OK)
        status = check(instance, knowns, n_knowns, REAL, INPUT | (instance->is.phase == INITIALIZATION ? PARAMETER : STATE),
                       "fmi2GetDirectionalDerivative");
    if (status == fmi2OK) status = check_ranges(instance);
    if (status == fmi2OK) status = prepare(instance);
    if (status != fmi2OK) return status;

    memset(result, 0, n_unknowns * sizeof *result);
    for (size_t k = 0; k < n_unknowns; k++) lazy |= variables[unknowns[k]].lazy;
    displaced(instance, knowns, 0, seed, 0.0, false, ahead); /* steps fit the outputs at the present values */
    for (size_t k = 0; k < n_knowns; k++) {
        if (!isfinite(seed[k])) return report(instance, LOG_ERROR, "a seed of a directional derivative is not finite");
        if (seed[k] != 0.0) h = fmin(h, instance->model->difference(ahead, knowns[k]) / fabs(seed[k]));
    }
    if (isinf(h)) return fmi2OK;
    up = reach(instance->is.values, knowns, n_knowns, seed, h);
    down = reach(instance->is.values, knowns, n_knowns, seed, -h);
    if (up == down) return report(instance, LOG_DISCARD, "the directional derivative leads out of the allowed range");
    displaced(instance, knowns, n_knowns, seed, up, lazy, ahead);
    displaced(instance, knowns, n_knowns, seed, down, lazy, behind);
    for (size_t k = 0; k < n_unknowns; k++) {
        result[k] = (ahead[unknowns[k]] - behind[unknowns[k]]) / (up - down);
        if (!isfinite(result[k]))
            return report(instance, LOG_DISCARD, "%s has no finite derivative here", variables[unknowns[k]].name);
    }
    return fmi2OK;
}
