/* planes_simd.h - shade: loads the values at the corners of ZR_LANES triangles and makes their planes, for kernels.
 *
 * Exact:  the reference's rules 6 (swapped corners), 8 (planes) and 9 (values over w).
 */
#ifndef ZR_PLANES_SIMD_H
#define ZR_PLANES_SIMD_H

#include "base/inlined.h"
#include "base/rgba_simd.h"
#include "base/vec3_simd.h"
#include "raster/triangle_simd.h"
#include "shade/eye_values_simd.h"
#include "shade/paint.h"
#include "shade/varyings.h"

/* ---- numbers and values ---- */

/* Returns zr_flat_number of primitives `numbers` of a draw. */
static inline zr_vi zr_flat_number_v(const struct zr_draw *draw, enum zr_rate rate, zr_vi numbers)
{
    const zr_vm all = ZR_ALL_LANES;
    if (rate == ZR_RATE_DRAW) return zr_vi_set(0);
    if (rate == ZR_RATE_FIRST_VERTEX && !draw->faces) return zr_vi_gather(all, draw->corners, numbers * zr_vi_set(3));
    const zr_vi face =
        draw->faces ? zr_vi_gather(all, draw->faces, numbers) : numbers + zr_vi_set((int32_t)draw->first_face);
    if (rate == ZR_RATE_FACE) return face;
    const zr_vi slot = zr_vi_gather(all, draw->mesh->face_offsets, face);
    return rate == ZR_RATE_FIRST_CORNER ? slot : zr_vi_gather(all, draw->mesh->indices, slot);
}

/* Returns zr_smooth_number of corner k of primitives `numbers`. `vertex`: that corner's vertex. */
static inline zr_vi zr_smooth_number_v(const struct zr_draw *draw, enum zr_rate rate, zr_vi numbers, zr_vi vertex,
                                       int k)
{
    const zr_vi word = numbers * zr_vi_set(3);
    if (rate == ZR_RATE_VERTEX) return vertex;
    return draw->slots ? zr_vi_gather(ZR_ALL_LANES, draw->slots, word + zr_vi_set(k))
                       : word + zr_vi_set((int32_t)(3 * draw->first_face) + k);
}

/* Corners of ZR_LANES triangles: numbers of their window vertices and of their values. */
struct zr_corner_numbers {
    int32_t vertex[3][ZR_LANES];
    int32_t value[3][ZR_LANES];
};

/* Returns the same corners with value numbers at `rate`. */
ZR_INLINED struct zr_corner_numbers zr_corners_at_rate(const struct zr_draw *draw, enum zr_rate rate, zr_vi numbers,
                                                       const struct zr_corner_numbers *corners)
{
    const bool is_flat = zr_rate_is_flat(rate);
    const zr_vi flat = is_flat ? zr_flat_number_v(draw, rate, numbers) : zr_vi_set(0);
    struct zr_corner_numbers out = *corners;
    for (int k = 0; k < 3; k++) {
        const zr_vi vertex = zr_vi_load(corners->vertex[k]) - zr_vi_set((int32_t)draw->first_vertex);
        zr_vi_store(out.value[k], is_flat ? flat : zr_smooth_number_v(draw, rate, numbers, vertex, k));
    }
    return out;
}

static inline struct zr_corner_numbers zr_corner_numbers_of(const struct zr_draw *draw, enum zr_rate rate,
                                                            zr_vi numbers)
{
    const bool is_flat = zr_rate_is_flat(rate);
    const zr_vi flat = is_flat ? zr_flat_number_v(draw, rate, numbers) : zr_vi_set(0);
    struct zr_corner_numbers out;
    for (int k = 0; k < 3; k++) {
        const zr_vi vertex = zr_vi_gather(ZR_ALL_LANES, draw->corners, numbers * zr_vi_set(3) + zr_vi_set(k));
        zr_vi_store(out.value[k], is_flat ? flat : zr_smooth_number_v(draw, rate, numbers, vertex, k));
        zr_vi_store(out.vertex[k], vertex + zr_vi_set((int32_t)draw->first_vertex));
    }
    return out;
}

/* Returns the lanes that show their backs. `turned`: counter-clockwise lanes. */
static inline zr_vm zr_shown_backs(const struct zr_draw *draw, zr_vi numbers, zr_vm turned)
{
    const zr_vi one = zr_vi_set(1);
    if (!draw->traits) return zr_backs_v(turned, draw->mirrored);
    return zr_vi_eq(zr_vi_gather(ZR_ALL_LANES, draw->traits, numbers) & one, one);
}

