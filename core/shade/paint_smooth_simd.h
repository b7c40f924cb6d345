/* paint_smooth_simd.h - shade: triangles whose colours vary, for the kernels that paint: where their corners are, their
 * planes, and short runs of them. As many runs as there are lanes are set up at once, and then painted side by side,
 * one a lane.
 */
#ifndef ZR_PAINT_SMOOTH_SIMD_H
#define ZR_PAINT_SMOOTH_SIMD_H

#include "raster/triangle_simd.h"
#include "shade/paint_simd.h"

/* A short run has so many pixels at most. */
enum { ZR_SHORT_RUN = 8 };

/* Triangles that are known at a time, and room for a vector behind them. */
enum { ZR_SMOOTH_MOST = 512, ZR_SMOOTH_ROOM = ZR_SMOOTH_MOST + ZR_LANES };

/* Colours of fronts and of backs; one array, and not mirrored, where no back is seen in colours of its own. mirrored:
 * as in zr_batch. */
struct zr_smooth_sides {
    const zr_vec4 *front, *back;
    bool mirrored;
};

/* Where the corners of triangles stand. */
struct zr_smooth_corners {
    struct zr_smooth_sides sides;      /* that color[] counts from */
    int32_t vertex[3][ZR_SMOOTH_ROOM]; /* of the geometry */
    int32_t color[3][ZR_SMOOTH_ROOM];
};

struct zr_smooth_queue {
    struct zr_runs runs;
    struct zr_smooth_corners corners;
};

/* value / divisor, rounded down, of values of 0 .. 2^16 - 1 and divisors up to 2^7: the float quotient is near enough.
 */
static inline zr_vi zr_quotient_v(zr_vi value, int32_t divisor)
{
    const zr_vf exact = (zr_vf_of(value) + zr_vf_set(0.5f)) * zr_vf_set(1.0f / (float)divisor);
    return zr_vi_round(exact - zr_vf_set(0.5f));
}

/* ---- looking up ---- */

static inline void zr_smooth_expect(const struct zr_smooth_corners *corners, const struct zr_window_vertex *vertices,
                                    uint32_t i)
{
    for (int k = 0; k < 3; k++) {
        __builtin_prefetch(&vertices[corners->vertex[k][i]]);
        __builtin_prefetch(&corners->sides.front[corners->color[k][i]]);
        if (corners->sides.back != corners->sides.front) __builtin_prefetch(&corners->sides.back[corners->color[k][i]]);
    }
}

static inline struct zr_smooth_sides zr_smooth_sides_of(const struct zr_batch *batch)
{
    if (!batch->sided) return (struct zr_smooth_sides){batch->front, batch->front, false};
    return (struct zr_smooth_sides){batch->front, batch->back, batch->mirrored};
}

/* Corners `first` .. first + ZR_LANES - 1 are those of triangles of a smooth batch, by their numbers in it. */
static inline void zr_smooth_look_up(struct zr_smooth_corners *corners, const struct zr_window_vertex *vertices,
                                     const struct zr_batch *batch, zr_vi numbers, uint32_t first)
{
    const zr_vi word = numbers * zr_vi_set(3);
    corners->sides = zr_smooth_sides_of(batch);
    for (int k = 0; k < 3; k++) {
        const zr_vi corner = zr_vi_gather(ZR_ALL_LANES, batch->corners, word + zr_vi_set(k));
        zr_vi color = corner;
        if (batch->colors == ZR_BATCH_PER_CORNER)
            color = batch->slots ? zr_vi_gather(ZR_ALL_LANES, batch->slots, word + zr_vi_set(k))
                                 : word + zr_vi_set((int32_t)(3 * batch->first_face) + k);
        zr_vi_store(corners->color[k] + first, color);
        zr_vi_store(corners->vertex[k] + first, corner + zr_vi_set((int32_t)batch->first_vertex));
    }
    for (uint32_t i = first; i < first + ZR_LANES; i++)
        zr_smooth_expect(corners, vertices, i);
}

/* ---- planes ---- */

struct zr_color_planes {
    struct zr_plane_v oow, red, green, blue;
};

struct zr_color_v {
    zr_vf red, green, blue;
};

/* Lane i of colour k has what stands at AT_k(i), as ZR_LOAD4 has it. */
#define ZR_LOAD_COLORS(c, AT_0, AT_1, AT_2)                                                                            \
    do {                                                                                                               \
        zr_vf alpha;                                                                                                   \
        ZR_LOAD4((c)[0].red, (c)[0].green, (c)[0].blue, alpha, AT_0);                                                  \
        ZR_LOAD4((c)[1].red, (c)[1].green, (c)[1].blue, alpha, AT_1);                                                  \
        ZR_LOAD4((c)[2].red, (c)[2].green, (c)[2].blue, alpha, AT_2);                                                  \
        (void)alpha;                                                                                                   \
    } while (0)

