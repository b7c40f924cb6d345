/* say.h - client: lines on a terminal that have texts of others, such as names of files. Bytes that show nothing, and
 * would command the terminal, become '?' (base/visible.h), as in ls. */
#ifndef SAY_H
#define SAY_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

/* Prints a text. */
void say_text(FILE *out, const char *text, size_t length);

/* Prints "zraster: ", the text and a line end to standard error. */
__attribute__((format(printf, 1, 2))) void say(const char *format, ...);
void say_list(const char *format, va_list arguments);

#endif
