/* color_simd.h - shade: the channel color. Flat parts have a word; smooth parts and those shaded per pixel have
 * planes. */
#ifndef ZR_COLOR_SIMD_H
#define ZR_COLOR_SIMD_H

#include "scene/channels.h"
#include "shade/blocks_simd.h"
#include "shade/words_simd.h"

/* ---- look-up ---- */

/* Numbers of a run's colours. Flat: one per lane, backs behind all fronts. */
struct zr_color_places {
    struct zr_corner_numbers smooth;
    int32_t flat[ZR_LANES];
};

/* Number of runs between look-up and use: by then, prefetched values have arrived. */
enum { ZR_RUNS_AHEAD = 8 };

static inline bool zr_draw_run_has_planes(const struct zr_draw_run *run)
{
    return zr_draw_is_smooth(run->of_draw) || run->of_draw->is_per_pixel;
}

static inline void zr_look_up_smooth(const struct zr_shader *s, const struct zr_draw_run *run,
                                     struct zr_corner_numbers *out)
{
    const struct zr_attribute *color = &run->of_draw->attributes[ZR_ATTRIBUTE_COLOR],
                              *back = &run->of_draw->attributes[ZR_ATTRIBUTE_BACK_COLOR];
    *out = zr_corner_numbers_of(run->draw, color->rate, zr_draw_run_numbers(s, run));
    for (int i = 0; i < ZR_LANES; i++)
        for (int k = 0; k < 3; k++) {
            __builtin_prefetch(&s->geometry->vertices[out->vertex[k][i]]);
            __builtin_prefetch(&color->values[out->value[k][i]]);
            if (run->of_draw->two_sided_colors) __builtin_prefetch(&back->values[out->value[k][i]]);
        }
}

static inline void zr_look_up_colors(const struct zr_shader *s, const struct zr_draw_run *run,
                                     struct zr_color_places *out)
{
    const struct zr_draw_attributes *of_draw = run->of_draw;
    if (zr_draw_is_of_wires(run->draw)) return;
    if (zr_draw_run_has_planes(run)) {
        zr_look_up_smooth(s, run, &out->smooth);
        return;
    }
    zr_vi_store(out->flat, zr_sided_number(s->geometry, of_draw, zr_draw_run_numbers(s, run)));
    for (int i = 0; i < ZR_LANES; i++)
        __builtin_prefetch(of_draw->packed ? (const void *)&of_draw->packed[out->flat[i]]
                                           : (const void *)zr_flat_at(of_draw, out->flat[i]));
}

/* ---- making ---- */

static inline void zr_make_lines(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask)
{
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        const uint32_t number = s->parts.owners[i] - 1;
        const bool is_per_pixel = mask & ZR_VARY_PER_PIXEL && s->materials[i];
        s->has_planes[i] = is_per_pixel || !zr_line_color(s->geometry, run->of_draw, number, &s->words[i]);
        s->any_planes |= s->has_planes[i];
        if (s->has_planes[i]) zr_put_line(s, run, mask, i);
    }
}

ZR_INLINED void zr_make_smooth(struct zr_shader *s, const struct zr_draw_run *run,
                               const struct zr_corner_numbers *corners, unsigned mask)
{
    zr_put_triangles(s, run, mask, corners, run->of_draw->is_per_pixel);
    memset(s->has_planes + run->first, true, ZR_LANES);
    s->any_planes = true;
}

ZR_INLINED void zr_make_colors(struct zr_shader *s, const struct zr_draw_run *run, const struct zr_color_places *places,
                               unsigned mask)
{
    if (mask & ZR_VARY_PER_PIXEL) zr_put_material(s, run, run->of_draw->is_per_pixel);
    if (zr_mixes_constants(mask)) memset(s->is_constant + run->first, false, ZR_LANES);
    if (zr_draw_is_of_wires(run->draw))
        zr_make_lines(s, run, mask);
    else if (zr_draw_run_has_planes(run))
        zr_make_smooth(s, run, &places->smooth, mask);
    else
        zr_put_words(s, run, zr_flat_look_up(run->of_draw, zr_vi_load(places->flat)));
}

/* ---- the channel ---- */

enum {
    ZR_COLOR_VARYINGS = ZR_VARY_COLOR,
    ZR_COLOR_PER_PIXEL_VARYINGS = ZR_VARY_COLOR | ZR_VARY_NORMAL | ZR_VARY_POINT | ZR_VARY_PER_PIXEL,
    ZR_COLOR_FOG_VARYINGS = ZR_COLOR_PER_PIXEL_VARYINGS | ZR_VARY_DEPTH,
    ZR_COLOR_TEXTURED_VARYINGS = ZR_COLOR_FOG_VARYINGS | ZR_VARY_PLACE
};

/* Inlined for each set: a constant set keeps planes in registers. */
ZR_INLINED void zr_shade_colors_by(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_tile_targets *to, unsigned mask)
{
    struct zr_color_places places[ZR_RUNS_AHEAD];
    for (uint32_t i = 0; i < s->run_count + ZR_RUNS_AHEAD; i++) {
        struct zr_color_places *of_run = &places[i % ZR_RUNS_AHEAD];
        if (i >= ZR_RUNS_AHEAD) zr_make_colors(s, &s->runs[i - ZR_RUNS_AHEAD], of_run, mask);
        zr_prefetch_run(s, i);
        if (i < s->run_count) zr_look_up_colors(s, &s->runs[i], of_run);
    }
    const struct zr_store finish = {tile, tile->has_early_color, to->behind.first ? &to->behind : NULL,
                                    &to->channels[ZR_CHANNEL_COLOR]};
    zr_store_blocks(s, &finish, begin, end, mask);
}

static inline void zr_shade_colors(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_tile_targets *to)
{
    s->words[0] = to->clear_value;
    s->materials[0] = NULL;
    s->is_constant[0] = s->has_planes[0] = s->any_planes = s->any_per_pixel = false;
    if (s->attributes->any_textured)
        ZR_KERNEL(zr_paint_textured)(s, tile, begin, end, to);
    else if (s->attributes->fog.is_on)
        zr_shade_colors_by(s, tile, begin, end, to, ZR_COLOR_FOG_VARYINGS);
    else if (s->attributes->any_per_pixel)
        zr_shade_colors_by(s, tile, begin, end, to, ZR_COLOR_PER_PIXEL_VARYINGS);
    else
        zr_shade_colors_by(s, tile, begin, end, to, ZR_COLOR_VARYINGS);
}

#endif
