/* Directional and adjoint derivatives: products with the matrix that the model knows, difference quotients for the rest.
 *
 * They are those of outputs with respect to inputs (in initialisation: inputs and parameters) at their present values. In
 * co-simulation outputs are also taken as functions of the present inputs, as a step from a cold start computes them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

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

/* Whether outputs are the same functions of both. */
static bool same_inputs(const Instance *instance, const double *a, const double *b)
{
    for (size_t i = 0; i < N(values); i++)
        if (instance->table.variables[i].role & (PARAMETER | INPUT) && a[i] != b[i]) return false;
    return true;
}

/* Let `slopes` be the matrix of the model at the present values. It stays until one of them changes. */
static Status update_slopes(Instance *instance)
{
    const size_t rows = (size_t)N(derived), columns = (size_t)N(derived_by);
    double *values = instance->other;
    int64_t number = 0, at;
    if (instance->has_slopes && same_inputs(instance, instance->values, instance->slopes_at)) return OK;
    instance->has_slopes = false;
    if (instance->type == MODEL_EXCHANGE && instance->work_is_solved && same_inputs(instance, instance->values, instance->solved)) {
        memcpy(values, instance->solved, N(values) * sizeof(double)); /* solved from a cold start */
    } else {
        memcpy(values, instance->values, N(values) * sizeof(double));
        memset(instance->work, 0, (size_t)instance->memory_size * sizeof(double));
        number = evaluate(instance, values, 0.0);
    }
    instance->work_is_solved = false;
    if (has_failed(instance, number)) return say(instance, number);
    at = instance->kernels->jacobian(values, instance->work, instance->resources, instance->table.own);
    if (at + (int64_t)(rows * columns) > instance->kernels->size(values, instance->resources, instance->table.own))
        return report(instance, LOG_ERROR, "the derivatives in resources do not fit this binary");
    memcpy(instance->slopes, instance->work + at, rows * columns * sizeof(double));
    for (size_t c = 0; c < columns; c++)
        for (size_t r = 0; r < rows; r++)
            if (!isfinite(instance->slopes[r * columns + c])) instance->slopes[c] = NAN; /* the whole column is not known */
    memcpy(instance->slopes_at, instance->values, N(values) * sizeof(double));
    instance->has_slopes = true;
    return OK;
}

/* Row of the matrix for a value reference, or -1. */
static int row_of(const Instance *instance, uint64_t reference)
{
    for (uint64_t r = 0; r < N(derived); r++)
        if ((uint64_t)instance->table.derived[r] == reference) return (int)r;
    return -1;
}

static Status not_finite(const Instance *instance, Reference unknown)
{
    return report(instance, LOG_DISCARD, "%s has no finite derivative here", TEXT(instance->table.variables[unknown].name));
}

enum { IN_MATRIX = 1, NOT_IN_MATRIX = 2 };

/* Fill the results of the unknowns that are, or are not, in the matrix by central differences with a suitable step, one-sided
 * at the end of a range. */
static Status differ(Instance *instance, const double *seeds, int which, const Reference unknowns[], size_t n, double *result)
{
    double *values = instance->other;
    double up, down /* negative */, h = INFINITY;
    bool lazy = false;
    for (size_t k = 0; k < n; k++) lazy |= instance->table.variables[unknowns[k]].lazy != 0;
    displaced(instance, seeds, 0.0, false, values); /* the steps depend on the outputs at the present values */
    for (size_t i = 0; i < N(values); i++)
        if (seeds[i] != 0.0)
            h = fmin(h, instance->kernels->difference(values, (int64_t)i, instance->resources, instance->table.own) / fabs(seeds[i]));
    if (isinf(h)) return OK;
    up = reach(instance, seeds, h);
    down = reach(instance, seeds, -h);
    if (up == down) return report(instance, LOG_DISCARD, "the directional derivative leaves the allowed range");
    for (int side = 0; side < 2; side++) {
        double *to = result;
        displaced(instance, seeds, side ? down : up, lazy, values);
        for (size_t k = 0; k < n; k++) {
            const double *found = numbers_of(instance, values, unknowns[k]);
            for (size_t i = 0; i < extent(instance, unknowns[k]); i++, to++) {
                if (!(which & (row_of(instance, unknowns[k] + (uint64_t)i) < 0 ? NOT_IN_MATRIX : IN_MATRIX))) continue;
                *to = side ? (*to - found[i]) / (up - down) : found[i];
                if (side && !isfinite(*to)) return not_finite(instance, unknowns[k]);
            }
        }
    }
    return OK;
}

static bool any(const double *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (numbers[i] != 0.0) return true;
    return false;
}

