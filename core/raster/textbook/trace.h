/* trace.h - raster: steps of a hidden-surface algorithm, for the channel trace.
 *
 * Algorithms record their steps in zr_samples.trace, which is NULL in production: they look at it once a row or a span.
 * A trace is a list of values that open and close objects and lists, as in JSON (output/json/trace_json.h prints it).
 *
 * Space:  window space, y up: rows count from the bottom, and the centre of pixel X, Y is at X, Y.
 * Bounds: numbers of steps and of values. A trace beyond them, or without memory, raises its cancel flag, which ends
 *         the algorithm. */
#ifndef ZR_TRACE_H
#define ZR_TRACE_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/run.h"
#include "raster/samples.h"

enum { ZR_TRACE_VALUES_MAX = 1 << 20 };

enum zr_trace_kind {
    ZR_TRACE_BEGIN,
    ZR_TRACE_END,
    ZR_TRACE_INTEGER,
    ZR_TRACE_FLOAT,
    ZR_TRACE_REAL,
    ZR_TRACE_TEXT,
    ZR_TRACE_BOOL
};

struct zr_trace_value {
    const char *key; /* a literal; NULL in lists */
    enum zr_trace_kind kind;
    union {
        char bracket; /* of the object or list that begins or ends */
        int64_t integer;
        float number;
        double real;
        const char *text; /* a literal */
        bool is_true;
    };
};

/* A primitive of the trace: its triangles, in scene order. Its id is 1 + its place in the list. */
struct zr_trace_primitive {
    uint32_t first, count;
};

struct zr_trace {
    struct zr_arena *arena;
    struct zr_cancel cancel; /* for the algorithm */
    uint32_t steps;
    bool is_beyond; /* the bounds */
    size_t count, room;
    struct zr_trace_value *values;
    uint32_t primitive_count;
    struct zr_trace_primitive primitives[ZR_TRACE_PRIMITIVES_MAX];
    int32_t *xs; /* temporary crossings of a row */
    size_t xs_room;
};

/* ---- values ---- */

void zr_trace_begin(struct zr_trace *trace, const char *key, char bracket);
void zr_trace_end(struct zr_trace *trace, char bracket);
void zr_trace_integer(struct zr_trace *trace, const char *key, int64_t value);
void zr_trace_float(struct zr_trace *trace, const char *key, float value);
void zr_trace_text(struct zr_trace *trace, const char *key, const char *text);
void zr_trace_bool(struct zr_trace *trace, const char *key, bool value);

/* Records a coordinate of the snapped grid, in pixels. */
void zr_trace_place(struct zr_trace *trace, const char *key, int32_t snapped);

/* Opens the object of a step. */
void zr_trace_step(struct zr_trace *trace);

/* Records a list of integers. */
void zr_trace_integers(struct zr_trace *trace, const char *key, const int64_t *values, int count);

/* ---- primitives and rows ---- */

/* Records window and primitives, and opens the list of steps. `primitives` has at most ZR_TRACE_PRIMITIVES_MAX. */
struct zr_primitives;
void zr_trace_open(struct zr_trace *trace, const char *algorithm, const struct zr_geometry *geometry,
                   const struct zr_primitives *primitives);
void zr_trace_close(struct zr_trace *trace);

/* Returns the id of the primitive to which triangle `number` belongs; 0: none. */
uint32_t zr_trace_id(const struct zr_trace *trace, uint32_t number);

/* Records spans of a row with their depths and z-tests: xs[0] .. xs[1] - 1, xs[2] .. xs[3] - 1, and so on. They must
 * not be drawn yet, and lie in the window, apart, and inside the primitive. */
void zr_trace_spans(struct zr_trace *trace, const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                    int32_t y, const int32_t *xs, size_t count, const struct zr_samples *samples);

/* Returns room for `count` crossings, until the next call; NULL without memory. */
int32_t *zr_trace_crossings(struct zr_trace *trace, size_t count);

/* ---- halfspace ---- */

/* The half-space algorithm of lessons: sample by sample, without vectors. Its tiles have 4 x 4 samples. Triangles have
 * edge functions; for other primitives, each edge flips the samples right of it, as in oddeven.h. A zr_visibility_fn.
 */
enum zr_status zr_plain_halfspace(const struct zr_run *run, const struct zr_geometry *geometry,
                                  struct zr_samples *samples);

#endif
