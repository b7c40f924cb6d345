/* versus_llvmpipe.h - bench: our core against Mesa's software renderer, picture by picture. */
#ifndef ZR_BENCH_VERSUS_LLVMPIPE_H
#define ZR_BENCH_VERSUS_LLVMPIPE_H

#include "bench/bench.h"

/* Every work, in every variant, on 1 and 2 threads. First the pictures of both sides are compared, the other side
 * in its exact mode: a row whose pictures differ is wrong. With bench->check_only that is all, told as TAP. */
void versus_llvmpipe(struct bench *bench);

#endif
