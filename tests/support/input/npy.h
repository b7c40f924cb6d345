/* npy.h - tests: files as numpy.save writes them. */
#ifndef ZR_TESTS_NPY_H
#define ZR_TESTS_NPY_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns a file, to be freed: `descr` is "<f4", `order` "False" or "True", `shape` "(2, 3)". NULL without memory. */
static inline char *npy_file(const char *descr, const char *order, const char *shape, const void *numbers, size_t bytes,
                             size_t *size)
{
    char text[256];
    const int used =
        snprintf(text, sizeof text, "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }", descr, order, shape);
    const size_t head = ((size_t)used + 11 + 63) / 64 * 64;
    char *file = malloc(head + bytes);
    *size = 0;
    if (!file) return NULL;
    memset(file, ' ', head);
    memcpy(file, "\x93NUMPY\1", 8);
    file[8] = (char)((head - 10) & 255);
    file[9] = (char)((head - 10) >> 8);
    memcpy(file + 10, text, (size_t)used);
    file[head - 1] = '\n';
    if (bytes > 0) memcpy(file + head, numbers, bytes);
    *size = head + bytes;
    return file;
}

#endif
