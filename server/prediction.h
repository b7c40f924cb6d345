/* prediction.h - how long will this work take? Judged by what such work has taken before.
 *
 * The renderer counts the work of a scene (zr_scene_cost). What a unit of each kind takes
 * begins with figures of an ordinary machine, so that the daemon answers at once, and is
 * learned from the requests that are served, in processor time of all threads: so load
 * does not matter, and neither does how many threads share a picture.
 * Each algorithm is learned by itself, and encoding. Figures fall as far as requests show that the machine is faster,
 * but rise to twice the lowest only: no machine shows more than that it is faster than was thought, while a
 * request that is not what it seems can look slow without end. So what is refused is predicted right to a factor of
 * two, whoever taught what; and each refusal takes figures back towards the lowest, since what is refused can teach
 * nothing any more. Thread-safe.
 */
#ifndef ZRASTERD_PREDICTION_H
#define ZRASTERD_PREDICTION_H

#include <pthread.h>
#include <stdint.h>

#include "zraster.h"

enum prediction_kind {
    PREDICTION_TRIANGLE,
    PREDICTION_FRAGMENT,
    PREDICTION_SHAPE_TRIANGLE, /* meshes, which are drawn many triangles at once, teach nothing about shapes */
    PREDICTION_SHAPE_FRAGMENT,
    PREDICTION_SAMPLE,
    PREDICTION_PIXEL,
    PREDICTION_PNG_PIXEL,
    PREDICTION_KINDS
};

/* An algorithm of the renderer, or encoding. */
enum { PREDICTION_ENCODE = 8, PREDICTION_TASKS };

struct prediction_task {
    double unit_ns[PREDICTION_KINDS];   /* on one thread */
    double lowest_ns[PREDICTION_KINDS]; /* that it has been since the first request; before, what slow machines take */
    double weight[PREDICTION_KINDS];    /* what was learned already, in requests of this kind alone; bounded */
};

struct prediction {
    pthread_mutex_t lock;
    struct prediction_task tasks[PREDICTION_TASKS];
    unsigned running, begun; /* requests that are worked on, and that ever were */
};

void prediction_init(struct prediction *prediction);
void prediction_free(struct prediction *prediction);

/* Milliseconds that rendering and encoding will take on one thread. */
double prediction_ms(struct prediction *prediction, const struct zr_cost *cost);

/* What the two did take, in processor time; below 0: not known. What was too short to tell
 * much, for it has a share of what every request takes, is passed over. */
void prediction_learn(struct prediction *prediction, const struct zr_cost *cost, double render_ms, double encode_ms);

/* Such work was refused for what it was predicted to take. */
void prediction_refused(struct prediction *prediction, const struct zr_cost *cost);

/* ---- processor time of one request ----
 *
 * It is the process's: only a request that nobody else's work overlaps can be told its own.
 *
 *     prediction_begin(f);
 *     struct prediction_lap lap = prediction_start_lap(f);
 *     ...
 *     ms = prediction_end_lap(f, &lap);     and on with the next
 *     prediction_end(f);
 */

struct prediction_lap {
    unsigned begun; /* 0: it was not alone */
    int64_t processor_us;
};

void prediction_begin(struct prediction *prediction);
void prediction_end(struct prediction *prediction);
struct prediction_lap prediction_start_lap(struct prediction *prediction);

/* Milliseconds since the lap began, and begins the next; -1 where others were at work meanwhile. */
double prediction_end_lap(struct prediction *prediction, struct prediction_lap *lap);

#endif
