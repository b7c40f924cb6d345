/* server/jobs/queue.c: lanes of small and large jobs, their order, and memory that goes back to the system. */
#include <malloc.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <unistd.h>

#include "clock.h"
#include "jobs/queue.h"
#include "support/tests.h"

enum { CALM_MS = 1, PATIENCE_MS = 10000, LITTLE = 20000, PASS = 9 << 20 };

/* Reports its begin and the memory that its arena has then, allocates a little and a pass, and ends when it may. */
struct task {
    struct queue_job job;
    size_t had_memory;
    sem_t begun, may_end;
};

static void work(struct queue_job *job, struct zr_arena *arena)
{
    struct task *task = (struct task *)(void *)job;
    task->had_memory = arena->spare_bytes;
    zr_arena_alloc(arena, LITTLE, 1);
    const struct zr_arena_step pass = zr_arena_open_step(arena);
    zr_arena_alloc(arena, PASS, 1);
    zr_arena_close_step(arena, &pass);
    sem_post(&task->begun);
    sem_wait(&task->may_end);
}

static bool is_taken(struct queue *queue, struct queue_job *job, enum queue_lane lane)
{
    return queue_push(queue, job, lane) == REFUSAL_NONE;
}

static void task_init(struct task *task, bool may_end)
{
    *task = (struct task){.job.work = work};
    sem_init(&task->begun, 0, 0);
    sem_init(&task->may_end, 0, may_end);
}

static bool task_begins(struct task *task)
{
    const struct timespec until = clock_after_ms(PATIENCE_MS);
    return sem_clockwait(&task->begun, CLOCK_MONOTONIC, &until) == 0;
}

/* In the C library's place: a thread of the queue comes by here while it gives its memory back. */
static struct {
    struct queue *queue;
    struct task *task; /* NULL: nothing is pushed */
} pushed_in_trim;

int malloc_trim(size_t pad)
{
    struct task *task = pushed_in_trim.task;
    (void)pad;
    pushed_in_trim.task = NULL;
    if (task) queue_push(pushed_in_trim.queue, &task->job, QUEUE_SMALL);
    return 0;
}

TEST(job_that_comes_while_memory_goes_back_does_not_hold_up_later_small_ones)
{
    struct task first, second, large, small;
    task_init(&first, true);
    task_init(&second, true);
    task_init(&large, false);
    task_init(&small, true);
    struct queue *queue = queue_create(&(struct queue_options){.workers = 1, .capacity = 4, .calm_ms = CALM_MS});
    assert_non_null(queue);
    pushed_in_trim.queue = queue;
    pushed_in_trim.task = &second;
    assert_true(is_taken(queue, &first.job, QUEUE_LARGE)); /* the worker's, which then is calm */
    bool served = task_begins(&first) && task_begins(&second);
    assert_true(is_taken(queue, &large.job, QUEUE_LARGE));
    served = served && task_begins(&large);
    assert_true(is_taken(queue, &small.job, QUEUE_SMALL)); /* beside it, so the express's */
    served = served && task_begins(&small);
    sem_post(&large.may_end);
    queue_destroy(queue);
    assert_true(served);
}

/* One after the other, on one worker. */
static void run_two(struct task *first, struct task *second, const struct queue_options *options, bool when_calm)
{
    task_init(first, true);
    task_init(second, true);
    struct queue *queue = queue_create(options);
    assert_non_null(queue);
    pushed_in_trim.queue = queue;
    pushed_in_trim.task = when_calm ? second : NULL;
    assert_true(is_taken(queue, &first->job, QUEUE_LARGE));
    bool served = task_begins(first);
    if (!when_calm) assert_true(is_taken(queue, &second->job, QUEUE_LARGE));
    served = served && task_begins(second);
    queue_destroy(queue);
    assert_true(served);
}

TEST(memory_of_a_job_and_its_passes_is_kept_for_the_next_one)
{
    struct task first, second;
    const struct queue_options options = {.workers = 1,
                                          .capacity = 4,
                                          .request_memory_bytes = 1 << 24,
                                          .keep_memory_bytes = 1 << 24,
                                          .calm_ms = PATIENCE_MS};
    run_two(&first, &second, &options, false);
    assert_int_equal(first.had_memory, 0);
    assert_in_range(second.had_memory, PASS + LITTLE, 1 << 24);
}

