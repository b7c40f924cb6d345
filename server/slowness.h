/* slowness.h - measures the time of this machine relative to the reference machine of predictions (core/cost.h). */
#ifndef ZRASTERD_SLOWNESS_H
#define ZRASTERD_SLOWNESS_H

#include <pthread.h>
#include <stdbool.h>

#include "base/isa.h"

struct slowness {
    enum zr_isa isa;
    pthread_t thread;
    bool has_thread;
    pthread_mutex_t mutex; /* of the rest */
    pthread_cond_t known;
    bool is_known;
    double value;
};

/* Starts a thread that draws a small picture several times, in some 20 ms. Its least processor time over that of the
 * reference machine is the slowness: 1 there, about 8 without vector instructions. It is measured once, at start, so
 * clients cannot change it; 1 if there is no memory for it. */
void slowness_start(struct slowness *slowness, enum zr_isa isa);

/* Returns the slowness; as long as it is not known, waits for it or returns 1. Any thread may call. */
double slowness_of(struct slowness *slowness, bool wait);

void slowness_end(struct slowness *slowness);

#endif
