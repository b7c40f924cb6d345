/* floats_simd.h - shade: colours of the samples of a tile as floats, with their opacity; for the kernel that shades.
 *
 * Every part has planes, flat ones such that are the same all over.
 * Exact:  as color_simd.h, before colours become bytes; kept within 0..1.
 */
#ifndef ZR_FLOATS_SIMD_H
#define ZR_FLOATS_SIMD_H

#include "base/inlined.h"
#include "shade/channels/color_simd.h"

/* ---- making ---- */

static void zr_make_float_lines(struct zr_shader *s, const struct zr_run *run)
{
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        static const struct zr_material unlit = {.shading = ZR_SHADING_UNLIT};
        struct zr_plane planes[ZR_FLOAT_PLANES];
        s->is_constant[i] = zr_line_floats(s->geometry, run->surface, s->parts.owners[i] - 1, planes);
        s->materials[i] = &unlit;
        zr_put_alone(s, i, planes, ZR_FLOAT_PLANES, ZR_FLOAT_PLANES);
    }
}

static inline void zr_put_opacity(struct zr_shader *s, const struct zr_run *run, const struct zr_triangle_setup_v *way,
                                  const struct zr_corner_numbers *corners, uint32_t backs, bool flat)
{
    const struct zr_attribute *attributes = run->surface->attributes;
    const zr_vec4 *const of_side[2] = {attributes[ZR_ATTRIBUTE_COLOR].values,
                                       attributes[ZR_ATTRIBUTE_BACK_COLOR].values};
    const zr_vf zero = zr_vf_set(0.0f);
    float values[3][ZR_LANES];
    for (int i = 0; i < ZR_LANES; i++)
        for (int k = 0; k < 3; k++)
            values[k][i] = of_side[backs >> i & 1u][corners->value[k][i]].w;
    const zr_vf v0 = zr_vf_load(values[0]), v1 = zr_vf_load(values[1]), v2 = zr_vf_load(values[2]);
    const struct zr_plane_v plane = flat ? (struct zr_plane_v){v0, zero, zero} : zr_plane1_make(way, v0, v1, v2);
    zr_put_plane(s, run->first, ZR_OPACITY_PLANE, ZR_FLOAT_PLANES, &plane);
}

/* Where they lie in the image of the base colour, of texcoords as the mesh has them. */
static inline void zr_put_places(struct zr_shader *s, const struct zr_run *run, const struct zr_triangle_setup_v *way,
                                 const int32_t (*vertices)[ZR_LANES])
{
    const struct zr_texture_map *map = zr_opacity_map_of(&s->surfaces->textures, run->draw->material);
    const zr_vec4 *texcoords = run->surface->attributes[ZR_ATTRIBUTE_TEXCOORD].values;
    float places[2][3][ZR_LANES];
    if (!map || !texcoords) return;
    texcoords -= run->draw->first_vertex;
    for (int i = 0; i < ZR_LANES; i++)
        for (int k = 0; k < 3; k++) {
            const zr_vec4 given = texcoords[vertices[k][i]];
            const bool second = map->texture->texcoord;
            float place[2];
            zr_texture_transform(map->texture, second ? given.z : given.x, second ? given.w : given.y, place);
            places[0][k][i] = place[0];
            places[1][k][i] = place[1];
        }
    for (int c = 0; c < 2; c++) {
        const struct zr_plane_v plane =
            zr_plane1_make(way, zr_vf_load(places[c][0]), zr_vf_load(places[c][1]), zr_vf_load(places[c][2]));
        zr_put_plane(s, run->first, 1 + ZR_VALUES_FOG + c, ZR_FLOAT_PLANES, &plane);
    }
}

