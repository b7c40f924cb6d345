/* stl_weld.h - input: finds equal vertices of binary STL, so that each place is stored once.
 *
 * Rule:  vertices are equal if their twelve bytes are: 0 and -0 stay apart.
 * Exact: numbers in the order of the file, for any number of threads. */
#ifndef ZR_STL_WELD_H
#define ZR_STL_WELD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/run.h"

enum {
    ZR_STL_HEADER = 84,         /* bytes before the first triangle */
    ZR_STL_TRIANGLE_BYTES = 50, /* normal, three vertices, two bytes of attributes */
    ZR_STL_VERTICES_AT = 12,    /* offset in a triangle, after its normal */
    ZR_STL_VERTEX_BYTES = 12
};

/* Returns the bytes of a corner: three floats. `triangles`: of the file, from the first triangle on. */
static inline const char *zr_stl_corner(const char *triangles, size_t corner)
{
    return triangles + corner / 3 * ZR_STL_TRIANGLE_BYTES + ZR_STL_VERTICES_AT + corner % 3 * ZR_STL_VERTEX_BYTES;
}

/* Returns a hash of three floats. */
static inline uint32_t zr_stl_hash(const uint32_t words[3])
{
    uint64_t h = words[0] * UINT64_C(0x9e3779b97f4a7c15) ^ words[1] * UINT64_C(0xc2b2ae3d27d4eb4f) ^
                 words[2] * UINT64_C(0x165667b19e3779f9);
    h = (h ^ h >> 29) * UINT64_C(0xbf58476d1ce4e5b9);
    return (uint32_t)(h >> 32);
}

/* Sets firsts[c] to the first corner that equals corner c. Returns the number of different ones. Returns 0, with an
 * undefined result, if there are more than a third of the corners, when sharing does not pay, if hashes were made to
 * collide, if the arena failed, or if cancelled. `hashes`: of all corners. The run's arena holds scratch: up to 7 bytes
 * per corner. */
size_t zr_stl_weld(const struct zr_run *run, const char *triangles, size_t corners, const uint32_t *hashes,
                   uint32_t *firsts);

#endif
