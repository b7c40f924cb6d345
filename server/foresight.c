#include "foresight.h"

#include <math.h>
#include <stdbool.h>

#include "clock.h"
#include "scene/sight.h"

/* Where learning begins: one core of a few years ago. Right to a factor of some, which is
 * enough to tell a second from a minute. */
static const double INITIAL_NS[FORESIGHT_KINDS] = {
    [FORESIGHT_TRIANGLE] = 150.0,     [FORESIGHT_FRAGMENT] = 0.6, [FORESIGHT_SHAPE_TRIANGLE] = 150.0,
    [FORESIGHT_SHAPE_FRAGMENT] = 0.6, [FORESIGHT_PIXEL] = 1.0,    [FORESIGHT_PNG_PIXEL] = 8.0};

/* INITIAL_WEIGHT: the figures above count as a quarter of a request. WEIGHT_MAX: a new request
 * always counts for an eighth, so that what is known keeps up with the machine. */
static const double INITIAL_WEIGHT = 0.25, WEIGHT_MAX = 7.0;
static const double STEP_DOWN = 8.0, STEP_UP = 2.0; /* however wrong one request was foreseen */
static const double RISE_MAX = 2.0;                 /* above the lowest */
static const double REFUSED_GAIN = 0.125;           /* of the way back to the lowest, or to the figures above */
static const double FASTEST = 64.0, SLOWEST = 8.0;  /* than the figures above, at most */
static const double LEAST_MS = 0.3;

void foresight_init(struct foresight *foresight)
{
    *foresight = (struct foresight){.running = 0};
    pthread_mutex_init(&foresight->lock, NULL);
    for (struct foresight_task *task = foresight->tasks; task < foresight->tasks + FORESIGHT_TASKS; task++)
        for (int kind = 0; kind < FORESIGHT_KINDS; kind++) {
            task->unit_ns[kind] = INITIAL_NS[kind];
            task->lowest_ns[kind] = INITIAL_NS[kind] * SLOWEST / RISE_MAX;
            task->weight[kind] = INITIAL_WEIGHT;
        }
}

void foresight_free(struct foresight *foresight)
{
    pthread_mutex_destroy(&foresight->lock);
}

struct units {
    double of[FORESIGHT_KINDS];
};

static struct units rendered(const struct zr_cost *cost)
{
    return (struct units){{[FORESIGHT_TRIANGLE] = cost->triangles,
                           [FORESIGHT_FRAGMENT] = cost->fragments,
                           [FORESIGHT_SHAPE_TRIANGLE] = cost->shape_triangles,
                           [FORESIGHT_SHAPE_FRAGMENT] = cost->shape_fragments,
                           [FORESIGHT_PIXEL] = cost->pixels}};
}

static struct units encoded(const struct zr_cost *cost)
{
    return (struct units){{[FORESIGHT_PNG_PIXEL] = cost->png_pixels}};
}

static double predict_ns(const struct foresight_task *task, const struct units *units)
{
    double sum = 0.0;
    for (int kind = 0; kind < FORESIGHT_KINDS; kind++)
        sum += task->unit_ns[kind] * units->of[kind];
    return sum;
}

static struct foresight_task *task_of(struct foresight *foresight, const struct zr_cost *cost)
{
    return &foresight->tasks[cost->algorithm];
}

double foresight_predict_ms(struct foresight *foresight, const struct zr_cost *cost)
{
    struct units render = rendered(cost), encode = encoded(cost);
    pthread_mutex_lock(&foresight->lock);
    double ns =
        predict_ns(task_of(foresight, cost), &render) + predict_ns(&foresight->tasks[FORESIGHT_ENCODE], &encode);
    pthread_mutex_unlock(&foresight->lock);
    return ns * 1e-6;
}

/* With the lock held. Each kind is moved by its share of what was foreseen: a kind that a request hardly has in it
 * learns hardly anything from it. Steps are of logarithms, so that half and twice as much weigh the same. */
static void learn(struct foresight_task *task, const struct units *units, double took_ms)
{
    double foreseen_ns = predict_ns(task, units);
    if (took_ms < LEAST_MS || foreseen_ns <= 0.0) return;
    double ratio = fmin(fmax(took_ms * 1e6 / foreseen_ns, 1.0 / STEP_DOWN), STEP_UP);
    for (int kind = 0; kind < FORESIGHT_KINDS; kind++) {
        double share = task->unit_ns[kind] * units->of[kind] / foreseen_ns;
        if (share <= 0.0) continue;
        double gain = share / (task->weight[kind] + share), unit_ns = task->unit_ns[kind] * pow(ratio, gain);
        task->unit_ns[kind] = fmin(fmax(unit_ns, INITIAL_NS[kind] / FASTEST), task->lowest_ns[kind] * RISE_MAX);
        task->lowest_ns[kind] = fmin(task->lowest_ns[kind], task->unit_ns[kind]);
        task->weight[kind] = fmin(task->weight[kind] + share, WEIGHT_MAX);
    }
}

/* With the lock held. */
static void go_back(struct foresight_task *task, const struct units *units)
{
    for (int kind = 0; kind < FORESIGHT_KINDS; kind++) {
        double end_ns = fmin(task->lowest_ns[kind], INITIAL_NS[kind]);
        if (units->of[kind] > 0.0 && task->unit_ns[kind] > end_ns)
            task->unit_ns[kind] *= pow(end_ns / task->unit_ns[kind], REFUSED_GAIN);
    }
}

void foresight_refused(struct foresight *foresight, const struct zr_cost *cost)
{
    struct units render = rendered(cost), encode = encoded(cost);
    pthread_mutex_lock(&foresight->lock);
    go_back(task_of(foresight, cost), &render);
    go_back(&foresight->tasks[FORESIGHT_ENCODE], &encode);
    pthread_mutex_unlock(&foresight->lock);
}

void foresight_learn(struct foresight *foresight, const struct zr_cost *cost, double render_ms, double encode_ms)
{
    struct units render = rendered(cost), encode = encoded(cost);
    pthread_mutex_lock(&foresight->lock);
    learn(task_of(foresight, cost), &render, render_ms);
    learn(&foresight->tasks[FORESIGHT_ENCODE], &encode, encode_ms);
    pthread_mutex_unlock(&foresight->lock);
}

/* ---- processor time of one request ---- */

void foresight_begin(struct foresight *foresight)
{
    pthread_mutex_lock(&foresight->lock);
    foresight->running++;
    if (++foresight->begun == 0) foresight->begun = 1;
    pthread_mutex_unlock(&foresight->lock);
}

void foresight_end(struct foresight *foresight)
{
    pthread_mutex_lock(&foresight->lock);
    foresight->running--;
    pthread_mutex_unlock(&foresight->lock);
}

struct foresight_lap foresight_start_lap(struct foresight *foresight)
{
    pthread_mutex_lock(&foresight->lock);
    unsigned begun = foresight->running == 1 ? foresight->begun : 0;
    pthread_mutex_unlock(&foresight->lock);
    return (struct foresight_lap){begun, clock_process_us()};
}

double foresight_end_lap(struct foresight *foresight, struct foresight_lap *lap)
{
    struct foresight_lap next = foresight_start_lap(foresight);
    bool alone = lap->begun != 0 && lap->begun == next.begun;
    double ms = alone ? (double)(next.processor_us - lap->processor_us) / 1000.0 : -1.0;
    *lap = next;
    return ms;
}
