/* FMU states: the content and the warm start in one block, which is also its serialised form. */
#include <stdlib.h>
#include <string.h>

#include "instance.h"

typedef struct {
    char guid[sizeof MODEL_GUID];
    uint64_t checksum; /* of everything behind it */
    int64_t size;      /* of the whole block in bytes */
    int64_t type;
    int64_t memory_size;
    Content is;
    double memory[];
} State;

static uint64_t checksum(const State *state)
{
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    const unsigned char *from = (const unsigned char *)&state->size, *to = (const unsigned char *)state + state->size;
    while (from < to) hash = (hash ^ *from++) * 1099511628211u;
    return hash;
}

static size_t size_with(int64_t memory_size) { return sizeof(State) + (size_t)memory_size * sizeof(double); }

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *target)
{
    Instance *instance = c;
    size_t size;
    State *state;
    REQUIRE(instance, "fmi2GetFMUstate", ANY);
    if (!target) return report(instance, LOG_ERROR, "fmi2GetFMUstate: no place for the state is given");
    size = size_with(instance->memory_size);
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
    state->memory_size = instance->memory_size;
    state->is = instance->is;
    if (instance->memory) memcpy(state->memory, instance->memory, size - sizeof *state);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate source)
{
    Instance *instance = c;
    const State *state = source;
    REQUIRE(instance, "fmi2SetFMUstate", ANY);
    if (!state) return report(instance, LOG_ERROR, "fmi2SetFMUstate: no state is given");
    if (state->type != (int64_t)instance->type)
        return report(instance, LOG_ERROR, "fmi2SetFMUstate: the state is of the other kind of FMU");
    if (state->memory_size != instance->memory_size) {
        double *memory = malloc((size_t)state->memory_size * sizeof(double) + 1);
        if (!memory) return report(instance, LOG_ERROR, "out of memory");
        free(instance->memory);
        instance->memory = memory;
        instance->memory_size = state->memory_size;
        free(instance->work); /* laid out for another memory */
        instance->work = NULL;
    }
    instance->is = state->is;
    if (instance->memory) memcpy(instance->memory, state->memory, (size_t)state->memory_size * sizeof(double));
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2FreeFMUstate", ANY);
    if (state) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2SerializedFMUstateSize", ANY);
    if (!state || !size) return report(instance, LOG_ERROR, "fmi2SerializedFMUstateSize: no state is given");
    *size = (size_t)((State *)state)->size;
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate source, fmi2Byte bytes[], size_t size)
{
    Instance *instance = c;
    State *state = source;
    REQUIRE(instance, "fmi2SerializeFMUstate", ANY);
    if (!state || !bytes || size < (size_t)state->size)
        return report(instance, LOG_ERROR, "fmi2SerializeFMUstate: no state, or too few bytes for it");
    state->checksum = checksum(state);
    memcpy(bytes, state, (size_t)state->size);
    return fmi2OK;
}

/* Bytes of another build, cut short or damaged are refused. */
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *target)
{
    Instance *instance = c;
    State *state;
    bool valid;
    REQUIRE(instance, "fmi2DeSerializeFMUstate", ANY);
    if (!bytes || !target || size < sizeof *state)
        return report(instance, LOG_ERROR, "fmi2DeSerializeFMUstate: these bytes are no state of this FMU");
    state = malloc(size);
    if (!state) return report(instance, LOG_ERROR, "out of memory");
    memcpy(state, bytes, size);
    valid = !memcmp(state->guid, MODEL_GUID, sizeof MODEL_GUID) && state->size >= (int64_t)sizeof *state &&
            (uint64_t)state->size <= size && state->memory_size >= 0 &&
            state->memory_size == (state->size - (int64_t)sizeof *state) / (int64_t)sizeof(double) &&
            state->checksum == checksum(state);
    if (!valid) {
        free(state);
        return report(instance, LOG_ERROR, "fmi2DeSerializeFMUstate: these bytes are no state of this FMU");
    }
    free(*target);
    *target = state;
    return fmi2OK;
}
