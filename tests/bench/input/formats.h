/* formats.h - bench: reads and draws files of one mesh in several formats, and draws a kept mesh in other poses. */
#ifndef ZR_BENCH_FORMATS_H
#define ZR_BENCH_FORMATS_H

#include "bench/bench.h"

/* One thread, warm arenas, 512x512: GLB and PLY against binary STL, GLB of 1.1 M triangles against a copy of its bytes
 * and drawing alone, smooth STL against flat STL, and another pose of a kept mesh against drawing alone. */
void formats_against_each_other(struct bench *bench);

/* images.c: a GLB with textures, read by two threads and by one. */
void images_by_threads(struct bench *bench);

#endif
