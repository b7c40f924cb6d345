/* versus_glsl.h - bench: what is shaded pixel by pixel, against llvmpipe running the same shading as GLSL. */
#ifndef ZR_BENCH_VERSUS_GLSL_H
#define ZR_BENCH_VERSUS_GLSL_H

#include "bench/bench.h"

/* An animal with normals at its vertices, on 1 and 2 threads, after the pictures were compared: Phong's and all
 * depths to the last bit, pbr's colours to a step of 255. */
void versus_glsl(struct bench *bench);

#endif
