/* Life of an instance from instantiation to free, and its messages. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

/* Kernels as objects are for two kinds of x86-64 processors. Kernels in C are for any processor. */
#if !defined(KERNELS_IN_C) && (defined(__x86_64__) || defined(_M_X64))
#define HAS_TWO_KERNELS
#include "processor.h"
#endif

static const struct {
    Category category;
    const char *name;
    Status status;
} categories[] = {
    {LOG_WARNING, "logStatusWarning", WARNING},
    {LOG_DISCARD, "logStatusDiscard", DISCARD},
    {LOG_ERROR, "logStatusError", ERROR},
};
#define N_CATEGORIES (sizeof categories / sizeof *categories)

/* Log a message if its category is switched on. Return the status of the category. */
Status report(const Instance *instance, Category category, const char *format, ...)
{
    size_t i = 0;
    while (categories[i].category != category) i++;
    if (instance->log.logger && (instance->categories & category)) {
        char message[512];
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message, sizeof message, format, arguments);
        va_end(arguments);
        instance->log.write(&instance->log, instance->name, categories[i].status, categories[i].name, message);
    }
    return categories[i].status;
}

static const char *phase_name(int64_t phase)
{
    switch (phase) {
    case INSTANTIATED: return "before initialisation";
    case CONFIGURATION: return "in configuration mode";
    case INITIALIZATION: return "in initialisation mode";
    case EVENT: return "in event mode";
    case CONTINUOUS: return "in continuous-time mode";
    case STEP_COMPLETE: return "after initialisation";
    case STEP_FAILED: return "after a discarded step";
    case TERMINATED: return "after terminate";
    default: return "after an error";
    }
}

/* Report a call that is not legal in this state. It has changed nothing. */
Status refuse(const Instance *instance, const char *function)
{
    const char *kind = instance->type == CO_SIMULATION ? "co-simulation" : "model exchange";
    return report(instance, LOG_ERROR, "%s is not allowed in %s %s; the call is ignored", function, kind,
                  phase_name(instance->is.phase));
}

bool has_null(const Instance *instance, const char *function, const void *const pointers[], size_t n)
{
    if (!instance) return true;
    for (size_t i = 0; i < n; i++)
        if (!pointers[i]) {
            report(instance, LOG_ERROR, "%s: pointer %zu after the instance is NULL; the call is ignored", function, i + 1);
            return true;
        }
    return false;
}

Status choose_log(Instance *instance, const char *function, bool on, size_t n, const char *const names[])
{
    int chosen = n == 0 ? LOG_WARNING | LOG_DISCARD | LOG_ERROR : 0;
    REQUIRE(instance, function, ANY);
    for (size_t k = 0; k < n; k++) {
        size_t i = 0;
        while (i < N_CATEGORIES && (!names || !names[k] || strcmp(names[k], categories[i].name))) i++;
        if (i == N_CATEGORIES)
            return report(instance, LOG_ERROR, "log category %.60s is unknown", names && names[k] ? names[k] : "NULL");
        chosen |= categories[i].category;
    }
    instance->categories = on ? chosen : 0;
    return OK;
}

static void restart(Instance *instance)
{
    memset(&instance->is, 0, sizeof instance->is);
    for (size_t i = 0; i < N(values); i++) instance->values[i] = instance->table.variables[i].start;
    memcpy(instance->solved, instance->values, N(values) * sizeof(double));
    memset(instance->accepted, 0, N(totals) * sizeof(double));
    instance->is.stop_time = INFINITY;
    instance->is.phase = INSTANTIATED;
    instance->is.is_new = true;
    if (instance->memory) memset(instance->memory, 0, (size_t)(instance->starts * instance->memory_size) * sizeof(double));
    instance->work_is_solved = false;
}

#define DECLARE(kind, cpu) \
    int64_t kind##_memory_##cpu(double *, const double *, const double *); \
    int64_t kind##_size_##cpu(double *, const double *, const double *); \
    int64_t kind##_prepare_##cpu(double *, double *, const double *, const double *); \
    int64_t kind##_outputs_##cpu(double *, double *, double, const double *, const double *); \
    int64_t kind##_lazy_##cpu(double *, double *, const double *, const double *); \
    int64_t kind##_jacobian_##cpu(double *, double *, const double *, const double *); \
    double kind##_difference_##cpu(double *, int64_t, const double *, const double *); \
    int64_t kind##_field_##cpu(double *, double *, int64_t, const double *, const double *);
