/* crowd.h - bench: several pictures at once, each on a thread of its own. Threads share no output and do not wait for
 * one another, so this is an upper bound for threads of the machine: they share its memory and caches, also with other
 * processes, as the threads of one picture do.
 */
#ifndef ZR_BENCH_CROWD_H
#define ZR_BENCH_CROWD_H

#include "bench/versus/sides.h"

struct crowd;

/* Returns NULL, with a message on stderr, without threads or memory. It ends with the child that opened it. */
struct crowd *crowd_open(int threads);

/* What all draw from now on, from the same arrays. */
void crowd_take(struct crowd *crowd, const struct work *work, const struct variant *variant);

/* Milliseconds from when the first picture is begun until all are there; less than 0 on failure. All threads are awake
 * before. */
double crowd_draw(struct crowd *crowd);

#endif
