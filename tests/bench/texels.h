/* texels.h - bench: pictures for textures, made up: a grain of several sizes over stripes, squares or nothing. */
#ifndef ZR_BENCH_TEXELS_H
#define ZR_BENCH_TEXELS_H

#include <stdint.h>

enum texels { TEXELS_SQUARES, TEXELS_STRIPES, TEXELS_CLOUDS, TEXELS_KINDS };

/* side x side texels, RGBA, opaque; the side is a power of two. To be freed; NULL where there is no memory. */
uint8_t *texels_make(enum texels kind, uint32_t side);

#endif
