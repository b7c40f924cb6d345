/* gbuffer_simd.h - shade: what is seen at the samples of a tile, as a G-buffer (gbuffer.h), for the kernel that shades.
 *
 * Every part has planes: of 1/w, of its own colour, its normal and its point. Those of what is flat are 1/w's, times
 * it.
 */
#ifndef ZR_GBUFFER_SIMD_H
#define ZR_GBUFFER_SIMD_H

#include "base/inlined.h"
#include "shade/blocks_simd.h"
#include "shade/gbuffer.h"

enum { ZR_SAMPLE_PLANES = 1 + ZR_VALUES_LATE };

/* ---- making ---- */

static void zr_make_sample_lines(struct zr_shader *s, const struct zr_run *run)
{
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        struct zr_plane planes[ZR_SAMPLE_PLANES];
        zr_line_sample(s->geometry, run->surface, s->parts.owners[i] - 1, planes);
        zr_put_alone(s, i, planes, ZR_SAMPLE_PLANES, ZR_SAMPLE_PLANES);
    }
}

/* Three values, from plane k on. */
static inline void zr_put_values(struct zr_shader *s, const struct zr_run *run, int k,
                                 const struct zr_triangle_setup_v *way, const struct zr_vec3_v values[3], bool flat)
{
    const zr_vf each[3] = {values[0].x, values[0].y, values[0].z};
    if (!flat) {
        const struct zr_planes3_v planes = zr_planes3_make(way, values);
        zr_put_three(s, run->first, k, ZR_SAMPLE_PLANES, &planes);
        return;
    }
    for (int i = 0; i < 3; i++) {
        const struct zr_plane_v oow = way->oow_plane,
                                plane = {oow.a0 * each[i], oow.dadx * each[i], oow.dady * each[i]};
        zr_put_plane(s, run->first, k + i, ZR_SAMPLE_PLANES, &plane);
    }
}

static inline void zr_make_samples(struct zr_shader *s, const struct zr_run *run, bool with_base)
{
    if (zr_draw_is_of_wires(run->draw)) {
        zr_make_sample_lines(s, run);
        return;
    }
    const struct zr_draw_attributes *surface = run->surface;
    const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR],
                              *normal = &surface->attributes[ZR_ATTRIBUTE_NORMAL];
    const zr_vec4 *points = surface->attributes[ZR_ATTRIBUTE_POINT].values - run->draw->first_vertex;
    const zr_vi numbers = zr_run_numbers(s, run);
    const struct zr_corner_numbers corners = zr_corner_numbers_of(run->draw, color->rate, numbers);
    const struct zr_triangle_setup_v way = zr_way_of(s->geometry->vertices, corners.vertex);
    struct zr_vec3_v values[3];
    zr_put_plane(s, run->first, 0, ZR_SAMPLE_PLANES, &way.oow_plane);
    if (with_base && color->rate == ZR_RATE_DRAW) {
        values[0] = zr_spread_v((zr_vec3){color->values->x, color->values->y, color->values->z});
        zr_put_values(s, run, 1, &way, values, true);
    } else if (with_base) {
        zr_values_load(color->values, corners.value, values);
        zr_put_values(s, run, 1, &way, values, zr_rate_is_flat(color->rate));
    }
    zr_normals_load(surface, numbers, way.turned, values);
    zr_put_values(s, run, 4, &way, values, zr_rate_is_flat(normal->rate));
    zr_values_load(points, corners.vertex, values);
    zr_put_values(s, run, 7, &way, values, false);
}

/* ---- samples ---- */

/* Nine values of ZR_LANES samples, in the order of the planes. */
struct zr_sample_v {
    zr_vf value[ZR_VALUES_LATE];
};

static inline struct zr_sample_v zr_no_sample(void)
{
    struct zr_sample_v out;
    for (int k = 0; k < ZR_VALUES_LATE; k++)
        out.value[k] = zr_vf_set(k < 6 ? 0.0f : ZR_FAR_POINT);
    return out;
}

ZR_INLINED struct zr_sample_v zr_sample_of(zr_vf (*planes)[3], zr_vm seen, zr_vf x, zr_vf y, int first)
{
    const zr_vf w = zr_vf_set(1.0f) / zr_shaded_value(planes, 0, x, y);
    const struct zr_vec3_v normal = zr_normalize_v(zr_shaded_three(planes, 4, w, x, y));
    struct zr_sample_v out = zr_no_sample();
    for (int k = first; k < ZR_VALUES_LATE; k++)
        out.value[k] = zr_vf_select(seen, zr_shaded_value(planes, 1 + k, x, y) * w, out.value[k]);
    out.value[3] = zr_vf_select(seen, normal.x, out.value[3]);
    out.value[4] = zr_vf_select(seen, normal.y, out.value[4]);
    out.value[5] = zr_vf_select(seen, normal.z, out.value[5]);
    return out;
}

/* The rows of a G-buffer, in the order of the planes. */
struct zr_sample_rows {
    float *of[ZR_VALUES_LATE];
    ptrdiff_t stride;
};

