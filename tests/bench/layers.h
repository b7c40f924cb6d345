/* layers.h - bench: what is see-through. */
#ifndef ZR_BENCH_LAYERS_H
#define ZR_BENCH_LAYERS_H

#include "bench/bench.h"

/* A million see-through triangles at 1080p, on 1 and 2 threads, against llvmpipe blending them in the order in which
 * they come, without sorting: less work, and another picture. The pictures of sorted layers are compared by
 * zraster-verify. The note tells what a fragment takes. */
void layers_against_llvmpipe(struct bench *bench);

#endif
