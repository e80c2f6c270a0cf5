/* Reading and setting variables, the states in which this is legal, and directional derivatives. */
#include <math.h>
#include <string.h>

#include "instance.h"

/* Count of numbers that a value reference denotes. */
size_t extent(const Instance *instance, Reference reference)
{
    if (!instance->arrays) return 1;
    return instance->table.variables[reference].role == FIELD ? field_size(instance, instance->values)
                                                                : (size_t)instance->table.variables[reference].size;
}

/* Damage that has accumulated since the start. */
static const double *accumulated(const Instance *instance)
{
    const int64_t choice = instance->table.head->accumulates, n = (int64_t)N(accumulated);
    if (choice == NONE || instance->values[choice] <= 1.0 || instance->memory_size < n) return instance->nothing;
    return instance->memory + instance->memory_size - n;
}

/* The numbers in `values` or working memory that a value reference denotes. */
static const double *numbers_of(const Instance *instance, double *values, Reference reference)
{
    const int64_t field = (int64_t)(reference - N(values) - N(accumulated));
    if (instance->table.variables[reference].role == ACCUMULATED) return accumulated(instance) + (reference - N(values));
    if (instance->table.variables[reference].role != FIELD) return values + reference;
    return instance->work + instance->kernels->field(values, instance->work, field, instance->resources, instance->table.own);
}

/* The same for the instance's own values. `solved` holds the values that working memory belongs to. */
const double *numbers(const Instance *instance, Reference reference)
{
    if (instance->table.variables[reference].role == TIME) return &instance->is.time;
    return numbers_of(instance, (double *)(instance->table.variables[reference].role == FIELD ? instance->solved : instance->values),
                      reference);
}

static bool exists(const Instance *instance, Reference reference)
{
    if (!instance->arrays) return reference < N(values) + N(accumulated);
    return reference <= N(values) + N(accumulated) + N(fields) && (instance->table.variables[reference].size > 0 || instance->table.variables[reference].role == FIELD);
}

/* Check that all references have these kinds and roles and denote n_values numbers. */
static Status check(const Instance *instance, const Reference refs[], size_t n, int kinds, int roles, size_t n_values,
                    const char *function)
{
    size_t count = 0;
    if (n > 0 && !refs) return report(instance, LOG_ERROR, "%s: the value references are NULL", function);
    for (size_t k = 0; k < n; k++) {
        if (!exists(instance, refs[k]))
            return report(instance, LOG_ERROR, "%s: there is no value reference %u", function, refs[k]);
        if (!(instance->table.variables[refs[k]].kind & kinds) || !(instance->table.variables[refs[k]].role & roles))
            return report(instance, LOG_ERROR, "%s is not a variable for %s now", TEXT(instance->table.variables[refs[k]].name), function);
        count += extent(instance, refs[k]);
    }
    if (count == n_values) return OK;
    return report(instance, LOG_ERROR, "%s: %zu values are given, but the variables have %zu", function, n_values, count);
}

/* Update the variables before they are read. A host may read inputs and parameters at any time. */
Status before_get(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds, size_t n_values)
{
    int roles = PARAMETER | INPUT | TIME, read = 0;
    bool lazy = false;
    Status status, later = OK;
    REQUIRE(instance, function, instance->arrays ? ANY : ANY & ~INSTANTIATED);
    if (!(instance->is.phase & (INSTANTIATED | CONFIGURATION))) roles |= ANY_OUTPUT | FIELD;
    status = check(instance, refs, n, kinds, roles, n_values, function);
    if (status != OK) return status;
    for (size_t k = 0; k < n; k++) {
        read |= (int)instance->table.variables[refs[k]].role;
        lazy |= instance->table.variables[refs[k]].lazy != 0;
    }
    if (read & (ANY_OUTPUT | FIELD) && instance->is.phase & (INITIALIZATION | EVENT | CONTINUOUS))
        status = refresh(instance);
    if (lazy && status <= WARNING) later = update_lazy(instance);
    if (later <= WARNING && status <= WARNING && read & FIELD) later = update_work(instance);
    return later > status ? later : status;
}

/* Any value is accepted. The next computation checks all values and names one that it cannot use. */
Status before_set(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds, size_t n_values)
{
    int roles = INPUT;
    Status status;
    REQUIRE(instance, function, INSTANTIATED | CONFIGURATION | INITIALIZATION | RUNNING);
    if (instance->is.phase & (INSTANTIATED | INITIALIZATION)) roles |= PARAMETER | TOTAL;
    if (instance->is.phase & (EVENT | STEP_COMPLETE | STEP_FAILED)) roles |= TUNABLE;
    if (instance->is.phase & (EVENT | CONTINUOUS)) roles |= STATE; /* beyond the standard; CasADi sets states so */
    if (instance->arrays && n > 0 && (kinds == COUNT) != (instance->is.phase == CONFIGURATION))
        return report(instance, LOG_ERROR, "%s: only structural parameters are set, and only in configuration mode", function);
    if (instance->is.phase == CONFIGURATION) roles = PARAMETER;
    status = check(instance, refs, n, kinds, roles, n_values, function);
    if (status == OK && n > 0) instance->is.is_new = true;
    return status;
}

