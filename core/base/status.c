#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Removes a partial UTF-8 character from the end of a text that snprintf cut: `wanted` is its result. */
static void trim_to_character(char *text, size_t size, int wanted)
{
    if (wanted < 0 || (size_t)wanted < size) return;
    size_t end = strlen(text);
    while (end > 0 && ((unsigned char)text[end - 1] & 0xC0u) == 0x80u)
        end--;
    if (end > 0 && (unsigned char)text[end - 1] >= 0xC0u)
        end--;
    else
        end = strlen(text);
    text[end] = '\0';
}

enum zr_status zr_error_add(struct zr_error *error, enum zr_status status, const char *pointer, const char *format, ...)
{
    if (error->count == 0) error->status = status;
    if (error->count < ZR_ERROR_ITEMS) {
        struct zr_error_item *item = &error->items[error->count];
        int wanted = snprintf(item->pointer, sizeof item->pointer, "%s", pointer ? pointer : "");
        trim_to_character(item->pointer, sizeof item->pointer, wanted);
        va_list arguments;
        va_start(arguments, format);
        wanted = vsnprintf(item->detail, sizeof item->detail, format, arguments);
        va_end(arguments);
        trim_to_character(item->detail, sizeof item->detail, wanted);
    }
    error->count++;
    return status;
}

size_t zr_error_held(const struct zr_error *error)
{
    return error->count < ZR_ERROR_ITEMS ? error->count : ZR_ERROR_ITEMS;
}
