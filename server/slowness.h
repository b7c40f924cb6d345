/* slowness.h - how much longer this machine takes than the one that predictions are for (core/cost.h). */
#ifndef ZRASTERD_SLOWNESS_H
#define ZRASTERD_SLOWNESS_H

#include "base/isa.h"

/* Draws a small picture some times on one thread, some 20 ms in all, and compares the least processor time with that of
 * the reference machine: 1 there, and about 8 without any vector instructions. Once, at start: no client can change it.
 * 1 where there is no thread or no memory for it. */
double slowness_measure(enum zr_isa isa);

#endif
