/* color_simd.h - shade: the channel color. Flat parts have a word, smooth ones planes of their colours, and those that
 * are shaded late also of normals and points.
 */
#ifndef ZR_COLOR_SIMD_H
#define ZR_COLOR_SIMD_H

#include "shade/blocks_simd.h"
#include "shade/words_simd.h"

/* ---- looking up ---- */

static inline void zr_expect_smooth(const struct zr_batch *batch, const struct zr_window_vertex *vertices,
                                    zr_vi numbers)
{
    const struct zr_sides sides = zr_sides_of(batch);
    const struct zr_corner_numbers corners = zr_corner_numbers_of(batch, batch->colors, numbers);
    for (int i = 0; i < ZR_LANES; i++)
        for (int k = 0; k < 3; k++) {
            __builtin_prefetch(&vertices[corners.vertex[k][i]]);
            __builtin_prefetch(&sides.front[corners.value[k][i]]);
            if (sides.back != sides.front) __builtin_prefetch(&sides.back[corners.value[k][i]]);
        }
}

/* Where they stand is found, and asked for: by the time that it is looked at, it has come from memory. */
static inline void zr_expect_colors(struct zr_shader *s, const struct zr_run *run)
{
    if (!run->batch || !zr_batch_is_gathered(run->batch)) return;
    const zr_vi numbers = zr_run_numbers(s, run);
    if (zr_batch_is_smooth(run->batch)) {
        zr_expect_smooth(run->batch, s->geometry->vertices, numbers);
        return;
    }
    int32_t places[ZR_LANES];
    zr_vi_store(places, zr_flat_number(run->batch, ZR_ALL_LANES, numbers));
    for (int i = 0; i < ZR_LANES; i++)
        __builtin_prefetch(run->batch->packed ? (const void *)&run->batch->packed[places[i]]
                                              : (const void *)zr_flat_at(run->batch, places[i]));
}

/* ---- making ---- */

/* One by itself: one that is written out, which may be a line, or of a batch with more than 32 bits can number. */
static void zr_make_alone(struct zr_shader *s, uint32_t i, const struct zr_batch *batch, int count)
{
    const struct zr_surface surface = zr_surface_make(s->geometry, batch, s->parts.owners[i] - 1);
    s->words[i] = surface.color;
    s->has_planes[i] = false;
    s->materials[i] = surface.material;
    s->any_late |= surface.material != NULL;
    if (!surface.flat) zr_put_surface(s, i, &surface, count);
}

/* Of triangles whose normals and points are wanted beside their colours. */
static inline void zr_put_late(struct zr_shader *s, const struct zr_run *run, const struct zr_way_v *way,
                               const int32_t (*vertices)[ZR_LANES], int count)
{
    struct zr_vec3_v values[3];
    zr_normals_load(run->batch, zr_run_numbers(s, run), way->turned, values);
    const struct zr_planes3_v normals = zr_planes3_make(way, values);
    zr_values_load(s->geometry->points, vertices, values);
    const struct zr_planes3_v points = zr_planes3_make(way, values);
    zr_put_three(s, run->first, 4, count, &normals);
    zr_put_three(s, run->first, 7, count, &points);
    for (uint32_t i = run->first; i < run->first + ZR_LANES; i++)
        s->materials[i] = run->batch->material;
    s->any_late = true;
}

static inline void zr_put_smooth(struct zr_shader *s, const struct zr_run *run, int count)
{
    const struct zr_batch *batch = run->batch;
    const struct zr_corner_numbers corners = zr_corner_numbers_of(batch, batch->colors, zr_run_numbers(s, run));
    const struct zr_way_v way = zr_way_of(s->geometry->vertices, corners.vertex);
    struct zr_vec3_v values[3];
    zr_colors_load(zr_sides_of(batch), corners.value, way.turned, values);
    const struct zr_planes3_v planes = zr_planes3_make(&way, values);
    zr_put_plane(s, run->first, 0, count, &way.oow_plane);
    zr_put_three(s, run->first, 1, count, &planes);
    memset(s->has_planes + run->first, true, ZR_LANES);
    s->any_planes = true;
    if (count > 1 + ZR_VALUES_FEW && zr_material_is_shaded_late(batch->material))
        zr_put_late(s, run, &way, corners.vertex, count);
}

static inline void zr_make_colors(struct zr_shader *s, const struct zr_run *run, int count)
{
    const struct zr_batch *batch = run->batch;
    const uint32_t first = run->first;
    if (count > 1 + ZR_VALUES_FEW)
        for (uint32_t i = first; i < first + ZR_LANES; i++)
            s->materials[i] = NULL;
    if (!batch) {
        zr_put_words(s, run, zr_vi_set((int32_t)s->nothing));
    } else if (!zr_batch_is_gathered(batch)) {
        for (uint32_t i = first; i < first + run->count; i++)
            zr_make_alone(s, i, batch, count);
    } else if (zr_batch_is_smooth(batch)) {
        zr_put_smooth(s, run, count);
    } else {
        const zr_vi numbers = zr_flat_number(batch, ZR_ALL_LANES, zr_run_numbers(s, run));
        zr_put_words(s, run, zr_flat_look_up(batch, numbers));
    }
}

/* ---- the channel ---- */

static inline void zr_shade_colors_by(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                      const struct zr_shaded *to, int plane_count)
{
    for (uint32_t i = 0; i < s->run_count; i++)
        zr_expect_colors(s, &s->runs[i]);
    for (uint32_t i = 0; i < s->run_count; i++)
        zr_make_colors(s, &s->runs[i], plane_count);
    zr_finish_blocks(s, tile, begin, end, tile->has_colors, plane_count, to->behind.first ? &to->behind : NULL,
                     &to->colors);
}

/* How many planes there are is known when this is compiled: else they would not stay in registers. */
static inline void zr_shade_colors(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_shaded *to)
{
    s->nothing = to->nothing;
    s->any_planes = s->any_late = false;
    if (to->is_shaded_late)
        zr_shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_MOST);
    else
        zr_shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_FEW);
}

#endif
