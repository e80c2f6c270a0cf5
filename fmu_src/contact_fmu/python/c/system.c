/* What the entry needs of Linux and Windows: pythonfmu's library beside it, and a name of a folder that Python can get. */
#ifndef _WIN32
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "entry.h"
#include "location.h"

#ifdef _WIN32
enum { LONGEST = 4096, OF_ADDRESS = 4 | 2 /* without a new reference */, BESIDE_IT = 8 };
__declspec(dllimport) int __stdcall GetModuleHandleExW(unsigned long flags, const wchar_t *address, void **module);
__declspec(dllimport) unsigned long __stdcall GetModuleFileNameW(void *module, wchar_t *path, unsigned long room);
__declspec(dllimport) void *__stdcall LoadLibraryExW(const wchar_t *path, void *file, unsigned long flags);
__declspec(dllimport) void *__stdcall GetProcAddress(void *module, const char *name);
__declspec(dllimport) int __stdcall FreeLibrary(void *module);
__declspec(dllimport) unsigned long __stdcall GetLastError(void);
__declspec(dllimport) unsigned long __stdcall GetShortPathNameW(const wchar_t *path, wchar_t *shorter, unsigned long room);

static void *loaded; /* pythonfmu's library */

/* Release pythonfmu's library with this one, so that the host can delete the file. At the end of a process there is no need. */
int __stdcall _DllMainCRTStartup(void *library, unsigned long reason, void *at_the_end)
{
    (void)library;
    if (reason == 0 && !at_the_end && loaded) FreeLibrary(loaded);
    return 1;
}

void *open_library(Instance *instance)
{
    static const wchar_t name[] = L"pythonfmu-export.dll";
    wchar_t path[LONGEST];
    void *own = NULL, *found = NULL;
    unsigned long n = 0;
    if (GetModuleHandleExW(OF_ADDRESS, (const wchar_t *)(void *)&open_library, &own)) n = GetModuleFileNameW(own, path, LONGEST);
    while (n > 0 && path[n - 1] != L'\\' && path[n - 1] != L'/') n--;
    if (n > 0 && n + sizeof name / sizeof *name < LONGEST) {
        wmemcpy(path + n, name, sizeof name / sizeof *name);
        found = LoadLibraryExW(path, NULL, BESIDE_IT);
    }
    if (!found)
        report(instance, fmi2Error,
               "pythonfmu-export.dll, beside this FMU's library, cannot be loaded (error %lu of Windows): this FMU needs Python with "
               "the package wheelrail-contact, and python3.dll on PATH", GetLastError());
    else if (!loaded)
        loaded = found;
    else
        FreeLibrary(found); /* there is one reference for all instances */
    return found;
}

void *find(void *library, const char *name) { return GetProcAddress(library, name); }
#else
void *open_library(Instance *instance)
{
    static const char name[] = "pythonfmu-export.so";
    Dl_info own;
    void *found = NULL;
    const char *end = dladdr((void *)&fmi2Instantiate, &own) && own.dli_fname ? strrchr(own.dli_fname, '/') : NULL;
    const size_t n = end ? (size_t)(end - own.dli_fname) + 1 : 0;
    char *path = malloc(n + sizeof name);
    if (path) {
        if (n) memcpy(path, own.dli_fname, n);
        memcpy(path + n, name, sizeof name);
        found = dlopen(path, RTLD_NOW | RTLD_LOCAL); /* now: a function that is missing later would end the process */
    }
    free(path);
    if (!found) {
        const char *why = dlerror();
        report(instance, fmi2Error,
               "this FMU needs Python with the package wheelrail-contact in the process of its host; a host that is no Python must "
               "preload it (LD_PRELOAD=libpython3.so): %s", why ? why : "out of memory");
    }
    return found;
}

void *find(void *library, const char *name) { return dlsym(library, name); }
#endif

/* Whether pythonfmu takes the path as it is. It decodes %20, and Python decodes names by the locale of the host. */
static bool is_plain(const char *path)
{
    for (; *path; path++)
        if (*path < ' ' || *path > '~' || *path == '%') return false;
    return true;
}

char *location_for_python(Instance *instance, const char *folder)
{
#ifdef _WIN32
    static const char prefix[] = "file:///";
#else
    static const char prefix[] = "file://";
#endif
    const size_t length = strlen(folder);
    char *made = malloc(sizeof prefix + length + 64); /* 64: of the other name on Linux; on Windows the other one is shorter */
    if (!made) {
        report(instance, fmi2Error, "out of memory");
        return NULL;
    }
    strcpy(made, prefix);
    if (is_plain(folder)) return strcat(made, folder);
#ifdef _WIN32
    wchar_t path[LONGEST], other[LONGEST];
    if (MultiByteToWideChar(UTF_8, 0, folder, -1, path, LONGEST) > 0) {
        const unsigned long n = GetShortPathNameW(path, other, LONGEST);
        bool plain = n > 0 && n < LONGEST && n <= length;
        for (unsigned long k = 0; plain && k < n; k++) {
            plain = other[k] >= L' ' && other[k] <= L'~' && other[k] != L'%';
            made[sizeof prefix - 1 + k] = (char)other[k];
        }
        made[sizeof prefix - 1 + (plain ? n : 0)] = '\0';
        if (plain) return made;
    }
    report(instance, fmi2Error,
           "the FMU lies in %s, whose name Python cannot get here: Windows has no short name for it. Unzip it in a folder whose "
           "path has only letters A to Z, digits and blanks", folder);
#else
    instance->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (instance->folder >= 0) {
        char test[64];
        snprintf(test, sizeof test, "/proc/self/fd/%d", instance->folder);
        if (access(test, R_OK) == 0) return strcat(made, test);
    }
    report(instance, fmi2Error, "the FMU lies in %s, whose name Python cannot get here: /proc is not there", folder);
#endif
    free(made);
    return NULL;
}
