/* color_simd.h - shade: the channel color. Flat parts have a word, smooth ones planes of their colours, and those that
 * are shaded late also of normals and points.
 */
#ifndef ZR_COLOR_SIMD_H
#define ZR_COLOR_SIMD_H

#include "shade/blocks_simd.h"
#include "shade/words_simd.h"

/* ---- looking up ---- */

/* Where the colours of a run stand: of flat ones, each one's, backs behind all fronts. */
struct zr_color_places {
    struct zr_corner_numbers smooth;
    int32_t flat[ZR_LANES];
};

/* So many runs are looked up before the first of them is made: by then it has come from memory. */
enum { ZR_RUNS_AHEAD = 8 };

static inline bool zr_run_has_planes(const struct zr_run *run)
{
    return zr_draw_is_smooth(run->surface) || run->surface->is_per_pixel;
}

static inline void zr_look_up_smooth(const struct zr_shader *s, const struct zr_run *run, struct zr_corner_numbers *out)
{
    const struct zr_attribute *color = &run->surface->attributes[ZR_ATTRIBUTE_COLOR],
                              *back = &run->surface->attributes[ZR_ATTRIBUTE_BACK_COLOR];
    *out = zr_corner_numbers_of(run->draw, color->rate, zr_run_numbers(s, run));
    for (int i = 0; i < ZR_LANES; i++)
        for (int k = 0; k < 3; k++) {
            __builtin_prefetch(&s->geometry->vertices[out->vertex[k][i]]);
            __builtin_prefetch(&color->values[out->value[k][i]]);
            if (run->surface->sided) __builtin_prefetch(&back->values[out->value[k][i]]);
        }
}

static inline void zr_look_up_colors(const struct zr_shader *s, const struct zr_run *run, struct zr_color_places *out)
{
    const struct zr_draw_attributes *surface = run->surface;
    if (zr_draw_is_of_wires(run->draw)) return;
    if (zr_run_has_planes(run)) {
        zr_look_up_smooth(s, run, &out->smooth);
        return;
    }
    zr_vi_store(out->flat, zr_sided_number(s->geometry, surface, zr_run_numbers(s, run)));
    for (int i = 0; i < ZR_LANES; i++)
        __builtin_prefetch(surface->packed ? (const void *)&surface->packed[out->flat[i]]
                                           : (const void *)zr_flat_at(surface, out->flat[i]));
}

/* ---- making ---- */

static void zr_make_lines(struct zr_shader *s, const struct zr_run *run, int count)
{
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        static const struct zr_material unlit = {.shading = ZR_SHADING_UNLIT};
        struct zr_plane planes[1 + ZR_VALUES_MOST];
        const bool is_per_pixel = count > 1 + ZR_VALUES_LATE;
        const bool flat =
            zr_line_color(s->geometry, run->surface, s->parts.owners[i] - 1, is_per_pixel, planes, &s->words[i]);
        s->has_planes[i] = false;
        if (!flat || is_per_pixel) zr_put_alone(s, i, planes, 1 + ZR_VALUES_MOST, count);
        if (!is_per_pixel) continue;
        s->is_constant[i] = flat;
        s->materials[i] = &unlit;
        s->any_late = true;
    }
}

/* Where they lie in a texture; 0 where they have none. */
static inline void zr_put_texcoords(struct zr_shader *s, const struct zr_run *run,
                                    const struct zr_triangle_setup_v *way, const int32_t (*vertices)[ZR_LANES],
                                    int count)
{
    const zr_vec4 *texcoords = run->surface->attributes[ZR_ATTRIBUTE_TEXCOORD].values;
    const struct zr_plane_v none = {zr_vf_set(0.0f), zr_vf_set(0.0f), zr_vf_set(0.0f)};
    struct zr_planes3_v planes = {none, none, none};
    if (texcoords) {
        struct zr_vec3_v values[3];
        zr_values_load(texcoords - run->draw->first_vertex, vertices, values);
        planes = zr_planes3_make(way, values);
    }
    zr_put_plane(s, run->first, 1 + ZR_VALUES_FOG, count, &planes.x);
    zr_put_plane(s, run->first, 2 + ZR_VALUES_FOG, count, &planes.y);
}