static inline void zr_make_floats(struct zr_shader *s, const struct zr_run *run)
{
    if (zr_draw_is_of_wires(run->draw)) {
        zr_make_float_lines(s, run);
        return;
    }
    const struct zr_draw_attributes *surface = run->surface;
    const enum zr_rate rate = surface->attributes[ZR_ATTRIBUTE_COLOR].rate;
    const bool flat = zr_rate_is_flat(rate);
    const zr_vi numbers = zr_run_numbers(s, run);
    const struct zr_corner_numbers corners = zr_corner_numbers_of(run->draw, rate, numbers);
    const struct zr_triangle_setup_v way = zr_way_of(s->geometry->vertices, corners.vertex);
    const uint32_t backs = surface->sided ? zr_vm_bits(zr_shown_backs(run->draw, numbers, way.turned)) : 0;
    const zr_vf zero = zr_vf_set(0.0f);
    struct zr_vec3_v values[3];
    zr_colors_load(surface, corners.value, backs, values);
    struct zr_planes3_v planes = zr_planes3_make(&way, values);
    if (flat)
        planes = (struct zr_planes3_v){{values[0].x, zero, zero}, {values[0].y, zero, zero}, {values[0].z, zero, zero}};
    zr_put_plane(s, run->first, 0, ZR_FLOAT_PLANES, &way.oow_plane);
    zr_put_three(s, run->first, 1, ZR_FLOAT_PLANES, &planes);
    zr_put_opacity(s, run, &way, &corners, backs, flat);
    memset(s->is_constant + run->first, flat, ZR_LANES);
    for (uint32_t i = run->first; i < run->first + ZR_LANES; i++)
        s->materials[i] = NULL;
    if (!surface->is_per_pixel) return;
    zr_put_late(s, run, &way, corners.vertex, ZR_FLOAT_PLANES);
    if (s->surfaces->texcoords_as_given) zr_put_places(s, run, &way, corners.vertex);
}

/* ---- samples ---- */

struct zr_rgba_v {
    zr_vf of[4];
};

/* Samples of parts that are shaded late take their model's colour; the others keep their own. */
static inline void zr_late_floats(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner,
                                  zr_vf (*planes)[3], zr_vf w, zr_vf x, zr_vf y, struct zr_vec3_v *color,
                                  zr_vf *opacity)
{
    const struct zr_texture_maps *textures = &s->surfaces->textures;
    const zr_vf one = zr_vf_set(1.0f), own = *opacity; /* a material may come again, behind others */
    const struct zr_model_inputs in = {*color, zr_shaded_three(planes, 4, w, x, y),
                                       zr_shaded_three(planes, 7, w, x, y)};
    const struct zr_material *done = NULL;
    for (uint32_t i = first; i < first + count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        zr_vm of_it = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
        for (uint32_t other = i; other < first + count; other++)
            if (s->materials[other] == material)
                of_it = zr_vm_or(of_it, zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[other])));
        struct zr_model_inputs of_material = in;
        const struct zr_texture_map *map = zr_texture_map_of(textures, material, ZR_TEXTURE_BASE_COLOR),
                                    *alpha = zr_opacity_map_of(textures, material);
        if (map && !s->surfaces->texcoords_as_given)
            of_material.color = zr_textured_v(map, material, in.color, planes, x, y);
        if (alpha)
            *opacity = zr_vf_select(
                of_it, own * zr_textured_v(alpha, material, (struct zr_vec3_v){one, one, one}, planes, x, y).x,
                *opacity);
        struct zr_vec3_v late = zr_model_color(&s->model, material, &of_material);
        if (s->surfaces->fog.is_on)
            late = zr_fogged_v(&s->model, late, zr_shaded_value(planes, 1 + ZR_VALUES_LATE, x, y) * w);
        *color = zr_choose_v(of_it, late, *color);
        done = material;
    }
}

static inline zr_vf zr_within_1(zr_vf v)
{
    return zr_vf_min(zr_vf_max(v, zr_vf_set(0.0f)), zr_vf_set(1.0f));
}

