/* A C host that executes commands from standard input: script LIBRARY GUID KIND RESOURCES… (0 model exchange, 1 co-simulation).
 * It makes an instance for each location of the resources, and goes on with the last one.
 * Each line is a letter, a value reference or a count, and numbers: s REFERENCE VALUE sets a Real, n an Integer,
 * g REFERENCE prints a Real, d TIME STEP does a step, t TIME sets the time. i initialises; parameters are set before it. r resets. */
#include "common.h"
#include "fmi2FunctionTypes.h"

#define FIND(type, name) type *name = (type *)find(library, "fmi2" #name)
#define DO(call) \
    do { \
        if ((call) > fmi2Warning) return printf("%s\n", #call), 1; \
    } while (0)

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment, (void)instance, (void)status, (void)category;
    puts(message);
}

int main(int n_arguments, char **arguments)
{
    if (n_arguments < 5) return puts("script LIBRARY GUID KIND RESOURCES…"), 2;
    void *library = open_library(arguments[1]);
    if (!library) return puts("the library cannot be loaded"), 2;
    FIND(fmi2InstantiateTYPE, Instantiate);
    FIND(fmi2SetupExperimentTYPE, SetupExperiment);
    FIND(fmi2EnterInitializationModeTYPE, EnterInitializationMode);
    FIND(fmi2ExitInitializationModeTYPE, ExitInitializationMode);
    FIND(fmi2EnterContinuousTimeModeTYPE, EnterContinuousTimeMode);
    FIND(fmi2SetRealTYPE, SetReal);
    FIND(fmi2SetIntegerTYPE, SetInteger);
    FIND(fmi2ResetTYPE, Reset);
    FIND(fmi2GetRealTYPE, GetReal);
    FIND(fmi2DoStepTYPE, DoStep);
    FIND(fmi2SetTimeTYPE, SetTime);
    FIND(fmi2FreeInstanceTYPE, FreeInstance);

    fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    fmi2Component c = NULL;
    for (int i = 4; i < n_arguments; i++) {
        if (c) FreeInstance(c);
        c = Instantiate("instance", (fmi2Type)atoi(arguments[3]), arguments[2], arguments[i], &callbacks, 0, 1);
    }
    if (!c) return 1;
    char letter;
    while (scanf(" %c", &letter) == 1) {
        unsigned n = 0;
        int whole = 0;
        double a = 0.0, b = 0.0;
        if (letter == 'i') {
            DO(SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0));
            DO(EnterInitializationMode(c));
            DO(ExitInitializationMode(c));
            if (atoi(arguments[3]) == fmi2ModelExchange) DO(EnterContinuousTimeMode(c));
        } else if (letter == 's' && scanf("%u %lf", &n, &a) == 2) {
            DO(SetReal(c, &n, 1, &a));
        } else if (letter == 'n' && scanf("%u %d", &n, &whole) == 2) {
            DO(SetInteger(c, &n, 1, &whole));
        } else if (letter == 'r') {
            DO(Reset(c));
        } else if (letter == 'g' && scanf("%u", &n) == 1) {
            DO(GetReal(c, &n, 1, &a));
            printf("%.17g\n", a);
        } else if (letter == 'd' && scanf("%lf %lf", &a, &b) == 2) {
            DO(DoStep(c, a, b, fmi2True));
        } else if (letter == 't' && scanf("%lf", &a) == 1) {
            DO(SetTime(c, a));
        } else {
            return printf("%c is not a command\n", letter), 2;
        }
    }
    FreeInstance(c);
    return 0;
}
