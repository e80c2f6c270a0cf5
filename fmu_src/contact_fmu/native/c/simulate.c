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

/* No model has continuous states or event indicators. */
static Status must_be_none(const Instance *instance, const char *function, size_t n)
{
    return n == 0 ? OK : report(instance, LOG_ERROR, "%s: there are 0, but %zu were requested", function, n);
}

Status set_none(Instance *instance, const char *function, size_t n)
{
    REQUIRE(instance, function, CONTINUOUS);
    return must_be_none(instance, function, n);
}

/* Phases in which a model's states and indicators may be read. */
#define READABLE (EVENT | CONTINUOUS | (instance->type == MODEL_EXCHANGE ? INITIALIZATION | TERMINATED : 0))

Status get_none(Instance *instance, const char *function, size_t n)
{
    REQUIRE(instance, function, READABLE);
    return must_be_none(instance, function, n);
}

Status count_none(const Instance *instance, const char *function, size_t *n)
{
    REQUIRE(instance, function, READABLE | (instance->type == MODEL_EXCHANGE ? INSTANTIATED | CONFIGURATION : 0));
    *n = 0;
    return OK;
}