static inline struct zr_rgba_v zr_floats_at(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner,
                                            zr_vf x, zr_vf y)
{
    zr_vf planes[ZR_FLOAT_PLANES][3];
    zr_select_planes(s, first, count, owner, ZR_FLOAT_PLANES, planes);
    const zr_vf one = zr_vf_set(1.0f), w = one / zr_shaded_value(planes, 0, x, y);
    zr_vf color_w = w;
    for (uint32_t i = first; i < first + count; i++)
        if (s->is_constant[i])
            color_w = zr_vf_select(zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i])), one, color_w);
    struct zr_vec3_v color = zr_shaded_three(planes, 1, color_w, x, y);
    zr_vf opacity = zr_shaded_value(planes, ZR_OPACITY_PLANE, x, y) * color_w;
    if (s->surfaces->any_late || s->surfaces->textures.of)
        zr_late_floats(s, first, count, owner, planes, w, x, y, &color, &opacity);
    return (struct zr_rgba_v){{zr_within_1(color.x), zr_within_1(color.y), zr_within_1(color.z), zr_within_1(opacity)}};
}

/* ---- blocks ---- */

static inline void zr_float_block(const struct zr_shader *s, const struct zr_tile *tile, int number,
                                  float *const out[4])
{
    const uint32_t part = s->parts.blocks[number].first;
    const zr_vi owner = zr_vi_set((int32_t)s->parts.owners[part]);
    const int32_t left = zr_block_left(number), low = zr_block_low(number);
    if (part == 0) return;
    for (int32_t row = low; row < low + ZR_BLOCK_HEIGHT; row++)
        for (int32_t column = left; column < left + ZR_BLOCK_WIDTH; column += ZR_LANES) {
            const zr_vf x = zr_vf_of(zr_vi_set(tile->x + column) + zr_vi_ramp());
            const struct zr_rgba_v rgba = zr_floats_at(s, part, 1, owner, x, zr_vf_set((float)(tile->y + row)));
            for (int k = 0; k < 4; k++)
                zr_vf_store(out[k] + row * ZR_TILE_STRIDE + column, rgba.of[k]);
        }
}

static inline void zr_float_patches(const struct zr_shader *s, const struct zr_tile *tile, int number,
                                    float *const out[4])
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct zr_patch_place place = zr_patch_place_of(tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p += ZR_PATCH_ROWS) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const zr_vf fy = zr_vf_of(place.row + zr_vi_set(place.low + y));
        zr_vi rows[4][ZR_PATCH_ROWS];
        for (int k = 0; k < ZR_PATCH_ROWS; k++) {
            const uint32_t count = block->patches[p + k];
            const zr_vi owner = zr_vi_load_patch(tile->owner + zr_patch_first(number, p + k), ZR_TILE_STRIDE);
            const zr_vf fx = zr_vf_of(place.column + zr_vi_set(place.left + x + k * ZR_PATCH_COLUMNS));
            struct zr_rgba_v rgba = {{fx, fx, fx, fx}}; /* where nobody is, anything */
            if (count > 0) rgba = zr_floats_at(s, part, count, owner, fx, fy);
            for (int v = 0; v < 4; v++)
                rows[v][k] = zr_vi_bits_of(rgba.of[v]);
            part += count;
        }
        for (int v = 0; v < 4; v++) {
            float *to = out[v] + (place.low - tile->y + y) * ZR_TILE_STRIDE + place.left - tile->x + x;
            zr_vi_rows_of_patches(rows[v]);
            for (int k = 0; k < ZR_PATCH_ROWS; k++)
                zr_vi_store(to + k * ZR_TILE_STRIDE, rows[v][k]);
        }
    }
}

/* Of blocks begin .. end - 1, whose parts have been found. */
static inline void zr_float_blocks(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   float *const out[4])
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (uint32_t i = 0; i < s->run_count; i++)
        zr_make_floats(s, &s->runs[i]);
    for (int b = begin; b < end; b++) {
        if (b % ZR_BLOCK_COLUMNS >= across) continue;
        if (s->parts.blocks[b].is_whole)
            zr_float_block(s, tile, b, out);
        else
            zr_float_patches(s, tile, b, out);
    }
}

#endif
