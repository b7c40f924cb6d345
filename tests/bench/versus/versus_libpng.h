/* versus_libpng.h - bench: zr_encode of one picture against libpng with its default settings, on the same pixels. */
#ifndef ZR_BENCH_VERSUS_LIBPNG_H
#define ZR_BENCH_VERSUS_LIBPNG_H

#include "bench/bench.h"

/* Colour, flat and smooth, and 16-bit depth, on 1 and 2 threads: time and bytes. What we wrote is read back by
 * libpng, and must be the pixels of the frame. */
void versus_libpng(struct bench *bench);

#endif
