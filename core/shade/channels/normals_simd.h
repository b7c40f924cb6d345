/* normals_simd.h - shade: the channel normals: three floats a pixel, unit length, of the side that is seen. */
#ifndef ZR_CHANNEL_NORMALS_SIMD_H
#define ZR_CHANNEL_NORMALS_SIMD_H

#include "shade/blocks_simd.h"

/* ---- making ---- */

enum { ZR_NORMAL_PLANES = 1 + ZR_VALUES_FEW };

/* Of nobody, and of lines. */
static inline void zr_put_no_normal(struct zr_shader *s, uint32_t part)
{
    static const struct zr_plane one = {1, 0, 0};
    zr_put_alone(s, part, &one, 1, ZR_NORMAL_PLANES);
}

/* Flat ones have planes that are the same all over, over a w of 1. */
static inline void zr_make_normals(struct zr_shader *s, const struct zr_run *run)
{
    const uint32_t first = run->first;
    if (zr_draw_is_of_wires(run->draw)) {
        for (uint32_t i = first; i < first + run->count; i++)
            zr_put_no_normal(s, i);
        return;
    }
    const struct zr_attribute *normal = &run->surface->attributes[ZR_ATTRIBUTE_NORMAL];
    const zr_vi numbers = zr_run_numbers(s, run);
    const struct zr_corner_numbers corners = zr_corner_numbers_of(run->draw, normal->rate, numbers);
    const struct zr_triangle_setup_v way = zr_way_of(s->geometry->vertices, corners.vertex);
    struct zr_vec3_v values[3];
    zr_normals_load(run->surface, numbers, way.turned, values);
    struct zr_plane_v oow = way.oow_plane;
    struct zr_planes3_v planes;
    if (zr_rate_is_flat(normal->rate)) {
        const zr_vf zero = zr_vf_set(0.0f);
        oow = (struct zr_plane_v){zr_vf_set(1.0f), zero, zero};
        planes = (struct zr_planes3_v){{values[0].x, zero, zero}, {values[0].y, zero, zero}, {values[0].z, zero, zero}};
    } else {
        planes = zr_planes3_make(&way, values);
    }
    zr_put_plane(s, first, 0, ZR_NORMAL_PLANES, &oow);
    zr_put_three(s, first, 1, ZR_NORMAL_PLANES, &planes);
    memset(s->has_planes + first, true, ZR_LANES);
}

/* ---- pixels ---- */

/* To three floats a pixel, one after the other; lanes that are nobody's are left out. */
static inline void zr_put_normals(struct zr_vec3_v n, uint32_t lanes, const struct zr_pixel_rows *rows, const float *x,
                                  const float *y, int32_t tile_x, int32_t tile_y)
{
    float each[3][ZR_LANES];
    zr_vf_store(each[0], n.x);
    zr_vf_store(each[1], n.y);
    zr_vf_store(each[2], n.z);
    for (; lanes; lanes &= lanes - 1) {
        const int i = zr_lowest_bit(lanes);
        float *out = (float *)rows->first + ((int32_t)y[i] - tile_y) * rows->stride + 3 * ((int32_t)x[i] - tile_x);
        for (int k = 0; k < 3; k++)
            out[k] = each[k][i];
    }
}

static inline struct zr_vec3_v zr_normals_at(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner,
                                             const struct zr_tile_targets *to, zr_vf x, zr_vf y)
{
    zr_vf planes[ZR_NORMAL_PLANES][3];
    zr_select_planes(s, first, count, owner, ZR_NORMAL_PLANES, planes);
    const zr_vf w = zr_vf_set(1.0f) / zr_shaded_value(planes, 0, x, y);
    const struct zr_vec3_v n = zr_normalize_v(zr_shaded_three(planes, 1, w, x, y));
    const float(*m)[3] = to->normals_to_space;
    return zr_normalize_v((struct zr_vec3_v){zr_dot_v(zr_spread_v((zr_vec3){m[0][0], m[0][1], m[0][2]}), n),
                                             zr_dot_v(zr_spread_v((zr_vec3){m[1][0], m[1][1], m[1][2]}), n),
                                             zr_dot_v(zr_spread_v((zr_vec3){m[2][0], m[2][1], m[2][2]}), n)});
}

static inline void zr_shade_normals_of_block(const struct zr_shader *s, const struct zr_tile *tile, int number,
                                             const struct zr_tile_targets *to)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct zr_patch_place place = zr_patch_place_of(tile, number);
    const zr_vi width = zr_vi_set(tile->x + tile->width), height = zr_vi_set(tile->y + tile->height);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const uint32_t count = block->is_whole ? 1 : block->patches[p];
        const zr_vi owner = block->is_whole ? zr_vi_set((int32_t)s->parts.owners[part])
                                            : zr_vi_load_patch(tile->owner + zr_patch_first(number, p), ZR_TILE_STRIDE);
        const zr_vi column = place.column + zr_vi_set(place.left + x), row = place.row + zr_vi_set(place.low + y);
        const zr_vm within = zr_vm_and(zr_vi_lt(column, width), zr_vi_lt(row, height));
        const zr_vf fx = zr_vf_of(column), fy = zr_vf_of(row), zero = zr_vf_set(0.0f);
        struct zr_vec3_v n = {zero, zero, zero};
        float xs[ZR_LANES], ys[ZR_LANES];
        if (count > 0)
            n = zr_choose_v(zr_vi_lt(zr_vi_set(0), owner), zr_normals_at(s, part, count, owner, to, fx, fy), n);
        zr_vf_store(xs, fx);
        zr_vf_store(ys, fy);
        zr_put_normals(n, zr_vm_bits(within), &to->channels[ZR_CHANNEL_NORMALS], xs, ys, tile->x, tile->y);
        if (!block->is_whole) part += count;
    }
}

static inline void zr_shade_normals(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                    const struct zr_tile_targets *to)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    zr_put_no_normal(s, 0);
    for (uint32_t i = 0; i < s->run_count; i++)
        zr_make_normals(s, &s->runs[i]);
    for (int b = begin; b < end; b++)
        if (b % ZR_BLOCK_COLUMNS < across) zr_shade_normals_of_block(s, tile, b, to);
}

#endif
