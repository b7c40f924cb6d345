/* renderer.h - api: threads, limits, and memory that calls share.
 *
 * Memory:  arenas wait for the next call in atomic slots, so a fork never copies a held lock. An arena for
 *          drawing (scratch) and one for a result differ: a result must not pin the scratch memory of earlier calls.
 * Threads: any number of threads may call all functions at once.
 * fork:    a child makes a team of its own at its first call; the parent's team stays in the child's memory, unused.
 */
#ifndef ZR_LIBRARY_RENDERER_H
#define ZR_LIBRARY_RENDERER_H

#include <locale.h>
#include <stdatomic.h>

#include "api/zraster.h"
#include "core.h"

enum { ZR_IDLE_ARENAS = 32 };

/* A team and the process that made it. */
struct zr_process_team;

struct zraster {
    atomic_uint users; /* the caller, scenes and pictures; the last one frees it */
    struct zr_limits limits;
    size_t memory_max, memory_keep;
    int threads;
    locale_t c_locale;
    _Atomic(struct zr_process_team *) team;
    _Atomic(struct zr_arena *) idle_scratch[ZR_IDLE_ARENAS], idle_results[ZR_IDLE_ARENAS];
    _Atomic(char *) tables, schema; /* zraster_tables, zraster_schema; NULL until the first call */
    atomic_size_t kept;             /* bytes in idle arenas; at most memory_keep */
};

/* Adds a user; zraster_close removes one. */
zraster *zr_renderer_use(zraster *renderer);

/* Returns the team of this process; NULL, one thread, if the system has no more threads. */
struct zr_team *zr_renderer_team(zraster *renderer);

enum zr_arena_use { ZR_ARENA_SCRATCH, ZR_ARENA_RESULT };

/* Takes an empty arena, kept or new, with the ceiling memory_max. It is charged with `beside` bytes, which another
 * arena of the call holds. NULL without memory. */
struct zr_arena *zr_renderer_take(zraster *renderer, enum zr_arena_use use, size_t beside);

/* Returns an arena; NULL does nothing. Keeps its blocks as far as memory_keep allows. */
void zr_renderer_give(zraster *renderer, struct zr_arena *arena, enum zr_arena_use use);

/* Makes the calling thread's LC_NUMERIC "C", for numbers in texts, until zr_renderer_leave with the result. */
locale_t zr_renderer_enter(const zraster *renderer);
void zr_renderer_leave(locale_t before);

#endif
