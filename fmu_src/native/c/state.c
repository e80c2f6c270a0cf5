/* FMU states: content and warm start in one block. The block is also the serialised form. */
#include <stdlib.h>
#include <string.h>

#include "instance.h"

typedef struct {
    uint64_t checksum; /* of all bytes after it */
    char guid[sizeof MODEL_GUID];
    int64_t size;      /* of the whole block in bytes */
    int64_t type;
    uint64_t resources_hash;
    int64_t memory_size;
    Content is;
    double memory[]; /* both warm starts */
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
    return hash(state->guid, (size_t)state->size - offsetof(State, guid));
}

static size_t memory_bytes(int64_t memory_size) { return 2 * (size_t)memory_size * sizeof(double); }

Status get_state(Instance *instance, const char *function, void **target)
{
    size_t size;
    State *state;
    REQUIRE(instance, function, ANY);
    if (!target) return report(instance, LOG_ERROR, "%s: the pointer to the state is NULL", function);
    size = sizeof *state + memory_bytes(instance->memory_size);
    state = *target;
    if (!state || state->size != (int64_t)size) {
        state = calloc(1, size);
        if (!state) return report(instance, LOG_ERROR, "out of memory");
        free(*target);
    }
    *target = state;
    memcpy(state->guid, MODEL_GUID, sizeof MODEL_GUID);
    state->size = (int64_t)size;
    state->type = instance->type;
    state->resources_hash = instance->resources_hash;
    state->memory_size = instance->memory_size;
    state->is = instance->is;
    if (instance->memory) memcpy(state->memory, instance->memory, size - sizeof *state);
    return OK;
}

Status set_state(Instance *instance, const char *function, const void *source)
{
    const State *state = source;
    REQUIRE(instance, function, ANY);
    if (!state) return report(instance, LOG_ERROR, "%s: the state is NULL", function);
    if (state->type != (int64_t)instance->type)
        return report(instance, LOG_ERROR, "%s: the state is from the other FMI type", function);
    if (state->resources_hash != instance->resources_hash)
        return report(instance, LOG_ERROR, "%s: the state is from an FMU with other files in resources", function);
    if (state->memory_size != instance->memory_size) {
        double *memory = malloc(memory_bytes(state->memory_size) + 1);
        if (!memory) return report(instance, LOG_ERROR, "out of memory");
        free(instance->memory);
        instance->memory = memory;
        instance->memory_size = state->memory_size;
        free_work(instance); /* its layout is for another resolution */
    }
    instance->is = state->is;
    instance->work_is_solved = false;
    if (instance->memory) memcpy(instance->memory, state->memory, memory_bytes(state->memory_size));
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
    *size = (size_t)((const State *)state)->size;
    return OK;
}

Status serialize(Instance *instance, const char *function, void *source, void *bytes, size_t size)
{
    State *state = source;
    REQUIRE(instance, function, ANY);
    if (!state || !bytes || size < (size_t)state->size)
        return report(instance, LOG_ERROR, "%s: the state is NULL or the buffer is too small", function);
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
    valid = !memcmp(state->guid, MODEL_GUID, sizeof MODEL_GUID) && state->size >= (int64_t)sizeof *state &&
            (uint64_t)state->size <= size && state->memory_size >= 0 &&
            memory_bytes(state->memory_size) == (size_t)state->size - sizeof *state &&
            state->checksum == checksum(state);
    if (!valid) {
        free(state);
        return report(instance, LOG_ERROR, "%s: these bytes are not a state of this FMU", function);
    }
    free(*target);
    *target = state;
    return OK;
}
