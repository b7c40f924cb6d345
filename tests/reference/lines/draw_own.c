#include <math.h>
#include <string.h>

#include "base/rgba.h"
#include "geometry/clip.h"
#include "geometry/outline.h"
#include "geometry/viewport.h"
#include "raster/depth_offset.h"
#include "raster/line.h"
#include "raster/plane.h"
#include "raster/setup.h"
#include "reference/lines/batch.h"

const char *const fault_names[FAULT_COUNT] = {
    "none",          "reversed",    "other-rule",      "snapped-first", "inclusive",
    "plane-swapped", "plane-short", "clip-one-by-one", "clip-edges",    "edges-of-planes",
    "order",         "cull-area",   "offset-in-plane", "offset-slope",  "offset-clamped"};

struct drawer {
    const struct batch *batch;
    enum fault fault;
    struct batch_picture *picture;
    struct batch_stats *stats;
    struct zr_viewport viewport;
};

/* A vertex in the window with what is interpolated. */
struct corner {
    struct zr_window_vertex window;
    zr_vec4 color;
    bool placed;
};

/* The planes of a line or a triangle. */
struct surface {
    struct zr_plane depth, oow, red, green, blue;
    float offset;
    bool smooth;
    zr_vec4 flat;
};

static float clamp_depth(float z)
{
    z = z < 1.0f ? z : 1.0f;
    return z > 0.0f ? z : 0.0f;
}

static void draw_pixel(struct drawer *drawer, const struct surface *s, int32_t x, int32_t y)
{
    const struct batch *batch = drawer->batch;
    if (x < 0 || y < 0 || x >= (int32_t)batch->width || y >= (int32_t)batch->height) return;
    size_t pixel = (size_t)(batch->height - 1 - (uint32_t)y) * batch->width + (size_t)x;
    float fx = (float)x, fy = (float)y, z = zr_plane_at(&s->depth, fx, fy);
    z = drawer->fault == FAULT_OFFSET_CLAMPED ? clamp_depth(z) + s->offset : clamp_depth(z + s->offset);
    float *depth = &drawer->picture->depth[pixel];
    if (!(z < *depth)) return;
    *depth = z;
    zr_vec4 color = s->flat;
    if (s->smooth) {
        float reciprocal = 1.0f / zr_plane_at(&s->oow, fx, fy);
        color = (zr_vec4){zr_plane_at(&s->red, fx, fy) * reciprocal, zr_plane_at(&s->green, fx, fy) * reciprocal,
                          zr_plane_at(&s->blue, fx, fy) * reciprocal, 1.0f};
    }
    uint8_t *rgba = &drawer->picture->rgba[pixel * 4];
    rgba[0] = zr_rgba_byte(color.x);
    rgba[1] = zr_rgba_byte(color.y);
    rgba[2] = zr_rgba_byte(color.z);
    rgba[3] = 255;
}

/* ---- lines ---- */

/* Rule 7 over the four edges, at a pixel. */
static bool line_covers(const struct zr_line_corners *c, bool inclusive, int32_t px, int32_t py)
{
    for (int i = 0; i < 4; i++) {
        int j = (i + 1) % 4;
        int64_t a = c->y[i] - c->y[j], b = c->x[i] - c->x[j];
        int64_t bias = inclusive || a < 0 || (a == 0 && b > 0) ? 1 : 0;
        if (a * c->x[i] - b * c->y[i] + ZR_SUBPIXELS * (b * py - a * px) + bias <= 0) return false;
    }
    return true;
}

/* Column by column (row by row), the few pixels beside the line. */
static void draw_corners(struct drawer *drawer, const struct zr_line_corners *c, const struct surface *surface)
{
    bool x_major = c->x[0] == c->x[3];
    const int32_t *major = x_major ? c->x : c->y, *minor = x_major ? c->y : c->x;
    int32_t m0 = major[0], m1 = major[1], n0 = (minor[0] + minor[3]) / 2, n1 = (minor[1] + minor[2]) / 2;
    int32_t low = (m0 < m1 ? m0 : m1) / ZR_SUBPIXELS - 1, high = (m0 < m1 ? m1 : m0) / ZR_SUBPIXELS + 1;
    for (int32_t i = low; i <= high; i++) {
        double t = (i * 256.0 - m0) / ((double)m1 - m0), middle = n0 + t * ((double)n1 - n0);
        int32_t j = (int32_t)floor(middle / 256.0);
        for (int32_t k = j - 2; k <= j + 3; k++) {
            int32_t x = x_major ? i : k, y = x_major ? k : i;
            if (line_covers(c, drawer->fault == FAULT_INCLUSIVE, x, y)) draw_pixel(drawer, surface, x, y);
        }
    }
}