/* Loads the four floats at AT_k(i) to lane i of c[k] and last[k], with ZR_LOAD4. */
#define ZR_LOAD_FOURS(c, last, AT_0, AT_1, AT_2)                                                                       \
    do {                                                                                                               \
        ZR_LOAD4((c)[0].x, (c)[0].y, (c)[0].z, (last)[0], AT_0);                                                       \
        ZR_LOAD4((c)[1].x, (c)[1].y, (c)[1].z, (last)[1], AT_1);                                                       \
        ZR_LOAD4((c)[2].x, (c)[2].y, (c)[2].z, (last)[2], AT_2);                                                       \
    } while (0)

/* Loads values by their numbers. Inlined, so that unused fourth components are never computed. */
ZR_INLINED void zr_values_load(const zr_vec4 *values, const int32_t (*numbers)[ZR_LANES], struct zr_vec3_v c[3],
                               zr_vf last[3])
{
#define ZR_VALUE_0(i) (&values[numbers[0][i]].x)
#define ZR_VALUE_1(i) (&values[numbers[1][i]].x)
#define ZR_VALUE_2(i) (&values[numbers[2][i]].x)
    ZR_LOAD_FOURS(c, last, ZR_VALUE_0, ZR_VALUE_1, ZR_VALUE_2);
#undef ZR_VALUE_0
#undef ZR_VALUE_1
#undef ZR_VALUE_2
}

/* Loads the points of a draw by the numbers of their window vertices. has_depth: `last` is wanted. */
ZR_INLINED void zr_points_load(const struct zr_draw_attributes *of_draw, const int32_t (*vertices)[ZR_LANES],
                               bool has_depth, struct zr_vec3_v c[3], zr_vf last[3])
{
    const uint32_t first = of_draw->draw->first_vertex;
    if (of_draw->points) {
        struct zr_eye_values made;
        ZR_KERNEL(zr_eye_vectors_at)(of_draw->points, first, vertices, has_depth, &made);
        zr_eye_values_load(&made, c, last);
    } else {
        zr_values_load(of_draw->attributes[ZR_ATTRIBUTE_POINT].values - first, vertices, c, last);
    }
}

/* ---- planes ---- */

/* Values that all planes of a triangle share. */
struct zr_triangle_setup_v {
    zr_vm turned;                /* two corners are swapped (rule 6) */
    zr_vf oow[3];                /* 1/w of the corners, in mesh order */
    struct zr_basis_v basis;     /* basis of the corners, in the order of rule 6 */
    struct zr_plane_v oow_plane; /* plane of 1/w */
};

ZR_INLINED struct zr_triangle_setup_v zr_triangle_setup_make(zr_vm turned, const struct zr_corner_v corners[3])
{
    struct zr_corner_v v[3] = {corners[0], corners[1], corners[2]};
    const int k = zr_swapped_corner();
    struct zr_triangle_setup_v setup = {.turned = turned, .oow = {v[0].oow, v[1].oow, v[2].oow}};
    zr_swap_vf(turned, &v[0].x, &v[k].x);
    zr_swap_vf(turned, &v[0].y, &v[k].y);
    zr_swap_vf(turned, &v[0].oow, &v[k].oow);
    setup.basis = zr_basis_make_v(v);
    setup.oow_plane = zr_plane_make_v(&setup.basis, v[0].oow, v[1].oow, v[2].oow);
    return setup;
}

/* Planes of x, y and z, each times 1/w. */
struct zr_planes3_v {
    struct zr_plane_v x, y, z;
};

/* Makes three planes. `values` are in mesh order. */
ZR_INLINED struct zr_planes3_v zr_planes3_make(const struct zr_triangle_setup_v *setup,
                                               const struct zr_vec3_v values[3])
{
    struct zr_vec3_v v[3] = {zr_scale_v(values[0], setup->oow[0]), zr_scale_v(values[1], setup->oow[1]),
                             zr_scale_v(values[2], setup->oow[2])};
    const int k = zr_swapped_corner();
    zr_swap_vf(setup->turned, &v[0].x, &v[k].x);
    zr_swap_vf(setup->turned, &v[0].y, &v[k].y);
    zr_swap_vf(setup->turned, &v[0].z, &v[k].z);
    return (struct zr_planes3_v){zr_plane_make_v(&setup->basis, v[0].x, v[1].x, v[2].x),
                                 zr_plane_make_v(&setup->basis, v[0].y, v[1].y, v[2].y),
                                 zr_plane_make_v(&setup->basis, v[0].z, v[1].z, v[2].z)};
}

/* Makes the plane of one value per corner, in mesh order. */
ZR_INLINED struct zr_plane_v zr_plane1_make(const struct zr_triangle_setup_v *setup, zr_vf v0, zr_vf v1, zr_vf v2)
{
    zr_vf v[3] = {v0 * setup->oow[0], v1 * setup->oow[1], v2 * setup->oow[2]};
    zr_swap_vf(setup->turned, &v[0], &v[zr_swapped_corner()]);
    return zr_plane_make_v(&setup->basis, v[0], v[1], v[2]);
}

