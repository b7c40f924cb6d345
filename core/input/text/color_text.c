#include "input/text/color_text.h"

#include <strings.h>

#include "input/text/color_names.h"
#include "input/text/text.h"

/* Reads `count` channels of one or two hexadecimal digits; a single digit is doubled. */
static bool read_hex(const char *text, size_t digits, size_t count, zr_vec4 *out)
{
    float channels[4] = {0, 0, 0, 1.0f};
    for (size_t i = 0; i < count; i++, text += digits) {
        int high = zr_hex_digit(text[0]), low = zr_hex_digit(text[digits - 1]);
        if (high < 0 || low < 0) return false;
        channels[i] = zr_color_channel(high * 16 + low);
    }
    *out = (zr_vec4){channels[0], channels[1], channels[2], channels[3]};
    return true;
}

bool zr_color_of_text(const char *text, size_t length, zr_vec4 *out)
{
    if (length > 0 && text[0] == '#') {
        if (length == 4 || length == 5) return read_hex(text + 1, 1, length - 1, out);
        return (length == 7 || length == 9) && read_hex(text + 1, 2, (length - 1) / 2, out);
    }
    static const char none[] = "transparent";
    if (length == sizeof none - 1 && strncasecmp(text, none, length) == 0) {
        *out = (zr_vec4){0};
        return true;
    }
    uint32_t rgb;
    if (!zr_color_of_name(text, length, &rgb)) return false;
    *out = (zr_vec4){zr_color_channel((int)(rgb >> 16)), zr_color_channel((int)(rgb >> 8 & 255)),
                     zr_color_channel((int)(rgb & 255)), 1};
    return true;
}
