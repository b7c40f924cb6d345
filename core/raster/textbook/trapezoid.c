/* trapezoid.c - raster: draws polygon by polygon into a z-buffer, cut into trapezoids between rows.
 *
 * From row to row, active edges keep their order from left to right until one begins, one ends, or two cross. Between
 * such rows, each pair of edges bounds a trapezoid. Its parallel sides lie along rows, and its left and right x change
 * by constant steps.
 * Source: Foley, van Dam, Feiner & Hughes, "Computer Graphics: Principles and Practice", 1990, 3.6; the cutting is
 *         Fournier & Montuno's, "Triangulating Simple Polygons and Equivalent Problems", 1984; the z-buffer is
 *         Catmull's, 1974.
 * Exact:  x is an integer column and a distance from the edge in parts. The number of parts per column is chosen so
 *         that a step is an integer number of columns and parts. Nothing is rounded, so no error accumulates. With
 *         corners below 2^22 in magnitude, a column has less than 2^31 parts. */
#include "base/run.h"
#include "raster/textbook/algorithms.h"
#include "raster/textbook/trace.h"

/* An edge: its rows, and where it crosses the current one. */
struct side {
    int32_t begin, end;
    int32_t x;         /* first column not left of the edge */
    int64_t excess;    /* parts from the edge to x: 0 .. whole - 1 */
    int32_t step;      /* columns per row, rounded down */
    int64_t step_rest; /* parts per row beyond `step`: 0 .. whole - 1 */
    int64_t whole;     /* parts per column */
    uint32_t next;     /* next side that begins in the same row: 1 + number; 0: none */
};

struct polygon {
    uint32_t *beginning;   /* by row of the window: first side that begins there, 1 + number, or 0 */
    struct side *sides;    /* one per edge */
    struct side **passing; /* sides that cross the row, from left to right */
    uint32_t passing_count, room;
    struct zr_hit *hits; /* of one row */
};

/* ---- sides ---- */

static int64_t floor_divide(int64_t dividend, int64_t divisor)
{
    int64_t rest = dividend % divisor;
    return (dividend - (rest < 0 ? rest + divisor : rest)) / divisor;
}

/* Makes a side, cut to the rows of the box. Returns false if no rows remain. */
static bool make_side(const struct zr_grid_edge *edge, const struct zr_primitive *box, struct side *side)
{
    int64_t run = (int64_t)edge->x1 - edge->x0, rise = (int64_t)edge->y1 - edge->y0;
    int32_t begin = (edge->y0 + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS,
            end = (edge->y1 + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS;
    side->begin = begin > box->min_y ? begin : box->min_y;
    side->end = end <= box->max_y ? end : box->max_y + 1;
    side->whole = rise * ZR_SUBPIXELS;
    int64_t parts = edge->x0 * rise + run * ((int64_t)side->begin * ZR_SUBPIXELS - edge->y0);
    int64_t column = -floor_divide(-parts, side->whole);
    side->x = (int32_t)column;
    side->excess = column * side->whole - parts;
    side->step = (int32_t)floor_divide(run, rise);
    side->step_rest = (run - side->step * rise) * ZR_SUBPIXELS;
    return side->begin < side->end;
}

static void step(struct side *side)
{
    side->x += side->step;
    side->excess -= side->step_rest;
    if (side->excess >= 0) return;
    side->x++;
    side->excess += side->whole;
}

static bool make_sides(struct zr_arena *arena, const struct zr_primitive *primitive, struct polygon *polygon)
{
    if (primitive->edge_count > polygon->room) {
        polygon->room = primitive->edge_count > 2 * polygon->room ? primitive->edge_count : 2 * polygon->room;
        polygon->sides = zr_arena_alloc(arena, polygon->room, sizeof *polygon->sides);
        polygon->passing = zr_arena_alloc(arena, polygon->room, sizeof *polygon->passing);
        if (!zr_arena_ok(arena)) return false;
    }
    polygon->passing_count = 0;
    for (int32_t y = primitive->min_y; y <= primitive->max_y; y++)
        polygon->beginning[y] = 0;
    const struct zr_grid_edge *edges = zr_primitive_edges(primitive);
    for (uint32_t i = 0; i < primitive->edge_count; i++) {
        struct side *side = &polygon->sides[i];
        if (!make_side(&edges[i], primitive, side)) continue;
        side->next = polygon->beginning[side->begin];
        polygon->beginning[side->begin] = i + 1;
    }
    return true;
}

/* ---- rows where trapezoids begin ---- */

/* Restores the order after sides begin or cross: few have to move, and not far. */
static void sort(struct polygon *polygon)
{
    for (uint32_t i = 1; i < polygon->passing_count; i++) {
        struct side *side = polygon->passing[i];
        uint32_t to = i;
        for (; to > 0 && polygon->passing[to - 1]->x > side->x; to--)
            polygon->passing[to] = polygon->passing[to - 1];
        polygon->passing[to] = side;
    }
}

static bool is_sorted(const struct polygon *polygon)
{
    for (uint32_t i = 1; i < polygon->passing_count; i++)
        if (polygon->passing[i - 1]->x > polygon->passing[i]->x) return false;
    return true;
}

static void begin_and_end_sides(struct polygon *polygon, int32_t y)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < polygon->passing_count; i++)
        if (polygon->passing[i]->end > y) polygon->passing[kept++] = polygon->passing[i];
    for (uint32_t number = polygon->beginning[y]; number > 0; number = polygon->sides[number - 1].next)
        polygon->passing[kept++] = &polygon->sides[number - 1];
    polygon->passing_count = kept;
    sort(polygon);
}

