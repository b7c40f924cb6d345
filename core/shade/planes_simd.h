/* planes_simd.h - shade: triangles whose colours vary, ZR_LANES at once, for kernels: where their corners are, their
 * planes, and what these show.
 *
 * Exact:  the reference's rules 6 (which corners change places), 8 (planes) and 9 (colours over w).
 */
#ifndef ZR_PLANES_SIMD_H
#define ZR_PLANES_SIMD_H

#include "base/rgba_simd.h"
#include "raster/triangle_simd.h"
#include "shade/paint.h"

/* Colours of fronts and of backs; one array, and not mirrored, where no back is seen in colours of its own. mirrored:
 * as in zr_batch. */
struct zr_smooth_sides {
    const zr_vec4 *front, *back;
    bool mirrored;
};

/* Where the corners of triangles stand. */
struct zr_smooth_corners {
    int32_t vertex[3][ZR_LANES]; /* of the geometry */
    int32_t color[3][ZR_LANES];  /* of the sides */
};

/* ---- looking up ---- */

static inline struct zr_smooth_sides zr_smooth_sides_of(const struct zr_batch *batch)
{
    if (!batch->sided) return (struct zr_smooth_sides){batch->front, batch->front, false};
    return (struct zr_smooth_sides){batch->front, batch->back, batch->mirrored};
}

/* As zr_batch_value, of what varies over triangles: their corners k. `corner`: their positions. */
static inline zr_vi zr_value_v(const struct zr_batch *batch, enum zr_batch_colors rate, zr_vi numbers, zr_vi corner,
                               int k)
{
    const zr_vi word = numbers * zr_vi_set(3);
    if (rate == ZR_BATCH_PER_VERTEX) return corner;
    if (rate == ZR_BATCH_PER_CORNER)
        return batch->slots ? zr_vi_gather(ZR_ALL_LANES, batch->slots, word + zr_vi_set(k))
                            : word + zr_vi_set((int32_t)(3 * batch->first_face) + k);
    return batch->faces ? zr_vi_gather(ZR_ALL_LANES, batch->faces, numbers)
                        : numbers + zr_vi_set((int32_t)batch->first_face);
}

/* The corners of triangles, by their numbers in a batch, and the values that vary over them at a rate. */
static inline struct zr_smooth_corners zr_smooth_corners_of(const struct zr_batch *batch, enum zr_batch_colors rate,
                                                            zr_vi numbers)
{
    struct zr_smooth_corners out;
    for (int k = 0; k < 3; k++) {
        const zr_vi word = numbers * zr_vi_set(3) + zr_vi_set(k);
        const zr_vi corner = zr_vi_gather(ZR_ALL_LANES, batch->corners, word);
        zr_vi_store(out.color[k], zr_value_v(batch, rate, numbers, corner, k));
        zr_vi_store(out.vertex[k], corner + zr_vi_set((int32_t)batch->first_vertex));
    }
    return out;
}

static inline void zr_smooth_expect(const struct zr_batch *batch, const struct zr_window_vertex *vertices,
                                    zr_vi numbers)
{
    const struct zr_smooth_sides sides = zr_smooth_sides_of(batch);
    const struct zr_smooth_corners corners = zr_smooth_corners_of(batch, batch->colors, numbers);
    for (int i = 0; i < ZR_LANES; i++)
        for (int k = 0; k < 3; k++) {
            __builtin_prefetch(&vertices[corners.vertex[k][i]]);
            __builtin_prefetch(&sides.front[corners.color[k][i]]);
            if (sides.back != sides.front) __builtin_prefetch(&sides.back[corners.color[k][i]]);
        }
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

/* The colours of the side that each shows. */
static inline void zr_smooth_load_colors(const struct zr_smooth_corners *corners, struct zr_smooth_sides sides,
                                         zr_vm turned, struct zr_color_v c[3])
{
    const zr_vec4 *const of_side[2] = {sides.front, sides.back};
    const uint32_t backs = zr_vm_bits(zr_backs_v(turned, sides.mirrored));
#define ZR_COLOR(i, k) (&of_side[(backs >> (i)) & 1u][corners->color[k][i]].x)
#define ZR_COLOR_0(i)  ZR_COLOR(i, 0)
#define ZR_COLOR_1(i)  ZR_COLOR(i, 1)
#define ZR_COLOR_2(i)  ZR_COLOR(i, 2)
    ZR_LOAD_COLORS(c, ZR_COLOR_0, ZR_COLOR_1, ZR_COLOR_2);
#undef ZR_COLOR_0
#undef ZR_COLOR_1
#undef ZR_COLOR_2
#undef ZR_COLOR
}

/* Where triangles stand, and which of them are turned (rule 6). */
static inline zr_vm zr_smooth_load_corners(const struct zr_smooth_corners *corners,
                                           const struct zr_window_vertex *vertices, struct zr_corner_v v[3])
{
#define ZR_VERTEX_0(i) (&vertices[corners->vertex[0][i]].x)
#define ZR_VERTEX_1(i) (&vertices[corners->vertex[1][i]].x)
#define ZR_VERTEX_2(i) (&vertices[corners->vertex[2][i]].x)
    ZR_LOAD_CORNERS(v, ZR_VERTEX_0, ZR_VERTEX_1, ZR_VERTEX_2);
#undef ZR_VERTEX_0
#undef ZR_VERTEX_1
#undef ZR_VERTEX_2
    return zr_turned_v(vertices, corners->vertex[0], corners->vertex[1], corners->vertex[2], v);
}

/* Of triangles of a smooth batch, by their numbers in it. */
static inline struct zr_color_planes zr_color_planes_make(const struct zr_batch *batch,
                                                          const struct zr_window_vertex *vertices, zr_vi numbers)
{
    const struct zr_smooth_corners corners = zr_smooth_corners_of(batch, batch->colors, numbers);
    struct zr_corner_v v[3];
    struct zr_color_v c[3];
    const zr_vm turned = zr_smooth_load_corners(&corners, vertices, v);
    zr_smooth_load_colors(&corners, zr_smooth_sides_of(batch), turned, c);
    return zr_color_planes_of(turned, v, c);
}

/* Any values of four floats, of which the first three count, by their numbers. */
static inline void zr_values_load(const zr_vec4 *values, int32_t (*numbers)[ZR_LANES], struct zr_color_v c[3])
{
#define ZR_VALUE_0(i) (&values[numbers[0][i]].x)
#define ZR_VALUE_1(i) (&values[numbers[1][i]].x)
#define ZR_VALUE_2(i) (&values[numbers[2][i]].x)
    ZR_LOAD_COLORS(c, ZR_VALUE_0, ZR_VALUE_1, ZR_VALUE_2);
#undef ZR_VALUE_0
#undef ZR_VALUE_1
#undef ZR_VALUE_2
}

/* The normals of triangles of a batch, of the sides that they show. */
static inline void zr_normals_load(const struct zr_batch *batch, zr_vi numbers, zr_vm turned, struct zr_color_v c[3])
{
    struct zr_smooth_corners corners = zr_smooth_corners_of(batch, batch->normals_rate, numbers);
    const zr_vf one = zr_vf_set(1.0f);
    const zr_vf sign =
        zr_vf_select(zr_backs_v(turned, batch->mirrored), ZR_MUTANT(backs_keep_normals, zr_vf_set(-1.0f), one), one);
    zr_values_load(batch->normals, corners.color, c);
    for (int k = 0; k < 3; k++) {
        c[k].red = c[k].red * sign;
        c[k].green = c[k].green * sign;
        c[k].blue = c[k].blue * sign;
    }
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

#endif
