/* server/queue.c: who is woken, and when. */
#include <malloc.h>
#include <semaphore.h>

#include "clock.h"
#include "queue.h"
#include "support/cmocka_all.h"

enum { CALM_MS = 1, PATIENCE_MS = 10000, LITTLE = 20000 };

/* Says that it has begun, and what its arena then had, uses a little, and ends when it may. */
struct task {
    struct queue_job job;
    bool had_memory;
    sem_t begun, may_end;
};

static void work(struct queue_job *job, struct zr_arena *arena)
{
    struct task *task = (struct task *)(void *)job;
    task->had_memory = arena->first != NULL;
    zr_arena_alloc(arena, LITTLE, 1);
    sem_post(&task->begun);
    sem_wait(&task->may_end);
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

static void job_that_comes_while_memory_goes_back_does_not_hold_up_later_small_ones(void **state)
{
    (void)state;
    struct task first, second, large, small;
    task_init(&first, true);
    task_init(&second, true);
    task_init(&large, false);
    task_init(&small, true);
    struct queue *queue = queue_create(&(struct queue_options){.workers = 1, .capacity = 4, .calm_ms = CALM_MS});
    assert_non_null(queue);
    pushed_in_trim.queue = queue;
    pushed_in_trim.task = &second;
    assert_true(queue_push(queue, &first.job, QUEUE_LARGE)); /* the worker's, which then is calm */
    bool served = task_begins(&first) && task_begins(&second);
    assert_true(queue_push(queue, &large.job, QUEUE_LARGE));
    served = served && task_begins(&large);
    assert_true(queue_push(queue, &small.job, QUEUE_SMALL)); /* beside it, so the express's */
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
    assert_true(queue_push(queue, &first->job, QUEUE_LARGE));
    bool served = task_begins(first);
    if (!when_calm) assert_true(queue_push(queue, &second->job, QUEUE_LARGE));
    served = served && task_begins(second);
    queue_destroy(queue);
    assert_true(served);
}

static void memory_of_small_jobs_is_kept_for_the_next_one(void **state)
{
    (void)state;
    struct task first, second;
    const struct queue_options options = {.workers = 1,
                                          .capacity = 4,
                                          .request_memory_bytes = 1 << 24,
                                          .keep_memory_bytes = 1 << 24,
                                          .calm_ms = PATIENCE_MS};
    run_two(&first, &second, &options, false);
    assert_false(first.had_memory);
    assert_true(second.had_memory);
}

static void memory_all_goes_back_when_it_is_calm(void **state)
{
    (void)state;
    struct task first, second;
    const struct queue_options options = {
        .workers = 1, .capacity = 4, .request_memory_bytes = 1 << 24, .keep_memory_bytes = 1 << 24, .calm_ms = CALM_MS};
    run_two(&first, &second, &options, true);
    assert_false(second.had_memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_of_small_jobs_is_kept_for_the_next_one),
        cmocka_unit_test(memory_all_goes_back_when_it_is_calm),
        cmocka_unit_test(job_that_comes_while_memory_goes_back_does_not_hold_up_later_small_ones),
    };
    return cmocka_run_group_tests_name("queue", tests, NULL, NULL);
}
