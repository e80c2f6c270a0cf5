/* Start of a host on Windows, and the functions of C that Windows has under other names. It is linked instead of the run-time
 * library of mingw, which takes zig a minute to build. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

int main(int n, char **words);
_CRTIMP int _configure_narrow_argv(int mode);
_CRTIMP int _initialize_narrow_environment(void);

void __main(void) {} /* main calls it; it would run constructors */

void mainCRTStartup(void)
{
    _configure_narrow_argv(1); /* as given, without expanding wildcards */
    _initialize_narrow_environment();
    exit(main(*__p___argc(), *__p___argv()));
}

int printf(const char *format, ...)
{
    va_list arguments;
    int length;
    va_start(arguments, format);
    length = __stdio_common_vfprintf(_CRT_INTERNAL_PRINTF_STANDARD_SNPRINTF_BEHAVIOR, stdout, format, NULL, arguments);
    va_end(arguments);
    return length;
}

int scanf(const char *format, ...)
{
    va_list arguments;
    int read;
    va_start(arguments, format);
    read = __stdio_common_vfscanf(0, stdin, format, NULL, arguments);
    va_end(arguments);
    return read;
}
