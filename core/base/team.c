#include "base/team.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#if defined __SSE2__
#include <emmintrin.h>
#endif

/* Shading needs 1.5 MB of stack, and ThreadSanitizer takes most of one MB. */
enum { STACK_BYTES = 3 << 20, YIELDS = 100, LINGERING_YIELDS = 200, PARTS_PER_THREAD = 3 };

/* Lives on the stack of its caller, which returns only when `inside` is 0. */
struct job {
    void (*work)(void *);
    void *context;
    atomic_int inside; /* helpers currently in `work`; changed under the lock */
    bool open;         /* false once some thread returned: no ranges are left */
    struct job *next;
};

struct zr_team {
    pthread_mutex_t lock;
    pthread_cond_t job_came, helper_left;
    struct job *jobs;
    atomic_uint jobs_ever; /* counter, may overflow; changed under the lock */
    bool stopping;
    enum zr_isa isa;
    int helper_count;
    pthread_t helpers[];
};

static struct job *find_open_job(struct zr_team *team)
{
    for (struct job *job = team->jobs; job; job = job->next)
        if (job->open) return job;
    return NULL;
}

/* Polls for the next job: a picture consists of several jobs. Sleeping and waking in between would take 20 us each time
 * (6 % of the bunny at 512x512). Yields the processor to others. Releases the lock meanwhile. */
static void linger(struct zr_team *team)
{
    const unsigned jobs_ever = atomic_load_explicit(&team->jobs_ever, memory_order_relaxed);
    pthread_mutex_unlock(&team->lock);
    for (int i = 0; i < LINGERING_YIELDS; i++) {
        if (atomic_load_explicit(&team->jobs_ever, memory_order_relaxed) != jobs_ever) break;
        sched_yield();
    }
    pthread_mutex_lock(&team->lock);
}

static void *help(void *argument)
{
    struct zr_team *team = argument;
    bool has_just_helped = false;
    pthread_mutex_lock(&team->lock);
    while (!team->stopping) {
        struct job *job = find_open_job(team);
        if (!job) {
            if (has_just_helped)
                linger(team);
            else
                pthread_cond_wait(&team->job_came, &team->lock);
            has_just_helped = false;
            continue;
        }
        job->inside++;
        pthread_mutex_unlock(&team->lock);
        job->work(job->context);
        pthread_mutex_lock(&team->lock);
        job->open = false;
        if (--job->inside == 0) pthread_cond_broadcast(&team->helper_left);
        has_just_helped = true;
    }
    pthread_mutex_unlock(&team->lock);
    return NULL;
}

struct zr_team *zr_team_create(int threads)
{
    return zr_team_create_for(threads, zr_isa_best());
}

struct zr_team *zr_team_create_for(int threads, enum zr_isa isa)
{
    if (threads < 1) threads = 1;
    if (threads > ZR_TEAM_MAX) threads = ZR_TEAM_MAX;
    struct zr_team *team = calloc(1, sizeof *team + sizeof(pthread_t) * (size_t)threads);
    if (!team) return NULL;
    team->isa = isa;
    pthread_mutex_init(&team->lock, NULL);
    pthread_cond_init(&team->job_came, NULL);
    pthread_cond_init(&team->helper_left, NULL);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    int failure = 0;
    while (team->helper_count < threads - 1 && !failure) {
        failure = pthread_create(&team->helpers[team->helper_count], &attributes, help, team);
        if (!failure) team->helper_count++;
    }
    pthread_attr_destroy(&attributes);
    if (failure) {
        zr_team_destroy(team);
        return NULL;
    }
    return team;
}

void zr_team_destroy(struct zr_team *team)
{
    if (!team) return;
    pthread_mutex_lock(&team->lock);
    team->stopping = true;
    pthread_cond_broadcast(&team->job_came);
    pthread_mutex_unlock(&team->lock);
    for (int i = 0; i < team->helper_count; i++)
        pthread_join(team->helpers[i], NULL);
    pthread_cond_destroy(&team->helper_left);
    pthread_cond_destroy(&team->job_came);
    pthread_mutex_destroy(&team->lock);
    free(team);
}

int zr_team_size(const struct zr_team *team)
{
    return team ? team->helper_count + 1 : 1;
}

enum zr_isa zr_team_isa(const struct zr_team *team)
{
    return team ? team->isa : zr_isa_best();
}

static void unlink_job(struct zr_team *team, struct job *job)
{
    struct job **link = &team->jobs;
    while (*link != job)
        link = &(*link)->next;
    *link = job->next;
}

