/* Where the resources of an FMU lie: a path, or a file URI, in UTF-8. */
#ifndef LOCATION_H
#define LOCATION_H
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

#ifdef _WIN32
/* function of kernel32, declared here because windows.h defines names like INPUT and ERROR */
__declspec(dllimport) int __stdcall MultiByteToWideChar(unsigned code_page, unsigned long flags, const char *from, int n,
                                                        wchar_t *to, int room);
enum { UTF_8 = 65001 };
#endif

static inline int hexadecimal(char c)
{
    const char *digits = "0123456789abcdef0123456789ABCDEF", *found = c ? strchr(digits, c) : NULL;
    return found ? (int)(found - digits) % 16 : -1;
}

/* Whether a text begins with these small letters, written in small or capital letters. */
static inline bool begins(const char *text, const char *letters)
{
    for (; *letters; text++, letters++)
        if (*text != *letters && (*letters < 'a' || *letters > 'z' || *text != *letters - 'a' + 'A')) return false;
    return true;
}

/* Return the path of a file URI, or a copy of any other text; NULL for NULL. file:///a%20b and file:/a%20b give /a b. The
 * query and the fragment of a URI are no part of its path. */
static inline char *path_of(const char *location)
{
    char *path, *end;
    if (!location) return NULL;
    end = path = malloc(strlen(location) + 1);
    if (!path) return NULL;
    if (!begins(location, "file:")) return strcpy(path, location);
    location += 5;
    if (begins(location, "//localhost/")) location += 11;
    if (!strncmp(location, "///", 3)) location += 2;
    while (*location && *location != '?' && *location != '#') {
        int high = *location == '%' ? hexadecimal(location[1]) : -1, low = high >= 0 ? hexadecimal(location[2]) : -1;
        *end++ = low >= 0 ? (char)(16 * high + low) : *location;
        location += low >= 0 ? 3 : 1;
    }
    *end = '\0';
#ifdef _WIN32
    if (path[0] == '/' && path[1] && path[2] == ':') memmove(path, path + 1, (size_t)(end - path)); /* /C:/a becomes C:/a */
#endif
    return path;
}

static inline FILE *open_to_read(const char *path)
{
#ifdef _WIN32
    wchar_t wide[4096];
    return MultiByteToWideChar(UTF_8, 0, path, -1, wide, 4096) > 0 ? _wfopen(wide, L"rb") : NULL;
#else
    return fopen(path, "rb");
#endif
}
#endif
