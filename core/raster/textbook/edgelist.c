/* edgelist.c - raster: draws polygon by polygon into a z-buffer, by ordered edge lists.
 *
 * Each edge of a polygon adds the x at which it crosses a row to that row's list. The lists are sorted, and samples
 * between the first and second, third and fourth x are filled (the ordered edge list: Rogers, "Procedural Elements for
 * Computer Graphics", 1985, section 2; Foley, van Dam, Feiner & Hughes, "Computer Graphics: Principles and Practice",
 * 1990, 3.6). The z-buffer is Catmull's (1974). The textbooks interpolate z along edges; here depth is the primitive's
 * own plane at the sample, by the common rule.
 *
 * Exact:  an x is the first sample not left of the edge, by one integer division per row, rounded up. So a pair of them
 *         encloses exactly the samples that have an odd number of edges on their left. */
#include "base/run.h"
#include "raster/textbook/algorithms.h"
#include "raster/textbook/trace.h"

/* Lists of all rows, stored one after the other. */
struct lists {
    uint32_t *ends; /* [y + 1]: end of the list of row y, relative to the polygon's lowest row */
    int32_t *xs;
    size_t room;         /* capacity of xs */
    struct zr_hit *hits; /* of one row */
};

struct rows {
    int32_t begin, end;
};

/* ---- edges ---- */

/* Divides, rounding up. */
static int64_t divide(int64_t dividend, int64_t divisor)
{
    return dividend > 0 ? (dividend - 1) / divisor + 1 : dividend / divisor;
}

/* Returns the rows of the polygon that the edge crosses. */
static struct rows rows_of(const struct zr_grid_edge *edge, const struct zr_primitive *primitive)
{
    struct rows rows = {(int32_t)divide(edge->y0, ZR_SUBPIXELS), (int32_t)divide(edge->y1, ZR_SUBPIXELS)};
    if (rows.begin < primitive->min_y) rows.begin = primitive->min_y;
    if (rows.end > primitive->max_y + 1) rows.end = primitive->max_y + 1;
    return rows;
}

/* Returns the window column at which the edge crosses row y, clamped to 0 .. width. */
static int32_t crossing(const struct zr_grid_edge *edge, int32_t y, uint32_t width)
{
    int64_t run = (int64_t)edge->x1 - edge->x0, rise = (int64_t)edge->y1 - edge->y0;
    int64_t above = (int64_t)edge->y1 - (int64_t)y * ZR_SUBPIXELS;
    int64_t x = divide(edge->x1 * rise - run * above, rise * ZR_SUBPIXELS);
    if (x < 0) return 0;
    return x < width ? (int32_t)x : (int32_t)width;
}

/* ---- lists ---- */

/* Counts the entries of each row and computes the starts of the lists. */
static bool make_room(struct zr_arena *arena, const struct zr_primitive *primitive, struct lists *lists)
{
    const struct zr_grid_edge *edges = zr_primitive_edges(primitive);
    int32_t height = primitive->max_y - primitive->min_y + 1;
    for (int32_t i = 0; i <= height; i++)
        lists->ends[i] = 0;
    for (uint32_t i = 0; i < primitive->edge_count; i++) {
        struct rows rows = rows_of(&edges[i], primitive);
        for (int32_t y = rows.begin; y < rows.end; y++)
            lists->ends[y - primitive->min_y + 1]++;
    }
    /* Start of each list; storing entries advances it to the end. */
    uint32_t total = 0;
    for (int32_t i = 1; i <= height; i++) {
        uint32_t count = lists->ends[i];
        lists->ends[i] = total;
        total += count;
    }
    if (total <= lists->room) return true;
    size_t room = total > 2 * lists->room ? total : 2 * lists->room;
    lists->xs = zr_arena_alloc(arena, room, sizeof *lists->xs);
    lists->room = room;
    return lists->xs != NULL;
}

static void enter(const struct zr_primitive *primitive, uint32_t width, struct lists *lists)
{
    const struct zr_grid_edge *edges = zr_primitive_edges(primitive);
    for (uint32_t i = 0; i < primitive->edge_count; i++) {
        struct rows rows = rows_of(&edges[i], primitive);
        for (int32_t y = rows.begin; y < rows.end; y++)
            lists->xs[lists->ends[y - primitive->min_y + 1]++] = crossing(&edges[i], y, width);
    }
}

/* Shell sort: most lists have two entries, and none more than the polygon has corners. */
static void sort(int32_t *xs, uint32_t count)
{
    static const uint32_t gaps[] = {1750, 701, 301, 132, 57, 23, 10, 4, 1}; /* Ciura 2001 */
    for (size_t g = 0; g < sizeof gaps / sizeof gaps[0]; g++)
        for (uint32_t i = gaps[g]; i < count; i++) {
            int32_t x = xs[i];
            uint32_t to = i;
            for (; to >= gaps[g] && xs[to - gaps[g]] > x; to -= gaps[g])
                xs[to] = xs[to - gaps[g]];
            xs[to] = x;
        }
}

/* ---- filling ---- */

/* Fills between the first and second x of row y's list, the third and fourth, and so on. */
static void fill_row(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t y,
                     const struct lists *lists, struct zr_samples *samples)
{
    const uint32_t *ends = &lists->ends[y - primitive->min_y];
    for (uint32_t i = ends[0]; i + 1 < ends[1]; i += 2) {
        int32_t begin = lists->xs[i], end = lists->xs[i + 1];
        if (begin < end) zr_primitive_hits(geometry, primitive, y, begin, end, lists->hits);
        for (int32_t x = begin; x < end; x++)
            zr_samples_put(samples, x, y, lists->hits[x - begin]);
    }
}

static void trace_row(struct zr_trace *trace, const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                      int32_t y, const int32_t *xs, uint32_t count, const struct zr_samples *samples)
{
    zr_trace_step(trace);
    zr_trace_integer(trace, "primitive", zr_trace_id(trace, primitive->first));
    zr_trace_integer(trace, "row", y);
    zr_trace_begin(trace, "xs", '[');
    for (uint32_t i = 0; i < count; i++)
        zr_trace_integer(trace, NULL, xs[i]);
    zr_trace_end(trace, ']');
    zr_trace_spans(trace, geometry, primitive, y, xs, count, samples);
    zr_trace_end(trace, '}');
}

static enum zr_status draw(const struct zr_run *run, const struct zr_geometry *geometry,
                           const struct zr_primitive *primitive, struct lists *lists, struct zr_samples *samples)
{
    if (!make_room(run->arena, primitive, lists)) return ZR_NO_MEMORY;
    enter(primitive, samples->width, lists);
    for (int32_t y = primitive->min_y; y <= primitive->max_y; y++) {
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        const uint32_t *ends = &lists->ends[y - primitive->min_y];
        if (ends[0] == ends[1]) continue; /* if all lists are empty, xs may be NULL */
        sort(lists->xs + ends[0], ends[1] - ends[0]);
        if (samples->trace)
            trace_row(samples->trace, geometry, primitive, y, lists->xs + ends[0], ends[1] - ends[0], samples);
        fill_row(geometry, primitive, y, lists, samples);
    }
    return ZR_OK;
}

enum zr_status zr_edgelist(const struct zr_run *run, const struct zr_geometry *geometry, struct zr_samples *samples)
{
    struct lists lists = {.ends = zr_arena_alloc(run->arena, (size_t)samples->height + 1, sizeof *lists.ends),
                          .hits = zr_arena_alloc(run->arena, samples->width, sizeof *lists.hits)};
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
        enum zr_status status = draw(run, geometry, &primitive, &lists, samples);
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}
