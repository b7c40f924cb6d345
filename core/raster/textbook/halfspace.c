/* halfspace.c - raster: the half-space algorithm of lessons, sample by sample (production's is halfspace_kernel.c).
 *
 * A triangle is the intersection of three half-planes. Each has an edge function c + a X + b Y, positive inside
 * (Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988). The function is linear, so it is greatest and least
 * at corners of a tile: a tile is outside if some function is positive at none of them, inside if all functions are
 * positive at all of them. Only samples of mixed tiles are tested.
 *
 * Polygons of any shape, lines and points have no such functions. Each of their edges flips the samples at and to the
 * right of it; samples flipped an odd number of times are covered (Ackland & Weste, "The Edge Flag Algorithm", 1981).
 */
#include <string.h>

#include "base/run.h"
#include "raster/setup.h"
#include "raster/textbook/algorithms.h"
#include "raster/textbook/trace.h"

enum { TILE_SIDE = 4 };

struct box {
    int32_t x0, y0, x1, y1; /* inclusive */
};

struct drawing {
    const struct zr_geometry *geometry;
    const struct zr_primitive *primitive;
    const struct zr_cancel *cancel;
    struct zr_samples *samples;
    struct zr_hit *hits; /* of one row */
    bool *flags;         /* of one row */
    int32_t *xs;         /* of one row */
};

/* Draws the spans xs[0] .. xs[1] - 1, xs[2] .. xs[3] - 1, and so on. */
static void put_spans(const struct drawing *d, int32_t y, const int32_t *xs, size_t count)
{
    if (d->samples->trace) zr_trace_spans(d->samples->trace, d->geometry, d->primitive, y, xs, count, d->samples);
    for (size_t i = 0; i + 1 < count; i += 2) {
        zr_primitive_hits(d->geometry, d->primitive, y, xs[i], xs[i + 1], d->hits);
        for (int32_t x = xs[i]; x < xs[i + 1]; x++)
            zr_samples_put(d->samples, x, y, d->hits[x - xs[i]]);
    }
}

/* ---- triangles ---- */

enum relation { OUTSIDE, MIXED, INSIDE };

static enum relation relate(const struct zr_setup *setup, const struct box *tile)
{
    enum relation relation = INSIDE;
    for (int k = 0; k < 3; k++) {
        const struct zr_edge *edge = &setup->edges[k];
        const bool right = edge->a > 0, up = edge->b > 0;
        const int64_t most = zr_edge_at(edge, right ? tile->x1 : tile->x0, up ? tile->y1 : tile->y0),
                      least = zr_edge_at(edge, right ? tile->x0 : tile->x1, up ? tile->y0 : tile->y1);
        if (most <= 0) return OUTSIDE;
        if (least <= 0) relation = MIXED;
    }
    return relation;
}

/* Finds the covered samples of a row of the tile: one span, since a triangle is convex. */
static void find_span(const struct zr_setup *setup, const struct box *tile, enum relation relation, int32_t y,
                      int32_t span[2])
{
    span[0] = tile->x0;
    while (relation == MIXED && span[0] <= tile->x1 && !zr_setup_covers(setup, span[0], y))
        span[0]++;
    span[1] = relation == MIXED ? span[0] : tile->x1 + 1;
    while (span[1] <= tile->x1 && zr_setup_covers(setup, span[1], y))
        span[1]++;
}

/* Records the edge functions, and opens the list of tiles. */
static void trace_edges(struct zr_trace *trace, const struct zr_setup *setup)
{
    zr_trace_begin(trace, "edges", '[');
    for (int k = 0; k < 3; k++)
        zr_trace_integers(trace, NULL, (int64_t[]){setup->edges[k].a, setup->edges[k].b, setup->edges[k].c}, 3);
    zr_trace_end(trace, ']');
    zr_trace_begin(trace, "tiles", '[');
}

/* Records a tile, and opens the list of its rows. */
static void trace_tile(struct zr_trace *trace, const struct box *tile, enum relation relation)
{
    static const char *const words[] = {[OUTSIDE] = "outside", [MIXED] = "mixed", [INSIDE] = "inside"};
    zr_trace_begin(trace, NULL, '{');
    zr_trace_integer(trace, "x", tile->x0);
    zr_trace_integer(trace, "y", tile->y0);
    zr_trace_integer(trace, "width", tile->x1 - tile->x0 + 1);
    zr_trace_integer(trace, "height", tile->y1 - tile->y0 + 1);
    zr_trace_text(trace, "is", words[relation]);
    zr_trace_begin(trace, "rows", '[');
}

static void draw_tile(const struct drawing *drawing, const struct zr_setup *setup, const struct box *tile)
{
    struct zr_trace *trace = drawing->samples->trace;
    const enum relation relation = relate(setup, tile);
    if (trace) trace_tile(trace, tile, relation);
    for (int32_t y = tile->y0; relation != OUTSIDE && y <= tile->y1; y++) {
        int32_t span[2];
        find_span(setup, tile, relation, y, span);
        if (span[0] >= span[1]) continue;
        if (trace) zr_trace_begin(trace, NULL, '{');
        if (trace) zr_trace_integer(trace, "row", y);
        put_spans(drawing, y, span, 2);
        if (trace) zr_trace_end(trace, '}');
    }
    if (trace) zr_trace_end(trace, ']');
    if (trace) zr_trace_end(trace, '}');
}