/* Polls, since helpers are nearly done by now: sleeping and waking takes longer (30 us of the 800 of a large picture).
 * Yields the processor to others. */
static void wait_briefly(const atomic_int *inside)
{
    for (int i = 0; i < YIELDS && atomic_load_explicit(inside, memory_order_relaxed) > 0; i++)
        sched_yield();
}

/* Calls work(context) on this thread and on every idle helper, and returns when all calls have returned. The team must
 * have helpers. */
static void run(struct zr_team *team, void (*work)(void *context), void *context)
{
    struct job job = {.work = work, .context = context, .open = true};
    pthread_mutex_lock(&team->lock);
    /* Append, so that the oldest job gets help first. */
    struct job **link = &team->jobs;
    while (*link)
        link = &(*link)->next;
    *link = &job;
    atomic_fetch_add_explicit(&team->jobs_ever, 1, memory_order_relaxed);
    pthread_cond_broadcast(&team->job_came);
    pthread_mutex_unlock(&team->lock);

    work(context);

    pthread_mutex_lock(&team->lock);
    job.open = false;
    pthread_mutex_unlock(&team->lock);
    wait_briefly(&job.inside);
    pthread_mutex_lock(&team->lock);
    while (job.inside > 0)
        pthread_cond_wait(&team->helper_left, &team->lock);
    unlink_job(team, &job);
    pthread_mutex_unlock(&team->lock);
}

struct shares {
    atomic_size_t next;
    atomic_int workers; /* threads that have claimed a range */
    size_t count, grain;
    size_t parts; /* a claim takes 1 / parts of the remaining work */
    void (*work)(void *context, int worker, size_t begin, size_t end);
    void *context;
};

/* Claims consecutive ranges (guided self-scheduling): many at first, so that a thread's work is contiguous, and single
 * ones at the end, so that all threads finish together. Against single ranges throughout, this saves a tenth of the
 * time of a million triangles on two threads, and a fiftieth of a large picture's. */
static bool claim(struct shares *shares, size_t *begin, size_t *end)
{
    size_t next = atomic_load_explicit(&shares->next, memory_order_relaxed), after;
    do {
        if (next >= shares->count) return false;
        const size_t left = shares->count - next;
        size_t taken = left / shares->parts / shares->grain * shares->grain;
        if (taken < shares->grain) taken = shares->grain;
        after = taken < left ? next + taken : shares->count;
    } while (!atomic_compare_exchange_weak_explicit(&shares->next, &next, after, memory_order_relaxed,
                                                    memory_order_relaxed));
    *begin = next;
    *end = after;
    return true;
}

/* Orders non-temporal stores, which locks do not. Once per thread, since it waits for memory (once per range of tiles,
 * it took a fiftieth of a large picture's time). */
static void finish_stores(void)
{
#if defined __SSE2__
    _mm_sfence();
#endif
}

static void claim_shares(void *argument)
{
    struct shares *shares = argument;
    int worker = -1; /* assigned with the first range; latecomers get no number */
    size_t begin, end;
    while (claim(shares, &begin, &end)) {
        if (worker < 0) worker = atomic_fetch_add_explicit(&shares->workers, 1, memory_order_relaxed);
        for (; begin < end; begin += shares->grain)
            shares->work(shares->context, worker, begin, end - begin < shares->grain ? end : begin + shares->grain);
    }
    finish_stores();
}

void zr_team_shares(struct zr_team *team, size_t count, size_t grain,
                    void (*work)(void *context, int worker, size_t begin, size_t end), void *context)
{
    struct shares shares = {.count = count,
                            .grain = grain,
                            .parts = (size_t)zr_team_size(team) * PARTS_PER_THREAD,
                            .work = work,
                            .context = context};
    if (zr_team_size(team) > 1 && count > grain) {
        run(team, claim_shares, &shares);
        return;
    }
    for (size_t begin = 0; begin < count; begin += grain)
        work(context, 0, begin, count - begin < grain ? count : begin + grain);
    finish_stores();
}

struct ranges {
    void (*work)(void *context, size_t begin, size_t end);
    void *context;
};

static void work_on_range(void *argument, int worker, size_t begin, size_t end)
{
    struct ranges *ranges = argument;
    (void)worker;
    ranges->work(ranges->context, begin, end);
}

void zr_team_ranges(struct zr_team *team, size_t count, size_t grain,
                    void (*work)(void *context, size_t begin, size_t end), void *context)
{
    struct ranges ranges = {work, context};
    zr_team_shares(team, count, grain, work_on_range, &ranges);
}
