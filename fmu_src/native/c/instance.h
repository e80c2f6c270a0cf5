/* One instance of the FMU. The model is in two places: model.h, generated from the variable table, and the entries
 * model_…, compiled from the solver's kernels, once for every processor and once for those with AVX2. Everything here
 * serves any model with that interface, and both versions of FMI: fmi2.c and fmi3.c only translate, what a call does and
 * when it is legal is in the other files.
 *
 * Nothing outside an instance can be written, so instances may run in threads of their own. An instance allocates when it
 * is made, when its resolution is set and when a state is taken; a step allocates nothing. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model.h"

/* ---- the model: one array of all values by value reference, one of working memory that begins with the warm start;
 * component.py says what each does. Those that compute return 0 or the number of a message. */
typedef struct {
    int64_t (*memory)(double *values, const double *resources);
    int64_t (*size)(double *values, const double *resources);
    int64_t (*prepare)(double *values, double *work, const double *resources);
    int64_t (*start)(double *values, double *work, const double *resources);
    int64_t (*outputs)(double *values, double *work, double h, const double *resources);
    int64_t (*lazy)(double *values, double *work, const double *resources);
    double (*difference)(double *values, int64_t reference, const double *resources);
    int64_t (*field)(double *values, double *work, int64_t k, const double *resources);
} Model;

/* ---- the table */
typedef enum {
    REAL = 1,
    INTEGER = 2,
    ENUMERATION = 4,
    BOOLEAN = 8,
    COUNT = 16 /* INTEGER that fields have their size from: in FMI 3.0 a structural parameter */
} Kind;
typedef enum {
    PARAMETER = 1,
    INPUT = 2,
    OUTPUT = 4,
    STATE = 8, /* continuous state, an output as well */
    TOTAL = 16, /* output that adds up, with a start value */
    FIELD = 32, /* output of FMI 3.0, an array as large as the resolution makes it */
    TIME = 64,  /* in FMI 3.0 a variable as well */
    ACCUMULATED = 128 /* output that adds up without being a value: these are the end of the warm start, if it has them */
} Role;
#define ANY_OUTPUT (OUTPUT | STATE | TOTAL | ACCUMULATED)
typedef uint32_t Reference;

typedef struct {
    const char *name;
    Kind kind;
    Role role;
    size_t size; /* of the array that begins here, 1 for a scalar, 0 within an array; of a field see FIELD_SIZE */
    bool lazy;   /* computed by model_lazy when somebody reads it */
    bool open_minimum;
    double start, minimum, maximum;
} Variable;

/* First those with a number in `values`, then those that accumulate: an array has one variable for each in FMI 2.0, one for
 * all in FMI 3.0. */
extern const Variable variables[N_VALUES + N_ACCUMULATED + N_FIELDS + 1];

/* Continuous states: value references of one and of its derivative, and its nominal value. */
typedef struct {
    int value, derivative;
    double nominal;
} Continuous;

extern const Continuous states[N_STATES];

/* Files in resources/ that an instance reads, and how each begins. */
typedef struct {
    const char *name;
    char magic[9];
} Resource;

extern const Resource resources[N_RESOURCES];

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

/* ---- FMI's state machine; a step is done when the call returns, so there is no state for one in progress */
typedef enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    EVENT = 4,           /* model exchange */
    CONTINUOUS = 8,      /* model exchange */
    STEP_COMPLETE = 16,  /* co-simulation */
    STEP_FAILED = 32,    /* co-simulation; the discarded step has changed nothing and may be tried again */
    TERMINATED = 64,
    BROKEN = 128,        /* out of memory: only reset, restore and free remain */
    CONFIGURATION = 256  /* FMI 3.0: structural parameters can be set */
} Phase;

#define RUNNING (EVENT | CONTINUOUS | STEP_COMPLETE | STEP_FAILED)
#define ANY (INSTANTIATED | CONFIGURATION | INITIALIZATION | RUNNING | TERMINATED | BROKEN)

typedef enum { MODEL_EXCHANGE, CO_SIMULATION } Type; /* the numbers of fmi2Type */
typedef enum { OK, WARNING, DISCARD, ERROR } Status; /* the numbers of fmi2Status and fmi3Status */

/* Where messages go: the host's function, of the type that its version of FMI has, and who calls it. Copied, as the host's
 * structure may be gone after the instance is made. */
typedef struct Log {
    void (*write)(const struct Log *log, const char *name, Status status, const char *category, char *message);
    void (*logger)(void);
    void *environment;
} Log;

