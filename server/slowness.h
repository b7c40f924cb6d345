/* slowness.h - measures the time of this machine relative to the reference machine of predictions (core/cost.h). */
#ifndef ZRASTERD_SLOWNESS_H
#define ZRASTERD_SLOWNESS_H

#include "base/isa.h"

/* Draws a small picture several times on one thread, some 20 ms in all. Returns its least processor time over that of
 * the reference machine: 1 there, about 8 without vector instructions. Called once, at start, so clients cannot change
 * it. Returns 1 if there is no thread or memory for it. */
double slowness_measure(enum zr_isa isa);

#endif
