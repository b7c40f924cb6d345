/* scanline.c - raster: draws the whole picture row by row, without a z-buffer.
 *
 * A table holds edges by the row in which they begin; active edges are stepped from row to row. Along a row, each edge
 * enters or leaves its polygon. So the row is divided into intervals that are covered by the same polygons, and the
 * nearest is found in each.
 * Source: Wylie, Romney, Evans & Erdahl, "Half-tone Perspective Drawings by Computer", 1967; Bouknight, "A Procedure
 *         for Generation of Three-dimensional Half-toned Computer Graphics Presentations", 1970; intervals as in
 *         Watkins, "A Real-time Visible Surface Algorithm", 1970.
 * Exact:  an edge's x is stepped column by column, by the sign of an integer (Bresenham, "Algorithm for computer
 *         control of a digital plotter", 1965). Along a row, each float operation of a primitive's depth is monotone,
 *         so depth is monotone, and the two ends of an interval bound it. If one polygon remains, it fills the
 *         interval. If more remain, they may intersect, and each sample decides.
 * Memory: all edges, and the data of one row. */
#include "base/run.h"
#include "raster/textbook/algorithms.h"
#include "raster/textbook/trace.h"

enum { EDGES_PER_CANCEL_CHECK = 1024 };

/* An edge of the table. */
struct entry {
    uint32_t primitive, edge;
};

struct table {
    size_t *begins;        /* first entry of row y; height + 1 */
    struct entry *entries; /* sorted by first row */
};

/* An active edge. */
struct passing {
    int32_t x;      /* first column not left of it */
    int64_t excess; /* distance of x to the right of it, 0 .. column - 1 */
    int64_t column; /* increase of excess per column */
    int64_t row;    /* decrease of excess per row */
    int32_t end;    /* first row that it does not cross */
    uint32_t owner; /* primitive number */
    size_t same_x;  /* next edge of this row with the same x: 1 + number */
};

/* A primitive that covers an interval. */
struct layer {
    uint32_t primitive;
    float near, far; /* bounds of its depth in the interval */
};

struct sweep {
    const struct zr_geometry *geometry;
    const struct zr_primitive *primitives;
    const struct zr_cancel *cancel;
    struct zr_samples *samples;
    struct passing *passing;
    size_t passing_count, passing_room;
    size_t *at;       /* by column: first edge there, 1 + number; 0: none */
    uint32_t *inside; /* primitives that contain the sweep position, unordered */
    uint32_t inside_count;
    uint32_t *places; /* by primitive: 1 + its index in `inside`, or 0 */
    struct layer *layers;
    struct zr_hit *hits, *nearest; /* of one interval */
};

/* ---- the table ---- */

struct rows {
    int32_t begin, end;
};

