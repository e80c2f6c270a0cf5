/* What a library for Windows needs besides the FMU: its start, and the two functions of C that Windows has under other names.
   mingw's start-up code has them too, but zig takes a minute to build it. */
#include <stdarg.h>
#include <stddef.h>

/* Option of the Universal C Runtime (corecrt_stdio_config.h): a text that is too long is cut, and ends with 0. */
enum { STANDARD_SNPRINTF = 2 };

int __stdio_common_vsprintf(unsigned long long options, char *text, size_t room, const char *format, void *locale,
                            va_list values);

/* There are no constructors, no variables of a thread and nothing to free. */
int __stdcall _DllMainCRTStartup(void *library, unsigned long reason, void *reserved)
{
    (void)library, (void)reason, (void)reserved;
    return 1;
}

int vsnprintf(char *text, size_t room, const char *format, va_list values)
{
    return __stdio_common_vsprintf(STANDARD_SNPRINTF, text, room, format, NULL, values);
}

int snprintf(char *text, size_t room, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int length = vsnprintf(text, room, format, values);
    va_end(values);
    return length;
}