/* Return `h`, or 0 if a step of this length along the seed leaves the range of a known. */
static double reach(const Instance *instance, const double *seeds, double h)
{
    for (size_t i = 0; i < N(values); i++)
        if (seeds[i] != 0.0 && !in_range(&instance->table.variables[i], instance->values[i] + h * seeds[i])) return 0.0;
    return h;
}

/* Compute values and outputs at a distance h along the seed. */
static void displaced(Instance *instance, const double *seeds, double h, bool lazy, double *values)
{
    for (size_t i = 0; i < N(values); i++)
        values[i] = seeds[i] != 0.0 ? instance->values[i] + h * seeds[i] : instance->values[i];
    memset(instance->work, 0, (size_t)instance->memory_size * sizeof(double));
    instance->work_is_solved = false;
    evaluate(instance, values, 0.0);
    if (!lazy) return;
    instance->kernels->lazy(values, instance->work, instance->resources, instance->table.own);
    memset(instance->work, 0, (size_t)instance->memory_size * sizeof(double));
    evaluate(instance, values, 0.0); /* restores the fields, which the lazy outputs overwrite */
}

/* Directional derivatives of outputs and state derivatives with respect to inputs and states (in initialisation: inputs and
 * parameters) at their present values. They are central differences with a suitable step for each variable, one-sided at the
 * end of a range. In co-simulation outputs are also taken as functions of the present inputs, as a step computes them in a
 * model without states. */
Status derivative(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
                  const Reference knowns[], size_t n_knowns, const double seed[], size_t n_seed, double result[],
                  size_t n_result)
{
    double *seeds = instance ? instance->before : NULL, *values = instance ? instance->other : NULL;
    double up, down /* negative */, h = INFINITY;
    bool lazy = false;
    Status status;
    REQUIRE(instance, function, INITIALIZATION | RUNNING | TERMINATED);
    status = check(instance, unknowns, n_unknowns, REAL, ANY_OUTPUT | FIELD, n_result, function);
    if (status == OK)
        status = check(instance, knowns, n_knowns, REAL | INTEGER | ENUMERATION | BOOLEAN, INPUT | (instance->is.phase == INITIALIZATION ? PARAMETER : STATE),
                       n_seed, function);
    choose(instance, instance->values);
    if (status == OK) status = check_ranges(instance, instance->values, N(values));
    if (status == OK) status = prepare(instance, instance->values);
    if (status != OK) return status;

    memset(seeds, 0, N(values) * sizeof *seeds);
    for (size_t k = 0; k < n_knowns; k++)
        for (size_t i = 0; i < extent(instance, knowns[k]); i++, seed++) {
            if (!isfinite(*seed)) return report(instance, LOG_ERROR, "a seed of a directional derivative is not finite");
            /* OMSimulator names every dependency of an unknown, enumerations too, with seeds of 0. */
            if (*seed != 0.0 && !(instance->table.variables[knowns[k]].kind & REAL))
                return report(instance, LOG_ERROR, "%s is not a variable for %s now, unless its seed is 0",
                              TEXT(instance->table.variables[knowns[k]].name), function);
            seeds[knowns[k] + i] += *seed;
        }
    if (n_result > 0) memset(result, 0, n_result * sizeof *result); /* else it may be NULL */
    for (size_t k = 0; k < n_unknowns; k++) lazy |= instance->table.variables[unknowns[k]].lazy != 0;
    displaced(instance, seeds, 0.0, false, values); /* the steps depend on the outputs at the present values */
    for (size_t i = 0; i < N(values); i++)
        if (seeds[i] != 0.0) h = fmin(h, instance->kernels->difference(values, (int64_t)i, instance->resources, instance->table.own) / fabs(seeds[i]));
    if (isinf(h)) return OK;
    up = reach(instance, seeds, h);
    down = reach(instance, seeds, -h);
    if (up == down) return report(instance, LOG_DISCARD, "the directional derivative leaves the allowed range");
    displaced(instance, seeds, up, lazy, values);
    for (size_t k = 0, at = 0; k < n_unknowns; at += extent(instance, unknowns[k++]))
        memcpy(result + at, numbers_of(instance, values, unknowns[k]), extent(instance, unknowns[k]) * sizeof *result);
    displaced(instance, seeds, down, lazy, values);
    for (size_t k = 0; k < n_unknowns; k++) {
        const double *behind = numbers_of(instance, values, unknowns[k]);
        for (size_t i = 0; i < extent(instance, unknowns[k]); i++, result++) {
            *result = (*result - behind[i]) / (up - down);
            if (!isfinite(*result))
                return report(instance, LOG_DISCARD, "%s has no finite derivative here", TEXT(instance->table.variables[unknowns[k]].name));
        }
    }
    return OK;
}
