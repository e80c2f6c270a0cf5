/* What the FMU's library for Windows needs of a C run-time library and the system does not export by name: the entry of the
 * library, and functions that format text. It is linked instead of the run-time library of mingw. */
#include <stdarg.h>
#include <stdio.h>

/* The library has nothing to set up: no constructors, no data of threads, no writable data outside its instances. */
int __stdcall _DllMainCRTStartup(void *library, unsigned long reason, void *reserved)
{
    (void)library, (void)reason, (void)reserved;
    return 1;
}

int vsnprintf(char *text, size_t size, const char *format, va_list arguments)
{
    return __stdio_common_vsprintf(_CRT_INTERNAL_PRINTF_STANDARD_SNPRINTF_BEHAVIOR, text, size, format, NULL, arguments);
}

int snprintf(char *text, size_t size, const char *format, ...)
{
    va_list arguments;
    int length;
    va_start(arguments, format);
    length = vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return length;
}
