/* Loggers of both versions of FMI that only count the messages. */
#ifndef COUNTING_H
#define COUNTING_H

#include "common.h"
#include "fmi2FunctionTypes.h"
#include "fmi3FunctionTypes.h"

static void log_2(void *environment, const char *name, fmi2Status status, const char *category, const char *message, ...)
{
    (void)environment, (void)name, (void)status, (void)category, (void)message;
    messages++;
}
static void log_3(void *environment, fmi3Status status, const char *category, const char *message)
{
    (void)environment, (void)status, (void)category, (void)message;
    messages++;
}

#endif
