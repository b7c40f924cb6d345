#include "text.h"

#include <string.h>

/* Returns the length of the character at `s`, 1..4; 0 for invalid bytes: stray or missing continuations, overlong
 * forms, surrogates, beyond U+10FFFF. */
static size_t character_length(const unsigned char *s)
{
    if (s[0] < 0x80) return 1;
    size_t length = s[0] >= 0xC2 && s[0] <= 0xDF ? 2 : (s[0] & 0xF0) == 0xE0 ? 3 : s[0] >= 0xF0 && s[0] <= 0xF4 ? 4 : 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80) return 0;
    if (s[0] == 0xE0 && s[1] < 0xA0) return 0;
    if (s[0] == 0xED && s[1] > 0x9F) return 0;
    if (s[0] == 0xF0 && s[1] < 0x90) return 0;
    if (s[0] == 0xF4 && s[1] > 0x8F) return 0;
    return length;
}

void text_to_utf8(char *out, size_t size, const char *source)
{
    static const char REPLACEMENT[] = "\xEF\xBF\xBD";
    size_t used = 0;
    while (*source) {
        size_t length = character_length((const unsigned char *)source);
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