TEST(memory_all_goes_back_when_it_is_calm)
{
    struct task first, second;
    const struct queue_options options = {
        .workers = 1, .capacity = 4, .request_memory_bytes = 1 << 24, .keep_memory_bytes = 1 << 24, .calm_ms = CALM_MS};
    run_two(&first, &second, &options, true);
    assert_int_equal(second.had_memory, 0);
}

/* ---- the express ---- */

/* A job that counts as small, runs until the queue reports that it takes too long, and then makes way. */
struct endless {
    struct queue_job job;
    struct queue *queue;
    sem_t begun;
    atomic_bool was_told, runs_again, may_end;
};

static void work_on(struct queue_job *job, struct zr_arena *arena)
{
    struct endless *endless = (struct endless *)(void *)job;
    (void)arena;
    if (!job->overdue) {
        endless->runs_again = true;
        return;
    }
    sem_post(&endless->begun);
    while (!zr_is_cancelled(job->overdue) && !endless->may_end)
        usleep(1000);
    endless->was_told = zr_is_cancelled(job->overdue);
    if (endless->was_told) queue_put_back(endless->queue, job);
}

TEST(small_jobs_do_not_wait_for_one_that_only_seemed_to_be_small)
{
    struct task large, small[2];
    struct endless endless = {.job.work = work_on};
    task_init(&large, false);
    sem_init(&endless.begun, 0, 0);
    struct queue *queue = endless.queue =
        queue_create(&(struct queue_options){.workers = 1, .capacity = 4, .calm_ms = PATIENCE_MS});
    assert_non_null(queue);
    assert_true(is_taken(queue, &large.job, QUEUE_LARGE));
    assert_true(task_begins(&large));
    assert_true(is_taken(queue, &endless.job, QUEUE_SMALL));
    assert_int_equal(sem_wait(&endless.begun), 0);
    usleep(2 * QUEUE_EXPRESS_MS * 1000);
    bool told_alone = endless.was_told; /* nobody waits: it may go on */
    bool served = true;
    for (int i = 0; i < 2; i++) {
        task_init(&small[i], true);
        assert_true(is_taken(queue, &small[i].job, QUEUE_SMALL));
        served = served && task_begins(&small[i]);
    }
    bool was_told = endless.was_told, ran_beside = endless.runs_again;
    endless.may_end = true;
    sem_post(&large.may_end);
    queue_destroy(queue);
    assert_true(served && was_told && !told_alone && !ran_beside);
    assert_true(endless.runs_again);
}

struct nap {
    struct queue_job job;
    sem_t *ended;
    unsigned ms;
};

static void sleep_on(struct queue_job *job, struct zr_arena *arena)
{
    struct nap *nap = (struct nap *)(void *)job;
    sem_t *ended = nap->ended;
    (void)arena;
    usleep(nap->ms * 1000);
    sem_post(ended);
}

/* What a job takes there, the small ones behind it wait for, however long that is. */
TEST(what_holds_up_the_express_counts_among_small_jobs)
{
    enum { LONG_MS = 4 * QUEUE_EXPRESS_MS, COMING = 10 };
    struct task large, express;
    sem_t ended;
    sem_init(&ended, 0, 0);
    task_init(&large, false);
    task_init(&express, false);
    struct nap nap = {{.work = sleep_on}, &ended, LONG_MS};
    struct queue *queue = queue_create(&(struct queue_options){.workers = 1, .capacity = 1000, .calm_ms = PATIENCE_MS});
    assert_non_null(queue);
    assert_true(is_taken(queue, &large.job, QUEUE_LARGE) && task_begins(&large));
    assert_int_equal(REFUSAL_NONE, queue_busy_with(queue, QUEUE_SMALL, COMING));
    assert_true(is_taken(queue, &nap.job, QUEUE_SMALL));
    assert_int_equal(sem_wait(&ended), 0);
    assert_true(is_taken(queue, &express.job, QUEUE_SMALL) && task_begins(&express)); /* the queue has counted it */
    const bool is_full = queue_busy_with(queue, QUEUE_SMALL, COMING);
    sem_post(&large.may_end);
    sem_post(&express.may_end);
    queue_destroy(queue);
    assert_true(is_full);
}

