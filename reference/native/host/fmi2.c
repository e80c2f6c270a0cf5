/* Code shared by the commands, and main. */
#include "fmi2.h"

#define DEFINE(f) fmi2##f##TYPE *f;
FUNCTIONS(DEFINE)

void use(void *library, const char *its_guid, const char *its_resources)
{
    guid = its_guid, resources = its_resources;
#define FIND(f) \
    if (!(f = (fmi2##f##TYPE *)find(library, "fmi2" #f))) puts("fmi2" #f " is missing"), exit(2);
    FUNCTIONS(FIND)
}

LOGGER(logger)
{
    (void)environment, (void)instance, (void)status, (void)category;
    messages++;
    snprintf(last_message, sizeof last_message, "%s", message);
}

LOGGER(quiet)
{
    (void)environment, (void)instance, (void)status, (void)category, (void)message;
}

fmi2Component make(fmi2Type type, fmi2CallbackLogger log)
{
    fmi2CallbackFunctions callbacks = {log, NULL, NULL, NULL, NULL};
    fmi2Component c = Instantiate("instance", type, guid, resources, &callbacks, fmi2False, fmi2True);
    memset((void *)&callbacks, 0, sizeof callbacks);
    return c;
}

fmi2Component running(fmi2CallbackLogger log)
{
    fmi2Component c = make(fmi2CoSimulation, log);
    SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    EnterInitializationMode(c);
    ExitInitializationMode(c);
    return c;
}

fmi2Status set_real(fmi2Component c, fmi2ValueReference r, double value) { return SetReal(c, &r, 1, &value); }
fmi2Status set_integer(fmi2Component c, fmi2ValueReference r, int value) { return SetInteger(c, &r, 1, &value); }

double real(fmi2Component c, fmi2ValueReference r)
{
    double value = NAN;
    GetReal(c, &r, 1, &value);
    return value;
}

int whole(fmi2Component c, fmi2ValueReference r)
{
    fmi2Integer value = -1;
    GetInteger(c, &r, 1, &value);
    return value;
}

void coarsen(fmi2Component c)
{
    static const fmi2ValueReference resolution[] = RESOLUTION;
    static const fmi2Integer least[] = COARSEST;
    SetInteger(c, resolution, sizeof resolution / sizeof *resolution, least);
}

double reached(fmi2Component c)
{
    double time = 0.0;
    return GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK ? time : 0.0;
}

double any(fmi2Component c, fmi2ValueReference r)
{
    double value;
    return GetReal(c, &r, 1, &value) > fmi2Warning ? whole(c, r) : value;
}

/* LIBRARY GUID RESOURCES COMMAND NUMBER [PATH GUID RESOURCES | NUMBER]. Failures are printed and set the exit code. */
int main(int n_arguments, char **arguments)
{
    double begin = now();
    void *library = n_arguments > 5 ? open_library(arguments[1]) : NULL;
    const char *command = n_arguments > 5 ? arguments[4] : "", *path = n_arguments > 6 ? arguments[6] : "";
    int number = n_arguments > 5 ? atoi(arguments[5]) : 0;
    if (!library) return puts("the library cannot be loaded"), 2;
    use(library, arguments[2], arguments[3]);
    if (!strcmp(command, "instantiate")) instantiate();
    else if (!strcmp(command, "every_call")) every_call();
    else if (!strcmp(command, "fuzz")) fuzz(number);
    else if (!strcmp(command, "status_functions")) status_functions();
    else if (!strcmp(command, "log_categories")) log_categories();
    else if (!strcmp(command, "threads")) threads();
    else if (!strcmp(command, "soak")) soak(number, atoi(path));
    else if (!strcmp(command, "two_libraries") && n_arguments > 8)
        two_libraries(library, path, arguments[7], arguments[8]);
    else if (!strcmp(command, "first_step")) first_step(begin);
    else if (!strcmp(command, "speed")) speed(number, path);
    else return printf("%s is not a command\n", command), 2;
    return failures != 0;
}
