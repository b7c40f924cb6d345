#include "output/pfm.h"

#include <stdio.h>

#include "output/bytes/words.h"

enum { HEADER_MAX = 48 };

enum zr_status zr_pfm_write(uint32_t width, uint32_t height, uint32_t components, const float *values,
                            struct zr_buffer *out)
{
    char header[HEADER_MAX];
    const int length =
        snprintf(header, sizeof header, "%s\n%u %u\n-1.0\n", components == 3 ? "PF" : "Pf", width, height);
    const size_t row = (size_t)width * components;
    if (!zr_buffer_room(out, (size_t)length + 4 * row * height)) return ZR_NO_MEMORY;
    zr_buffer_add(out, header, (size_t)length);
    for (uint32_t y = height; y-- > 0;)
        zr_words_add(out, values + y * row, row);
    return ZR_OK;
}
