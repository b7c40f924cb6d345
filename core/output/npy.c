#include "output/npy.h"

#include <stdio.h>
#include <string.h>

#include "output/bytes/words.h"

/* The data begin at a multiple of 64 bytes, as the format requires. */
_Static_assert(ZR_NPY_HEADER % 64 == 0, "the data are aligned");
enum { PREFIX_SIZE = 10 };

enum zr_status zr_npy_begin(enum zr_npy_type type, const size_t *shape, size_t axes, struct zr_buffer *out)
{
    char header[ZR_NPY_HEADER + 1], sides[100] = "";
    int used = 0;
    for (size_t i = 0; i < axes; i++)
        used += snprintf(sides + used, sizeof sides - (size_t)used, "%s%zu", i ? ", " : "", shape[i]);
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    header[8] = ZR_NPY_HEADER - PREFIX_SIZE;
    header[9] = 0;
    const int length = snprintf(header + PREFIX_SIZE, ZR_NPY_HEADER - PREFIX_SIZE,
                                "{'descr': '%s', 'fortran_order': False, 'shape': (%s%s), }",
                                type == ZR_NPY_FLOAT32 ? "<f4" : "<u4", sides, axes == 1 ? "," : "");
    memset(header + PREFIX_SIZE + length, ' ', (size_t)(ZR_NPY_HEADER - PREFIX_SIZE - length));
    header[ZR_NPY_HEADER - 1] = '\n';
    return zr_buffer_add(out, header, ZR_NPY_HEADER) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_npy_write(enum zr_npy_type type, uint32_t width, uint32_t height, uint32_t components,
                            const void *values, struct zr_buffer *out)
{
    const size_t shape[] = {height, width, components}, words = (size_t)width * height * components;
    if (zr_npy_begin(type, shape, components > 1 ? 3 : 2, out) != ZR_OK) return ZR_NO_MEMORY;
    return zr_words_add(out, values, words) ? ZR_OK : ZR_NO_MEMORY;
}
