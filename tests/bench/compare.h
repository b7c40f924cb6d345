/* compare.h - bench: this build against another one, row by row. */
#ifndef ZR_BENCH_COMPARE_H
#define ZR_BENCH_COMPARE_H

#include "bench/bench.h"

enum { COMPARE_ADDS = 2 };

/* Runs this program and that of the folder `other`, each with its own daemon, with the arguments that both are given
 * (ends with NULL; the first is left to this function, which adds up to COMPARE_ADDS), round by round in turns, and
 * prints of each row both medians, and how many times as fast this build is. What both found lies beside `output` then,
 * as this.json and other.json. Returns the exit status: 1 where one of them failed. */
int compare_builds(const struct bench *bench, const char *other, const char **arguments, const char *output);

#endif