static void draw_triangle(const struct drawing *drawing)
{
    const struct zr_primitive *p = drawing->primitive;
    const struct zr_triangle triangle = zr_primitive_triangle(drawing->geometry, p, p->first);
    const struct zr_setup setup = zr_setup_make(drawing->geometry->vertices, &triangle);
    struct zr_trace *trace = drawing->samples->trace;
    if (trace) trace_edges(trace, &setup);
    for (int32_t y = p->min_y - p->min_y % TILE_SIDE; y <= p->max_y; y += TILE_SIDE)
        for (int32_t x = p->min_x - p->min_x % TILE_SIDE; x <= p->max_x; x += TILE_SIDE) {
            const int32_t x1 = x + TILE_SIDE - 1, y1 = y + TILE_SIDE - 1;
            const struct box tile = {x > p->min_x ? x : p->min_x, y > p->min_y ? y : p->min_y,
                                     x1 < p->max_x ? x1 : p->max_x, y1 < p->max_y ? y1 : p->max_y};
            draw_tile(drawing, &setup, &tile);
        }
    if (trace) zr_trace_end(trace, ']');
}

/* ---- other primitives ---- */

/* Returns true if the sample is not left of the edge. */
static bool is_right_of(const struct zr_grid_edge *edge, int32_t x, int32_t y)
{
    const int64_t along = (int64_t)y * ZR_SUBPIXELS - edge->y0, aside = (int64_t)x * ZR_SUBPIXELS - edge->x0;
    return aside * ((int64_t)edge->y1 - edge->y0) >= along * ((int64_t)edge->x1 - edge->x0);
}

/* Flips the flags of the box right of each edge that crosses the row. */
static void flip_row(const struct drawing *drawing, int32_t y)
{
    const struct zr_primitive *p = drawing->primitive;
    const struct zr_grid_edge *edges = zr_primitive_edges(p);
    struct zr_trace *trace = drawing->samples->trace;
    memset(drawing->flags, 0, drawing->samples->width * sizeof *drawing->flags);
    if (trace) zr_trace_begin(trace, "flips", '[');
    for (uint32_t i = 0; i < p->edge_count; i++) {
        const int64_t level = (int64_t)y * ZR_SUBPIXELS;
        if (level < edges[i].y0 || level >= edges[i].y1) continue;
        int32_t x = p->min_x;
        while (x <= p->max_x && !is_right_of(&edges[i], x, y))
            x++;
        if (trace) zr_trace_integer(trace, NULL, x);
        for (; x <= p->max_x; x++)
            drawing->flags[x] = !drawing->flags[x];
    }
    if (trace) zr_trace_end(trace, ']');
}

static void draw_flipped(const struct drawing *drawing, int32_t y)
{
    const int32_t width = (int32_t)drawing->samples->width;
    size_t count = 0;
    for (int32_t x = 0; x < width; x++)
        if (drawing->flags[x] != (x > 0 && drawing->flags[x - 1])) drawing->xs[count++] = x;
    if (count % 2 == 1) drawing->xs[count++] = width;
    put_spans(drawing, y, drawing->xs, count);
}

static void draw_by_flips(const struct drawing *drawing)
{
    struct zr_trace *trace = drawing->samples->trace;
    if (trace) zr_trace_begin(trace, "rows", '[');
    for (int32_t y = drawing->primitive->min_y; y <= drawing->primitive->max_y && !zr_is_cancelled(drawing->cancel);
         y++) {
        if (trace) zr_trace_begin(trace, NULL, '{');
        if (trace) zr_trace_integer(trace, "row", y);
        flip_row(drawing, y);
        draw_flipped(drawing, y);
        if (trace) zr_trace_end(trace, '}');
    }
    if (trace) zr_trace_end(trace, ']');
}

/* ---- entry point ---- */

/* Opens the step of a primitive. */
static void trace_primitive(struct zr_trace *trace, const struct zr_primitive *p)
{
    zr_trace_step(trace);
    zr_trace_integer(trace, "primitive", zr_trace_id(trace, p->first));
    zr_trace_integers(trace, "box", (int64_t[]){p->min_x, p->min_y, p->max_x, p->max_y}, 4);
}

enum zr_status zr_plain_halfspace(const struct zr_run *run, const struct zr_geometry *geometry,
                                  struct zr_samples *samples)
{
    struct zr_primitives primitives;
    const enum zr_status status = zr_primitives_make(run->arena, geometry, samples, run->cancel, &primitives);
    struct drawing drawing = {.geometry = geometry, .cancel = run->cancel, .samples = samples};
    if (status != ZR_OK) return status;
    drawing.hits = zr_arena_alloc(run->arena, samples->width, sizeof *drawing.hits);
    drawing.flags = zr_arena_alloc(run->arena, samples->width, sizeof *drawing.flags);
    drawing.xs = zr_arena_alloc(run->arena, (size_t)samples->width + 1, sizeof *drawing.xs);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < primitives.count && !zr_is_cancelled(run->cancel); i++) {
        drawing.primitive = &primitives.items[i];
        if (samples->trace) trace_primitive(samples->trace, drawing.primitive);
        if (drawing.primitive->draw->kind == ZR_DRAW_TRIANGLES)
            draw_triangle(&drawing);
        else
            draw_by_flips(&drawing);
        if (samples->trace) zr_trace_end(samples->trace, '}');
    }
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
