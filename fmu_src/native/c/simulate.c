/* Co-simulation and model exchange. */
#include <math.h>
#include <string.h>

#include "instance.h"

/* ---------------------------------------------------------------- co-simulation */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean no_set_state_before)
{
    Instance *instance = c;
    fmi2Status status;
    (void)no_set_state_before;
    REQUIRE(instance, "fmi2DoStep", STEP_COMPLETE | STEP_FAILED);
    if (!isfinite(time)) return report(instance, LOG_ERROR, "currentCommunicationPoint = %g is not finite", time);
    if (!isfinite(h) || h <= 0.0)
        return report(instance, LOG_ERROR, "communicationStepSize = %g is outside the allowed range ]0, inf[", h);
    /* a thousandth of a step: what masters that add up steps lose by rounding is less */
    if (time + h > instance->is.stop_time + 1e-3 * h)
        return report(instance, LOG_ERROR, "end of the step = %g is past the stopTime = %g", time + h,
                      instance->is.stop_time);
    status = update(instance, h, true);
    if (status <= fmi2Warning) instance->is.time = time + h;
    if (status == fmi2Error) return status;
    instance->is.phase = status == fmi2Discard ? STEP_FAILED : STEP_COMPLETE;
    instance->is.last_step = status;
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2CancelStep", 0); /* no step is ever in progress */
    return fmi2OK;
}

#define STEPPED (STEP_COMPLETE | STEP_FAILED | TERMINATED)
#define OF_SLAVES(phases) (instance->type == fmi2CoSimulation ? (phases) : 0)

static fmi2Status unknown_status(const Instance *instance, const char *function)
{
    return report(instance, LOG_DISCARD, "%s: there is no such status", function);
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2GetStatus", OF_SLAVES(STEPPED));
    if (kind != fmi2DoStepStatus) return unknown_status(instance, "fmi2GetStatus");
    *value = (fmi2Status)instance->is.last_step;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2GetRealStatus", OF_SLAVES(STEPPED));
    if (kind != fmi2LastSuccessfulTime) return unknown_status(instance, "fmi2GetRealStatus");
    *value = instance->is.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    Instance *instance = c;
    (void)kind, (void)value;
    REQUIRE(instance, "fmi2GetIntegerStatus", OF_SLAVES(STEPPED));
    return unknown_status(instance, "fmi2GetIntegerStatus");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2GetBooleanStatus", OF_SLAVES(STEPPED));
    if (kind != fmi2Terminated) return unknown_status(instance, "fmi2GetBooleanStatus");
    *value = fmi2False; /* this model never asks to stop */
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2GetStringStatus", OF_SLAVES(STEPPED));
    if (kind != fmi2PendingStatus) return unknown_status(instance, "fmi2GetStringStatus");
    *value = "";
    return fmi2OK;
}

/* Inputs are constant over a step and outputs have no derivatives: the capability flags say so. */
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference refs[], size_t n,
                                       const fmi2Integer order[], const fmi2Real values[])
{
    Instance *instance = c;
    (void)refs, (void)order, (void)values;
    REQUIRE(instance, "fmi2SetRealInputDerivatives",
            OF_SLAVES(INSTANTIATED | INITIALIZATION | STEP_COMPLETE | STEP_FAILED));
    return n == 0 ? fmi2OK : report(instance, LOG_ERROR, "inputs are not interpolated (canInterpolateInputs is false)");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference refs[], size_t n,
                                        const fmi2Integer order[], fmi2Real values[])
{
    Instance *instance = c;
    (void)refs, (void)order, (void)values;
    REQUIRE(instance, "fmi2GetRealOutputDerivatives", OF_SLAVES(STEPPED));
    return n == 0 ? fmi2OK : report(instance, LOG_ERROR, "outputs have no derivatives (maxOutputDerivativeOrder is 0)");
}

/* ---------------------------------------------------------------- model exchange */

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2EnterEventMode", EVENT | CONTINUOUS);
    instance->is.phase = EVENT;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2NewDiscreteStates", EVENT);
    memset(info, 0, sizeof *info); /* there are no events: nothing is needed, nothing changes */
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2EnterContinuousTimeMode", EVENT);
    instance->is.phase = CONTINUOUS;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_set_state_before, fmi2Boolean *enter_event_mode,
                                       fmi2Boolean *terminate)
{
    Instance *instance = c;
    fmi2Status status;
    (void)no_set_state_before;
    REQUIRE(instance, "fmi2CompletedIntegratorStep", CONTINUOUS);
    *enter_event_mode = *terminate = fmi2False;
    status = refresh(instance);
    if (status <= fmi2Warning) accumulate(instance);
    return status;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2SetTime", EVENT | CONTINUOUS);
    if (!isfinite(time)) return report(instance, LOG_ERROR, "time = %g is not finite", time); /* solvers look past the end */
    instance->is.time = time;
    return fmi2OK;
}

#define MODEL_EXCHANGE (instance->type == fmi2ModelExchange ? INITIALIZATION | TERMINATED : 0)

static fmi2Status wrong_number(const Instance *instance, const char *function, size_t n, size_t there_are)
{
    return report(instance, LOG_ERROR, "%s: there are %zu, %zu were asked for", function, there_are, n);
}

/* Any values are taken; the next computation checks them. */
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2SetContinuousStates", CONTINUOUS);
    if (n != N_STATES) return wrong_number(instance, "fmi2SetContinuousStates", n, N_STATES);
    for (size_t i = 0; i < n; i++) instance->is.values[states[i].value] = x[i];
    if (n > 0) instance->is.is_new = true;
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t n)
{
    Instance *instance = c;
    fmi2Status status = fmi2OK;
    REQUIRE(instance, "fmi2GetDerivatives", EVENT | CONTINUOUS | MODEL_EXCHANGE);
    if (n != N_STATES) return wrong_number(instance, "fmi2GetDerivatives", n, N_STATES);
    if (n > 0 && instance->is.phase != TERMINATED) status = refresh(instance);
    if (status > fmi2Warning) return status;
    for (size_t i = 0; i < n; i++) derivatives[i] = instance->is.values[states[i].derivative];
    return status;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n)
{
    Instance *instance = c;
    (void)indicators;
    REQUIRE(instance, "fmi2GetEventIndicators", EVENT | CONTINUOUS | MODEL_EXCHANGE);
    return n == 0 ? fmi2OK : wrong_number(instance, "fmi2GetEventIndicators", n, 0);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n)
{
    Instance *instance = c;
    fmi2Status status = fmi2OK;
    REQUIRE(instance, "fmi2GetContinuousStates", EVENT | CONTINUOUS | MODEL_EXCHANGE);
    if (n != N_STATES) return wrong_number(instance, "fmi2GetContinuousStates", n, N_STATES);
    if (n > 0 && instance->is.phase == INITIALIZATION) status = refresh(instance);
    if (status > fmi2Warning) return status;
    for (size_t i = 0; i < n; i++) x[i] = instance->is.values[states[i].value];
    return status;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n)
{
    Instance *instance = c;
    REQUIRE(instance, "fmi2GetNominalsOfContinuousStates", EVENT | CONTINUOUS | MODEL_EXCHANGE);
    if (n != N_STATES) return wrong_number(instance, "fmi2GetNominalsOfContinuousStates", n, N_STATES);
    for (size_t i = 0; i < n; i++) nominals[i] = states[i].nominal;
    return fmi2OK;
}
