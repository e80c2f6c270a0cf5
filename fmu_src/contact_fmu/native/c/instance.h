/* One instance of an FMU. Its model is data: resources/model.bin has the variables, totals and messages, and says
 * which kernels compute it (table.c). So this code, with all kernels, is one library for every FMU. fmi2.c and fmi3.c only
 * translate. The other files define what a call does and when it is legal.
 *
 * There is no writable data outside an instance, so each instance may run in its own thread. Memory is allocated when an
 * instance is made, when its resolution is set and when a state is saved. A step allocates nothing. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "build.h"
#include "names.h"

/* ---- the kernels of one kind of model. They take one array of all values, indexed by value reference, and one of working
 * memory, which begins with the warm start; then the files in resources/ and the numbers of the model. component.py documents
 * each function. Those that compute return 0 or the number of a message. */
typedef struct {
    const char *kind;
    int64_t (*memory)(double *values, const double *resources, const double *own);
    int64_t (*size)(double *values, const double *resources, const double *own);
    int64_t (*prepare)(double *values, double *work, const double *resources, const double *own);
    int64_t (*outputs)(double *values, double *work, double h, const double *resources, const double *own);
    int64_t (*lazy)(double *values, double *work, const double *resources, const double *own);
    int64_t (*jacobian)(double *values, double *work, const double *resources, const double *own);
    double (*difference)(double *values, int64_t reference, const double *resources, const double *own);
    int64_t (*field)(double *values, double *work, int64_t k, const double *resources, const double *own);
} Kernels;

/* ---- the table: structs of 8-byte members, as they lie in model.bin. A text is its place among the texts. */
typedef enum {
    REAL = 1,
    INTEGER = 2,
    ENUMERATION = 4,
    BOOLEAN = 8,
    COUNT = 16 /* INTEGER that sets the size of fields: a structural parameter in FMI 3.0 */
} Kind;
typedef enum {
    PARAMETER = 1,
    INPUT = 2,
    OUTPUT = 4,
    TOTAL = 16, /* output that is integrated over time, with a start value */
    FIELD = 32, /* output of FMI 3.0, an array whose size depends on the resolution */
    TIME = 64,  /* a variable only in FMI 3.0 */
    TUNABLE = 256, /* with PARAMETER: may change between steps and in event mode */
    ACCUMULATED = 128 /* output that adds up and is not in `values`: at the end of the warm start, if anything accumulates */
} Role;
#define ANY_OUTPUT (OUTPUT | TOTAL | ACCUMULATED)
typedef uint32_t Reference;

/* A value that is used only with some items of an enumeration, a bit for each; without bits it is always used. */
typedef struct {
    int64_t enumeration, items;
} Use;
enum { MOST_USES = 2 };

typedef struct {
    uint64_t name;
    int64_t kind, role; /* Kind, Role */
    uint64_t size; /* size of the array that begins here, 1 for a scalar, 0 within an array; for fields see field_size */
    int64_t lazy;  /* computed by the kernel `lazy` only when a host reads it */
    int64_t open_minimum;
    double start, minimum, maximum;
    Use used[MOST_USES];
} Variable;

/* A file in resources/ that an instance reads, the bytes with which it begins, its number of rows and most points of a row. */
typedef struct {
    uint64_t name;
    char magic[8];
    int64_t rows, most;
} Resource;

/* An output that is integrated over time, by a rate, over the way by a speed of either sign, or by both multiplied.
 * What is missing is NONE. */
typedef struct {
    int64_t total, rate, speed;
} Total;

/* A variable that stands for another one, whose type some hosts do not know. A choice that is not 0 is the value of its
 * enumeration. A mirror is an output that shows a local variable as a Real. */
typedef struct {
    int64_t twin, of;
} Twin;

/* A message of the model, by number: a warning or the reason to discard a step, of a value if it is one's. There is no text if
 * there is nothing to log. */
typedef enum { LOG_WARNING = 1, LOG_DISCARD = 2, LOG_ERROR = 4 } Category;
typedef struct {
    int64_t category; /* Category, or 0 */
    uint64_t text;
    int64_t value; /* or NONE */
} Message;

/* A number that is allowed but not usual: the value, of an array any of its n ones, or, of a wheel that moves, the slip
 * 1 + value * factor / other. Zero is usual. */
typedef struct {
    int64_t value, n, other, factor;
    double least, largest; /* magnitudes */
    uint64_t text;
} Doubt;
enum { MOST_DOUBTS = 64 };
#define SLOWEST 1e-3 /* speed [m/s] below which a wheel stands, so its slip says nothing */

