/* Compute outputs from values: check ranges, prepare working memory, call the model's functions and check their results. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

bool in_range(const Variable *variable, double value)
{
    if (!isfinite(value) || value > variable->maximum) return false;
    return variable->open_minimum ? value > variable->minimum : value >= variable->minimum;
}

/* Let the choices that are not 0 be the values of their enumerations. */
void choose(const Instance *instance, double *values)
{
    for (size_t i = 0; i < N(choices); i++)
        if (values[instance->table.choices[i].twin] >= 1.0 && in_range(&instance->table.variables[instance->table.choices[i].twin], values[instance->table.choices[i].twin]))
            values[instance->table.choices[i].of] = values[instance->table.choices[i].twin];
}

/* After this the discrete variables are what their mirrors show. In continuous-time mode they keep what they were. */
void show_mirrored(const Instance *instance, double *values)
{
    for (size_t i = 0; i < N(mirrors); i++) values[instance->table.mirrors[i].of] = values[instance->table.mirrors[i].twin];
}

/* Whether a value has any effect. The enumerations come before the values that depend on them. */
static bool is_used(const Variable *variable, const double *values)
{
    for (int k = 0; k < MOST_USES && variable->used[k].items; k++)
        if (!(variable->used[k].items >> (int)values[variable->used[k].enumeration] & 1u)) return false;
    return true;
}

/* Whether this value may be computed with, or is not used. */
bool is_allowed(const Instance *instance, size_t i, const double *values)
{
    if (instance->table.variables[i].role == OUTPUT) return isfinite(values[i]);
    return in_range(&instance->table.variables[i], values[i]) || !is_used(&instance->table.variables[i], values);
}

/* Check the first n values, which are in order, since parameters come first. */
Status check_ranges(const Instance *instance, const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const Variable *v = &instance->table.variables[i];
        if (v->role == OUTPUT || is_allowed(instance, i, values)) continue;
        if (isinf(v->minimum) && isinf(v->maximum))
            return report(instance, LOG_DISCARD, "%s = %g is not finite", TEXT(v->name), values[i]);
        return report(instance, LOG_DISCARD, "%s = %g is outside the allowed range %s%g, %g%s", TEXT(v->name), values[i],
                      v->open_minimum || isinf(v->minimum) ? "]" : "[", v->minimum, v->maximum,
                      isinf(v->maximum) ? "[" : "]");
    }
    return OK;
}

/* Log the model's message with this number. Numbers without a text are not logged. */
static const Message *message(const Instance *instance, int64_t number)
{
    return &instance->table.messages[number > 0 && (uint64_t)number <= N(messages) ? number : 0];
}
bool has_failed(const Instance *instance, int64_t number) { return message(instance, number)->category == LOG_DISCARD; }
Status say(const Instance *instance, int64_t number)
{
    const Message *m = message(instance, number);
    if (!m->category) return OK;
    if (m->value == NONE) return report(instance, (Category)m->category, "%s", TEXT(m->text));
    return report(instance, (Category)m->category, "%s = %g: %s", TEXT(instance->table.variables[m->value].name),
                  instance->values[m->value], TEXT(m->text));
}

/* Return the first number of a doubt that is not usual, with its place in `at`, or 0. */
static double unusual(const Instance *instance, const Doubt *d, const double *values, size_t *at)
{
    for (*at = (size_t)d->value; *at < (size_t)(d->value + d->n); ++*at) {
        double x = values[*at];
        if (d->other != NONE) x = fabs(values[d->other]) > SLOWEST ? 1.0 + x * values[d->factor] / values[d->other] : 0.0;
        /* a load below zero, as of a host's solver, is none */
        if ((fabs(x) > d->largest || (x > 0.0 && x < d->least)) && is_used(&instance->table.variables[*at], values)) return x;
    }
    return 0.0;
}

