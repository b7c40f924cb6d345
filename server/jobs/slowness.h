/* slowness.h - measures the time of this machine relative to the reference machine of predictions (core/cost/cost.h). */
#ifndef ZRASTERD_SLOWNESS_H
#define ZRASTERD_SLOWNESS_H

#include <pthread.h>
#include <stdbool.h>

#include "base/isa.h"

/* Processor time of a small picture over that of the reference machine: 1 there, about 8 without vector instructions.
 */
struct slowness {
    enum zr_isa isa;
    pthread_t thread;
    bool has_thread;
    pthread_mutex_t mutex; /* of the rest */
    pthread_cond_t known;
    bool is_known;
    double value;
};

/* Starts a thread that draws the picture several times, in some 20 ms, and measures the least time. Called once, at
 * start, so clients cannot change the slowness. It is 1 if there is no memory for the picture. */
void slowness_start(struct slowness *slowness, enum zr_isa isa);

/* Returns the slowness. Until it is known, waits for it if `wait`, else returns 1. Any thread may call. */
double slowness_of(struct slowness *slowness, bool wait);

/* Waits for the thread and frees all. */
void slowness_end(struct slowness *slowness);

#endif