/* Rule 9, of corners as they stand in the mesh, and their colours; of those that are `turned` two change places. */
static inline struct zr_color_planes zr_color_planes_of(zr_vm turned, struct zr_corner_v v[3], struct zr_color_v c[3])
{
    for (int k = 0; k < 3; k++) {
        c[k].red = c[k].red * v[k].oow;
        c[k].green = c[k].green * v[k].oow;
        c[k].blue = c[k].blue * v[k].oow;
    }
    const int k = zr_swapped_corner();
    zr_swap_vf(turned, &v[0].x, &v[k].x);
    zr_swap_vf(turned, &v[0].y, &v[k].y);
    zr_swap_vf(turned, &v[0].oow, &v[k].oow);
    zr_swap_vf(turned, &c[0].red, &c[k].red);
    zr_swap_vf(turned, &c[0].green, &c[k].green);
    zr_swap_vf(turned, &c[0].blue, &c[k].blue);
    const struct zr_basis_v basis = zr_basis_make_v(v);
    return (struct zr_color_planes){zr_plane_make_v(&basis, v[0].oow, v[1].oow, v[2].oow),
                                    zr_plane_make_v(&basis, c[0].red, c[1].red, c[2].red),
                                    zr_plane_make_v(&basis, c[0].green, c[1].green, c[2].green),
                                    zr_plane_make_v(&basis, c[0].blue, c[1].blue, c[2].blue)};
}

/* The colours of triangles `first` .. first + ZR_LANES - 1, of the side that each shows. */
static inline void zr_smooth_load_colors(const struct zr_smooth_corners *corners, uint32_t first, zr_vm turned,
                                         struct zr_color_v c[3])
{
    const zr_vec4 *const of_side[2] = {corners->sides.front, corners->sides.back};
    const uint32_t backs = zr_vm_bits(zr_backs_v(turned, corners->sides.mirrored));
#define ZR_COLOR(i, k) (&of_side[(backs >> (i)) & 1u][corners->color[k][first + (i)]].x)
#define ZR_COLOR_0(i)  ZR_COLOR(i, 0)
#define ZR_COLOR_1(i)  ZR_COLOR(i, 1)
#define ZR_COLOR_2(i)  ZR_COLOR(i, 2)
    ZR_LOAD_COLORS(c, ZR_COLOR_0, ZR_COLOR_1, ZR_COLOR_2);
#undef ZR_COLOR_0
#undef ZR_COLOR_1
#undef ZR_COLOR_2
#undef ZR_COLOR
}

/* Of triangles `first` .. first + ZR_LANES - 1. */
static inline struct zr_color_planes zr_color_planes_make(const struct zr_smooth_corners *corners,
                                                          const struct zr_window_vertex *vertices, uint32_t first)
{
    struct zr_corner_v v[3];
    struct zr_color_v c[3];
#define ZR_VERTEX_0(i) (&vertices[corners->vertex[0][first + (i)]].x)
#define ZR_VERTEX_1(i) (&vertices[corners->vertex[1][first + (i)]].x)
#define ZR_VERTEX_2(i) (&vertices[corners->vertex[2][first + (i)]].x)
    ZR_LOAD_CORNERS(v, ZR_VERTEX_0, ZR_VERTEX_1, ZR_VERTEX_2);
#undef ZR_VERTEX_0
#undef ZR_VERTEX_1
#undef ZR_VERTEX_2
    const zr_vm turned =
        zr_turned_v(vertices, corners->vertex[0] + first, corners->vertex[1] + first, corners->vertex[2] + first, v);
    zr_smooth_load_colors(corners, first, turned, c);
    return zr_color_planes_of(turned, v, c);
}

/* Of 1/w, and colours times that. */
static inline zr_vi zr_color_over_w(zr_vf oow, zr_vf red, zr_vf green, zr_vf blue)
{
    const zr_vf one = zr_vf_set(1.0f), reciprocal = ZR_MUTANT(colors_over_no_w, one / oow, one);
    return zr_rgba_opaque_v(red * reciprocal, green * reciprocal, blue * reciprocal);
}

static inline zr_vi zr_color_at(const struct zr_color_planes *p, zr_vf x, zr_vf y)
{
    return zr_color_over_w(zr_plane_at_v(&p->oow, x, y), zr_plane_at_v(&p->red, x, y), zr_plane_at_v(&p->green, x, y),
                           zr_plane_at_v(&p->blue, x, y));
}

/* ---- runs ---- */

/* The first n of four, n at most 4. */
static inline void zr_store_four(uint32_t *out, const uint32_t *four, uint32_t n)
{
    for (uint32_t i = 0; i < n; i += ZR_LANES)
        zr_vi_store_first(out + i, zr_vi_load(four + i), n - i < ZR_LANES ? n - i : ZR_LANES);
}