/* Returns the next row above y in which a side begins or ends. */
static int32_t next_change(const struct polygon *polygon, int32_t y, int32_t end)
{
    for (uint32_t i = 0; i < polygon->passing_count; i++)
        if (polygon->passing[i]->end < end) end = polygon->passing[i]->end;
    for (int32_t row = y + 1; row < end; row++)
        if (polygon->beginning[row] > 0) return row;
    return end;
}

/* ---- trapezoids ---- */

static void fill(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t y, int32_t left,
                 int32_t right, struct zr_hit *hits, struct zr_samples *samples)
{
    if (left < 0) left = 0;
    if (right > (int32_t)samples->width) right = (int32_t)samples->width;
    if (left < right) zr_primitive_hits(geometry, primitive, y, left, right, hits);
    for (int32_t x = left; x < right; x++)
        zr_samples_put(samples, x, y, hits[x - left]);
}

static void trace_side(struct zr_trace *trace, const char *key, const struct polygon *polygon, const struct side *side)
{
    zr_trace_begin(trace, key, '{');
    zr_trace_integer(trace, "edge", side - polygon->sides);
    zr_trace_integer(trace, "x", side->x);
    zr_trace_integer(trace, "excess", side->excess);
    zr_trace_integer(trace, "step", side->step);
    zr_trace_integer(trace, "rest", side->step_rest);
    zr_trace_integer(trace, "parts", side->whole);
    zr_trace_end(trace, '}');
}

/* Records the trapezoids that begin in row y. */
static void trace_trapezoids(struct zr_trace *trace, const struct zr_primitive *primitive,
                             const struct polygon *polygon, int32_t y, int32_t end)
{
    zr_trace_step(trace);
    zr_trace_integer(trace, "primitive", zr_trace_id(trace, primitive->first));
    zr_trace_integer(trace, "bottom", y);
    zr_trace_integer(trace, "top", end);
    zr_trace_begin(trace, "trapezoids", '[');
    for (uint32_t i = 0; i + 1 < polygon->passing_count; i += 2) {
        zr_trace_begin(trace, NULL, '{');
        trace_side(trace, "left", polygon, polygon->passing[i]);
        trace_side(trace, "right", polygon, polygon->passing[i + 1]);
        zr_trace_end(trace, '}');
    }
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

static void trace_row(struct zr_trace *trace, const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                      const struct polygon *polygon, int32_t y, const struct zr_samples *samples)
{
    const int32_t width = (int32_t)samples->width;
    int32_t *xs = zr_trace_crossings(trace, polygon->passing_count);
    for (uint32_t i = 0; xs && i < polygon->passing_count; i++) {
        const int32_t x = polygon->passing[i]->x;
        xs[i] = x < 0 ? 0 : x < width ? x : width;
    }
    zr_trace_step(trace);
    zr_trace_integer(trace, "primitive", zr_trace_id(trace, primitive->first));
    zr_trace_integer(trace, "row", y);
    zr_trace_spans(trace, geometry, primitive, y, xs, xs ? polygon->passing_count : 0, samples);
    zr_trace_end(trace, '}');
}

/* Draws the trapezoids from row y on, and returns the row at which they end: `end`, or that in which two sides have
 * crossed. */
static int32_t draw_trapezoids(const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                               struct polygon *polygon, int32_t y, int32_t end, const struct zr_cancel *cancel,
                               struct zr_samples *samples)
{
    if (samples->trace) trace_trapezoids(samples->trace, primitive, polygon, y, end);
    do {
        if (samples->trace) trace_row(samples->trace, geometry, primitive, polygon, y, samples);
        for (uint32_t i = 0; i + 1 < polygon->passing_count; i += 2)
            fill(geometry, primitive, y, polygon->passing[i]->x, polygon->passing[i + 1]->x, polygon->hits, samples);
        for (uint32_t i = 0; i < polygon->passing_count; i++)
            step(polygon->passing[i]);
        y++;
    } while (y < end && is_sorted(polygon) && !zr_is_cancelled(cancel));
    return y;
}

static enum zr_status draw(const struct zr_run *run, const struct zr_geometry *geometry,
                           const struct zr_primitive *primitive, struct polygon *polygon, struct zr_samples *samples)
{
    if (!make_sides(run->arena, primitive, polygon)) return ZR_NO_MEMORY;
    for (int32_t y = primitive->min_y; y <= primitive->max_y;) {
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        begin_and_end_sides(polygon, y);
        int32_t end = next_change(polygon, y, primitive->max_y + 1);
        y = draw_trapezoids(geometry, primitive, polygon, y, end, run->cancel, samples);
    }
    return ZR_OK;
}

enum zr_status zr_trapezoid(const struct zr_run *run, const struct zr_geometry *geometry, struct zr_samples *samples)
{
    struct polygon polygon = {.beginning = zr_arena_alloc(run->arena, samples->height, sizeof *polygon.beginning),
                              .hits = zr_arena_alloc(run->arena, samples->width, sizeof *polygon.hits)};
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    const struct zr_draw *of = &geometry->draws[0];
    struct zr_primitive primitive;
    for (uint32_t first = 0; first < geometry->primitive_count; first += primitive.count) {
        of = zr_draw_next(geometry, of, first);
        if (!zr_samples_take(samples, of)) {
            primitive.count = zr_primitive_count(geometry, of, first);
            continue;
        }
        zr_primitive_make(geometry, of, first, samples->width, samples->height, &primitive);
        if (zr_primitive_is_empty(&primitive)) continue;
        enum zr_status status = draw(run, geometry, &primitive, &polygon, samples);
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}
