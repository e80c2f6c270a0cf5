/* FMUs linked into one program, as on a target for hardware in the loop: no loader. FMUS(DO) lists their names, with which those
 * of their functions begin. Each makes three steps with its start values, in turn. The program prints the values of their
 * references, exactly. Arguments: for each FMU its guid, its resources, the number of references, and these. */
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

#define FUNCTIONS(fmu) \
    fmi2InstantiateTYPE fmu##_fmi2Instantiate; \
    fmi2SetupExperimentTYPE fmu##_fmi2SetupExperiment; \
    fmi2EnterInitializationModeTYPE fmu##_fmi2EnterInitializationMode; \
    fmi2ExitInitializationModeTYPE fmu##_fmi2ExitInitializationMode; \
    fmi2DoStepTYPE fmu##_fmi2DoStep; \
    fmi2GetRealTYPE fmu##_fmi2GetReal; \
    fmi2FreeInstanceTYPE fmu##_fmi2FreeInstance;
FMUS(FUNCTIONS)

static void say(void *environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)name, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

#define COUNT(fmu) +1
static fmi2Component made[FMUS(COUNT)];

#define START(fmu) \
    c = *one++ = fmu##_fmi2Instantiate("linked", fmi2CoSimulation, words[0], words[1], &functions, 0, 0); \
    if (!c || fmu##_fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0)) return 1; \
    if (fmu##_fmi2EnterInitializationMode(c) || fmu##_fmi2ExitInitializationMode(c)) return 2; \
    words += 3 + atoi(words[2]);
#define STEP(fmu) \
    if (fmu##_fmi2DoStep(*one++, 1e-3 * i, 1e-3, 0) > fmi2Warning) return 3;
#define PRINT(fmu) \
    for (int i = 0; i < atoi(words[2]); i++) { \
        fmi2ValueReference reference = (fmi2ValueReference)strtoul(words[3 + i], NULL, 10); \
        fmi2Real value; \
        if (fmu##_fmi2GetReal(*one, &reference, 1, &value)) return 4; \
        printf("%a\n", value); \
    } \
    fmu##_fmi2FreeInstance(*one++); \
    words += 3 + atoi(words[2]);

int main(int count, char **arguments)
{
    const fmi2CallbackFunctions functions = {say, calloc, free, NULL, NULL};
    char **words = arguments + 1;
    fmi2Component c, *one = made;
    (void)count;
    FMUS(START)
    for (int i = 0; i < 3; i++) {
        one = made;
        FMUS(STEP)
    }
    words = arguments + 1, one = made;
    FMUS(PRINT)
    return 0;
}