/* Two a worker are taken in any case. */
TEST(a_lane_takes_no_more_while_its_oldest_job_has_waited_for_too_long)
{
    struct task large, express, waiting[3];
    task_init(&large, false);
    task_init(&express, false);
    struct queue *queue = queue_create(&(struct queue_options){.workers = 1, .capacity = 1000, .calm_ms = PATIENCE_MS});
    assert_non_null(queue);
    assert_true(is_taken(queue, &large.job, QUEUE_LARGE) && task_begins(&large));
    assert_true(is_taken(queue, &express.job, QUEUE_SMALL) && task_begins(&express));
    for (int i = 0; i < 3; i++)
        task_init(&waiting[i], true);
    assert_true(is_taken(queue, &waiting[0].job, QUEUE_SMALL) && is_taken(queue, &waiting[1].job, QUEUE_SMALL));
    const bool is_full_at_once = queue_busy_with(queue, QUEUE_SMALL, 0);
    usleep((QUEUE_WAIT_MS + 100) * 1000);
    const bool takes_more = is_taken(queue, &waiting[2].job, QUEUE_SMALL);
    sem_post(&large.may_end);
    sem_post(&express.may_end);
    queue_destroy(queue);
    assert_true(!is_full_at_once && !takes_more);
}

/* ---- jobs that wait for their readers ---- */

/* Steps aside until it may go on, and then runs until it may end. */
struct pause {
    struct queue_job job;
    struct queue *queue;
    sem_t is_aside, may_go_on, is_back, may_end;
};

static void pause_on(struct queue_job *job, struct zr_arena *arena)
{
    struct pause *pause = (struct pause *)(void *)job;
    (void)arena;
    queue_step_aside(pause->queue, job);
    sem_post(&pause->is_aside);
    sem_wait(&pause->may_go_on);
    queue_step_back(pause->queue, job);
    sem_post(&pause->is_back);
    sem_wait(&pause->may_end);
}

/* Threads that stand in take the places; once a job is back, they end theirs and take no more. */
static int count_back(struct pause *pauses, int count)
{
    int back = 0, value;
    for (int i = 0; i < count; i++)
        back += sem_getvalue(&pauses[i].is_back, &value) == 0 && value > 0;
    return back;
}

TEST(jobs_that_step_aside_leave_their_places_to_others_and_take_the_next_ones_back)
{
    enum { PAUSES = 3 };
    struct pause pauses[PAUSES];
    struct task first, second, third;
    task_init(&first, false);
    task_init(&second, false);
    task_init(&third, true);
    struct queue *queue =
        queue_create(&(struct queue_options){.workers = 1, .stand_ins = PAUSES, .capacity = 9, .calm_ms = PATIENCE_MS});
    assert_non_null(queue);
    for (int i = 0; i < PAUSES; i++) {
        struct pause *pause = &pauses[i];
        *pause = (struct pause){.job.work = pause_on, .queue = queue};
        sem_init(&pause->is_aside, 0, 0);
        sem_init(&pause->may_go_on, 0, 0);
        sem_init(&pause->is_back, 0, 0);
        sem_init(&pause->may_end, 0, 0);
        assert_true(is_taken(queue, &pause->job, QUEUE_LARGE));
        assert_int_equal(sem_wait(&pause->is_aside), 0);
    }
    assert_true(is_taken(queue, &first.job, QUEUE_LARGE));
    const bool is_first_served = task_begins(&first);
    assert_true(is_taken(queue, &second.job, QUEUE_LARGE));
    usleep(20000);
    const bool is_one_at_once = sem_trywait(&second.begun) != 0;
    for (int i = 0; i < PAUSES; i++)
        sem_post(&pauses[i].may_go_on);
    usleep(20000);
    const bool do_wait = count_back(pauses, PAUSES) == 0; /* for the end of the first job */
    sem_post(&first.may_end);
    while (count_back(pauses, PAUSES) == 0)
        usleep(1000);
    usleep(20000);
    const bool is_one_back = count_back(pauses, PAUSES) == 1 && sem_trywait(&second.begun) != 0;
    queue_push(queue, &third.job, QUEUE_SMALL);
    const bool is_small_served = task_begins(&third); /* on the express */
    for (int i = 0; i < PAUSES; i++)
        sem_post(&pauses[i].may_end);
    const bool is_second_served = task_begins(&second);
    const bool are_back_before = count_back(pauses, PAUSES) == PAUSES;
    sem_post(&second.may_end);
    queue_destroy(queue);
    assert_true(is_first_served && is_one_at_once && do_wait && is_one_back);
    assert_true(is_small_served && is_second_served && are_back_before);
}

