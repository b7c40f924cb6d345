/* team.h - base: threads that share the work of one request.
 *
 * A team is shared: any number of callers may run jobs at once, each takes part
 * in its own, and helpers that are idle join whichever job is open. So one
 * request alone uses every core, and many requests share them, with no setting.
 * Invariant: each takes ranges from an atomic counter of the job's own, many at first and one by one at
 * the end, so that it does not matter how many come to help, or when. Threads wait on a condition variable;
 * before, for some hundred microseconds at most, they look out for what comes next, and let others have the
 * processor.
 */
#ifndef ZR_TEAM_H
#define ZR_TEAM_H

#include <stddef.h>

#include "base/isa.h"

enum { ZR_TEAM_MAX = 256 };

struct zr_team;

/* `threads` counts the caller too: 1 makes a team without helpers. Clamped to
 * 1..ZR_TEAM_MAX. NULL where threads or memory cannot be had. The kernels that it runs
 * are those of the best instruction set, or of one that is available. */
struct zr_team *zr_team_create(int threads);
struct zr_team *zr_team_create_for(int threads, enum zr_isa isa);
void zr_team_destroy(struct zr_team *team);

/* How many can work at once, the caller among them. `team` may be NULL: 1. */
int zr_team_size(const struct zr_team *team);

/* Of a team that is NULL, the best. */
enum zr_isa zr_team_isa(const struct zr_team *team);

/* Splits 0..count-1 into ranges of `grain` and calls work(context, begin, end) once
 * for each, on this thread and on every helper that is free, in no particular order.
 * Returns when all of them are back, and what they stored is there for any thread. Thread-safe. `team` may be NULL. */
void zr_team_ranges(struct zr_team *team, size_t count, size_t grain,
                    void (*work)(void *context, size_t begin, size_t end), void *context);

/* The same for work that keeps notes of its own: `worker` is less than zr_team_size(team), and than the number
 * of ranges, and no two threads have the same one. */
void zr_team_shares(struct zr_team *team, size_t count, size_t grain,
                    void (*work)(void *context, int worker, size_t begin, size_t end), void *context);

#endif