static void line_surface(const struct drawer *drawer, const struct corner *c0, const struct corner *c1,
                         struct surface *s)
{
    if (drawer->fault == FAULT_PLANE_SWAPPED) {
        const struct corner *c = c0;
        c0 = c1;
        c1 = c;
    }
    const struct zr_window_vertex *v0 = &c0->window, *v1 = &c1->window;
    struct zr_line_basis basis = zr_line_basis_make(v0, v1);
    if (drawer->fault == FAULT_PLANE_SHORT && basis.dx != 0.0f) basis.dx = v0->x - v1->x;
    s->depth = zr_line_plane_make(&basis, v0->z, v1->z);
    s->oow = zr_line_plane_make(&basis, v0->oow, v1->oow);
    s->red = zr_line_plane_make(&basis, c0->color.x * v0->oow, c1->color.x * v1->oow);
    s->green = zr_line_plane_make(&basis, c0->color.y * v0->oow, c1->color.y * v1->oow);
    s->blue = zr_line_plane_make(&basis, c0->color.z * v0->oow, c1->color.z * v1->oow);
}

static void draw_window_line(struct drawer *drawer, const struct corner *c0, const struct corner *c1,
                             const zr_vec4 *flat)
{
    struct zr_window_vertex v0 = c0->window, v1 = c1->window;
    if (drawer->fault == FAULT_SNAPPED_FIRST) {
        v0.x = (float)zr_snapped_x(&v0) / 256.0f + 0.5f;
        v0.y = (float)zr_snapped_y(&v0) / 256.0f + 0.5f;
        v1.x = (float)zr_snapped_x(&v1) / 256.0f + 0.5f;
        v1.y = (float)zr_snapped_y(&v1) / 256.0f + 0.5f;
    }
    struct zr_line_corners corners;
    bool reversed = drawer->fault == FAULT_REVERSED;
    drawer->stats->lines++;
    if (!c0->placed || !c1->placed || !zr_line_corners_make(reversed ? &v1 : &v0, reversed ? &v0 : &v1, 1, &corners)) {
        drawer->stats->dropped++;
        return;
    }
    struct surface surface = {.smooth = flat == NULL};
    if (flat) surface.flat = *flat;
    line_surface(drawer, c0, c1, &surface);
    draw_corners(drawer, &corners, &surface);
}

/* A corner in clip space, and what is cut with it. */
struct clip_corner {
    zr_vec4 position, front;
};

static void take_clipped(const struct zr_clipped *clipped, const struct clip_corner *in, struct clip_corner *out)
{
    zr_vec4 colors[ZR_CLIP_VALUES];
    for (int k = 0; k < clipped->corners; k++)
        colors[k] = in[k].front;
    zr_clip_replay(clipped->made, clipped->made_count, clipped->corners, colors);
    for (int i = 0; i < clipped->count; i++)
        out[i] = (struct clip_corner){clipped->vertices[i].position, colors[clipped->vertices[i].id]};
}

static bool cut_line(const struct clip_corner in[2], const unsigned codes[2], struct clip_corner out[2])
{
    const zr_vec4 ends[2] = {in[0].position, in[1].position};
    struct zr_clipped clipped;
    if (!zr_clip_line(ends, codes, &clipped)) return false;
    take_clipped(&clipped, in, out);
    return true;
}

static int cut_triangle(const struct clip_corner tri[3], unsigned outcodes, unsigned *edges,
                        struct clip_corner out[ZR_CLIP_MAX])
{
    const zr_vec4 corners[3] = {tri[0].position, tri[1].position, tri[2].position};
    struct zr_clipped clipped;
    zr_clip_triangle(corners, outcodes, edges, &clipped);
    take_clipped(&clipped, tri, out);
    return clipped.count;
}

static struct corner place(const struct drawer *drawer, const struct clip_corner *v)
{
    struct corner corner = {.color = v->front};
    corner.placed = zr_viewport_apply(&drawer->viewport, v->position, &corner.window);
    return corner;
}

static bool clip_one_by_one(const struct clip_corner in[2], struct clip_corner out[2])
{
    struct clip_corner line[2] = {in[0], in[1]};
    for (int plane = 0; plane < 6; plane++) {
        unsigned codes[2] = {zr_clip_outcode(line[0].position) & 1u << plane,
                             zr_clip_outcode(line[1].position) & 1u << plane};
        if (!cut_line(line, codes, out)) return false;
        line[0] = out[0];
        line[1] = out[1];
    }
    return true;
}

