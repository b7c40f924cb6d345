#include "output/svg_print.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_MOST = 512, DECIMALS_MOST = 40 };

void zr_svg_print(struct zr_buffer *out, const char *format, ...)
{
    char text[TEXT_MOST];
    va_list values;
    va_start(values, format);
    const int length = vsnprintf(text, sizeof text, format, values);
    va_end(values);
    if (length > 0 && length < TEXT_MOST) zr_buffer_add(out, text, (size_t)length);
}

int zr_svg_decimals(double pixel)
{
    int decimals = 0;
    for (double step = 0.01 * pixel; step < 0.9999 && decimals < DECIMALS_MOST; step *= 10.0)
        decimals++;
    return decimals;
}

void zr_svg_print_number(struct zr_buffer *out, double value, int decimals)
{
    char text[64];
    const int length = snprintf(text, sizeof text, "%.*f", decimals, value);
    bool is_zero = true;
    for (int i = 0; i < length; i++)
        is_zero = is_zero && (text[i] == '-' || text[i] == '0' || text[i] == '.');
    const int skipped = text[0] == '-' && is_zero ? 1 : 0;
    if (length < (int)sizeof text) zr_buffer_add(out, text + skipped, (size_t)(length - skipped));
}

void zr_svg_print_escaped(struct zr_buffer *out, const char *text)
{
    for (const char *at = text; *at; at++) {
        const bool is_none =
            (unsigned char)*at < 0x20 || (memcmp(at, "\xef\xbf", 2) == 0 && (unsigned char)at[2] > 0xbd);
        if (*at == '&')
            zr_svg_print(out, "&amp;");
        else if (*at == '<')
            zr_svg_print(out, "&lt;");
        else if (*at == '"')
            zr_svg_print(out, "&quot;");
        else
            zr_buffer_add(out, is_none ? "?" : at, 1);
        if (is_none && (unsigned char)*at >= 0x20) at += 2;
    }
}
