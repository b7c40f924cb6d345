/* meshopt_filter.h - input: layouts and filters of EXT_meshopt_compression. Source: its appendix B. */
#ifndef ZR_MESHOPT_FILTER_H
#define ZR_MESHOPT_FILTER_H

#include <stdint.h>

enum zr_meshopt_mode { ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_TRIANGLES, ZR_MESHOPT_INDICES };
enum zr_meshopt_filter { ZR_MESHOPT_NONE, ZR_MESHOPT_OCTAHEDRAL, ZR_MESHOPT_QUATERNION, ZR_MESHOPT_EXPONENTIAL };

/* `count` elements of `stride` bytes. */
struct zr_meshopt {
    int mode, filter;
    uint32_t count, stride;
};

/* Applies the filter to decoded elements, in place. */
void zr_meshopt_filter(const struct zr_meshopt *of, unsigned char *elements, uint32_t count);

#endif