static void draw_clip_line(struct drawer *drawer, const struct clip_corner in[2], const zr_vec4 *flat)
{
    struct clip_corner out[2];
    unsigned codes[2] = {zr_clip_outcode(in[0].position), zr_clip_outcode(in[1].position)};
    if (!(codes[0] & codes[1]) && (codes[0] | codes[1])) drawer->stats->clipped++;
    bool left = drawer->fault == FAULT_CLIP_ONE_BY_ONE ? clip_one_by_one(in, out) : cut_line(in, codes, out);
    if (!left) return;
    struct corner c0 = place(drawer, &out[0]), c1 = place(drawer, &out[1]);
    draw_window_line(drawer, &c0, &c1, flat);
}

/* A line's flat colour is its last corner's. */
static void draw_chain(struct drawer *drawer, const struct clip_corner *corners, uint32_t count, bool closed)
{
    for (uint32_t i = 1; i < count + (closed ? 1 : 0); i++) {
        const struct clip_corner line[2] = {corners[i - 1], corners[i % count]};
        draw_clip_line(drawer, line, drawer->batch->smooth ? NULL : &line[1].front);
    }
}

/* ---- outlines ---- */

static int outline(const struct drawer *drawer, const struct zr_window_vertex *vertices, int count, unsigned edges,
                   bool clipped, struct zr_outline_line lines[ZR_CLIP_MAX])
{
    unsigned faces = drawer->batch->faces;
    if (drawer->fault == FAULT_ORDER) clipped = true;
    if (drawer->fault == FAULT_EDGES_OF_PLANES) edges = ~0u;
    if (drawer->fault == FAULT_CULL_AREA && faces != ZR_SIDE_BOTH) {
        int left = zr_outline_make(vertices, count, edges, clipped, ZR_SIDE_BOTH, lines), kept = 0;
        for (int i = 0; i < left; i++)
            if (lines[i].back == (faces == ZR_SIDE_BACK)) lines[kept++] = lines[i];
        return kept;
    }
    return zr_outline_make(vertices, count, edges, clipped, faces, lines);
}

static void draw_outline(struct drawer *drawer, const struct clip_corner tri[3], unsigned edges, const zr_vec4 *flat)
{
    struct clip_corner out[ZR_CLIP_MAX] = {tri[0], tri[1], tri[2]};
    unsigned c0 = zr_clip_outcode(tri[0].position), c1 = zr_clip_outcode(tri[1].position),
             c2 = zr_clip_outcode(tri[2].position), any = c0 | c1 | c2;
    if (c0 & c1 & c2) return;
    if (any && drawer->fault == FAULT_CLIP_EDGES) {
        static const int order[3] = {2, 0, 1};
        for (int k = 0; k < 3; k++)
            if (edges >> order[k] & 1u)
                draw_clip_line(drawer, (struct clip_corner[2]){tri[order[k]], tri[(order[k] + 1) % 3]}, flat);
        return;
    }
    int count = any ? cut_triangle(tri, any, &edges, out) : 3;
    struct corner corners[ZR_CLIP_MAX];
    struct zr_window_vertex vertices[ZR_CLIP_MAX];
    for (int i = 0; i < count; i++) {
        corners[i] = place(drawer, &out[i]);
        vertices[i] = corners[i].window;
    }
    struct zr_outline_line lines[ZR_CLIP_MAX];
    int line_count = count ? outline(drawer, vertices, count, edges, any, lines) : 0;
    if (any) drawer->stats->clipped++;
    for (int i = 0; i < line_count; i++) {
        const zr_vec4 *side = lines[i].back ? &batch_back : &batch_front;
        draw_window_line(drawer, &corners[lines[i].from], &corners[lines[i].to], drawer->batch->sided ? side : flat);
    }
}

/* ---- filled triangles with an offset ---- */

