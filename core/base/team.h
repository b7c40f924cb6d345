/* team.h - base: threads that share the work of requests.
 *
 * A team is shared: several callers may run jobs at once. Each caller works on its own job, and idle helpers join any
 * open job. So a single request uses every core, and many requests share them, without configuration.
 * Exact:   threads claim ranges from an atomic counter of the job, many at first and one by one at the end. Results do
 *          not depend on the number of helpers or on the time at which they join.
 * Waiting: threads poll for the next job for at most some hundred microseconds and yield the processor, then wait on a
 *          condition variable. */
#ifndef ZR_TEAM_H
#define ZR_TEAM_H

#include <stddef.h>

#include "base/isa.h"

enum { ZR_TEAM_MAX = 256 };

struct zr_team;

/* Creates a team of `threads`, clamped to 1..ZR_TEAM_MAX; the caller counts as one, so 1 means no helpers. Kernels use
 * the best instruction set, or `isa`, which must be available. Returns NULL if threads or memory run out. */
struct zr_team *zr_team_create(int threads);
struct zr_team *zr_team_create_for(int threads, enum zr_isa isa);
void zr_team_destroy(struct zr_team *team);

/* Returns the number of threads, including the caller; 1 if `team` is NULL. */
int zr_team_size(const struct zr_team *team);

/* Returns the instruction set of its kernels; the best one if `team` is NULL. */
enum zr_isa zr_team_isa(const struct zr_team *team);

/* Splits 0..count-1 into ranges of `grain` and calls work(context, begin, end) once for each, on the calling thread and
 * idle helpers, in any order. Returns when all are done; their stores are then visible to every thread. Thread-safe.
 * `team` may be NULL. */
void zr_team_ranges(struct zr_team *team, size_t count, size_t grain,
                    void (*work)(void *context, size_t begin, size_t end), void *context);

/* Same for work with data per thread: `worker` is less than zr_team_size(team) and than the number of ranges, and
 * differs between threads. */
void zr_team_shares(struct zr_team *team, size_t count, size_t grain,
                    void (*work)(void *context, int worker, size_t begin, size_t end), void *context);

#endif