/* Of triangles whose normals and points are wanted beside their colours. */
static inline void zr_put_late(struct zr_shader *s, const struct zr_run *run, const struct zr_triangle_setup_v *way,
                               const int32_t (*vertices)[ZR_LANES], int count)
{
    const zr_vec4 *points = run->surface->attributes[ZR_ATTRIBUTE_POINT].values - run->draw->first_vertex;
    const struct zr_plane_v none = {zr_vf_set(0.0f), zr_vf_set(0.0f), zr_vf_set(0.0f)};
    struct zr_planes3_v planes = {none, none, none};
    struct zr_vec3_v values[3];
    if (run->surface->attributes[ZR_ATTRIBUTE_NORMAL].values) {
        zr_normals_load(run->surface, zr_run_numbers(s, run), way->turned, values);
        planes = zr_planes3_make(way, values);
    }
    zr_put_three(s, run->first, 4, count, &planes);
    zr_values_load(points, vertices, values);
    planes = zr_planes3_make(way, values);
    zr_put_three(s, run->first, 7, count, &planes);
    if (count > 1 + ZR_VALUES_LATE) {
        float depths[3][ZR_LANES];
        for (int i = 0; i < ZR_LANES; i++)
            for (int k = 0; k < 3; k++)
                depths[k][i] = points[vertices[k][i]].w;
        const struct zr_plane_v depth =
            zr_plane1_make(way, zr_vf_load(depths[0]), zr_vf_load(depths[1]), zr_vf_load(depths[2]));
        zr_put_plane(s, run->first, 1 + ZR_VALUES_LATE, count, &depth);
    }
    if (ZR_WITH_TEXTURES && count > 1 + ZR_VALUES_FOG) zr_put_texcoords(s, run, way, vertices, count);
    for (uint32_t i = run->first; i < run->first + ZR_LANES; i++)
        s->materials[i] = run->draw->material;
    s->any_late = true;
}

static inline void zr_put_smooth(struct zr_shader *s, const struct zr_run *run, const struct zr_corner_numbers *corners,
                                 int count)
{
    const struct zr_draw_attributes *surface = run->surface;
    const enum zr_rate rate = surface->attributes[ZR_ATTRIBUTE_COLOR].rate;
    const zr_vi numbers = zr_run_numbers(s, run);
    const struct zr_triangle_setup_v way = zr_way_of(s->geometry->vertices, corners->vertex);
    const uint32_t backs = surface->sided ? zr_vm_bits(zr_shown_backs(run->draw, numbers, way.turned)) : 0;
    struct zr_vec3_v values[3];
    zr_colors_load(surface, corners->value, backs, values);
    struct zr_planes3_v planes = zr_planes3_make(&way, values);
    if (zr_rate_is_flat(rate)) {
        const zr_vf zero = zr_vf_set(0.0f);
        planes = (struct zr_planes3_v){{values[0].x, zero, zero}, {values[0].y, zero, zero}, {values[0].z, zero, zero}};
    }
    if (count > 1 + ZR_VALUES_LATE) memset(s->is_constant + run->first, zr_rate_is_flat(rate), ZR_LANES);
    zr_put_plane(s, run->first, 0, count, &way.oow_plane);
    zr_put_three(s, run->first, 1, count, &planes);
    memset(s->has_planes + run->first, true, ZR_LANES);
    s->any_planes = true;
    if (count > 1 + ZR_VALUES_FEW && surface->is_per_pixel) zr_put_late(s, run, &way, corners->vertex, count);
}

static inline void zr_make_colors(struct zr_shader *s, const struct zr_run *run, const struct zr_color_places *places,
                                  int count)
{
    const uint32_t first = run->first;
    if (count > 1 + ZR_VALUES_FEW)
        for (uint32_t i = first; i < first + ZR_LANES; i++)
            s->materials[i] = NULL;
    if (count > 1 + ZR_VALUES_LATE) memset(s->is_constant + first, false, ZR_LANES);
    if (zr_draw_is_of_wires(run->draw)) {
        zr_make_lines(s, run, count);
    } else if (zr_run_has_planes(run)) {
        zr_put_smooth(s, run, &places->smooth, count);
    } else {
        zr_put_words(s, run, zr_flat_look_up(run->surface, zr_vi_load(places->flat)));
    }
}

/* ---- the channel ---- */

static inline void zr_shade_colors_by(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                      const struct zr_tile_targets *to, int plane_count)
{
    struct zr_color_places places[ZR_RUNS_AHEAD];
    for (uint32_t i = 0; i < s->run_count + ZR_RUNS_AHEAD; i++) {
        struct zr_color_places *of_run = &places[i % ZR_RUNS_AHEAD];
        if (i >= ZR_RUNS_AHEAD) zr_make_colors(s, &s->runs[i - ZR_RUNS_AHEAD], of_run, plane_count);
        if (i < s->run_count) zr_look_up_colors(s, &s->runs[i], of_run);
    }
    const struct zr_store finish = {tile, tile->has_words, to->behind.first ? &to->behind : NULL,
                                    &to->channels[ZR_CHANNEL_COLOR]};
    zr_store_blocks(s, &finish, begin, end, plane_count);
}

/* How many planes there are is known when this is compiled: else they would not stay in registers. */
static inline void zr_shade_colors(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_tile_targets *to)
{
    s->words[0] = to->nothing;
    s->materials[0] = NULL;
    s->is_constant[0] = s->has_planes[0] = s->any_planes = s->any_late = false;
    if (s->surfaces->any_textured)
        ZR_KERNEL(zr_paint_textured)(s, tile, begin, end, to);
    else if (s->surfaces->fog.is_on)
        zr_shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_FOG);
    else if (s->surfaces->any_late)
        zr_shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_LATE);
    else
        zr_shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_FEW);
}

#endif
