#include "raster/textbook/trace.h"

#include "raster/textbook/algorithms.h"

enum { FIRST_ROOM = 4096 };

/* ---- values ---- */

/* Ends the algorithm. */
static void stop(struct zr_trace *trace)
{
    atomic_store_explicit(&trace->cancel.raised, true, memory_order_relaxed);
}

static void put(struct zr_trace *trace, struct zr_trace_value value)
{
    if (trace->is_beyond || !zr_arena_ok(trace->arena)) return;
    if (trace->count == ZR_TRACE_VALUES_MAX) {
        trace->is_beyond = true;
        stop(trace);
        return;
    }
    if (trace->count == trace->room) {
        const size_t room = trace->room > 0 ? 2 * trace->room : FIRST_ROOM;
        void *grown = zr_arena_grow(trace->arena, trace->values, trace->count, room, sizeof *trace->values);
        if (!grown) {
            stop(trace);
            return;
        }
        trace->values = grown;
        trace->room = room;
    }
    trace->values[trace->count++] = value;
}

void zr_trace_begin(struct zr_trace *trace, const char *key, char bracket)
{
    put(trace, (struct zr_trace_value){.key = key, .kind = ZR_TRACE_BEGIN, .bracket = bracket});
}

void zr_trace_end(struct zr_trace *trace, char bracket)
{
    put(trace, (struct zr_trace_value){.kind = ZR_TRACE_END, .bracket = bracket});
}

void zr_trace_integer(struct zr_trace *trace, const char *key, int64_t value)
{
    put(trace, (struct zr_trace_value){.key = key, .kind = ZR_TRACE_INTEGER, .integer = value});
}

void zr_trace_float(struct zr_trace *trace, const char *key, float value)
{
    put(trace, (struct zr_trace_value){.key = key, .kind = ZR_TRACE_FLOAT, .number = value});
}

void zr_trace_text(struct zr_trace *trace, const char *key, const char *text)
{
    put(trace, (struct zr_trace_value){.key = key, .kind = ZR_TRACE_TEXT, .text = text});
}

void zr_trace_bool(struct zr_trace *trace, const char *key, bool value)
{
    put(trace, (struct zr_trace_value){.key = key, .kind = ZR_TRACE_BOOL, .is_true = value});
}

void zr_trace_place(struct zr_trace *trace, const char *key, int32_t snapped)
{
    put(trace, (struct zr_trace_value){.key = key, .kind = ZR_TRACE_REAL, .real = (double)snapped / ZR_SUBPIXELS});
}

void zr_trace_step(struct zr_trace *trace)
{
    if (++trace->steps > ZR_TRACE_STEPS_MAX) {
        trace->is_beyond = true;
        stop(trace);
    }
    zr_trace_begin(trace, NULL, '{');
}

void zr_trace_integers(struct zr_trace *trace, const char *key, const int64_t *values, int count)
{
    zr_trace_begin(trace, key, '[');
    for (int i = 0; i < count; i++)
        zr_trace_integer(trace, NULL, values[i]);
    zr_trace_end(trace, ']');
}

/* ---- primitives ---- */

static void put_corner(struct zr_trace *trace, const struct zr_window_vertex *vertex)
{
    zr_trace_begin(trace, NULL, '[');
    zr_trace_place(trace, NULL, zr_snapped_x(vertex));
    zr_trace_place(trace, NULL, zr_snapped_y(vertex));
    zr_trace_float(trace, NULL, vertex->z);
    zr_trace_end(trace, ']');
}

static void put_corners(struct zr_trace *trace, const char *key, const struct zr_geometry *geometry,
                        const struct zr_triangle *triangle, int count)
{
    zr_trace_begin(trace, key, '[');
    for (int k = 0; k < count; k++)
        put_corner(trace, &geometry->vertices[triangle->v[k]]);
    zr_trace_end(trace, ']');
}

/* Corners of triangles, lines and points; those of each triangle of a polygon. */
static void put_shape(struct zr_trace *trace, const struct zr_geometry *geometry, const struct zr_primitive *primitive)
{
    static const char *const names[] = {[ZR_DRAW_TRIANGLES] = "triangle",
                                        [ZR_DRAW_SHAPES] = "polygon",
                                        [ZR_DRAW_OUTLINES] = "outline",
                                        [ZR_DRAW_LINES] = "line",
                                        [ZR_DRAW_POINTS] = "point"};
    const enum zr_draw_kind kind = primitive->draw->kind;
    zr_trace_text(trace, "kind", names[kind]);
    if (kind == ZR_DRAW_SHAPES) zr_trace_begin(trace, "triangles", '[');
    for (uint32_t i = 0; i < primitive->count && !trace->is_beyond; i++) {
        const struct zr_triangle triangle = zr_primitive_triangle(geometry, primitive, primitive->first + i);
        put_corners(trace, kind == ZR_DRAW_SHAPES ? NULL : "corners", geometry, &triangle,
                    kind == ZR_DRAW_POINTS                 ? 1
                    : zr_draw_is_of_lines(primitive->draw) ? 2
                                                           : 3);
    }
    if (kind == ZR_DRAW_SHAPES) zr_trace_end(trace, ']');
}