#define LIST(kind, cpu) \
    {#kind, kind##_memory_##cpu, kind##_size_##cpu, kind##_prepare_##cpu, kind##_outputs_##cpu, \
     kind##_lazy_##cpu, kind##_jacobian_##cpu, kind##_difference_##cpu, kind##_field_##cpu},
#define KERNELS(cpu) \
    KINDS(DECLARE, cpu) \
    static const Kernels kernels_##cpu[] = {KINDS(LIST, cpu){0}};

#ifdef HAS_TWO_KERNELS
KERNELS(v2)
KERNELS(v3)

static const Kernels *kernels_for_this_processor(void) { return has_x86_64_v3() ? kernels_v3 : kernels_v2; }
#else
KERNELS(any)
static const Kernels *kernels_for_this_processor(void) { return kernels_any; }
#endif

/* Return the kernels of a kind of model for this processor, or NULL if they are not in this binary. */
const Kernels *kernels_of(const char *kind)
{
    const Kernels *k = kernels_for_this_processor();
    while (k->kind && strcmp(k->kind, kind)) k++;
    return k->kind ? k : NULL;
}

/* Return a new instance, or log the reason and return NULL. */
Instance *instantiate(Type type, bool arrays, const char *name, const char *guid, const char *folder, const Log *log,
                      bool logging)
{
    Instance *instance;
    Instance caller = {.categories = LOG_ERROR, .log = *log};
    snprintf(caller.name, sizeof caller.name, "%.*s", (int)sizeof caller.name - 1, name ? name : "");
    if (!name || !*name) {
        report(&caller, LOG_ERROR, "the instance has no name");
        return NULL;
    }
    if (type != CO_SIMULATION && type != MODEL_EXCHANGE) {
        report(&caller, LOG_ERROR, "fmuType %d is neither co-simulation nor model exchange", (int)type);
        return NULL;
    }
    instance = calloc(1, sizeof *instance);
    if (!instance) {
        report(&caller, LOG_ERROR, "out of memory");
        return NULL;
    }
    memcpy(instance->name, caller.name, sizeof instance->name);
    instance->type = type;
    instance->arrays = arrays;
    instance->log = *log;
    instance->categories = logging ? LOG_WARNING | LOG_DISCARD | LOG_ERROR : LOG_DISCARD | LOG_ERROR;
    if (load_table(instance, folder)) {
        const char *own = TEXT(instance->table.head->guid);
        if (!guid || strcmp(guid, own))
            report(instance, LOG_ERROR, "guid %.60s is not that of the resources, %s: they come from different builds",
                   guid ? guid : "NULL", own);
        else if (load_resources(instance, folder)) {
            restart(instance);
            return instance;
        }
    }
    release(instance);
    return NULL;
}

void release(Instance *instance)
{
    if (!instance) return;
    free_work(instance);
    free(instance->memory);
    free(instance->resources);
    free(instance->values);
    free(instance->table.block);
    free(instance);
}

Status set_up(Instance *instance, const char *function, double start, bool has_stop, double stop)
{
    REQUIRE(instance, function, INSTANTIATED);
    if (!isfinite(start) || (has_stop && !(stop >= start)))
        return report(instance, LOG_ERROR, "startTime = %g, stopTime = %g: allowed: numbers, the stop not before it", start, stop);
    instance->is.time = instance->is.accepted_time = start;
    instance->is.stop_time = has_stop ? stop : INFINITY;
    return OK;
}

Status enter_configuration(Instance *instance, const char *function)
{
    REQUIRE(instance, function, N(fields) > 0 ? INSTANTIATED : 0); /* without fields the FMU has no structural parameters */
    instance->is.phase = CONFIGURATION;
    return OK;
}

Status exit_configuration(Instance *instance, const char *function)
{
    REQUIRE(instance, function, CONFIGURATION);
    instance->is.phase = INSTANTIATED;
    return OK;
}

Status enter_initialization(Instance *instance, const char *function)
{
    REQUIRE(instance, function, INSTANTIATED);
    instance->is.phase = INITIALIZATION;
    return OK;
}

/* After Discard the instance stays in initialisation mode, where the host can correct the value. */
Status exit_initialization(Instance *instance, const char *function)
{
    Status status;
    REQUIRE(instance, function, INITIALIZATION);
    status = refresh(instance);
    if (status > WARNING) return status;
    instance->is.phase = instance->type == CO_SIMULATION ? STEP_COMPLETE : EVENT;
    if (instance->type == MODEL_EXCHANGE) accumulate(instance);
    return status;
}

Status terminate(Instance *instance, const char *function)
{
    REQUIRE(instance, function, RUNNING);
    instance->is.phase = TERMINATED;
    return OK;
}

Status reset(Instance *instance, const char *function)
{
    REQUIRE(instance, function, ANY);
    restart(instance);
    return OK;
}
