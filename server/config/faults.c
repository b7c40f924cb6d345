#include "faults.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/visible.h"

static void add(struct faults *faults, const char *format, va_list arguments)
{
    const size_t room = faults->size - faults->used;
    if (faults->used > 0 && room > 1) faults->text[faults->used++] = '\n';
    char *line = faults->text + faults->used;
    const int length = vsnprintf(line, faults->size - faults->used, format, arguments);
    zr_make_visible(line, false);
    if (length > 0) faults->used += (size_t)length;
    if (faults->used >= faults->size) faults->used = faults->size - 1;
}

void faults_begin(struct faults *faults, char *text, size_t size)
{
    *faults = (struct faults){.text = text, .size = size};
    *text = '\0';
}

void faults_add(struct faults *faults, const char *format, ...)
{
    if (++faults->count > FAULTS_MAX) return;
    va_list arguments;
    va_start(arguments, format);
    add(faults, format, arguments);
    va_end(arguments);
}

static void add_line(struct faults *faults, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add_line(struct faults *faults, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add(faults, format, arguments);
    va_end(arguments);
}

void faults_end(struct faults *faults)
{
    if (faults->count > FAULTS_MAX) add_line(faults, "and %u more", faults->count - FAULTS_MAX);
}
