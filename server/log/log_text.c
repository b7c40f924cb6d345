#include "log_text.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/visible.h"
#include "input/text/text.h"
#include "text.h"

enum { NAME_SIZE = 16 };

void log_text_escape(char out[LOG_TEXT_ESCAPED_SIZE], const char *text)
{
    char clean[LOG_TEXT_SIZE];
    size_t used = 0, length;
    text_to_utf8(clean, sizeof clean, text);
    const char *const end = clean + strlen(clean);
    for (const char *c = clean; *c; c += length) {
        length = zr_utf8_length(c, end);
        const unsigned code = zr_code_point(c, length);
        if (!zr_is_visible(code)) {
            used += (size_t)snprintf(out + used, LOG_TEXT_ESCAPED_SIZE - used, "\\u%04x", code);
            continue;
        }
        if (*c == '"' || *c == '\\') out[used++] = '\\';
        memcpy(out + used, c, length);
        used += length;
    }
    out[used] = '\0';
}

/* ---- secrets ---- */

static bool is_secret(const char *from, const char *to)
{
    static const char *const SECRETS[] = {"signature", "token", "access_token"};
    char name[NAME_SIZE];
    size_t used = 0;
    for (; from < to && used < sizeof name - 1; from++) {
        const bool is_escaped =
            *from == '%' && to - from > 2 && zr_hex_digit(from[1]) >= 0 && zr_hex_digit(from[2]) >= 0;
        const int byte = is_escaped ? zr_hex_digit(from[1]) << 4 | zr_hex_digit(from[2]) : *from;
        name[used++] = (char)byte;
        if (is_escaped) from += 2;
    }
    name[used] = '\0';
    if (from < to) return false; /* longer than all */
    for (size_t i = 0; i < sizeof SECRETS / sizeof SECRETS[0]; i++)
        if (strcasecmp(name, SECRETS[i]) == 0) return true;
    return false;
}

void log_text_redact(char *out, size_t size, const char *query)
{
    size_t used = 0;
    out[0] = '\0';
    for (const char *at = query; *at && used + 1 < size;) {
        const size_t length = strcspn(at, "&");
        const char *const end = at + length, *equals = memchr(at, '=', length);
        const bool is_hidden = equals && is_secret(at, equals);
        const int shown = (int)((is_hidden ? equals + 1 : end) - at);
        used += (size_t)snprintf(out + used, size - used, "%.*s%s%s", shown, at, is_hidden ? "-" : "", *end ? "&" : "");
        at = *end ? end + 1 : end;
    }
}
