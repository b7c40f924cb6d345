#include "base/visible.h"

#include <string.h>

void zr_make_visible(char *text, bool has_lines)
{
    const char *const end = text + strlen(text);
    while (*text) {
        const size_t length = zr_visible_length(text, end), invisible = zr_utf8_length(text, end);
        if (length == 0 && !(has_lines && *text == '\n')) memset(text, '?', invisible ? invisible : 1);
        text += length ? length : invisible ? invisible : 1;
    }
}