static void put_edges(struct zr_trace *trace, const struct zr_primitive *primitive)
{
    const struct zr_grid_edge *edges = zr_primitive_edges(primitive);
    zr_trace_begin(trace, "edges", '[');
    for (uint32_t i = 0; i < primitive->edge_count && !trace->is_beyond; i++) {
        zr_trace_begin(trace, NULL, '[');
        zr_trace_place(trace, NULL, edges[i].x0);
        zr_trace_place(trace, NULL, edges[i].y0);
        zr_trace_place(trace, NULL, edges[i].x1);
        zr_trace_place(trace, NULL, edges[i].y1);
        zr_trace_end(trace, ']');
    }
    zr_trace_end(trace, ']');
}

void zr_trace_open(struct zr_trace *trace, const char *algorithm, const struct zr_geometry *geometry,
                   const struct zr_primitives *primitives)
{
    zr_trace_begin(trace, NULL, '{');
    zr_trace_text(trace, "algorithm", algorithm);
    zr_trace_begin(trace, "window", '{');
    zr_trace_integer(trace, "width", geometry->window.width);
    zr_trace_integer(trace, "height", geometry->window.height);
    zr_trace_end(trace, '}');
    zr_trace_begin(trace, "primitives", '[');
    for (uint32_t i = 0; i < primitives->count; i++) {
        const struct zr_primitive *primitive = &primitives->items[i];
        trace->primitives[trace->primitive_count++] = (struct zr_trace_primitive){primitive->first, primitive->count};
        zr_trace_begin(trace, NULL, '{');
        zr_trace_integer(trace, "id", i + 1);
        zr_trace_integer(trace, "faceId", zr_draw_id(primitive->draw, primitive->first));
        put_shape(trace, geometry, primitive);
        put_edges(trace, primitive);
        zr_trace_end(trace, '}');
    }
    zr_trace_end(trace, ']');
    zr_trace_begin(trace, "steps", '[');
}

void zr_trace_close(struct zr_trace *trace)
{
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

uint32_t zr_trace_id(const struct zr_trace *trace, uint32_t number)
{
    for (uint32_t i = 0; i < trace->primitive_count; i++)
        if (number - trace->primitives[i].first < trace->primitives[i].count) return i + 1;
    return 0;
}

/* ---- rows ---- */

/* Lists the columns whose hits pass the z-test, or those whose hits do not. hits: of all spans, one after the other. */
static void put_tested(struct zr_trace *trace, const char *key, bool passes, int32_t y, const int32_t *xs, size_t count,
                       const struct zr_hit *hits, const struct zr_samples *samples)
{
    const float *depths = samples->depth + (size_t)y * samples->width;
    zr_trace_begin(trace, key, '[');
    for (size_t i = 0; i + 1 < count; i += 2)
        for (int32_t x = xs[i]; x < xs[i + 1]; x++, hits++)
            if ((hits->depth < depths[x]) == passes) zr_trace_integer(trace, NULL, x);
    zr_trace_end(trace, ']');
}

void zr_trace_spans(struct zr_trace *trace, const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                    int32_t y, const int32_t *xs, size_t count, const struct zr_samples *samples)
{
    struct zr_hit hits[ZR_TRACE_SIDE_MAX];
    const struct zr_hit *of_span = hits;
    zr_trace_begin(trace, "spans", '[');
    for (size_t i = 0, used = 0; i + 1 < count; i += 2) {
        if (xs[i] >= xs[i + 1]) continue;
        zr_primitive_hits(geometry, primitive, y, xs[i], xs[i + 1], hits + used);
        used += (size_t)(xs[i + 1] - xs[i]);
        zr_trace_integers(trace, NULL, (int64_t[]){xs[i], xs[i + 1]}, 2);
    }
    zr_trace_end(trace, ']');
    zr_trace_begin(trace, "z", '[');
    for (size_t i = 0; i + 1 < count; i += 2) {
        if (xs[i] >= xs[i + 1]) continue;
        zr_trace_begin(trace, NULL, '[');
        for (int32_t x = xs[i]; x < xs[i + 1]; x++)
            zr_trace_float(trace, NULL, (of_span++)->depth);
        zr_trace_end(trace, ']');
    }
    zr_trace_end(trace, ']');
    put_tested(trace, "written", true, y, xs, count, hits, samples);
    put_tested(trace, "lost", false, y, xs, count, hits, samples);
}

int32_t *zr_trace_crossings(struct zr_trace *trace, size_t count)
{
    if (count <= trace->xs_room) return trace->xs;
    trace->xs = zr_arena_alloc(trace->arena, 2 * count, sizeof *trace->xs);
    trace->xs_room = trace->xs ? 2 * count : 0;
    if (!trace->xs) stop(trace);
    return trace->xs;
}