static inline struct zr_sample_rows zr_sample_rows_of(const struct zr_gbuffer *to)
{
    return (struct zr_sample_rows){{to->base[0], to->base[1], to->base[2], to->normal[0], to->normal[1], to->normal[2],
                                    to->point[0], to->point[1], to->point[2]},
                                   to->stride};
}

ZR_INLINED void zr_put_samples(const struct zr_sample_rows *to, ptrdiff_t at, const struct zr_sample_v *sample,
                               int first)
{
    for (int k = first; k < ZR_VALUES_LATE; k++)
        zr_vf_store(to->of[k] + at, sample->value[k]);
}

/* ---- blocks ---- */

ZR_INLINED void zr_sample_whole_block(const struct zr_shader *s, const struct zr_tile *tile, int number,
                                      const struct zr_sample_rows *to, int first)
{
    const uint32_t part = s->parts.blocks[number].first;
    const zr_vi owner = zr_vi_set((int32_t)s->parts.owners[part]);
    const int32_t left = zr_block_left(number), low = zr_block_low(number);
    const struct zr_sample_v none = zr_no_sample();
    zr_vf planes[ZR_SAMPLE_PLANES][3];
    if (part > 0) zr_select_planes(s, part, 1, owner, ZR_SAMPLE_PLANES, planes);
    for (int32_t row = 0; row < ZR_BLOCK_HEIGHT; row++)
        for (int32_t column = 0; column < ZR_BLOCK_WIDTH; column += ZR_LANES) {
            const zr_vf x = zr_vf_of(zr_vi_set(tile->x + left + column) + zr_vi_ramp());
            const zr_vf y = zr_vf_set((float)(tile->y + low + row));
            const ptrdiff_t at = (low + row) * to->stride + left + column;
            const struct zr_sample_v sample = part > 0 ? zr_sample_of(planes, ZR_ALL_LANES, x, y, first) : none;
            zr_put_samples(to, at, &sample, first);
        }
}

/* Patches side by side, as many as make whole rows of ZR_LANES. */
ZR_INLINED void zr_sample_patches(const struct zr_shader *s, const struct zr_tile *tile, int number,
                                  const struct zr_sample_rows *to, int first)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct zr_patch_place place = zr_patch_place_of(tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p += ZR_PATCH_ROWS) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const zr_vf fy = zr_vf_of(place.row + zr_vi_set(place.low + y));
        zr_vi rows[ZR_VALUES_LATE][ZR_PATCH_ROWS];
        for (int k = 0; k < ZR_PATCH_ROWS; k++) {
            const uint32_t count = block->patches[p + k];
            const zr_vi owner = zr_vi_load_patch(tile->owner + zr_patch_first(number, p + k), ZR_TILE_STRIDE);
            const zr_vf fx = zr_vf_of(place.column + zr_vi_set(place.left + x + k * ZR_PATCH_COLUMNS));
            struct zr_sample_v sample = zr_no_sample();
            if (count > 0) {
                zr_vf planes[ZR_SAMPLE_PLANES][3];
                zr_select_planes(s, part, count, owner, ZR_SAMPLE_PLANES, planes);
                sample = zr_sample_of(planes, zr_vi_lt(zr_vi_set(0), owner), fx, fy, first);
            }
            for (int v = first; v < ZR_VALUES_LATE; v++)
                rows[v][k] = zr_vi_bits_of(sample.value[v]);
            part += count;
        }
        for (int v = first; v < ZR_VALUES_LATE; v++) {
            zr_vi_rows_of_patches(rows[v]);
            float *out = to->of[v] + (place.low - tile->y + y) * to->stride + place.left - tile->x + x;
            for (int k = 0; k < ZR_PATCH_ROWS; k++)
                zr_vi_store(out + k * to->stride, rows[v][k]);
        }
    }
}

/* `first`: 0, or 3: without the surfaces' own colours. Known when this is compiled. */
ZR_INLINED void zr_sample_blocks_by(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                    const struct zr_sample_rows *to, int first)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (uint32_t i = 0; i < s->run_count; i++)
        zr_make_samples(s, &s->runs[i], first == 0);
    for (int b = begin; b < end; b++) {
        if (b % ZR_BLOCK_COLUMNS >= across) continue;
        if (s->parts.blocks[b].is_whole)
            zr_sample_whole_block(s, tile, b, to, first);
        else
            zr_sample_patches(s, tile, b, to, first);
    }
}

static inline void zr_sample_blocks(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                    const struct zr_gbuffer *to)
{
    const struct zr_sample_rows rows = zr_sample_rows_of(to);
    if (to->base[0])
        zr_sample_blocks_by(s, tile, begin, end, &rows, 0);
    else
        zr_sample_blocks_by(s, tile, begin, end, &rows, 3);
}

static inline zr_vi zr_material_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface,
                                      zr_vi numbers)
{
    (void)geometry;
    (void)numbers;
    return zr_vi_set((int32_t)surface->material);
}

#endif
