/* One instance of the FMU. The model is in two places: model.h, generated from the variable table, and the entries
 * model_…, compiled from the solver's kernels, once for every processor and once for those with AVX2. Everything here serves any model with that interface.
 *
 * Nothing outside an instance can be written, so instances may run in threads of their own. An instance allocates when it
 * is made, when its resolution is set and when a state is taken; a step allocates nothing. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <stdbool.h>
#include <stdint.h>

#include "fmi2Functions.h"
#include "model.h"

/* ---- the model: one array of all values by value reference, one of working memory that begins with the warm start;
 * component.py says what each does. Those that compute return 0 or the number of a message. */
typedef struct {
    int64_t (*memory)(double *values);
    int64_t (*size)(double *values);
    int64_t (*prepare)(double *values, double *work);
    int64_t (*start)(double *values, double *work);
    int64_t (*outputs)(double *values, double *work, double h);
    int64_t (*lazy)(double *values, double *work);
    double (*difference)(double *values, int64_t reference);
} Model;

/* ---- the table */
typedef enum { REAL = 1, INTEGER = 2, ENUMERATION = 4 } Kind;
typedef enum {
    PARAMETER = 1,
    INPUT = 2,
    OUTPUT = 4,
    STATE = 8, /* continuous state, an output as well */
    TOTAL = 16 /* output that adds up, with a start value */
} Role;
#define ANY_OUTPUT (OUTPUT | STATE | TOTAL)

typedef struct {
    const char *name;
    Kind kind;
    Role role;
    bool lazy; /* computed by model_lazy when somebody reads it */
    bool open_minimum;
    double start, minimum, maximum;
} Variable;

extern const Variable variables[N_VALUES];

/* Continuous states: value references of one and of its derivative, and its nominal value. */
typedef struct {
    int value, derivative;
    double nominal;
} Continuous;

extern const Continuous states[N_STATES];

/* Outputs that add up over time: the value of `total` grows at the rate of the product of two values, or of one. */
enum { ALONE = -1 };
typedef struct {
    int total, factor, other;
} Total;

extern const Total totals[N_TOTALS];

/* What a model has to say, by number: a warning, or why a step is discarded; no text where there is nothing to say. */
typedef enum { LOG_WARNING = 1, LOG_DISCARD = 2, LOG_ERROR = 4 } Category;
typedef struct {
    Category category;
    const char *text;
} Message;

extern const Message messages[N_MESSAGES + 1];

/* ---- FMI's state machine; StepInProgress does not occur, as a step is done when fmi2DoStep returns */
typedef enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    EVENT = 4,           /* model exchange */
    CONTINUOUS = 8,      /* model exchange */
    STEP_COMPLETE = 16,  /* co-simulation */
    STEP_FAILED = 32,    /* co-simulation; the discarded step has changed nothing and may be tried again */
    TERMINATED = 64,
    BROKEN = 128         /* out of memory: only reset, restore and free remain */
} Phase;

#define RUNNING (EVENT | CONTINUOUS | STEP_COMPLETE | STEP_FAILED)
#define ANY (INSTANTIATED | INITIALIZATION | RUNNING | TERMINATED | BROKEN)

/* What an instance is, besides its warm start: all of an FMU state, copied byte by byte. */
typedef struct {
    double values[N_VALUES];
    double solved[N_VALUES]; /* the values that the outputs belong to */
    double time, stop_time;
    double accepted_time, accepted[N_TOTALS]; /* model exchange: where the totals have been added up to, their rates there */
    int64_t phase;
    int64_t is_new;     /* something was set since the outputs were computed */
    int64_t lazy_stale; /* the lazy outputs belong to older values */
    int64_t last_step;  /* fmi2Status of the last fmi2DoStep */
    int64_t said;       /* number of the last warning, which is not repeated while it lasts */
} Content;

typedef struct {
    Content is;
    double *memory; /* warm start */
    int64_t memory_size;
    double *work;
    double prepared[N_VALUES]; /* parameters that `work` is laid out and filled for; a negative first one: none */
    const Model *model; /* compiled for this processor; the results are the same */
    fmi2Type type;
    char *name;
    int categories;
    fmi2CallbackLogger logger; /* copied: the host's structure may be gone after fmi2Instantiate */
    fmi2ComponentEnvironment environment;
} Instance;

/* lifecycle.c */
fmi2Status report(const Instance *instance, Category category, const char *format, ...);
fmi2Status refuse(const Instance *instance, const char *function);
#define REQUIRE(instance, function, phases) \
    do { \
        if (!(instance)) return fmi2Error; \
        if (!((instance)->is.phase & (phases))) return refuse(instance, function); \
    } while (0)

/* evaluate.c: compute in place; on anything but fmi2OK the content is as it was */
bool in_range(const Variable *variable, double value);
fmi2Status check_ranges(const Instance *instance);
fmi2Status prepare(Instance *instance);
int64_t evaluate(const Instance *instance, double *values, double h); /* leaves the content alone, not working memory */
fmi2Status update(Instance *instance, double h, bool warm);
void accumulate(Instance *instance);
fmi2Status update_lazy(Instance *instance);
fmi2Status refresh(Instance *instance);

#endif