/* Pixels `begin` .. begin + 3 of each run that is short and has them, at once: four vectors of all runs' pixels are
 * turned into four pixels of each run, which are stored without asking how many they are. `lengths`, of the runs
 * from pixel `begin` on; less than 1: none. */
static inline void zr_paint_four(const struct zr_color_planes *p, zr_vf x, zr_vf y, zr_vi lengths, const int32_t *at,
                                 uint32_t count, uint32_t *out)
{
    uint32_t fours[4 * ZR_LANES + ZR_LANES]; /* the last load looks behind the end */
    int32_t left[ZR_LANES];
    zr_vi colors[4];
    for (int k = 0; k < 4; k++, x = x + zr_vf_set(1.0f))
        colors[k] = zr_color_at(p, x, y);
    zr_vi_store4(fours, colors[0], colors[1], colors[2], colors[3]);
    zr_vi_store(left, zr_vi_max(zr_vi_min(lengths, zr_vi_set(4)), zr_vi_set(0)));
    for (uint32_t i = 0; i < count; i++)
        zr_store_four(out + at[i], fours + 4 * (size_t)i, (uint32_t)left[i]);
}

/* ---- the queue ---- */

/* Runs `first` .. first + count - 1; a group of lanes at most. Lanes behind that hold any run. */
static inline void zr_smooth_paint_group(const struct zr_smooth_queue *q, const struct zr_canvas *canvas,
                                         uint32_t first, uint32_t count)
{
    const struct zr_color_planes planes = zr_color_planes_make(&q->corners, canvas->geometry->vertices, first);
    const zr_vi at = zr_vi_load(q->runs.at + first), lengths = zr_vi_load(q->runs.length + first);
    const zr_vi row = zr_quotient_v(at, ZR_TILE_STRIDE), column = at - row * zr_vi_set(ZR_TILE_STRIDE);
    const zr_vf x = zr_vf_of(column + zr_vi_set(canvas->x)), y = zr_vf_of(row + zr_vi_set(canvas->y));
    for (int32_t begin = 0; begin < ZR_SHORT_RUN; begin += 4) {
        const zr_vi left = lengths - zr_vi_set(begin);
        if (!zr_vm_any(zr_vi_lt(zr_vi_set(0), left))) break;
        zr_paint_four(&planes, x + zr_vf_set((float)begin), y, left, q->runs.at + first, count, canvas->colors + begin);
    }
}

static inline void zr_smooth_move(struct zr_smooth_queue *q, uint32_t from, uint32_t to)
{
    for (int k = 0; k < 3; k++) {
        q->corners.vertex[k][to] = q->corners.vertex[k][from];
        q->corners.color[k][to] = q->corners.color[k][from];
    }
    q->runs.at[to] = q->runs.at[from];
    q->runs.length[to] = q->runs.length[from];
}

static inline void zr_smooth_begin(struct zr_smooth_queue *q)
{
    q->runs.count = 0;
    q->corners.sides = (struct zr_smooth_sides){NULL, NULL, false};
}

/* Full groups of lanes; what is left over waits for more, unless this is the end. */
static inline void zr_smooth_paint(struct zr_smooth_queue *q, const struct zr_canvas *canvas, bool end)
{
    const uint32_t full = q->runs.count / ZR_LANES * ZR_LANES, left = q->runs.count - full;
    for (uint32_t first = 0; first < full; first += ZR_LANES)
        zr_smooth_paint_group(q, canvas, first, ZR_LANES);
    q->runs.count = left;
    if (end && left > 0) {
        for (uint32_t i = left; i < ZR_LANES; i++)
            zr_smooth_move(q, full, full + i);
        zr_smooth_paint_group(q, canvas, full, left);
        q->runs.count = 0;
    }
    for (uint32_t i = 0; full > 0 && i < q->runs.count; i++)
        zr_smooth_move(q, full + i, i);
}

/* One run. Other sides than the last run's: what waits is painted first. */
static inline void zr_smooth_add(struct zr_smooth_queue *q, const struct zr_canvas *canvas, int32_t at, int32_t length,
                                 uint32_t first_vertex, const uint32_t v[3], struct zr_smooth_sides sides,
                                 const uint32_t c[3])
{
    const struct zr_smooth_sides *last = &q->corners.sides;
    if (last->front != sides.front || last->back != sides.back || last->mirrored != sides.mirrored)
        zr_smooth_paint(q, canvas, true);
    q->corners.sides = sides;
    for (int k = 0; k < 3; k++) {
        q->corners.vertex[k][q->runs.count] = (int32_t)(first_vertex + v[k]);
        q->corners.color[k][q->runs.count] = (int32_t)c[k];
    }
    zr_smooth_expect(&q->corners, canvas->geometry->vertices, q->runs.count);
    q->runs.at[q->runs.count] = at;
    q->runs.length[q->runs.count++] = length;
}

#endif
