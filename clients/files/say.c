#include "say.h"

#include <stdlib.h>
#include <string.h>

#include "base/visible.h"

void say_text(FILE *out, const char *text, size_t length)
{
    for (const char *const end = text + length; text < end;) {
        const size_t shown = zr_visible_length(text, end);
        if (shown == 0) fputc('?', out);
        fwrite(text, shown, 1, out);
        text += shown ? shown : 1;
    }
}

void say_list(const char *format, va_list arguments)
{
    char *line;
    if (vasprintf(&line, format, arguments) < 0) return;
    fputs("zraster: ", stderr);
    say_text(stderr, line, strlen(line));
    fputc('\n', stderr);
    free(line);
}

void say(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say_list(format, arguments);
    va_end(arguments);
}