/* How model.bin begins, after its magic bytes and its checksum. */
typedef struct {
    uint64_t bytes; /* of the file from here on */
    uint64_t guid, name, kind; /* texts */
    uint64_t n_values, n_accumulated, n_fields, n_parameters, n_messages, n_totals, n_choices, n_mirrors, n_resources;
    uint64_t n_derived, n_derived_by; /* rows and columns of the matrix of derivatives that the kernels know */
    uint64_t n_doubts;
    int64_t accumulates; /* enumeration: nothing accumulates with its first item; or NONE */
    int64_t field_factor, field_by[2]; /* size of a field: this number times two parameters, or NONE */
    uint64_t n_own, n_text; /* numbers for the kernels; bytes of all texts */
} Head;
enum { NONE = -1 };

/* The content of model.bin. First the variables in `values`, then those that accumulate, then fields and time. In FMI 2.0
 * each element of an array is a variable, in FMI 3.0 the whole array is one. */
typedef struct {
    double *block; /* all of it */
    const Head *head;
    const Variable *variables;
    const Message *messages; /* one more than n_messages, by number */
    const Total *totals;
    const Twin *choices, *mirrors;
    const Resource *resources;
    const int64_t *derived, *derived_by; /* value references */
    const Doubt *doubts;
    const double *own;
    const char *text;
} Table;

/* In functions with an `instance`: a number of its table, and one of its texts. */
#define N(what) (instance->table.head->n_##what)
#define TEXT(place) (instance->table.text + (place))

/* ---- FMI's state machine. A step is complete when the call returns, so there is no state for a step in progress. */
typedef enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    EVENT = 4,           /* model exchange */
    CONTINUOUS = 8,      /* model exchange */
    STEP_COMPLETE = 16,  /* co-simulation */
    STEP_FAILED = 32,    /* co-simulation: the discarded step has changed nothing and may be repeated */
    TERMINATED = 64,
    BROKEN = 128,        /* out of memory: only reset, restore and free are legal */
    CONFIGURATION = 256  /* FMI 3.0: structural parameters can be set */
} Phase;

#define RUNNING (EVENT | CONTINUOUS | STEP_COMPLETE | STEP_FAILED)
#define ANY (INSTANTIATED | CONFIGURATION | INITIALIZATION | RUNNING | TERMINATED | BROKEN)

typedef enum { MODEL_EXCHANGE, CO_SIMULATION } Type; /* the numbers of fmi2Type */
typedef enum { OK, WARNING, DISCARD, ERROR } Status; /* the numbers of fmi2Status and fmi3Status */

/* Destination of messages: the host's function, with the type of its version of FMI, and the caller. This is a copy, since the
 * host may free its structure after the instance is made. */
typedef struct Log {
    void (*write)(const struct Log *log, const char *name, Status status, const char *category, char *message);
    void (*logger)(void);
    void *environment;
} Log;

/* The content of an instance without its arrays. An FMU state copies all of it byte by byte. */
typedef struct {
    double time, stop_time;
    double accepted_time; /* model exchange: totals are integrated up to this time */
    int64_t phase;
    int64_t is_new;     /* a value was set after the outputs were computed */
    int64_t lazy_stale; /* the lazy outputs are out of date */
    int64_t last_step;  /* Status of the last step */
    int64_t said;       /* number of the last warning; it is logged once while it lasts */
} Content;

typedef struct {
    Content is;
    Table table;
    double *values; /* begins the block of these arrays; a state has the first three */
    double *solved; /* the values for which the outputs were computed */
    double *accepted; /* model exchange: rates of the totals at accepted_time */
    double *prepared; /* parameters for which `work` is laid out and filled; none if the first one is negative */
    double *before, *other, *rest; /* values within a call */
    double *slopes, *slopes_at; /* the matrix of derivatives, and the values at which it was computed */
    bool has_slopes;
    double *nothing; /* zeros in place of what accumulates */
    double *memory; /* warm start of the next step, then that of the present outputs if they are computed again on reading */
    int64_t memory_size, starts; /* numbers of one start; how many there are, 1 or 2 */
    double *resources;       /* for each file: number of points n, then its rows of n numbers; NULL if there are none */
    uint64_t resources_hash; /* identifies the resources: a state of other resources is refused */
    double *work;        /* begins at a cache line, so that vectors are loaded at once */
    void *work_block;    /* allocated block that contains `work` */
    bool work_is_solved; /* `work` still belongs to the outputs */
    const Kernels *kernels; /* kernels for this processor; the results are the same for all */
    Type type;
    bool arrays; /* FMI 3.0: a value reference denotes a whole array */
    char name[256]; /* a longer name is cut */
    int categories;
    uint64_t doubted; /* a bit for each doubt that was logged */
    Log log;
} Instance;