/* What an instance is, besides its memory: all of an FMU state, copied byte by byte. */
typedef struct {
    double values[N_VALUES];
    double solved[N_VALUES]; /* the values that the outputs belong to */
    double time, stop_time;
    double accepted_time, accepted[N_TOTALS]; /* model exchange: where the totals have been added up to, their rates there */
    int64_t phase;
    int64_t is_new;     /* something was set since the outputs were computed */
    int64_t lazy_stale; /* the lazy outputs belong to older values */
    int64_t last_step;  /* Status of the last step */
    int64_t said;       /* number of the last warning, which is not repeated while it lasts */
} Content;

typedef struct {
    Content is;
    double *memory; /* twice memory_size numbers: the warm start of the next step, then that which the outputs are from */
    int64_t memory_size;
    double *resources;       /* of each its number of points n, then n numbers each of three columns; NULL if there are none */
    uint64_t resources_hash; /* tells instances with other resources apart */
    double *work;        /* at the beginning of a cache line: vectors are loaded in one piece */
    void *work_block;    /* in which it lies */
    bool work_is_solved; /* and not used for anything else since */
    double prepared[N_VALUES]; /* parameters that `work` is laid out and filled for; a negative first one: none */
    const Model *model; /* compiled for this processor; the results are the same */
    Type type;
    bool arrays; /* FMI 3.0: value references stand for arrays */
    char *name;
    int categories;
    Log log;
} Instance;

/* Every function that a host calls is told its name there, for messages. */
#define REQUIRE(instance, function, phases) \
    do { \
        if (!(instance)) return ERROR; \
        if (!((instance)->is.phase & (phases))) return refuse(instance, function); \
    } while (0)

/* lifecycle.c */
Status report(const Instance *instance, Category category, const char *format, ...);
Status refuse(const Instance *instance, const char *function);
Status choose_log(Instance *instance, const char *function, bool on, size_t n, const char *const names[]);
Instance *instantiate(Type type, bool arrays, const char *name, const char *guid, const char *folder, const Log *log,
                      bool logging);
void release(Instance *instance);
Status set_up(Instance *instance, const char *function, double start, bool has_stop, double stop);
Status enter_configuration(Instance *instance, const char *function);
Status exit_configuration(Instance *instance, const char *function);
Status enter_initialization(Instance *instance, const char *function);
Status exit_initialization(Instance *instance, const char *function);
Status terminate(Instance *instance, const char *function);
Status reset(Instance *instance, const char *function);

/* resources.c; a folder is a path, a location is an URI, and its path is to be freed */
char *path_of(const char *location);
bool load_resources(Instance *instance, const char *folder);

/* state.c */
uint64_t hash(const void *content, size_t size);

/* variables.c: the first two check what is about to be copied, n references that stand for n_values numbers of these kinds */
Status before_get(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds, size_t n_values);
Status before_set(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds, size_t n_values);
size_t extent(const Instance *instance, Reference reference);
const double *numbers(const Instance *instance, Reference reference);
Status derivative(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
                  const Reference knowns[], size_t n_knowns, const double seed[], size_t n_seed, double result[],
                  size_t n_result);

/* simulate.c */
Status do_step(Instance *instance, const char *function, double time, double h);
Status enter_event(Instance *instance, const char *function);
Status update_discrete(Instance *instance, const char *function);
Status enter_continuous(Instance *instance, const char *function);
Status completed_step(Instance *instance, const char *function);
Status set_time(Instance *instance, const char *function, double time);
Status set_states(Instance *instance, const char *function, const double x[], size_t n);
Status get_states(Instance *instance, const char *function, double x[], size_t n);
Status get_derivatives(Instance *instance, const char *function, double derivatives[], size_t n);
Status get_nominals(Instance *instance, const char *function, double nominals[], size_t n);
Status get_indicators(Instance *instance, const char *function, size_t n);
Status count_of(const Instance *instance, const char *function, size_t there_are, size_t *n);

/* state.c */
Status get_state(Instance *instance, const char *function, void **target);
Status set_state(Instance *instance, const char *function, const void *source);
Status free_state(Instance *instance, const char *function, void **state);
Status state_size(Instance *instance, const char *function, const void *state, size_t *size);
Status serialize(Instance *instance, const char *function, void *source, void *bytes, size_t size);
Status deserialize(Instance *instance, const char *function, const void *bytes, size_t size, void **target);

/* evaluate.c: compute in place; on anything but OK the content is as it was */
bool in_range(const Variable *variable, double value);
Status check_ranges(const Instance *instance);
Status prepare(Instance *instance);
int64_t evaluate(const Instance *instance, double *values, double h); /* leaves the content alone, not working memory */
Status update(Instance *instance, double h, bool warm);
void accumulate(Instance *instance);
Status update_lazy(Instance *instance);
Status update_work(Instance *instance);
void free_work(Instance *instance);
Status refresh(Instance *instance);

#endif