/* Fill the derivatives of the unknowns along the seeds in `before`. */
static Status along(Instance *instance, const Reference unknowns[], size_t n, size_t n_result, double *result)
{
    const double *seeds = instance->before;
    const size_t columns = (size_t)N(derived_by), n_values = (size_t)N(values);
    double *rest = instance->rest; /* seeds of what the matrix does not know */
    bool asks = false;
    int which = 0;
    Status status = OK;
    if (n_result > 0) memset(result, 0, n_result * sizeof *result); /* else it may be NULL */
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < extent(instance, unknowns[k]); i++)
            which |= row_of(instance, unknowns[k] + (uint64_t)i) < 0 ? NOT_IN_MATRIX : IN_MATRIX;
    for (size_t c = 0; c < columns; c++) asks |= seeds[instance->table.derived_by[c]] != 0.0;
    memcpy(rest, seeds, n_values * sizeof *rest);
    if (asks && which & IN_MATRIX) {
        status = update_slopes(instance);
        for (size_t c = 0; status <= WARNING && c < columns; c++)
            if (!isnan(instance->slopes[c])) rest[instance->table.derived_by[c]] = 0.0;
    }
    if (status <= WARNING && which & IN_MATRIX && any(rest, n_values))
        status = differ(instance, rest, IN_MATRIX, unknowns, n, result);
    if (status <= WARNING && which & NOT_IN_MATRIX && any(seeds, n_values))
        status = differ(instance, seeds, NOT_IN_MATRIX, unknowns, n, result);
    if (status > WARNING || !(asks && which & IN_MATRIX)) return status;
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < extent(instance, unknowns[k]); i++, result++) {
            const int row = row_of(instance, unknowns[k] + (uint64_t)i);
            for (size_t c = 0; row >= 0 && c < columns; c++)
                if (!isnan(instance->slopes[c]))
                    *result += instance->slopes[(size_t)row * columns + c] * seeds[instance->table.derived_by[c]];
            if (!isfinite(*result)) return not_finite(instance, unknowns[k]);
        }
    return OK;
}

/* Check unknowns and knowns, and prepare working memory. */
static Status begin(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns, size_t of_unknowns,
                    const Reference knowns[], size_t n_knowns, size_t of_knowns)
{
    Status status;
    REQUIRE(instance, function, INITIALIZATION | RUNNING | TERMINATED);
    status = check_references(instance, unknowns, n_unknowns, REAL, ANY_OUTPUT | FIELD, of_unknowns, function);
    if (status == OK)
        status = check_references(instance, knowns, n_knowns, REAL | INTEGER | ENUMERATION | BOOLEAN,
                                  INPUT | (instance->is.phase == INITIALIZATION ? PARAMETER : 0), of_knowns, function);
    choose(instance, instance->values);
    if (status == OK) status = check_ranges(instance, instance->values, N(values));
    if (status == OK) status = prepare(instance, instance->values);
    return status;
}

static Status no_seed(const Instance *instance) { return report(instance, LOG_ERROR, "a seed of a derivative is not finite"); }

/* Fill the product of the derivatives with seeds of the knowns. */
Status derivative(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
                  const Reference knowns[], size_t n_knowns, const double seed[], size_t n_seed, double result[],
                  size_t n_result)
{
    Status status = begin(instance, function, unknowns, n_unknowns, n_result, knowns, n_knowns, n_seed);
    if (status != OK) return status;
    memset(instance->before, 0, N(values) * sizeof(double));
    for (size_t k = 0; k < n_knowns; k++)
        for (size_t i = 0; i < extent(instance, knowns[k]); i++, seed++) {
            if (!isfinite(*seed)) return no_seed(instance);
            /* OMSimulator names every dependency of an unknown, enumerations too, with seeds of 0. */
            if (*seed != 0.0 && !(instance->table.variables[knowns[k]].kind & REAL))
                return report(instance, LOG_ERROR, "%s is not a variable for %s now, unless its seed is 0",
                              TEXT(instance->table.variables[knowns[k]].name), function);
            instance->before[knowns[k] + i] += *seed;
        }
    return along(instance, unknowns, n_unknowns, n_result, result);
}

/* Fill the product of seeds of the unknowns with the derivatives: one direction for each known. Variables that are not real
 * have no derivative; their results are 0. */
Status adjoint(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
               const Reference knowns[], size_t n_knowns, const double seed[], size_t n_seed, double result[],
               size_t n_result)
{
    double *column;
    Status status = begin(instance, function, unknowns, n_unknowns, n_seed, knowns, n_knowns, n_result);
    if (status != OK) return status;
    for (size_t i = 0; i < n_seed; i++)
        if (!isfinite(seed[i])) return no_seed(instance);
    column = malloc((n_seed + 1) * sizeof *column);
    if (!column) return report(instance, LOG_ERROR, "out of memory");
    for (size_t k = 0; k < n_knowns && status <= WARNING; k++)
        for (size_t i = 0; i < extent(instance, knowns[k]) && status <= WARNING; i++, result++) {
            *result = 0.0;
            if (!(instance->table.variables[knowns[k]].kind & REAL)) continue;
            memset(instance->before, 0, N(values) * sizeof(double));
            instance->before[knowns[k] + i] = 1.0;
            status = along(instance, unknowns, n_unknowns, n_seed, column);
            for (size_t j = 0; j < n_seed; j++) *result += seed[j] * column[j];
            if (!isfinite(*result)) status = not_finite(instance, knowns[k]);
        }
    free(column);
    return status;
}
