/* crowd.h - bench: several pictures at once, each on a thread of its own. Nothing is written in common and nobody waits
 * for anybody, so this is a measure of what threads can come to on a machine: they share its memory and caches, and
 * whoever else is at work takes from them, as from one picture on as many threads.
 */
#ifndef ZR_BENCH_CROWD_H
#define ZR_BENCH_CROWD_H

#include "bench/versus/sides.h"

struct crowd;

/* NULL, explained on stderr, where threads or memory cannot be had. It ends with the child that opened it. */
struct crowd *crowd_open(int threads);

/* What all draw from now on, from the same arrays. */
void crowd_take(struct crowd *crowd, const struct work *work, const struct variant *variant);

/* Milliseconds from when the first picture is begun until all are there; less than 0 on failure. All threads are awake
 * before. */
double crowd_draw(struct crowd *crowd);

#endif
