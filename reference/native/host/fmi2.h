/* A C host for native FMUs (FMI 2.0). It loads a library with local symbols (RTLD_LOCAL) and looks up every function by name.
 * After fmi2Instantiate it zeroes the callbacks, since a host may have them on its stack. */
#ifndef FMI2_H
#define FMI2_H

#include "common.h"
#include "fmi2FunctionTypes.h"
#include "model.h"
#include "roles.h" /* made by reference/native: the variables of the FMU that the commands use, by role */

#define FUNCTIONS(X) \
    X(GetTypesPlatform) X(GetVersion) X(SetDebugLogging) X(Instantiate) X(FreeInstance) X(SetupExperiment) \
    X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) X(Reset) X(GetReal) X(GetInteger) X(GetBoolean) \
    X(GetString) X(SetReal) X(SetInteger) X(SetBoolean) X(SetString) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) \
    X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate) X(GetDirectionalDerivative) \
    X(SetRealInputDerivatives) X(GetRealOutputDerivatives) X(DoStep) X(CancelStep) X(GetStatus) X(GetRealStatus) \
    X(GetIntegerStatus) X(GetBooleanStatus) X(GetStringStatus) X(EnterEventMode) X(NewDiscreteStates) \
    X(EnterContinuousTimeMode) X(CompletedIntegratorStep) X(SetTime) X(SetContinuousStates) X(GetDerivatives) \
    X(GetEventIndicators) X(GetContinuousStates) X(GetNominalsOfContinuousStates)
#define DECLARE(f) extern fmi2##f##TYPE *f;
FUNCTIONS(DECLARE)

/* fmi2.c */
void use(void *library, const char *its_guid, const char *its_resources); /* let the functions above be those of this library */
#define LOGGER(name) \
    void name(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category, \
              fmi2String message, ...)
LOGGER(logger);
LOGGER(quiet);
fmi2Component make(fmi2Type type, fmi2CallbackLogger log);
fmi2Component running(fmi2CallbackLogger log);
fmi2Status set_real(fmi2Component c, fmi2ValueReference r, double value);
fmi2Status set_integer(fmi2Component c, fmi2ValueReference r, int value);
double real(fmi2Component c, fmi2ValueReference r);
int whole(fmi2Component c, fmi2ValueReference r);
void coarsen(fmi2Component c); /* set the coarsest resolution, for tests that are not about numbers */
double reached(fmi2Component c); /* end of the last step, 0 before the first */
double any(fmi2Component c, fmi2ValueReference r); /* value of a Real or an Integer of a `quiet` instance */

/* calls.c: legality of calls */
void instantiate(void);
void every_call(void);
void fuzz(int n);
void status_functions(void);
void log_categories(void);

/* runs.c: many steps, many instances */
void threads(void);
void soak(int cycles, int steps);
void two_libraries(void *library, const char *path, const char *its_guid, const char *its_resources);

/* speed.c */
void speed(int n, const char *kernels);
void first_step(double begin);

#endif