/* The functions below get the FMI name of the calling function, for messages. */
#define REQUIRE(instance, function, phases) \
    do { \
        if (!(instance)) return ERROR; \
        if (!((instance)->is.phase & (phases))) return refuse(instance, function); \
    } while (0)

/* Refuse a call with a NULL among its instance and its pointers; it has changed nothing. An array of no elements may be NULL. */
#define REFUSE_NULL(instance, error, ...) \
    do { \
        const void *const pointers[] = {__VA_ARGS__}; \
        if (has_null(instance, __func__, pointers, sizeof pointers / sizeof *pointers)) return error; \
    } while (0)
#define IF(n, array) ((n) ? (const void *)(array) : (const void *)"")

/* lifecycle.c */
const Kernels *kernels_of(const char *kind);
bool has_null(const Instance *instance, const char *function, const void *const pointers[], size_t n);
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

/* resources.c; a folder is a path */
FILE *open_resource(const Instance *instance, const char *folder, const char *name);
bool load_resources(Instance *instance, const char *folder);

/* table.c */
bool load_table(Instance *instance, const char *folder);
size_t field_size(const Instance *instance, const double *values);
size_t kept_numbers(const Instance *instance); /* values, solved and accepted */

/* state.c */
uint64_t hash(const void *content, size_t size);

/* variables.c: the first two check n references, which must denote n_values numbers of these kinds, before a copy */
Status before_get(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds, size_t n_values);
Status before_set(Instance *instance, const char *function, const Reference refs[], size_t n, int kinds, size_t n_values);
size_t extent(const Instance *instance, Reference reference);
const double *numbers(const Instance *instance, Reference reference);
const double *numbers_of(const Instance *instance, double *values, Reference reference);
Status check_references(const Instance *instance, const Reference refs[], size_t n, int kinds, int roles, size_t n_values,
                        const char *function);

/* derivatives.c */
Status derivative(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
                  const Reference knowns[], size_t n_knowns, const double seed[], size_t n_seed, double result[],
                  size_t n_result);

Status adjoint(Instance *instance, const char *function, const Reference unknowns[], size_t n_unknowns,
               const Reference knowns[], size_t n_knowns, const double seed[], size_t n_seed, double result[],
               size_t n_result);

/* simulate.c */
Status do_step(Instance *instance, const char *function, double time, double h);
Status enter_event(Instance *instance, const char *function);
Status update_discrete(Instance *instance, const char *function);
Status enter_continuous(Instance *instance, const char *function);
Status completed_step(Instance *instance, const char *function);
Status set_time(Instance *instance, const char *function, double time);
Status set_none(Instance *instance, const char *function, size_t n);
Status get_none(Instance *instance, const char *function, size_t n);
Status count_none(const Instance *instance, const char *function, size_t *n);

/* state.c */
Status get_state(Instance *instance, const char *function, void **target);
Status set_state(Instance *instance, const char *function, const void *source);
Status free_state(Instance *instance, const char *function, void **state);
Status state_size(Instance *instance, const char *function, const void *state, size_t *size);
Status serialize(Instance *instance, const char *function, void *source, void *bytes, size_t size);
Status deserialize(Instance *instance, const char *function, const void *bytes, size_t size, void **target);

/* evaluate.c: compute in place; unless the status is OK, the content is unchanged */
void choose(const Instance *instance, double *values);
void show_mirrored(const Instance *instance, double *values);
bool in_range(const Variable *variable, double value);
bool is_allowed(const Instance *instance, size_t i, const double *values);
Status check_ranges(const Instance *instance, const double *values, size_t n);
Status prepare(Instance *instance, double *values);
bool has_failed(const Instance *instance, int64_t number); /* whether the number of a message means that nothing was computed */
Status say(const Instance *instance, int64_t number);
Status tell_doubts(Instance *instance);
int64_t evaluate(const Instance *instance, double *values, double h); /* does not change the content, but uses working memory */
Status update(Instance *instance, double h, bool warm);
void accumulate(Instance *instance);
Status update_lazy(Instance *instance);
Status update_work(Instance *instance);
void free_work(Instance *instance);
Status refresh(Instance *instance);

#endif
