/* foresight.h - how long will this work take? Judged by what such work has taken before.
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
#ifndef ZRASTERD_FORESIGHT_H
#define ZRASTERD_FORESIGHT_H

#include <pthread.h>
#include <stdint.h>

#include "zraster.h"

enum foresight_kind {
    FORESIGHT_TRIANGLE,
    FORESIGHT_FRAGMENT,
    FORESIGHT_SHAPE_TRIANGLE, /* meshes, which are drawn many triangles at once, teach nothing about shapes */
    FORESIGHT_SHAPE_FRAGMENT,
    FORESIGHT_PIXEL,
    FORESIGHT_PNG_PIXEL,
    FORESIGHT_KINDS
};

/* An algorithm of the renderer, or encoding. */
enum { FORESIGHT_ENCODE = 8, FORESIGHT_TASKS };

struct foresight_task {
    double unit_ns[FORESIGHT_KINDS];   /* on one thread */
    double lowest_ns[FORESIGHT_KINDS]; /* that it has been since the first request; before, what slow machines take */
    double weight[FORESIGHT_KINDS];    /* what was learned already, in requests of this kind alone; bounded */
};

struct foresight {
    pthread_mutex_t lock;
    struct foresight_task tasks[FORESIGHT_TASKS];
    unsigned running, begun; /* requests that are worked on, and that ever were */
};

void foresight_init(struct foresight *foresight);
void foresight_free(struct foresight *foresight);

/* Milliseconds that rendering and encoding will take on one thread. */
double foresight_predict_ms(struct foresight *foresight, const struct zr_cost *cost);

/* What the two did take, in processor time; below 0: not known. What was too short to tell
 * much, for it has a share of what every request takes, is passed over. */
void foresight_learn(struct foresight *foresight, const struct zr_cost *cost, double render_ms, double encode_ms);

/* Such work was refused for what it was predicted to take. */
void foresight_refused(struct foresight *foresight, const struct zr_cost *cost);

/* ---- processor time of one request ----
 *
 * It is the process's: only a request that nobody else's work overlaps can be told its own.
 *
 *     foresight_begin(f);
 *     struct foresight_lap lap = foresight_start_lap(f);
 *     ...
 *     ms = foresight_end_lap(f, &lap);     and on with the next
 *     foresight_end(f);
 */

struct foresight_lap {
    unsigned begun; /* 0: it was not alone */
    int64_t processor_us;
};

void foresight_begin(struct foresight *foresight);
void foresight_end(struct foresight *foresight);
struct foresight_lap foresight_start_lap(struct foresight *foresight);

/* Milliseconds since the lap began, and begins the next; -1 where others were at work meanwhile. */
double foresight_end_lap(struct foresight *foresight, struct foresight_lap *lap);

#endif
