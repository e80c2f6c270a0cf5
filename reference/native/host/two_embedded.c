/* Two FMUs linked into one program, as on a target for hardware in the loop. Each has its name before those of its functions.
 * Each makes three steps with its start values, in turn. The program prints the values of their references, exactly.
 * Arguments: for each FMU its guid, its resources, the number of references, and these. ONE and TWO are the FMUs' names. */
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

#define JOIN(a, b) a##b
#define NAME(a, b) JOIN(a, b)
#define FUNCTIONS(fmu) \
    fmi2Component NAME(fmu, _fmi2Instantiate)(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *, \
                                              fmi2Boolean, fmi2Boolean); \
    fmi2Status NAME(fmu, _fmi2SetupExperiment)(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real); \
    fmi2Status NAME(fmu, _fmi2EnterInitializationMode)(fmi2Component); \
    fmi2Status NAME(fmu, _fmi2ExitInitializationMode)(fmi2Component); \
    fmi2Status NAME(fmu, _fmi2DoStep)(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean); \
    fmi2Status NAME(fmu, _fmi2GetReal)(fmi2Component, const fmi2ValueReference *, size_t, fmi2Real *); \
    void NAME(fmu, _fmi2FreeInstance)(fmi2Component);
FUNCTIONS(ONE)
FUNCTIONS(TWO)

static void say(void *environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)name, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

#define START(fmu, c) \
    do { \
        c = NAME(fmu, _fmi2Instantiate)("linked", fmi2CoSimulation, words[0], words[1], &functions, 0, 0); \
        if (!c || NAME(fmu, _fmi2SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0)) return 1; \
        if (NAME(fmu, _fmi2EnterInitializationMode)(c) || NAME(fmu, _fmi2ExitInitializationMode)(c)) return 2; \
        words += 3 + atoi(words[2]); \
    } while (0)

#define PRINT(fmu, c) \
    do { \
        for (int i = 0; i < atoi(words[2]); i++) { \
            fmi2ValueReference reference = (fmi2ValueReference)strtoul(words[3 + i], NULL, 10); \
            fmi2Real value; \
            if (NAME(fmu, _fmi2GetReal)(c, &reference, 1, &value)) return 4; \
            printf("%a\n", value); \
        } \
        NAME(fmu, _fmi2FreeInstance)(c); \
        words += 3 + atoi(words[2]); \
    } while (0)

int main(int count, char **arguments)
{
    const fmi2CallbackFunctions functions = {say, calloc, free, NULL, NULL};
    char **words = arguments + 1;
    fmi2Component one, two;
    (void)count;
    START(ONE, one);
    START(TWO, two);
    for (int i = 0; i < 3; i++) {
        if (NAME(ONE, _fmi2DoStep)(one, 1e-3 * i, 1e-3, 0) > fmi2Warning) return 3;
        if (NAME(TWO, _fmi2DoStep)(two, 1e-3 * i, 1e-3, 0) > fmi2Warning) return 3;
    }
    words = arguments + 1;
    PRINT(ONE, one);
    PRINT(TWO, two);
    return 0;
}
