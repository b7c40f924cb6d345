#include "api/renderer.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "api/options.h"
#include "api/spare_memory.h"

struct zr_process_team {
    pid_t process;
    struct zr_team *team;
};

/* Bytes that an idle arena of a result keeps at most: the next result, even a small one, holds all of them. */
enum { RESULT_KEEP_MAX = 4 << 20 };

/* ---- opening ---- */

static int count_processors(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
    const long all = sysconf(_SC_NPROCESSORS_ONLN);
    return all > 0 && all < ZR_TEAM_MAX ? (int)all : 1;
}

static void use_options(zraster *renderer, const struct zraster_options *options)
{
    struct zr_limits *limits = &renderer->limits;
    *limits = zr_limits_default();
    if (options->window_side_max) limits->window_side_max = options->window_side_max;
    if (options->instances_max) limits->instances_max = options->instances_max;
    if (options->window_pixels_max) limits->window_pixels_max = options->window_pixels_max;
    if (options->image_pixels_max) limits->image_pixels_max = options->image_pixels_max;
    renderer->memory_max = options->memory_max ? options->memory_max : zr_default_memory();
    renderer->memory_keep = options->memory_keep ? options->memory_keep : (size_t)64 << 20;
    const uint32_t threads = options->threads ? options->threads : (uint32_t)count_processors();
    renderer->threads = threads < ZR_TEAM_MAX ? (int)threads : ZR_TEAM_MAX;
}

zraster_status zraster_open(const struct zraster_options *options, zraster **out)
{
    struct zraster_options given;
    struct zr_error error = {0};
    *out = NULL;
    if (zr_options_read(options, &given, &error) != ZR_OK) return ZRASTER_BAD_REQUEST;
    zraster *renderer = calloc(1, sizeof *renderer);
    if (!renderer) return ZRASTER_NO_MEMORY;
    use_options(renderer, &given);
    renderer->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    atomic_init(&renderer->users, 1);
    if (renderer->c_locale == (locale_t)0) {
        free(renderer);
        return ZRASTER_NO_MEMORY;
    }
    *out = renderer;
    return ZRASTER_OK;
}

zraster *zr_renderer_use(zraster *renderer)
{
    atomic_fetch_add_explicit(&renderer->users, 1, memory_order_relaxed);
    return renderer;
}

/* Frees a team; one of another process has no threads here to join. */
static void free_team(struct zr_process_team *team)
{
    if (team && team->process == getpid()) zr_team_destroy(team->team);
    free(team);
}

void zraster_close(zraster *renderer)
{
    if (!renderer || atomic_fetch_sub_explicit(&renderer->users, 1, memory_order_acq_rel) != 1) return;
    zraster_trim(renderer);
    free_team(atomic_load(&renderer->team));
    freelocale(renderer->c_locale);
    free(atomic_load(&renderer->tables));
    free(atomic_load(&renderer->schema));
    free(renderer);
}

size_t zraster_spare_memory(void)
{
    return zr_spare_memory();
}

/* ---- threads ---- */

/* Makes a team whose helpers block all signals, so that handlers run in threads of the program. Signals of faults reach
 * the thread that has the fault: blocked, they would end the process without its handler. */
static struct zr_process_team *make_team(int threads, pid_t process)
{
    static const int faults[] = {SIGBUS, SIGSEGV, SIGFPE, SIGILL};
    struct zr_process_team *made = malloc(sizeof *made);
    sigset_t all, before;
    if (!made) return NULL;
    sigfillset(&all);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        sigdelset(&all, faults[i]);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    *made = (struct zr_process_team){process, zr_team_create(threads)};
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (made->team) return made;
    free(made);
    return NULL;
}

struct zr_team *zr_renderer_team(zraster *renderer)
{
    const pid_t process = getpid();
    struct zr_process_team *team = atomic_load(&renderer->team);
    if (team && team->process == process) return team->team;
    struct zr_process_team *made = make_team(renderer->threads, process);
    if (!made) return NULL;
    if (atomic_compare_exchange_strong(&renderer->team, &team, made)) return made->team;
    free_team(made); /* another thread was first */
    return team->team;
}

/* ---- memory ---- */

static _Atomic(struct zr_arena *) *slots_of(zraster *renderer, enum zr_arena_use use)
{
    return use == ZR_ARENA_SCRATCH ? renderer->idle_scratch : renderer->idle_results;
}

static struct zr_arena *take_idle(zraster *renderer, enum zr_arena_use use)
{
    _Atomic(struct zr_arena *) *slots = slots_of(renderer, use);
    for (int i = 0; i < ZR_IDLE_ARENAS; i++) {
        if (!atomic_load_explicit(&slots[i], memory_order_relaxed)) continue;
        struct zr_arena *arena = atomic_exchange(&slots[i], NULL);
        if (!arena) continue;
        atomic_fetch_sub(&renderer->kept, arena->spare_bytes);
        return arena;
    }
    return NULL;
}

struct zr_arena *zr_renderer_take(zraster *renderer, enum zr_arena_use use, size_t beside)
{
    struct zr_arena *arena = take_idle(renderer, use);
    if (!arena) {
        arena = malloc(sizeof *arena);
        if (arena) zr_arena_init(arena, renderer->memory_max);
    }
    if (arena && beside > 0) zr_arena_charge(arena, beside); /* or it has failed */
    return arena;
}

static void free_arena(struct zr_arena *arena)
{
    zr_arena_free(arena);
    free(arena);
}

/* Empties the arena and keeps its blocks as far as the budget allows. */
static void keep_some(zraster *renderer, struct zr_arena *arena, enum zr_arena_use use)
{
    const size_t kept = atomic_load(&renderer->kept);
    size_t left = kept < renderer->memory_keep ? renderer->memory_keep - kept : 0;
    if (use == ZR_ARENA_RESULT && left > RESULT_KEEP_MAX) left = RESULT_KEEP_MAX;
    zr_arena_reset(arena, left);
    if (atomic_fetch_add(&renderer->kept, arena->spare_bytes) + arena->spare_bytes <= renderer->memory_keep) return;
    atomic_fetch_sub(&renderer->kept, arena->spare_bytes); /* another thread took the rest of the budget */
    zr_arena_reset(arena, 0);
}

void zr_renderer_give(zraster *renderer, struct zr_arena *arena, enum zr_arena_use use)
{
    _Atomic(struct zr_arena *) *slots = slots_of(renderer, use);
    if (!arena) return;
    keep_some(renderer, arena, use);
    arena->cancel = NULL;
    const size_t bytes = arena->spare_bytes; /* the arena is another thread's once it is in a slot */
    for (int i = 0; bytes > 0 && i < ZR_IDLE_ARENAS; i++) {
        struct zr_arena *none = NULL;
        if (atomic_compare_exchange_strong(&slots[i], &none, arena)) return;
    }
    atomic_fetch_sub(&renderer->kept, bytes);
    free_arena(arena);
}

void zraster_trim(zraster *renderer)
{
    static const enum zr_arena_use uses[] = {ZR_ARENA_SCRATCH, ZR_ARENA_RESULT};
    if (!renderer) return;
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++)
        for (struct zr_arena *arena; (arena = take_idle(renderer, uses[i])) != NULL;)
            free_arena(arena);
}

/* ---- locale ---- */

locale_t zr_renderer_enter(const zraster *renderer)
{
    return uselocale(renderer->c_locale);
}

void zr_renderer_leave(locale_t before)
{
    uselocale(before);
}
