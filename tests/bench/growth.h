/* growth.h - bench: our times as the work grows, as threads do, with other channels and with light. No other
 * renderer runs: a row compares a time with that expected from the smaller work, one thread or simpler channels.
 */
#ifndef ZR_BENCH_GROWTH_H
#define ZR_BENCH_GROWTH_H

#include "bench/bench.h"

/* 1 k to 10 M triangles in one window, 256x256 to 8192x8192 pixels of one mesh, each on one thread: "theirs" is the
 * next smaller one's time, in proportion; at most 1.1 times that. */
void growth_of_work(struct bench *bench);

/* 2 to all threads: "theirs" is one thread's time, in the same run; and as many pictures at once, each on one thread.
 */
void growth_of_threads(struct bench *bench);

/* Channels, shadings and fog, against the same picture without them. */
void growth_of_channels(struct bench *bench);

/* Meshes lit and seen by a fitted view, whose time unlit and through matrices, in the same run, is "theirs". */
void growth_of_light(struct bench *bench);

/* What no renderer can go below here: the buffers cleared, the pixels copied. */
void growth_floors(struct bench *bench);

/* What can be written past the caches by two threads, against one, whose time, in the same run, is "theirs". */
void growth_past_caches(struct bench *bench);

#endif