/* Log each doubt about the present values, once for an instance. */
Status tell_doubts(Instance *instance)
{
    Status status = OK;
    for (size_t i = 0; i < N(doubts); i++) {
        const Doubt *d = &instance->table.doubts[i];
        size_t at;
        double x;
        if (instance->doubted >> i & 1u) continue;
        x = unusual(instance, d, instance->values, &at);
        if (x == 0.0) continue;
        instance->doubted |= (uint64_t)1 << i;
        status = report(instance, LOG_WARNING, "%s = %g: %s", TEXT(instance->table.variables[at].name), instance->values[at],
                        TEXT(d->text));
    }
    return status;
}

enum { CACHE_LINE = 64 };

void free_work(Instance *instance)
{
    free(instance->work_block);
    instance->work_block = instance->work = NULL;
}

/* Lay out and fill working memory for the parameters in `values`, which must be within their ranges. A warm start of another
 * size is discarded. */
Status prepare(Instance *instance, double *values)
{
    int64_t number;
    Status status;
    if (instance->work && !memcmp(values, instance->prepared, N(parameters) * sizeof(double))) return OK;
    status = check_ranges(instance, values, N(parameters)); /* those of a restored state have not been checked */
    if (status != OK) return status;
    int64_t memory_size = instance->kernels->memory(values, instance->resources, instance->table.own);
    void *block = malloc((size_t)instance->kernels->size(values, instance->resources, instance->table.own) * sizeof(double) + CACHE_LINE);
    double *memory = memory_size == instance->memory_size ? instance->memory : calloc((size_t)(instance->starts * memory_size), sizeof(double));
    if (!block || !memory) {
        free(block);
        if (memory != instance->memory) free(memory);
        instance->is.phase = BROKEN;
        return report(instance, LOG_ERROR, "out of memory: this resolution takes %lld bytes",
                      (long long)instance->kernels->size(values, instance->resources, instance->table.own) * (long long)sizeof(double));
    }
    free_work(instance);
    if (memory != instance->memory) free(instance->memory);
    instance->work_block = block;
    instance->work = (double *)(((uintptr_t)block + CACHE_LINE - 1) / CACHE_LINE * CACHE_LINE);
    instance->work_is_solved = false;
    instance->memory = memory;
    instance->memory_size = memory_size;
    memcpy(instance->prepared, values, N(parameters) * sizeof(double));
    number = instance->kernels->prepare(values, instance->work, instance->resources, instance->table.own);
    if (!has_failed(instance, number)) return OK;
    free_work(instance);
    return say(instance, number);
}

/* NaN and infinity must not leave the FMU: restore `before` if an output is not finite. What the host sets may be anything. */
static Status keep_finite(Instance *instance, const double *before)
{
    double *values = instance->values;
    for (size_t i = 0; i < N(values); i++) {
        if (!isfinite(values[i]) && !(instance->table.variables[i].role & (PARAMETER | INPUT))) {
            memcpy(values, before, N(values) * sizeof(double));
            return report(instance, LOG_DISCARD, "%s has no finite value for these inputs", TEXT(instance->table.variables[i].name));
        }
    }
    return OK;
}

/* Compute the outputs in `values` (of the instance or another array) with working memory as it is. Return the number of a
 * message. */
int64_t evaluate(const Instance *instance, double *values, double h)
{
    return instance->kernels->outputs(values, instance->work, h, instance->resources, instance->table.own);
}

static double rate(const Total *t, const double *values)
{
    double speed = t->speed == NONE ? 1.0 : fabs(values[t->speed]);
    return t->rate == NONE ? speed : speed * values[t->rate];
}

