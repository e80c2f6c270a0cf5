/* A host in the same program as the FMU's sources, as on a target for hardware in the loop: no files, no loader.
 * It makes three steps with the start values and prints the value of each reference in the arguments, exactly. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2Functions.h"

static void say(void *environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...)
{
    va_list arguments;
    (void)environment, (void)name, (void)status, (void)category;
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
}

int main(int count, char **words)
{
    const fmi2CallbackFunctions functions = {say, calloc, free, NULL, NULL};
    fmi2Component c = fmi2Instantiate("embedded", fmi2CoSimulation, MODEL_GUID, count > 1 ? words[1] : "", &functions, 0, 0);
    if (!c || fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) || fmi2EnterInitializationMode(c)) return 1;
    if (fmi2ExitInitializationMode(c)) return 2;
    for (int i = 0; i < 3; i++)
        if (fmi2DoStep(c, 1e-3 * i, 1e-3, 0) > fmi2Warning) return 3;
    for (int i = 2; i < count; i++) {
        fmi2ValueReference reference = (fmi2ValueReference)strtoul(words[i], NULL, 10);
        fmi2Real value;
        if (fmi2GetReal(c, &reference, 1, &value)) return 4;
        printf("%a\n", value);
    }
    fmi2FreeInstance(c);
    return 0;
}
