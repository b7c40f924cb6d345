/* base.h - tests/fuzz: pictures of a base that a scene is drawn into. */
#ifndef ZR_FUZZ_BASE_H
#define ZR_FUZZ_BASE_H

#include <string.h>

enum { BASE_WIDTH = 5, BASE_HEIGHT = 3, BASE_PIXELS = BASE_WIDTH * BASE_HEIGHT };

enum { NPY_HEAD = 128, NPY_BYTES = NPY_HEAD + 4 * BASE_PIXELS };

/* As numpy.save writes it: `values` are 4 bytes each, of a type such as "<f4". */
static inline void base_npy(char out[NPY_BYTES], const char *type, const void *values)
{
    static const char shape[] = "', 'fortran_order': False, 'shape': (3, 5), }";
    memcpy(out, "\x93NUMPY\1\0\x76\0{'descr': '", 21);
    memcpy(out + 21, type, 3);
    memset(out + 24, ' ', NPY_HEAD - 24);
    memcpy(out + 24, shape, sizeof shape - 1);
    out[NPY_HEAD - 1] = '\n';
    memcpy(out + NPY_HEAD, values, 4 * BASE_PIXELS);
}

/* A scene of one triangle in a window of that size, drawn into pictures; `members` are those of "base". */
#define BASE_SCENE(members, channels)                                                                                  \
    "{\"window\":{\"width\":5,\"height\":3},\"base\":{" members                                                        \
    "},\"view\":{\"eye\":[0,0,3],\"znear\":1,\"zfar\":9},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],"     \
    "\"outputs\":[" channels "]}"

#endif