/* Compute the outputs for the present values and advance totals by h. With `warm` start from the last step. */
Status update(Instance *instance, double h, bool warm)
{
    double *values = instance->values, *before = instance->before;
    double *next, *from;
    size_t memory_bytes;
    int64_t number;
    Status status = OK;
    choose(instance, values);
    if (instance->is.is_new) status = check_ranges(instance, values, N(values));
    if (status == OK) status = prepare(instance, values);
    if (status != OK) return status;
    memory_bytes = (size_t)instance->memory_size * sizeof(double);
    next = instance->memory, from = next + instance->memory_size;
    memcpy(before, values, N(values) * sizeof(double));
    instance->work_is_solved = false;
    if (warm)
        memcpy(instance->work, next, memory_bytes);
    else
        memset(instance->work, 0, memory_bytes);
    number = evaluate(instance, values, h);
    if (has_failed(instance, number)) {
        memcpy(values, before, N(values) * sizeof(double));
        return say(instance, number);
    }
    for (size_t i = 0; i < N(totals); i++) values[instance->table.totals[i].total] += rate(&instance->table.totals[i], values) * h;
    for (size_t i = 0; i < N(mirrors); i++) {
        values[instance->table.mirrors[i].twin] = values[instance->table.mirrors[i].of];
        if (instance->is.phase == CONTINUOUS) values[instance->table.mirrors[i].of] = before[instance->table.mirrors[i].of]; /* changes only at events */
    }
    status = keep_finite(instance, before);
    if (status != OK) return status;
    if (instance->starts > 1 && warm) memcpy(from, next, memory_bytes);
    if (instance->starts > 1 && !warm) memset(from, 0, memory_bytes);
    if (warm) memcpy(next, instance->work, memory_bytes);
    instance->work_is_solved = true;
    memcpy(instance->solved, values, N(values) * sizeof(double));
    instance->is.is_new = false;
    instance->is.lazy_stale = true;
    status = tell_doubts(instance);
    if (number == instance->is.said) return status;
    instance->is.said = number;
    return say(instance, number) == OK ? status : WARNING; /* a failure has been said above */
}

/* Restore working memory to the state of the last outputs, bit for bit, if it has been used since. */
Status update_work(Instance *instance)
{
    double *solved = instance->other;
    Status status;
    memcpy(solved, instance->solved, N(values) * sizeof(double));
    status = prepare(instance, solved);
    if (status != OK || instance->work_is_solved) return status;
    memcpy(instance->work, instance->memory + instance->memory_size, (size_t)instance->memory_size * sizeof(double));
    evaluate(instance, solved, 0.0);
    instance->work_is_solved = true;
    return OK;
}

/* Compute the lazy outputs of the last step from its solution in working memory. */
Status update_lazy(Instance *instance)
{
    double *solved = instance->other;
    if (!instance->is.lazy_stale || update_work(instance) != OK) return OK;
    memcpy(solved, instance->solved, N(values) * sizeof(double));
    instance->work_is_solved = false;
    instance->kernels->lazy(solved, instance->work, instance->resources, instance->table.own);
    for (size_t i = 0; i < N(values); i++)
        if (instance->table.variables[i].lazy) {
            if (!isfinite(solved[i]))
                return report(instance, LOG_DISCARD, "%s has no finite value for these inputs", TEXT(instance->table.variables[i].name));
            instance->values[i] = solved[i];
        }
    instance->is.lazy_stale = false;
    return OK;
}

/* Outputs follow inputs at once in initialisation and in model exchange. In co-simulation they change with the next step. */
Status refresh(Instance *instance)
{
    return instance->is.is_new ? update(instance, 0.0, false) : OK;
}

/* Model exchange: integrate the rates of the totals since the last accepted step, by the trapezoidal rule. */
void accumulate(Instance *instance)
{
    Content *is = &instance->is;
    double h = is->time - is->accepted_time;
    for (size_t i = 0; i < N(totals); i++) {
        double now = rate(&instance->table.totals[i], instance->values);
        if (h > 0.0) instance->values[instance->table.totals[i].total] += 0.5 * h * (instance->accepted[i] + now);
        instance->accepted[i] = now;
    }
    is->accepted_time = is->time;
}
