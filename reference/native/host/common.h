/* Shared by the C hosts: loading a library with local symbols, threads, and checks that print failures. */
#ifndef COMMON_H
#define COMMON_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define GetVersion fmu_version /* Windows has a function of this name */
typedef HANDLE Thread;
#define THREAD_RESULT DWORD WINAPI
#else
#include <pthread.h>
typedef pthread_t Thread;
#define THREAD_RESULT void *
#endif

extern const char *guid, *resources; /* of the tested FMU; resources is a URI in FMI 2.0, a path in FMI 3.0 */
extern int failures, messages;
extern char last_message[1024];

void *open_library(const char *path); /* RTLD_LOCAL */
void *find(void *library, const char *name);
typedef THREAD_RESULT Work(void *);
void start(Thread *thread, Work *work, void *argument);
void join(Thread thread);
void check(int good, const char *what, const char *where);
double now(void);          /* in microseconds */
unsigned draw(unsigned n); /* a random number below n, the same sequence in every run */

#endif
