#include "raster/primitive.h"

#include "raster/point.h"
#include "raster/setup.h"

/* ---- box ---- */

/* Computes the box of a line's parallelogram; empty if it has none. */
static void line_box(const struct zr_geometry *geometry, const struct zr_triangle *line, int32_t box[4])
{
    struct zr_line_corners c;
    if (!zr_line_corners_make(&geometry->vertices[line->v[0]], &geometry->vertices[line->v[1]],
                              geometry->window.line_width, &c)) {
        box[0] = box[1] = 0;
        box[2] = box[3] = -1;
        return;
    }
    int32_t low[2] = {c.x[0], c.y[0]}, high[2] = {c.x[0], c.y[0]};
    for (int k = 1; k < 4; k++) {
        low[0] = c.x[k] < low[0] ? c.x[k] : low[0];
        low[1] = c.y[k] < low[1] ? c.y[k] : low[1];
        high[0] = c.x[k] > high[0] ? c.x[k] : high[0];
        high[1] = c.y[k] > high[1] ? c.y[k] : high[1];
    }
    box[0] = zr_viewport_first_centre(low[0]);
    box[1] = zr_viewport_first_centre(low[1]);
    box[2] = zr_viewport_last_centre(high[0]);
    box[3] = zr_viewport_last_centre(high[1]);
}

static void find_box(const struct zr_geometry *geometry, const struct zr_triangle *triangle, int32_t box[4])
{
    if (triangle->line) {
        line_box(geometry, triangle, box);
        return;
    }
    if (triangle->shape == 0) {
        zr_setup_box(geometry->vertices, triangle, box);
        return;
    }
    const struct zr_shape *shape = &geometry->shapes[triangle->shape - 1];
    box[0] = zr_viewport_first_centre(shape->min_x);
    box[1] = zr_viewport_first_centre(shape->min_y);
    box[2] = zr_viewport_last_centre(shape->max_x);
    box[3] = zr_viewport_last_centre(shape->max_y);
}

void zr_primitive_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t first, int32_t box[4])
{
    if (draw->kind == ZR_DRAW_POINTS) {
        zr_point_box(geometry, draw, first, box);
        return;
    }
    const struct zr_triangle triangle = zr_triangle_of(geometry, draw, first);
    find_box(geometry, &triangle, box);
}

static void cut_box(struct zr_primitive *primitive, const int32_t box[4], uint32_t width, uint32_t height)
{
    primitive->min_x = box[0] > 0 ? box[0] : 0;
    primitive->min_y = box[1] > 0 ? box[1] : 0;
    primitive->max_x = box[2] < (int32_t)width ? box[2] : (int32_t)width - 1;
    primitive->max_y = box[3] < (int32_t)height ? box[3] : (int32_t)height - 1;
}

/* ---- edges ---- */

static void add_edge(struct zr_primitive *primitive, int32_t ax, int32_t ay, int32_t bx, int32_t by)
{
    struct zr_grid_edge edge;
    if (zr_grid_edge_make(ax, ay, bx, by, &edge)) primitive->own_edges[primitive->edge_count++] = edge;
}

static void add_triangle_edges(struct zr_primitive *primitive, const struct zr_window_vertex *vertices,
                               const struct zr_triangle *triangle)
{
    for (int k = 0; k < 3; k++) {
        const struct zr_window_vertex *a = &vertices[triangle->v[k]], *b = &vertices[triangle->v[(k + 1) % 3]];
        add_edge(primitive, zr_snapped_x(a), zr_snapped_y(a), zr_snapped_x(b), zr_snapped_y(b));
    }
}

static void add_line_edges(struct zr_primitive *primitive, const struct zr_geometry *geometry,
                           const struct zr_triangle *line)
{
    const struct zr_window_vertex *vertices = geometry->vertices;
    struct zr_line_corners c;
    if (!zr_line_corners_make(&vertices[line->v[0]], &vertices[line->v[1]], geometry->window.line_width, &c)) return;
    for (int k = 0; k < 4; k++)
        add_edge(primitive, c.x[k], c.y[k], c.x[(k + 1) % 4], c.y[(k + 1) % 4]);
}

/* Adds edges around the centres of the pixels; left and bottom centres lie on the edges. So the upper corners of an
 * octagon are cut by one pixel more: their last row lies below the end of the box. */
static void add_point_edges(struct zr_primitive *primitive, const struct zr_mesh *mesh, const int32_t box[4])
{
    const int32_t cut = zr_point_cut(mesh, box[2] - box[0] + 1), low = cut * ZR_SUBPIXELS;
    const int32_t high = cut > 0 ? low + ZR_SUBPIXELS : 0;
    const int32_t x0 = box[0] * ZR_SUBPIXELS, x1 = (box[2] + 1) * ZR_SUBPIXELS;
    const int32_t y0 = box[1] * ZR_SUBPIXELS, y1 = (box[3] + 1) * ZR_SUBPIXELS;
    add_edge(primitive, x0 + low, y0, x0, y0 + low);
    add_edge(primitive, x0, y0 + low, x0, y1 - high);
    add_edge(primitive, x0, y1 - high, x0 + high, y1);
    add_edge(primitive, x1 - low, y0, x1, y0 + low);
    add_edge(primitive, x1, y0 + low, x1, y1 - high);
    add_edge(primitive, x1, y1 - high, x1 - high, y1);
}

