/* What entry.c and system.c share: an instance, and what the system does for it. */
#ifndef ENTRY_H
#define ENTRY_H
#include <stdbool.h>

#include "fmi2Functions.h"

/* The functions of pythonfmu's library. */
#define FUNCTIONS(DO) \
    DO(Instantiate) DO(FreeInstance) DO(SetupExperiment) DO(EnterInitializationMode) DO(ExitInitializationMode) \
    DO(Terminate) DO(Reset) DO(GetReal) DO(GetInteger) DO(GetBoolean) DO(GetString) DO(SetReal) DO(SetInteger) \
    DO(SetBoolean) DO(SetString) DO(GetFMUstate) DO(SetFMUstate) DO(FreeFMUstate) DO(SerializedFMUstateSize) \
    DO(SerializeFMUstate) DO(DeSerializeFMUstate) DO(DoStep) DO(GetRealStatus)
#define MEMBER(name) fmi2##name##TYPE *name;

typedef struct {
    FUNCTIONS(MEMBER)
    fmi2Component slave;
    fmi2CallbackFunctions callbacks; /* of pythonfmu, which keeps a pointer to them */
    fmi2CallbackLogger logger;       /* of the host, which may free its structure */
    fmi2ComponentEnvironment environment;
    int categories;
    fmi2Status worst; /* that was logged in the present call */
    int folder;       /* descriptor of the resources, or -1 */
    char name[256];   /* a longer name is cut */
} Instance;

/* Tell the host a message, unless its category is switched off, and return the status. */
fmi2Status report(Instance *instance, fmi2Status status, const char *format, ...);

/* Return pythonfmu's library, which lies beside this one, or report why it cannot be loaded and return NULL. */
void *open_library(Instance *instance);
/* Return a function of it, or NULL. */
void *find(void *library, const char *name);
/* Return a URI of a folder that pythonfmu understands, or report why there is none and return NULL. */
char *location_for_python(Instance *instance, const char *folder);
#endif
