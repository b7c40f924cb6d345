#include "prediction.h"

#include <math.h>
#include <stdbool.h>

#include "clock.h"
#include "scene/resolved_view.h"

/* Where learning begins: one core of a few years ago. Right to a factor of some, which is
 * enough to tell a second from a minute. */
static const double INITIAL_NS[PREDICTION_KINDS] = {
    [PREDICTION_TRIANGLE] = 150.0,     [PREDICTION_FRAGMENT] = 0.6, [PREDICTION_SHAPE_TRIANGLE] = 150.0,
    [PREDICTION_SHAPE_FRAGMENT] = 0.6, [PREDICTION_SAMPLE] = 8.0,   [PREDICTION_PIXEL] = 1.0,
    [PREDICTION_PNG_PIXEL] = 8.0};

/* INITIAL_WEIGHT: the figures above count as a quarter of a request. WEIGHT_MAX: a new request
 * always counts for an eighth, so that what is known keeps up with the machine. */
static const double INITIAL_WEIGHT = 0.25, WEIGHT_MAX = 7.0;
static const double STEP_DOWN = 8.0, STEP_UP = 2.0; /* however wrong one request was predicted */
static const double RISE_MAX = 2.0;                 /* above the lowest */
static const double REFUSED_GAIN = 0.125;           /* of the way back to the lowest, or to the figures above */
static const double FASTEST = 64.0, SLOWEST = 8.0;  /* than the figures above, at most */
static const double LEAST_MS = 0.3;

void prediction_init(struct prediction *prediction)
{
    *prediction = (struct prediction){.running = 0};
    pthread_mutex_init(&prediction->lock, NULL);
    for (struct prediction_task *task = prediction->tasks; task < prediction->tasks + PREDICTION_TASKS; task++)
        for (int kind = 0; kind < PREDICTION_KINDS; kind++) {
            task->unit_ns[kind] = INITIAL_NS[kind];
            task->lowest_ns[kind] = INITIAL_NS[kind] * SLOWEST / RISE_MAX;
            task->weight[kind] = INITIAL_WEIGHT;
        }
}

void prediction_free(struct prediction *prediction)
{
    pthread_mutex_destroy(&prediction->lock);
}

struct units {
    double of[PREDICTION_KINDS];
};

static struct units rendered(const struct zr_cost *cost)
{
    return (struct units){{[PREDICTION_TRIANGLE] = cost->triangles,
                           [PREDICTION_FRAGMENT] = cost->fragments,
                           [PREDICTION_SHAPE_TRIANGLE] = cost->shape_triangles,
                           [PREDICTION_SHAPE_FRAGMENT] = cost->shape_fragments,
                           [PREDICTION_SAMPLE] = cost->samples,
                           [PREDICTION_PIXEL] = cost->pixels}};
}

static struct units encoded(const struct zr_cost *cost)
{
    return (struct units){{[PREDICTION_PNG_PIXEL] = cost->png_pixels}};
}

static double predict_ns(const struct prediction_task *task, const struct units *units)
{
    double sum = 0.0;
    for (int kind = 0; kind < PREDICTION_KINDS; kind++)
        sum += task->unit_ns[kind] * units->of[kind];
    return sum;
}

static struct prediction_task *task_of(struct prediction *prediction, const struct zr_cost *cost)
{
    return &prediction->tasks[cost->algorithm];
}

double prediction_ms(struct prediction *prediction, const struct zr_cost *cost)
{
    struct units render = rendered(cost), encode = encoded(cost);
    pthread_mutex_lock(&prediction->lock);
    double ns =
        predict_ns(task_of(prediction, cost), &render) + predict_ns(&prediction->tasks[PREDICTION_ENCODE], &encode);
    pthread_mutex_unlock(&prediction->lock);
    return ns * 1e-6;
}

/* With the lock held. Each kind is moved by its share of what was predicted: a kind that a request hardly has in it
 * learns hardly anything from it. Steps are of logarithms, so that half and twice as much weigh the same. */
static void learn(struct prediction_task *task, const struct units *units, double took_ms)
{
    double predicted_ns = predict_ns(task, units);
    if (took_ms < LEAST_MS || predicted_ns <= 0.0) return;
    double ratio = fmin(fmax(took_ms * 1e6 / predicted_ns, 1.0 / STEP_DOWN), STEP_UP);
    for (int kind = 0; kind < PREDICTION_KINDS; kind++) {
        double share = task->unit_ns[kind] * units->of[kind] / predicted_ns;
        if (share <= 0.0) continue;
        double gain = share / (task->weight[kind] + share), unit_ns = task->unit_ns[kind] * pow(ratio, gain);
        task->unit_ns[kind] = fmin(fmax(unit_ns, INITIAL_NS[kind] / FASTEST), task->lowest_ns[kind] * RISE_MAX);
        task->lowest_ns[kind] = fmin(task->lowest_ns[kind], task->unit_ns[kind]);
        task->weight[kind] = fmin(task->weight[kind] + share, WEIGHT_MAX);
    }
}

/* With the lock held. */
static void go_back(struct prediction_task *task, const struct units *units)
{
    for (int kind = 0; kind < PREDICTION_KINDS; kind++) {
        double end_ns = fmin(task->lowest_ns[kind], INITIAL_NS[kind]);
        if (units->of[kind] > 0.0 && task->unit_ns[kind] > end_ns)
            task->unit_ns[kind] *= pow(end_ns / task->unit_ns[kind], REFUSED_GAIN);
    }
}

void prediction_refused(struct prediction *prediction, const struct zr_cost *cost)
{
    struct units render = rendered(cost), encode = encoded(cost);
    pthread_mutex_lock(&prediction->lock);
    go_back(task_of(prediction, cost), &render);
    go_back(&prediction->tasks[PREDICTION_ENCODE], &encode);
    pthread_mutex_unlock(&prediction->lock);
}

void prediction_learn(struct prediction *prediction, const struct zr_cost *cost, double render_ms, double encode_ms)
{
    struct units render = rendered(cost), encode = encoded(cost);
    pthread_mutex_lock(&prediction->lock);
    learn(task_of(prediction, cost), &render, render_ms);
    learn(&prediction->tasks[PREDICTION_ENCODE], &encode, encode_ms);
    pthread_mutex_unlock(&prediction->lock);
}

/* ---- processor time of one request ---- */

void prediction_begin(struct prediction *prediction)
{
    pthread_mutex_lock(&prediction->lock);
    prediction->running++;
    if (++prediction->begun == 0) prediction->begun = 1;
    pthread_mutex_unlock(&prediction->lock);
}

void prediction_end(struct prediction *prediction)
{
    pthread_mutex_lock(&prediction->lock);
    prediction->running--;
    pthread_mutex_unlock(&prediction->lock);
}

struct prediction_lap prediction_start_lap(struct prediction *prediction)
{
    pthread_mutex_lock(&prediction->lock);
    unsigned begun = prediction->running == 1 ? prediction->begun : 0;
    pthread_mutex_unlock(&prediction->lock);
    return (struct prediction_lap){begun, clock_process_us()};
}

double prediction_end_lap(struct prediction *prediction, struct prediction_lap *lap)
{
    struct prediction_lap next = prediction_start_lap(prediction);
    bool alone = lap->begun != 0 && lap->begun == next.begun;
    double ms = alone ? (double)(next.processor_us - lap->processor_us) / 1000.0 : -1.0;
    *lap = next;
    return ms;
}
