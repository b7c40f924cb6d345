/* looks.h - bench: what looks take, and samples against llvmpipe's. */
#ifndef ZR_BENCH_LOOKS_H
#define ZR_BENCH_LOOKS_H

#include "bench/bench.h"
#include "bench/versus/sides.h"

/* Samples, linear light and each effect, on 1 and 2 threads: "theirs" is ours without, in the same run. */
void looks_against_plain(struct bench *bench);

/* 16 samples per pixel, on 1 and 2 threads, against llvmpipe's picture of 4x4 the size, read back and averaged
 * by as many threads, after the bytes of both were compared. */
void looks_against_llvmpipe(struct bench *bench);

/* Whole requests over HTTP, on 2 threads: looks of a mesh, against the plain flat picture of it. */
void looks_over_http(struct bench *bench);

/* What ours draws from now on: as the look studio shades it, with one sample and no effect. */
void looks_make_linear(struct ours *ours);

#endif
