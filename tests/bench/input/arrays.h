/* arrays.h - bench: reading a mesh whose numbers are arrays, against reading it as JSON. */
#ifndef ZR_BENCH_ARRAYS_H
#define ZR_BENCH_ARRAYS_H

#include "bench/bench.h"

/* zr_scene_read of the bunny, one thread, warm arena: positions and faces as NPY files, and as arrays of the process,
 * copied or lent. */
void arrays_against_json(struct bench *bench);

#endif
