/* Co-simulation and model exchange. */
#include <float.h>
#include <math.h>

#include "instance.h"

/* ---------------------------------------------------------------- co-simulation */

/* Return by how much a host's time may differ. Masters add up steps, with an error of less than a thousandth of a step. Others
 * keep the time in single precision; half a step off is wrong in any case. */
static double rounding(double time, double h)
{
    return 1e-3 * h + 16.0 * DBL_EPSILON * fabs(time) + fmin(FLT_EPSILON * fabs(time), 0.499 * h);
}

Status do_step(Instance *instance, const char *function, double time, double h)
{
    Status status;
    REQUIRE(instance, function, STEP_COMPLETE | STEP_FAILED);
    if (!isfinite(time)) return report(instance, LOG_ERROR, "currentCommunicationPoint = %g is not finite", time);
    if (!isfinite(h) || h <= 0.0)
        return report(instance, LOG_ERROR, "communicationStepSize = %g is outside the allowed range ]0, inf[", h);
    if (fabs(time - instance->is.time) > rounding(time, h))
        return report(instance, LOG_ERROR, "currentCommunicationPoint = %.17g does not continue the last step, which ended at %.17g",
                      time, instance->is.time);
    if (time + h > instance->is.stop_time + rounding(time, h))
        return report(instance, LOG_ERROR, "end of the step = %.17g is after the stopTime = %.17g", time + h,
                      instance->is.stop_time);
    status = update(instance, h, true);
    if (status <= WARNING) instance->is.time = time + h;
    if (status == ERROR) return status;
    instance->is.phase = status == DISCARD ? STEP_FAILED : STEP_COMPLETE;
    instance->is.last_step = status;
    return status;
}

/* ---------------------------------------------------------------- model exchange */

Status enter_event(Instance *instance, const char *function)
{
    REQUIRE(instance, function, EVENT | CONTINUOUS);
    instance->is.phase = EVENT;
    show_mirrored(instance, instance->values);
    return OK;
}

/* The model has no events of its own, so nothing is needed and nothing changes. */
Status update_discrete(Instance *instance, const char *function)
{
    REQUIRE(instance, function, EVENT);
    return OK;
}

/* Totals are integrated on from the rates after the event. */
Status enter_continuous(Instance *instance, const char *function)
{
    REQUIRE(instance, function, EVENT);
    if (N(totals) > 0 && refresh(instance) <= WARNING) accumulate(instance);
    instance->is.phase = CONTINUOUS;
    return OK;
}

Status completed_step(Instance *instance, const char *function)
{
    Status status;
    REQUIRE(instance, function, CONTINUOUS);
    status = refresh(instance);
    if (status <= WARNING) accumulate(instance);
    return status;
}

Status set_time(Instance *instance, const char *function, double time)
{
    REQUIRE(instance, function, EVENT | CONTINUOUS);
    /* Solvers evaluate past stopTime, so the end is not checked. */
    if (!isfinite(time)) return report(instance, LOG_ERROR, "time = %g is not finite", time);
    instance->is.time = time;
    return OK;
}

/* Require a state in which data of the continuous states may be read. */
#define READABLE (EVENT | CONTINUOUS | (instance->type == MODEL_EXCHANGE ? INITIALIZATION | TERMINATED : 0))

static Status wrong_number(const Instance *instance, const char *function, size_t n, size_t there_are)
{
    return report(instance, LOG_ERROR, "%s: there are %zu, but %zu were requested", function, there_are, n);
}

/* Any values are accepted. The next computation checks them. */
Status set_states(Instance *instance, const char *function, const double x[], size_t n)
{
    REQUIRE(instance, function, CONTINUOUS);
    if (n != N(states)) return wrong_number(instance, function, n, N(states));
    for (size_t i = 0; i < n; i++) instance->values[instance->table.states[i].value] = x[i];
    if (n > 0) instance->is.is_new = true;
    return OK;
}

Status get_states(Instance *instance, const char *function, double x[], size_t n)
{
    Status status = OK;
    REQUIRE(instance, function, READABLE);
    if (n != N(states)) return wrong_number(instance, function, n, N(states));
    if (n > 0 && instance->is.phase == INITIALIZATION) status = refresh(instance);
    if (status > WARNING) return status;
    for (size_t i = 0; i < n; i++) x[i] = instance->values[instance->table.states[i].value];
    return status;
}

Status get_derivatives(Instance *instance, const char *function, double derivatives[], size_t n)
{
    Status status = OK;
    REQUIRE(instance, function, READABLE);
    if (n != N(states)) return wrong_number(instance, function, n, N(states));
    if (n > 0 && instance->is.phase != TERMINATED) status = refresh(instance);
    if (status > WARNING) return status;
    for (size_t i = 0; i < n; i++) derivatives[i] = instance->values[instance->table.states[i].derivative];
    return status;
}

Status get_nominals(Instance *instance, const char *function, double nominals[], size_t n)
{
    REQUIRE(instance, function, READABLE);
    if (n != N(states)) return wrong_number(instance, function, n, N(states));
    for (size_t i = 0; i < n; i++) nominals[i] = instance->table.states[i].nominal;
    return OK;
}

Status get_indicators(Instance *instance, const char *function, size_t n)
{
    REQUIRE(instance, function, READABLE);
    return n == 0 ? OK : wrong_number(instance, function, n, 0);
}

Status count_of(const Instance *instance, const char *function, size_t there_are, size_t *n)
{
    REQUIRE(instance, function, READABLE | (instance->type == MODEL_EXCHANGE ? INSTANTIATED | CONFIGURATION : 0));
    *n = there_are;
    return OK;
}