/* Loads window vertices by their numbers. */
ZR_INLINED void zr_vertices_load(const struct zr_window_vertex *vertices, const int32_t (*numbers)[ZR_LANES],
                                 struct zr_corner_v v[3])
{
#define ZR_VERTEX_0(i) (&vertices[numbers[0][i]].x)
#define ZR_VERTEX_1(i) (&vertices[numbers[1][i]].x)
#define ZR_VERTEX_2(i) (&vertices[numbers[2][i]].x)
    ZR_LOAD_CORNERS(v, ZR_VERTEX_0, ZR_VERTEX_1, ZR_VERTEX_2);
#undef ZR_VERTEX_0
#undef ZR_VERTEX_1
#undef ZR_VERTEX_2
}

/* Returns the lanes of counter-clockwise triangles. */
static inline zr_vm zr_turned_of(const struct zr_window_vertex *vertices, const int32_t (*numbers)[ZR_LANES])
{
    struct zr_corner_v v[3];
    zr_vertices_load(vertices, numbers, v);
    return zr_turned_v(vertices, numbers[0], numbers[1], numbers[2], v);
}

ZR_INLINED struct zr_triangle_setup_v zr_way_of(const struct zr_window_vertex *vertices,
                                                const int32_t (*numbers)[ZR_LANES])
{
    struct zr_corner_v v[3];
    zr_vertices_load(vertices, numbers, v);
    return zr_triangle_setup_make(zr_turned_v(vertices, numbers[0], numbers[1], numbers[2], v), v);
}

/* ---- colours ---- */

/* Loads the colours of the visible sides; a bit of `backs` per lane. */
ZR_INLINED void zr_colors_load(const struct zr_draw_attributes *of_draw, const int32_t (*numbers)[ZR_LANES],
                               uint32_t backs, struct zr_vec3_v c[3], zr_vf opacity[3])
{
    const struct zr_attribute *attributes = of_draw->attributes;
    const zr_vec4 *const of_side[2] = {attributes[ZR_ATTRIBUTE_COLOR].values,
                                       attributes[ZR_ATTRIBUTE_BACK_COLOR].values};
#define ZR_COLOR(i, k) (&of_side[(backs >> (i)) & 1u][numbers[k][i]].x)
#define ZR_COLOR_0(i)  ZR_COLOR(i, 0)
#define ZR_COLOR_1(i)  ZR_COLOR(i, 1)
#define ZR_COLOR_2(i)  ZR_COLOR(i, 2)
    ZR_LOAD_FOURS(c, opacity, ZR_COLOR_0, ZR_COLOR_1, ZR_COLOR_2);
#undef ZR_COLOR_0
#undef ZR_COLOR_1
#undef ZR_COLOR_2
#undef ZR_COLOR
}

/* Packs colours that are given as 1/w and colours times 1/w. */
static inline zr_vi zr_color_over_w(zr_vf oow, zr_vf red, zr_vf green, zr_vf blue)
{
    const zr_vf one = zr_vf_set(1.0f), reciprocal = ZR_MUTANT(colors_over_no_w, one / oow, one);
    return zr_rgba_opaque_v(red * reciprocal, green * reciprocal, blue * reciprocal);
}

/* ---- normals ---- */

/* Loads the normals of the visible sides of a draw's triangles. */
ZR_INLINED void zr_normals_load(const struct zr_draw_attributes *of_draw, zr_vi numbers, zr_vm turned,
                                const struct zr_corner_numbers *corners, struct zr_vec3_v c[3])
{
    const struct zr_attribute *normal = &of_draw->attributes[ZR_ATTRIBUTE_NORMAL];
    const struct zr_corner_numbers own = zr_corners_at_rate(of_draw->draw, normal->rate, numbers, corners);
    const zr_vm backs = zr_shown_backs(of_draw->draw, numbers, turned);
    const zr_vf one = zr_vf_set(1.0f);
    const zr_vf sign = zr_vf_select(backs, ZR_MUTANT(backs_keep_normals, zr_vf_set(-1.0f), one), one);
    struct zr_eye_values made;
    zr_vf last[3];
    if (of_draw->normals) {
        ZR_KERNEL(zr_eye_normals_at)(of_draw->normals, (const int32_t(*)[ZR_LANES])own.value, &made);
        zr_eye_values_load(&made, c, last);
    } else {
        zr_values_load(normal->values, own.value, c, last);
    }
    for (int k = 0; k < 3; k++)
        c[k] = zr_scale_v(c[k], sign);
}

#endif
