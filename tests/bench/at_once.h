/* at_once.h - bench: several pictures at once, each on a thread of its own, with nothing shared: the most that the
 * machine lets threads do. Memory, caches and whoever else is at work limit these as they limit one picture on as many.
 */
#ifndef ZR_BENCH_AT_ONCE_H
#define ZR_BENCH_AT_ONCE_H

#include "bench/sides.h"

struct at_once;

/* NULL where threads or memory cannot be had. It ends with the child that opened it. */
struct at_once *at_once_open(int threads);

/* What all draw from now on. */
void at_once_take(struct at_once *at_once, const struct work *work, const struct variant *variant);

/* Milliseconds from when all threads are awake until all pictures are there; less than 0 on failure. */
double at_once_draw(struct at_once *at_once);

#endif
