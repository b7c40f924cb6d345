#include "output/npy.h"

#include <stdio.h>
#include <string.h>

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
    size_t bytes = (size_t)width * height * components * 4;
    if (!zr_buffer_add(out, header, HEADER_SIZE) || !zr_buffer_add(out, values, bytes)) return ZR_NO_MEMORY;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    unsigned char *data = out->bytes + out->size - bytes;
    for (size_t i = 0; i < bytes; i += 4) {
        uint32_t value;
        memcpy(&value, data + i, 4);
        value = __builtin_bswap32(value);
        memcpy(data + i, &value, 4);
    }
#endif
    return ZR_OK;
}