static struct rows rows_of(const struct zr_grid_edge *edge, int32_t height)
{
    struct rows rows = {(edge->y0 + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS,
                        (edge->y1 + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS};
    if (rows.begin < 0) rows.begin = 0;
    if (rows.end > height) rows.end = height;
    return rows;
}

/* Counting sort: counts, then offsets, then entries. */
static bool make_table(struct zr_arena *arena, const struct zr_primitives *primitives, int32_t height,
                       struct table *table)
{
    size_t *begins = zr_arena_zero(arena, (size_t)height + 1, sizeof *begins), total = 0;
    if (!begins) return false;
    for (uint32_t p = 0; p < primitives->count; p++) {
        const struct zr_grid_edge *edges = zr_primitive_edges(&primitives->items[p]);
        for (uint32_t e = 0; e < primitives->items[p].edge_count; e++) {
            struct rows rows = rows_of(&edges[e], height);
            if (rows.begin < rows.end) begins[rows.begin]++;
        }
    }
    for (int32_t y = 0; y <= height; y++) {
        size_t count = begins[y];
        begins[y] = total;
        total += count;
    }
    *table = (struct table){begins, zr_arena_alloc(arena, total, sizeof *table->entries)};
    if (!table->entries) return false;
    for (uint32_t p = 0; p < primitives->count; p++) {
        const struct zr_grid_edge *edges = zr_primitive_edges(&primitives->items[p]);
        for (uint32_t e = 0; e < primitives->items[p].edge_count; e++) {
            struct rows rows = rows_of(&edges[e], height);
            if (rows.begin < rows.end) table->entries[begins[rows.begin]++] = (struct entry){p, e};
        }
    }
    for (int32_t y = height; y > 0; y--)
        begins[y] = begins[y - 1];
    begins[0] = 0;
    return true;
}

/* ---- active edges ---- */

static void walk(struct passing *edge)
{
    for (; edge->excess < 0; edge->excess += edge->column)
        edge->x++;
    for (; edge->excess >= edge->column; edge->excess -= edge->column)
        edge->x--;
}

/* Makes the active edge in row y: starts at the column of the edge's lower end, and steps. */
static struct passing make_passing(const struct sweep *sweep, struct entry entry, int32_t y)
{
    const struct zr_grid_edge *edge = &zr_primitive_edges(&sweep->primitives[entry.primitive])[entry.edge];
    int64_t run = (int64_t)edge->x1 - edge->x0, rise = (int64_t)edge->y1 - edge->y0;
    struct passing passing = {.x = edge->x0 >> ZR_SUBPIXEL_BITS,
                              .column = rise * ZR_SUBPIXELS,
                              .row = run * ZR_SUBPIXELS,
                              .end = rows_of(edge, (int32_t)sweep->samples->height).end,
                              .owner = entry.primitive};
    passing.excess =
        ((int64_t)passing.x * ZR_SUBPIXELS - edge->x0) * rise - run * ((int64_t)y * ZR_SUBPIXELS - edge->y0);
    walk(&passing);
    return passing;
}

/* Drops the edges that end here, and steps the others to row y. */
static void step_row(int32_t y, struct sweep *sweep)
{
    size_t kept = 0;
    for (size_t i = 0; i < sweep->passing_count; i++) {
        struct passing *edge = &sweep->passing[i];
        if (edge->end <= y) continue;
        edge->excess -= edge->row;
        walk(edge);
        sweep->passing[kept++] = *edge;
    }
    sweep->passing_count = kept;
}

static enum zr_status begin_edges(struct zr_arena *arena, const struct table *table, int32_t y, struct sweep *sweep)
{
    size_t count = sweep->passing_count + table->begins[y + 1] - table->begins[y];
    if (count > sweep->passing_room) {
        size_t room = count > 2 * sweep->passing_room ? count : 2 * sweep->passing_room;
        sweep->passing = zr_arena_grow(arena, sweep->passing, sweep->passing_count, room, sizeof *sweep->passing);
        if (!sweep->passing) return ZR_NO_MEMORY;
        sweep->passing_room = room;
    }
    for (size_t i = table->begins[y]; i < table->begins[y + 1]; i++) {
        if (i % EDGES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(sweep->cancel)) return ZR_CANCELLED;
        sweep->passing[sweep->passing_count++] = make_passing(sweep, table->entries[i], y);
    }
    return ZR_OK;
}

/* Links each edge to its column, which sorts them. Edges right of the window are not needed. */
static void sort_row(struct sweep *sweep)
{
    int32_t width = (int32_t)sweep->samples->width;
    for (int32_t x = 0; x < width; x++)
        sweep->at[x] = 0;
    for (size_t i = 0; i < sweep->passing_count; i++) {
        struct passing *edge = &sweep->passing[i];
        if (edge->x >= width) continue;
        size_t *at = &sweep->at[edge->x > 0 ? edge->x : 0];
        edge->same_x = *at;
        *at = i + 1;
    }
}

/* ---- intervals ---- */

/* Enters the primitive, or leaves it. */
static void cross(struct sweep *sweep, uint32_t primitive)
{
    uint32_t place = sweep->places[primitive];
    if (place == 0) {
        sweep->inside[sweep->inside_count++] = primitive;
        sweep->places[primitive] = sweep->inside_count;
        return;
    }
    uint32_t last = sweep->inside[--sweep->inside_count];
    sweep->inside[place - 1] = last;
    sweep->places[last] = place;
    sweep->places[primitive] = 0;
}

/* Bounds a primitive's depth. A shape has several triangles, and may change between them anywhere. */
static struct layer make_layer(const struct sweep *sweep, uint32_t number, int32_t y, int32_t begin, int32_t end)
{
    const struct zr_primitive *primitive = &sweep->primitives[number];
    if (primitive->count > 1) return (struct layer){number, 0.0f, 1.0f};
    float left = zr_primitive_hit(sweep->geometry, primitive, begin, y).depth,
          right = end - begin > 1 ? zr_primitive_hit(sweep->geometry, primitive, end - 1, y).depth : left;
    return (struct layer){number, left < right ? left : right, left < right ? right : left};
}

/* Lists the primitives that may be visible in the interval: all except those entirely behind another. */
static uint32_t make_layers(struct sweep *sweep, int32_t y, int32_t begin, int32_t end)
{
    float least_far = 1.0f;
    uint32_t count = 0;
    for (uint32_t i = 0; i < sweep->inside_count; i++) {
        struct layer layer = make_layer(sweep, sweep->inside[i], y, begin, end);
        if (layer.near > least_far) continue;
        if (layer.far < least_far) least_far = layer.far;
        sweep->layers[count++] = layer;
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (sweep->layers[i].near <= least_far) sweep->layers[kept++] = sweep->layers[i];
    return kept;
}

/* ---- trace ---- */

/* Records the active edges from left to right, except those right of the window, and opens the list of spans. */
static void trace_edges(const struct sweep *sweep, int32_t y)
{
    struct zr_trace *trace = sweep->samples->trace;
    zr_trace_step(trace);
    zr_trace_integer(trace, "row", y);
    zr_trace_begin(trace, "active", '[');
    for (uint32_t x = 0; x < sweep->samples->width; x++)
        for (size_t i = sweep->at[x]; i > 0; i = sweep->passing[i - 1].same_x) {
            const struct passing *edge = &sweep->passing[i - 1];
            zr_trace_integers(trace, NULL, (int64_t[]){edge->owner + 1, edge->x}, 2);
        }
    zr_trace_end(trace, ']');
    zr_trace_begin(trace, "spans", '[');
}

/* Records the primitives that contain the interval, with their depths at its ends. */
static void trace_inside(const struct sweep *sweep, int32_t y, int32_t begin, int32_t end)
{
    struct zr_trace *trace = sweep->samples->trace;
    zr_trace_begin(trace, "inside", '[');
    for (uint32_t i = 0; i < sweep->inside_count; i++) {
        const struct zr_primitive *primitive = &sweep->primitives[sweep->inside[i]];
        zr_trace_begin(trace, NULL, '[');
        zr_trace_integer(trace, NULL, sweep->inside[i] + 1);
        zr_trace_float(trace, NULL, zr_primitive_hit(sweep->geometry, primitive, begin, y).depth);
        zr_trace_float(trace, NULL, zr_primitive_hit(sweep->geometry, primitive, end - 1, y).depth);
        zr_trace_end(trace, ']');
    }
    zr_trace_end(trace, ']');
}

/* Returns the primitive that the sample shows, 0: none. */
static uint32_t shown_at(const struct sweep *sweep, int32_t y, int32_t x, struct zr_hit hit)
{
    const struct zr_samples *samples = sweep->samples;
    const bool is_shown = hit.depth < samples->depth[(size_t)y * samples->width + (size_t)x];
    return is_shown ? zr_trace_id(samples->trace, hit.owner - 1) : 0;
}

/* Records an interval before its samples are stored. */
static void trace_interval(const struct sweep *sweep, int32_t y, int32_t begin, int32_t end, uint32_t layers)
{
    struct zr_trace *trace = sweep->samples->trace;
    zr_trace_begin(trace, NULL, '{');
    zr_trace_integer(trace, "x0", begin);
    zr_trace_integer(trace, "x1", end);
    trace_inside(sweep, y, begin, end);
    zr_trace_begin(trace, "left", '[');
    for (uint32_t i = 0; i < layers; i++)
        zr_trace_integer(trace, NULL, sweep->layers[i].primitive + 1);
    zr_trace_end(trace, ']');
    zr_trace_begin(trace, "shown", '[');
    for (int32_t x = begin, to; x < end; x = to) {
        const uint32_t shown = shown_at(sweep, y, x, sweep->nearest[x - begin]);
        for (to = x + 1; to < end && shown_at(sweep, y, to, sweep->nearest[to - begin]) == shown;)
            to++;
        zr_trace_integers(trace, NULL, (int64_t[]){x, to, shown}, 3);
    }
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

static void trace_end_of_row(struct zr_trace *trace)
{
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

/* ---- samples ---- */

/* Finds the nearest layer at each sample, on a tie the earliest. A single layer fills the interval. */
static void resolve(struct sweep *sweep, int32_t y, int32_t begin, int32_t end)
{
    struct zr_hit *nearest = sweep->nearest, *hits = sweep->hits;
    uint32_t count = make_layers(sweep, y, begin, end);
    for (uint32_t i = 0; i < count && !zr_is_cancelled(sweep->cancel); i++) {
        const struct zr_primitive *primitive = &sweep->primitives[sweep->layers[i].primitive];
        zr_primitive_hits(sweep->geometry, primitive, y, begin, end, i == 0 ? nearest : hits);
        for (int32_t k = 0; i > 0 && k < end - begin; k++)
            if (hits[k].depth < nearest[k].depth ||
                (hits[k].depth == nearest[k].depth && hits[k].owner < nearest[k].owner))
                nearest[k] = hits[k];
    }
    if (sweep->samples->trace) trace_interval(sweep, y, begin, end, count);
    for (int32_t x = begin; x < end; x++)
        zr_samples_put(sweep->samples, x, y, nearest[x - begin]); /* once per sample */
}

/* Adds all samples of all polygons to the lists. */
static void keep_all(struct sweep *sweep, int32_t y, int32_t begin, int32_t end)
{
    for (uint32_t i = 0; i < sweep->inside_count && !zr_is_cancelled(sweep->cancel); i++) {
        zr_primitive_hits(sweep->geometry, &sweep->primitives[sweep->inside[i]], y, begin, end, sweep->hits);
        for (int32_t x = begin; x < end; x++)
            zr_samples_put(sweep->samples, x, y, sweep->hits[x - begin]);
    }
}

static void sweep_row(struct sweep *sweep, int32_t y)
{
    int32_t width = (int32_t)sweep->samples->width;
    for (int32_t begin = 0, end; begin < width && !zr_is_cancelled(sweep->cancel); begin = end) {
        for (size_t i = sweep->at[begin]; i > 0; i = sweep->passing[i - 1].same_x)
            cross(sweep, sweep->passing[i - 1].owner);
        for (end = begin + 1; end < width && sweep->at[end] == 0;)
            end++;
        if (sweep->inside_count == 0) continue;
        if (sweep->samples->fragments)
            keep_all(sweep, y, begin, end);
        else
            resolve(sweep, y, begin, end);
    }
    while (sweep->inside_count > 0)
        sweep->places[sweep->inside[--sweep->inside_count]] = 0;
}

/* ---- entry point ---- */

enum zr_status zr_scanline(const struct zr_run *run, const struct zr_geometry *geometry, struct zr_samples *samples)
{
    struct zr_primitives primitives;
    struct table table;
    enum zr_status status = zr_primitives_make(run->arena, geometry, samples, run->cancel, &primitives);
    if (status != ZR_OK) return status;
    if (!make_table(run->arena, &primitives, (int32_t)samples->height, &table)) return ZR_NO_MEMORY;
    struct sweep sweep = {
        .geometry = geometry, .primitives = primitives.items, .cancel = run->cancel, .samples = samples};
    sweep.at = zr_arena_alloc(run->arena, samples->width, sizeof *sweep.at);
    sweep.inside = zr_arena_alloc(run->arena, primitives.count, sizeof *sweep.inside);
    sweep.places = zr_arena_zero(run->arena, primitives.count, sizeof *sweep.places);
    sweep.layers = zr_arena_alloc(run->arena, primitives.count, sizeof *sweep.layers);
    sweep.hits = zr_arena_alloc(run->arena, samples->width, sizeof *sweep.hits);
    sweep.nearest = zr_arena_zero(run->arena, samples->width, sizeof *sweep.nearest);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    for (int32_t y = 0; y < (int32_t)samples->height; y++) {
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        step_row(y, &sweep);
        if ((status = begin_edges(run->arena, &table, y, &sweep)) != ZR_OK) return status;
        if (sweep.passing_count == 0) continue;
        sort_row(&sweep);
        if (samples->trace) trace_edges(&sweep, y);
        sweep_row(&sweep, y);
        if (samples->trace) trace_end_of_row(samples->trace);
    }
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
