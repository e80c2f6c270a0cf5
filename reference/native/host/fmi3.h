/* A C host for the native FMU of FMI 3.0: LIBRARY TOKEN RESOURCES COMMAND [ARGUMENT]. */
#ifndef FMI3_H
#define FMI3_H

#include "common.h"
#include "fmi3FunctionTypes.h"
#include "model.h"

#define FUNCTIONS(X) \
    X(GetVersion) X(SetDebugLogging) X(InstantiateModelExchange) X(InstantiateCoSimulation) \
    X(InstantiateScheduledExecution) X(FreeInstance) X(EnterInitializationMode) X(ExitInitializationMode) \
    X(EnterEventMode) X(Terminate) X(Reset) X(GetFloat32) X(GetFloat64) X(GetInt8) X(GetUInt8) X(GetInt16) X(GetUInt16) \
    X(GetInt32) X(GetUInt32) X(GetInt64) X(GetUInt64) X(GetBoolean) X(GetString) X(GetBinary) X(GetClock) X(SetFloat32) \
    X(SetFloat64) X(SetInt8) X(SetUInt8) X(SetInt16) X(SetUInt16) X(SetInt32) X(SetUInt32) X(SetInt64) X(SetUInt64) \
    X(SetBoolean) X(SetString) X(SetBinary) X(SetClock) X(GetNumberOfVariableDependencies) X(GetVariableDependencies) \
    X(GetFMUState) X(SetFMUState) X(FreeFMUState) X(SerializedFMUStateSize) X(SerializeFMUState) X(DeserializeFMUState) \
    X(GetDirectionalDerivative) X(GetAdjointDerivative) X(EnterConfigurationMode) X(ExitConfigurationMode) \
    X(GetIntervalDecimal) X(GetIntervalFraction) X(GetShiftDecimal) X(GetShiftFraction) X(SetIntervalDecimal) \
    X(SetIntervalFraction) X(SetShiftDecimal) X(SetShiftFraction) X(EvaluateDiscreteStates) X(UpdateDiscreteStates) \
    X(EnterContinuousTimeMode) X(CompletedIntegratorStep) X(SetTime) X(SetContinuousStates) \
    X(GetContinuousStateDerivatives) X(GetEventIndicators) X(GetContinuousStates) X(GetNominalsOfContinuousStates) \
    X(GetNumberOfEventIndicators) X(GetNumberOfContinuousStates) X(EnterStepMode) X(GetOutputDerivatives) X(DoStep) \
    X(ActivateModelPartition)
#define DECLARE(f) extern fmi3##f##TYPE *f;
FUNCTIONS(DECLARE)

enum { SAMPLES = V_geometry_A - V_geometry_g }; /* ELEMENTS of a field is defined by the compiler's command line */
static const fmi3ValueReference load = V_load_normal_force, force = V_force_x, method = V_method_normal,
                                strips = V_resolution_n_strips, gap = V_geometry_g, pressure = V_field_pressure,
                                stick = V_field_stick, seconds = V_time;
static const double one = 1.0;

/* fmi3.c */
typedef enum { ME, CS } Type;
void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message);
fmi3Instance make(Type type, fmi3LogMessageCallback log);
fmi3Status set(fmi3Instance c, fmi3ValueReference r, double value);
fmi3Status step(fmi3Instance c, double time, double h);

/* calls_fmi3.c: legality of calls */
void instantiate(void);
void every_call(void);

#endif