/* ---- bounds ---- */

/* How many jobs of so many milliseconds wait at most, and for how long the queue says that one more would. */
static size_t fill(enum queue_lane lane, unsigned ms, size_t capacity, unsigned *wait_s)
{
    enum { TAUGHT = 3, MAX = 1024 };
    static struct nap naps[TAUGHT + MAX];
    struct task large, express;
    sem_t ended;
    sem_init(&ended, 0, 0);
    task_init(&large, false);
    task_init(&express, false);
    struct queue *queue =
        queue_create(&(struct queue_options){.workers = 1, .capacity = capacity, .calm_ms = PATIENCE_MS});
    assert_non_null(queue);
    for (int i = 0; i < TAUGHT; i++) {
        naps[i] = (struct nap){{.work = sleep_on}, &ended, ms};
        assert_true(is_taken(queue, &naps[i].job, lane));
        assert_int_equal(sem_wait(&ended), 0);
    }
    usleep(20000); /* the queue has counted it */
    assert_true(is_taken(queue, &large.job, QUEUE_LARGE) && task_begins(&large));
    assert_true(is_taken(queue, &express.job, QUEUE_SMALL) && task_begins(&express));
    size_t count = 0;
    for (; count < MAX; count++) {
        naps[TAUGHT + count] = (struct nap){{.work = sleep_on}, &ended, 0};
        if (!is_taken(queue, &naps[TAUGHT + count].job, lane)) break;
    }
    assert_int_equal(queue_busy_with(queue, lane, 0), count == capacity ? REFUSAL_QUEUE : REFUSAL_WAIT);
    *wait_s = queue_wait_estimate_s(queue, lane);
    for (size_t i = 0; i < count; i++)
        if (i % 2) assert_true(queue_remove(queue, &naps[TAUGHT + i].job)); /* out of the middle */
    sem_post(&large.may_end);
    sem_post(&express.may_end);
    for (size_t i = 0; i < count; i++)
        if (i % 2 == 0) assert_int_equal(sem_wait(&ended), 0);
    queue_destroy(queue);
    return count;
}

TEST(what_jobs_took_is_forgotten_once_it_is_calm)
{
    enum { SLOW_MS = 600 };
    struct nap nap;
    sem_t ended;
    sem_init(&ended, 0, 0);
    struct queue *queue = queue_create(&(struct queue_options){.workers = 1, .capacity = 64, .calm_ms = 300});
    assert_non_null(queue);
    nap = (struct nap){{.work = sleep_on}, &ended, SLOW_MS};
    assert_true(is_taken(queue, &nap.job, QUEUE_LARGE));
    assert_int_equal(sem_wait(&ended), 0);
    usleep(20000); /* the queue has counted it, and is not calm yet */
    assert_true(queue_busy_with(queue, QUEUE_LARGE, 20));
    for (int i = 0; i < 500 && queue_busy_with(queue, QUEUE_LARGE, 20); i++)
        usleep(10000);
    assert_int_equal(REFUSAL_NONE, queue_busy_with(queue, QUEUE_LARGE, 20));
    queue_destroy(queue);
}

TEST(as_many_wait_as_are_begun_within_a_second)
{
    unsigned wait_s;
    size_t count = fill(QUEUE_SMALL, 40, 1000, &wait_s);
    assert_true(count > 10 && count <= 26 && wait_s <= 2);
    count = fill(QUEUE_SMALL, 2, 1000, &wait_s);
    assert_true(count > 100 && count < 510 && wait_s <= 2);
    assert_int_equal(fill(QUEUE_SMALL, 2, 50, &wait_s), 50);
    assert_true(wait_s == 1);
    count = fill(QUEUE_LARGE, 2500, 1000, &wait_s); /* two may wait whatever they take */
    assert_true(count == 2 && wait_s >= 6 && wait_s <= 8);
}

RUN_TESTS(NULL, NULL)
