/* FMU states: content and warm start in one block. The block is also the serialised form. A host may pass any block, so what
 * could break the kernels is checked: whose state it is, its sizes, its phase, and that outputs belong to allowed values. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"

enum { GUID_ROOM = 40 }; /* with zeros after the guid */

typedef struct {
    char guid[GUID_ROOM]; /* first, since a state of another FMU may be shorter than this one */
    uint64_t checksum; /* of all bytes after it, written when it is serialised */
    int64_t size;      /* of the whole block in bytes */
    int64_t type;
    uint64_t resources_hash;
    int64_t memory_size;
    Content is;
    double numbers[]; /* values, solved, accepted; then the warm starts */
} State;

uint64_t hash(const void *content, size_t size)
{
    uint64_t value = 14695981039346656037u; /* FNV-1a */
    const unsigned char *from = content, *to = from + size;
    while (from < to) value = (value ^ *from++) * 1099511628211u;
    return value;
}

static uint64_t checksum(const State *state)
{
    return hash(&state->size, (size_t)state->size - offsetof(State, size));
}

static size_t memory_bytes(const Instance *instance, int64_t memory_size)
{
    return (size_t)(instance->starts * memory_size) * sizeof(double);
}
static size_t state_bytes(const Instance *instance, int64_t memory_size)
{
    return sizeof(State) + kept_numbers(instance) * sizeof(double) + memory_bytes(instance, memory_size);
}

static bool is_ours(const Instance *instance, const State *state)
{
    char own[GUID_ROOM]; /* zeros after the guid, which the checksum does not cover */
    strncpy(own, TEXT(instance->table.head->guid), GUID_ROOM);
    return !memcmp(state->guid, own, GUID_ROOM);
}

/* Whether this is a phase of an instance of this type. */
static bool is_phase(int64_t phase, Type type)
{
    const int64_t of_type = type == CO_SIMULATION ? STEP_COMPLETE | STEP_FAILED : EVENT | CONTINUOUS;
    const int64_t all = INSTANTIATED | CONFIGURATION | INITIALIZATION | TERMINATED | BROKEN | of_type;
    return phase > 0 && !(phase & (phase - 1)) && (phase & all) == phase;
}

/* Whether an instance can have this content. Values that the host has just set may be any: the next computation checks them. */
static bool is_possible(const Instance *instance, const State *state)
{
    const Content *is = &state->is;
    const double *values = state->numbers, *solved = values + N(values);
    if (!is_phase(is->phase, instance->type) || is->last_step < OK || is->last_step > ERROR) return false;
    if (is->is_new >> 1 || is->lazy_stale >> 1) return false;
    if (!isfinite(is->time) || !isfinite(is->accepted_time) || isnan(is->stop_time)) return false;
    for (size_t i = 0; i < N(values); i++)
        if (!is_allowed(instance, i, solved) || !(is->is_new || is_allowed(instance, i, values))) return false;
    /* working memory and fields have the size that follows from `values` and are then used with `solved` */
    if (is->is_new && is->phase & (INSTANTIATED | CONFIGURATION | INITIALIZATION)) return true;
    for (size_t i = 0; i < N(parameters); i++)
        if (values[i] != solved[i] && !(is->is_new && instance->table.variables[i].role & TUNABLE)) return false;
    return true;
}

Status get_state(Instance *instance, const char *function, void **target)
{
    size_t size;
    State *state;
    REQUIRE(instance, function, ANY);
    if (!target) return report(instance, LOG_ERROR, "%s: the pointer to the state is NULL", function);
    size = state_bytes(instance, instance->memory_size);
    state = *target;
    if (!state || state->size != (int64_t)size) {
        state = calloc(1, size);
        if (!state) return report(instance, LOG_ERROR, "out of memory");
        free(*target);
    }
    *target = state;
    strncpy(state->guid, TEXT(instance->table.head->guid), GUID_ROOM);
    state->size = (int64_t)size;
    state->type = instance->type;
    state->resources_hash = instance->resources_hash;
    state->memory_size = instance->memory_size;
    state->is = instance->is;
    memcpy(state->numbers, instance->values, kept_numbers(instance) * sizeof(double));
    if (instance->memory)
        memcpy(state->numbers + kept_numbers(instance), instance->memory, memory_bytes(instance, instance->memory_size));
    return OK;
}

Status set_state(Instance *instance, const char *function, const void *source)
{
    const State *state = source;
    REQUIRE(instance, function, ANY);
    if (!state) return report(instance, LOG_ERROR, "%s: the state is NULL", function);
    if (!is_ours(instance, state)) return report(instance, LOG_ERROR, "%s: this is not a state of this FMU", function);
    if (state->type != (int64_t)instance->type)
        return report(instance, LOG_ERROR, "%s: the state is from the other FMI type", function);
    if (state->resources_hash != instance->resources_hash)
        return report(instance, LOG_ERROR, "%s: the state is from an FMU with other files in resources", function);
    if (state->memory_size != instance->memory_size) {
        double *memory = malloc(memory_bytes(instance, state->memory_size) + 1);
        if (!memory) return report(instance, LOG_ERROR, "out of memory");
        free(instance->memory);
        instance->memory = memory;
        instance->memory_size = state->memory_size;
        free_work(instance); /* its layout is for another resolution */
    }
    instance->is = state->is;
    instance->work_is_solved = false;
    memcpy(instance->values, state->numbers, kept_numbers(instance) * sizeof(double));
    if (instance->memory)
        memcpy(instance->memory, state->numbers + kept_numbers(instance), memory_bytes(instance, state->memory_size));
    return OK;
}

Status free_state(Instance *instance, const char *function, void **state)
{
    REQUIRE(instance, function, ANY);
    if (state) {
        free(*state);
        *state = NULL;
    }
    return OK;
}

Status state_size(Instance *instance, const char *function, const void *state, size_t *size)
{
    REQUIRE(instance, function, ANY);
    if (!state || !size) return report(instance, LOG_ERROR, "%s: the state is NULL", function);
    if (!is_ours(instance, state)) return report(instance, LOG_ERROR, "%s: this is not a state of this FMU", function);
    *size = (size_t)((const State *)state)->size;
    return OK;
}

Status serialize(Instance *instance, const char *function, void *source, void *bytes, size_t size)
{
    State *state = source;
    REQUIRE(instance, function, ANY);
    if (!state || !bytes || !is_ours(instance, state) || size < (size_t)state->size)
        return report(instance, LOG_ERROR, "%s: the state is not one of this FMU or the buffer is too small", function);
    state->checksum = checksum(state);
    memcpy(bytes, state, (size_t)state->size);
    return OK;
}

/* Bytes that are from another build, truncated or damaged are refused. */
Status deserialize(Instance *instance, const char *function, const void *bytes, size_t size, void **target)
{
    State *state;
    bool valid;
    REQUIRE(instance, function, ANY);
    if (!bytes || !target || size < sizeof *state)
        return report(instance, LOG_ERROR, "%s: these bytes are not a state of this FMU", function);
    state = malloc(size);
    if (!state) return report(instance, LOG_ERROR, "out of memory");
    memcpy(state, bytes, size);
    valid = is_ours(instance, state) && state->size >= (int64_t)sizeof *state &&
            (uint64_t)state->size <= size && state->memory_size >= 0 && state->memory_size <= state->size &&
            state_bytes(instance, state->memory_size) == (size_t)state->size &&
            state->checksum == checksum(state) && is_possible(instance, state);
    if (!valid) {
        free(state);
        return report(instance, LOG_ERROR, "%s: these bytes are not a state of this FMU", function);
    }
    free(*target);
    *target = state;
    return OK;
}