void zr_primitive_make(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t first, uint32_t width,
                       uint32_t height, struct zr_primitive *primitive)
{
    const struct zr_triangle triangle = zr_triangle_of(geometry, draw, first);
    int32_t box[4];
    *primitive =
        (struct zr_primitive){.draw = draw, .first = first, .count = zr_primitive_count(geometry, draw, first)};
    primitive->depth = zr_depth_make(geometry->vertices, &triangle);
    zr_primitive_box(geometry, draw, first, box);
    cut_box(primitive, box, width, height);
    if (triangle.shape > 0) {
        const struct zr_shape *shape = &geometry->shapes[triangle.shape - 1];
        if (shape->edge_count > 0) primitive->shape_edges = geometry->edges + shape->first_edge;
        primitive->edge_count = shape->edge_count;
        return;
    }
    if (draw->kind == ZR_DRAW_POINTS)
        add_point_edges(primitive, draw->mesh, box);
    else if (triangle.line)
        add_line_edges(primitive, geometry, &triangle);
    else
        add_triangle_edges(primitive, geometry->vertices, &triangle);
}

/* ---- hits ---- */

/* Returns the distance of the sample from the nearest edge of a triangle, about in subpixels; negative outside. */
static double margin_at(const struct zr_setup *setup, int32_t x, int32_t y)
{
    double least = 0.0;
    for (int k = 0; k < 3; k++) {
        const struct zr_edge *e = &setup->edges[k];
        int64_t steepness = (e->a < 0 ? -e->a : e->a) + (e->b < 0 ? -e->b : e->b);
        double margin = (double)zr_edge_at(e, x, y) / (double)steepness;
        if (k == 0 || margin < least) least = margin;
    }
    return least;
}

struct zr_triangle zr_primitive_triangle(const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                                         uint32_t number)
{
    return zr_triangle_of(geometry, zr_draw_next(geometry, primitive->draw, number), number);
}

struct zr_hit zr_primitive_hit(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t x,
                               int32_t y)
{
    if (primitive->count == 1) return (struct zr_hit){zr_depth_at(&primitive->depth, x, y), primitive->first + 1};
    struct zr_hit hit = {0.0f, 0};
    double best = 0.0;
    for (uint32_t number = primitive->first; number < primitive->first + primitive->count; number++) {
        const struct zr_triangle triangle = zr_primitive_triangle(geometry, primitive, number);
        struct zr_setup setup = zr_setup_make(geometry->vertices, &triangle);
        bool inside = zr_setup_covers(&setup, x, y);
        double margin = margin_at(&setup, x, y);
        if (!inside && hit.owner != 0 && margin <= best) continue;
        best = margin;
        hit = (struct zr_hit){zr_depth_at(&setup.depth, x, y), number + 1};
        if (inside) break;
    }
    return hit;
}

/* Sets the hits of samples that the triangle covers and no earlier one did. Returns their number. */
static int32_t hit_by_triangle(const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                               uint32_t number, int32_t y, int32_t x0, int32_t x1, struct zr_hit *hits)
{
    const struct zr_triangle triangle = zr_primitive_triangle(geometry, primitive, number);
    int32_t box[4], count = 0;
    zr_setup_box(geometry->vertices, &triangle, box);
    if (y < box[1] || y > box[3] || x1 <= box[0] || x0 > box[2]) return 0;
    struct zr_setup setup = zr_setup_make(geometry->vertices, &triangle);
    for (int32_t x = x0 > box[0] ? x0 : box[0]; x < x1 && x <= box[2]; x++) {
        if (hits[x - x0].owner != 0 || !zr_setup_covers(&setup, x, y)) continue;
        hits[x - x0] = (struct zr_hit){zr_depth_at(&setup.depth, x, y), number + 1};
        count++;
    }
    return count;
}

void zr_primitive_hits(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t y, int32_t x0,
                       int32_t x1, struct zr_hit *hits)
{
    bool single = primitive->count == 1;
    for (int32_t x = x0; x < x1; x++)
        hits[x - x0] =
            single ? (struct zr_hit){zr_depth_at(&primitive->depth, x, y), primitive->first + 1} : (struct zr_hit){0};
    int32_t left = single ? 0 : x1 - x0;
    for (uint32_t i = 0; i < primitive->count && left > 0; i++)
        left -= hit_by_triangle(geometry, primitive, primitive->first + i, y, x0, x1, hits);
    for (int32_t x = x0; x < x1 && left > 0; x++)
        if (hits[x - x0].owner == 0) hits[x - x0] = zr_primitive_hit(geometry, primitive, x, y);
}
