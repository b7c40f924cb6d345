/* versus_cjson.h - bench: zr_scene_read, which makes and checks a scene, against cJSON, which makes a tree. */
#ifndef ZR_BENCH_VERSUS_CJSON_H
#define ZR_BENCH_VERSUS_CJSON_H

#include "bench/bench.h"

/* The same triangles as a soup of polygons and as an indexed mesh; into an arena that is warm, and into a new one.
 * Memory is the least that an arena must be allowed to hold, over the size of the arrays that the scene consists of. */
void versus_cjson(struct bench *bench);

#endif
