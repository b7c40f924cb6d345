#include "output/npy.h"

#include <stdio.h>
#include <string.h>

#include "output/words.h"

/* The data begin at a multiple of 64 bytes, as the format requires. */
enum { HEADER_SIZE = 128, PREFIX_SIZE = 10 };

enum zr_status zr_npy_write(enum zr_npy_type type, uint32_t width, uint32_t height, uint32_t components,
                            const void *values, struct zr_buffer *out)
{
    char header[HEADER_SIZE + 1], last[16] = "";
    if (components > 1) snprintf(last, sizeof last, ", %u", components);
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    header[8] = HEADER_SIZE - PREFIX_SIZE;
    header[9] = 0;
    int length = snprintf(header + PREFIX_SIZE, HEADER_SIZE - PREFIX_SIZE,
                          "{'descr': '%s', 'fortran_order': False, 'shape': (%u, %u%s), }",
                          type == ZR_NPY_FLOAT32 ? "<f4" : "<u4", height, width, last);
    memset(header + PREFIX_SIZE + length, ' ', (size_t)(HEADER_SIZE - PREFIX_SIZE - length));
    header[HEADER_SIZE - 1] = '\n';
    const size_t words = (size_t)width * height * components;
    return zr_buffer_add(out, header, HEADER_SIZE) && zr_words_add(out, values, words) ? ZR_OK : ZR_NO_MEMORY;
}
