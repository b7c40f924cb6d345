#include "text.h"

#include <string.h>
#include <strings.h>

#include "base/utf8.h"

void text_to_utf8(char *out, size_t size, const char *source)
{
    static const char REPLACEMENT[] = "\xEF\xBF\xBD";
    const char *const end = source + strlen(source);
    size_t used = 0;
    while (*source) {
        size_t length = zr_utf8_length(source, end);
        const char *from = length ? source : REPLACEMENT;
        size_t bytes = length ? length : sizeof REPLACEMENT - 1;
        if (used + bytes >= size) break;
        memcpy(out + used, from, bytes);
        used += bytes;
        source += length ? length : 1;
    }
    out[used] = '\0';
}

void text_to_ascii(char *out, size_t size, const char *source)
{
    size_t used = 0;
    for (; *source && used + 1 < size; source++)
        out[used++] = *source >= ' ' && *source <= '~' ? *source : '?';
    out[used] = '\0';
}

size_t text_trimmed_length(const char *text)
{
    size_t length = strlen(text);
    while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t'))
        length--;
    return length;
}

bool text_has_item(const char *list, const char *item, size_t length)
{
    static const char BETWEEN[] = " ,";
    for (const char *p = list + strspn(list, BETWEEN); *p; p += strspn(p, BETWEEN)) {
        const size_t found = strcspn(p, BETWEEN);
        if (found == length && strncasecmp(p, item, length) == 0) return true;
        p += found;
    }
    return false;
}

bool text_has_tag(const char *list, const char *tag)
{
    if (!list) return false;
    return (list[0] == '*' && text_trimmed_length(list) == 1) || strstr(list, tag);
}