static void draw_filled_piece(struct drawer *drawer, const struct corner *corners[3], const zr_vec4 *flat)
{
    struct zr_window_vertex v[3] = {corners[0]->window, corners[1]->window, corners[2]->window};
    zr_vec4 c[3] = {corners[0]->color, corners[1]->color, corners[2]->color};
    int64_t area = (int64_t)(zr_snapped_x(&v[0]) - zr_snapped_x(&v[1])) * (zr_snapped_y(&v[2]) - zr_snapped_y(&v[0])) -
                   (int64_t)(zr_snapped_y(&v[0]) - zr_snapped_y(&v[1])) * (zr_snapped_x(&v[2]) - zr_snapped_x(&v[0]));
    if (area == 0 || !corners[0]->placed || !corners[1]->placed || !corners[2]->placed) return;
    if (area < 0) {
        v[0] = corners[1]->window;
        v[1] = corners[0]->window;
        c[0] = corners[1]->color;
        c[1] = corners[0]->color;
    }
    struct zr_setup setup = zr_setup_make(v, &(struct zr_triangle){.v = {0, 1, 2}});
    struct zr_plane_basis basis = zr_plane_basis_make(&v[0], &v[1], &v[2]);
    struct surface s = {.depth = setup.depth.plane, .smooth = flat == NULL};
    if (flat) s.flat = *flat;
    s.oow = zr_plane_make(&basis, v[0].oow, v[1].oow, v[2].oow);
    s.red = zr_plane_make(&basis, c[0].x * v[0].oow, c[1].x * v[1].oow, c[2].x * v[2].oow);
    s.green = zr_plane_make(&basis, c[0].y * v[0].oow, c[1].y * v[1].oow, c[2].y * v[2].oow);
    s.blue = zr_plane_make(&basis, c[0].z * v[0].oow, c[1].z * v[1].oow, c[2].z * v[2].oow);
    s.offset = zr_depth_offset(&v[0], &v[1], &v[2], drawer->batch->factor, drawer->batch->units);
    if (drawer->fault == FAULT_OFFSET_SLOPE) {
        float dx = fabsf(s.depth.dadx), dy = fabsf(s.depth.dady);
        s.offset = zr_depth_offset(&v[0], &v[1], &v[2], 0.0f, drawer->batch->units) +
                   (dx > dy ? dx : dy) * drawer->batch->factor;
    }
    if (drawer->fault == FAULT_OFFSET_IN_PLANE) {
        s.depth.a0 += s.offset;
        s.offset = 0.0f;
    }
    for (int32_t y = setup.min_y; y <= setup.max_y; y++)
        for (int32_t x = setup.min_x; x <= setup.max_x; x++) {
            bool inside = true;
            for (int k = 0; k < 3; k++)
                inside &= setup.edges[k].c + setup.edges[k].a * x + setup.edges[k].b * y > 0;
            if (inside) draw_pixel(drawer, &s, x, y);
        }
}

static void draw_filled(struct drawer *drawer, const struct clip_corner tri[3], const zr_vec4 *flat)
{
    struct clip_corner out[ZR_CLIP_MAX];
    unsigned c0 = zr_clip_outcode(tri[0].position), c1 = zr_clip_outcode(tri[1].position),
             c2 = zr_clip_outcode(tri[2].position), any = c0 | c1 | c2;
    if (c0 & c1 & c2) return;
    if (any) {
        drawer->stats->clipped++;
        int count = cut_triangle(tri, any, NULL, out);
        struct corner corners[ZR_CLIP_MAX];
        for (int i = 0; i < count; i++)
            corners[i] = place(drawer, &out[i]);
        for (int i = 2; i < count; i++)
            draw_filled_piece(drawer, (const struct corner *[3]){&corners[i - 1], &corners[i], &corners[0]}, flat);
        return;
    }
    struct corner c[3] = {place(drawer, &tri[0]), place(drawer, &tri[1]), place(drawer, &tri[2])};
    draw_filled_piece(drawer, (const struct corner *[3]){&c[0], &c[1], &c[2]}, flat);
}

/* ---- the batch ---- */

static void draw_primitive(struct drawer *drawer, const struct clip_corner *corners, uint32_t count,
                           const zr_vec4 *flat)
{
    if (drawer->batch->mode == BATCH_LINES) {
        draw_chain(drawer, corners, count, drawer->batch->chain == CHAIN_LOOP && count > 2);
    } else if (drawer->batch->mode == BATCH_FILLED) {
        draw_filled(drawer, corners, flat);
    } else if (count == 3) {
        draw_outline(drawer, corners, 7, flat);
    } else {
        for (uint32_t i = 2; i < count; i++)
            draw_outline(drawer, (struct clip_corner[3]){corners[i - 1], corners[i], corners[0]},
                         zr_outline_fan_edges(i, count), flat);
    }
}

void draw_own(const struct batch *batch, enum fault fault, struct batch_picture *picture, struct batch_stats *stats)
{
    struct drawer drawer = {batch, fault, picture, stats, zr_viewport_make(batch->width, batch->height)};
    size_t pixels = (size_t)batch->width * batch->height;
    memset(picture->rgba, 0, pixels * 4);
    for (size_t i = 0; i < pixels; i++)
        picture->depth[i] = 1.0f;
    for (uint32_t i = 0; i < batch->count; i++) {
        struct clip_corner corners[BATCH_CORNERS];
        uint32_t first = batch->offsets[i], count = batch->offsets[i + 1] - first;
        for (uint32_t k = 0; k < count; k++)
            corners[k] =
                (struct clip_corner){.position = batch->positions[first + k], .front = batch->colors[first + k]};
        draw_primitive(&drawer, corners, count, batch->smooth ? NULL : &corners[0].front);
        stats->primitives++;
    }
}
