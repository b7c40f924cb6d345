/* versus_glsl.h - bench: what is shaded pixel by pixel, against llvmpipe running the same shading as GLSL. */
#ifndef ZR_BENCH_VERSUS_GLSL_H
#define ZR_BENCH_VERSUS_GLSL_H

#include "bench/bench.h"

/* An animal with normals at its vertices, on 1 and 2 threads, after the pictures were compared: colours to a step or
 * two, depths to the last bit. */
void versus_glsl(struct bench *bench);

#endif
