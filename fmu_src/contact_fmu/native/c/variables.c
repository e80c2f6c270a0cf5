/* Reading and setting variables, and the states in which this is legal. */
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
const double *numbers_of(const Instance *instance, double *values, Reference reference)
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
Status check_references(const Instance *instance, const Reference refs[], size_t n, int kinds, int roles, size_t n_values,
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
    status = check_references(instance, refs, n, kinds, roles, n_values, function);
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
    if (instance->arrays && n > 0 && (kinds == COUNT) != (instance->is.phase == CONFIGURATION))
        return report(instance, LOG_ERROR, "%s: only structural parameters are set, and only in configuration mode", function);
    if (instance->is.phase == CONFIGURATION) roles = PARAMETER;
    status = check_references(instance, refs, n, kinds, roles, n_values, function);
    if (status == OK && n > 0) instance->is.is_new = true;
    return status;
}
