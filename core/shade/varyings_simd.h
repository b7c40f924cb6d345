/* varyings_simd.h - shade: interpolates values over the samples of a tile, for the kernel that shades.
 *
 * Every part gets the planes of a set of groups (varyings.h). Then, ZR_LANES samples at a time, a maker computes its
 * results from the planes, and the walk stores them in rows. Sets and makers are compile-time constants and everything
 * is inlined, so that planes stay in registers.
 * Exact:  the reference's rules 8 (planes) and 9 (values over w).
 */
#ifndef ZR_VARYINGS_SIMD_H
#define ZR_VARYINGS_SIMD_H

#include "shade/cloud_values.h"
#include "shade/tangents_simd.h"

/* ---- planes ---- */

/* Makes plane k of a run, from one value per corner as the corners stand in the mesh. */
ZR_INLINED void zr_put_value(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask, int k,
                             const struct zr_triangle_setup_v *setup, const zr_vf v[3], bool flat)
{
    const zr_vf zero = zr_vf_set(0.0f);
    const struct zr_plane_v *oow = &setup->oow_plane;
    struct zr_plane_v plane = {v[0], zero, zero};
    if (!flat)
        plane = zr_plane1_make(setup, v[0], v[1], v[2]);
    else if (mask & ZR_VARY_OVER_W)
        plane = (struct zr_plane_v){oow->a0 * v[0], oow->dadx * v[0], oow->dady * v[0]};
    zr_put_plane(s, run->first, k, zr_plane_count(mask), &plane);
}

/* Makes planes k, k + 1 and k + 2. */
ZR_INLINED void zr_put_three(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask, int k,
                             const struct zr_triangle_setup_v *setup, const struct zr_vec3_v v[3], bool flat)
{
    const zr_vf x[3] = {v[0].x, v[1].x, v[2].x}, y[3] = {v[0].y, v[1].y, v[2].y}, z[3] = {v[0].z, v[1].z, v[2].z};
    zr_put_value(s, run, mask, k, setup, x, flat);
    zr_put_value(s, run, mask, k + 1, setup, y, flat);
    zr_put_value(s, run, mask, k + 2, setup, z, flat);
}

/* Makes the groups COLOR and OPACITY, which have one rate. */
ZR_INLINED void zr_put_colors(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask,
                              const struct zr_triangle_setup_v *setup, const struct zr_corner_numbers *corners)
{
    const struct zr_draw_attributes *of_draw = run->of_draw;
    const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    const bool flat = zr_rate_is_flat(color->rate);
    struct zr_vec3_v c[3];
    zr_vf opacity[3];
    uint32_t backs = 0;
    if (of_draw->two_sided_colors)
        backs = zr_vm_bits(zr_shown_backs(run->draw, zr_draw_run_numbers(s, run), setup->turned));
    zr_colors_load(of_draw, corners->value, backs, c, opacity);
    if (mask & ZR_VARY_COLOR) zr_put_three(s, run, mask, zr_first_plane(mask, ZR_VARY_COLOR), setup, c, flat);
    if (mask & ZR_VARY_OPACITY) zr_put_value(s, run, mask, zr_first_plane(mask, ZR_VARY_OPACITY), setup, opacity, flat);
    if (zr_mixes_constants(mask)) memset(s->is_constant + run->first, flat, ZR_LANES);
}

/* Makes the group NORMAL. Flat surfaces in fog have no normals: 0. */
ZR_INLINED void zr_put_normals(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask,
                               const struct zr_triangle_setup_v *setup, const struct zr_corner_numbers *corners)
{
    const struct zr_attribute *normal = &run->of_draw->attributes[ZR_ATTRIBUTE_NORMAL];
    const struct zr_vec3_v none = zr_spread_v((zr_vec3){0.0f, 0.0f, 0.0f});
    struct zr_vec3_v n[3] = {none, none, none};
    if (zr_draw_has_normals(run->of_draw))
        zr_normals_load(run->of_draw, zr_draw_run_numbers(s, run), setup->turned, corners, n);
    zr_put_three(s, run, mask, zr_first_plane(mask, ZR_VARY_NORMAL), setup, n,
                 !(mask & ZR_VARY_PER_PIXEL) && zr_rate_is_flat(normal->rate));
}

/* Makes the groups POINT and DEPTH. */
ZR_INLINED void zr_put_points(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask,
                              const struct zr_triangle_setup_v *setup, const struct zr_corner_numbers *corners)
{
    struct zr_vec3_v p[3];
    zr_vf depth[3];
    zr_points_load(run->of_draw, corners->vertex, mask & ZR_VARY_DEPTH, p, depth);
    if (mask & ZR_VARY_POINT) zr_put_three(s, run, mask, zr_first_plane(mask, ZR_VARY_POINT), setup, p, false);
    if (mask & ZR_VARY_DEPTH) zr_put_value(s, run, mask, zr_first_plane(mask, ZR_VARY_DEPTH), setup, depth, false);
}

/* Makes the group PLACE. In a G-buffer, texture coordinates are the mesh's own, and only opacity needs places. */
ZR_INLINED void zr_put_places(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask,
                              const struct zr_triangle_setup_v *setup, const struct zr_corner_numbers *corners)
{
    const struct zr_texture_map *alpha = zr_opacity_map_of(&s->attributes->textures, run->draw->material);
    zr_vf c[3][4], places[2][3];
    zr_texcoords_load(run, corners->vertex, c);
    for (int k = 0; k < 3; k++) {
        zr_vf place[2] = {c[k][0], c[k][1]};
        if (s->attributes->texcoords_as_given && alpha) zr_texture_transform_v(alpha->texture, c[k], place);
        places[0][k] = place[0];
        places[1][k] = place[1];
    }
    for (int i = 0; i < 2; i++)
        zr_put_value(s, run, mask, zr_first_plane(mask, ZR_VARY_PLACE) + i, setup, places[i], false);
}

/* Makes the groups TEXCOORDS and TANGENT. */
static inline void zr_put_texcoords(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask,
                                    const struct zr_triangle_setup_v *setup, const struct zr_corner_numbers *corners)
{
    const int first = zr_first_plane(mask, ZR_VARY_TEXCOORDS), tangent = zr_first_plane(mask, ZR_VARY_TANGENT);
    const struct zr_vec3_v none = zr_spread_v((zr_vec3){0.0f, 0.0f, 0.0f});
    struct zr_tangents_v tangents = {{none, none, none}, zr_vf_set(0.0f)};
    zr_vf c[3][4];
    zr_texcoords_load(run, corners->vertex, c);
    for (int k = 0; k < 4; k++) {
        const zr_vf values[3] = {c[0][k], c[1][k], c[2][k]};
        zr_put_value(s, run, mask, first + k, setup, values, false);
    }
    if (zr_material_has_tangents(run->draw->material))
        tangents = zr_tangents_find(s, run, setup->turned, corners->vertex, c);
    const zr_vf sign[3] = {tangents.sign, tangents.sign, tangents.sign};
    zr_put_three(s, run, mask, tangent, setup, tangents.along, false);
    zr_put_value(s, run, mask, tangent + 3, setup, sign, true);
}

/* Returns the rate of the values that zr_corner_numbers.value numbers for a set. */
static inline enum zr_rate zr_rate_of(const struct zr_draw_attributes *of_draw, unsigned mask)
{
    if (mask & (ZR_VARY_COLOR | ZR_VARY_OPACITY)) return of_draw->attributes[ZR_ATTRIBUTE_COLOR].rate;
    return mask & ZR_VARY_NORMAL ? of_draw->attributes[ZR_ATTRIBUTE_NORMAL].rate : ZR_RATE_DRAW;
}

/* Makes all planes of a run of triangles; is_per_pixel: they have all groups of a set with ZR_VARY_PER_PIXEL. */
ZR_INLINED void zr_put_triangles(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask,
                                 const struct zr_corner_numbers *corners, bool is_per_pixel)
{
    const struct zr_triangle_setup_v setup = zr_way_of(s->geometry->vertices, corners->vertex);
    struct zr_plane_v oow = setup.oow_plane;
    if (zr_may_lack_w(mask) && zr_rate_is_flat(zr_rate_of(run->of_draw, mask)))
        oow = (struct zr_plane_v){zr_vf_set(1.0f), zr_vf_set(0.0f), zr_vf_set(0.0f)};
    zr_put_plane(s, run->first, 0, zr_plane_count(mask), &oow);
    if (mask & (ZR_VARY_COLOR | ZR_VARY_OPACITY)) zr_put_colors(s, run, mask, &setup, corners);
    if (mask & ZR_VARY_PER_PIXEL && !is_per_pixel) return;
    if (mask & ZR_VARY_NORMAL) zr_put_normals(s, run, mask, &setup, corners);
    if (mask & (ZR_VARY_POINT | ZR_VARY_DEPTH)) zr_put_points(s, run, mask, &setup, corners);
    if (mask & ZR_VARY_PLACE) zr_put_places(s, run, mask, &setup, corners);
    if (mask & ZR_VARY_TEXCOORDS) zr_put_texcoords(s, run, mask, &setup, corners);
}

/* Makes all planes of part i, a line or a point. */
static inline void zr_put_line(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask, uint32_t i)
{
    struct zr_plane planes[ZR_PLANES_MOST];
    const uint32_t count = (uint32_t)zr_plane_count(mask);
    s->is_constant[i] = zr_line_planes(s->geometry, run->of_draw, s->parts.owners[i] - 1, mask, planes);
    for (uint32_t k = 0; k < count; k++)
        memcpy(s->planes[i * count + k], &planes[k], sizeof *planes);
}

/* Stores the material of each part of a run, NULL if it is not shaded per pixel. Lines are unlit. */
ZR_INLINED void zr_put_material(struct zr_shader *s, const struct zr_draw_run *run, bool is_per_pixel)
{
    static const struct zr_material unlit = {.shading = ZR_SHADING_UNLIT};
    const struct zr_material *material = zr_draw_is_of_wires(run->draw) ? &unlit : run->draw->material;
    for (uint32_t i = run->first; i < run->first + ZR_LANES; i++)
        s->materials[i] = is_per_pixel ? material : NULL;
    s->any_per_pixel |= is_per_pixel;
}

/* Prefetches the positions and colours of a run of points. */
ZR_INLINED void zr_prefetch_run(const struct zr_shader *s, uint32_t run)
{
    if (run >= s->run_count || !zr_draw_is_cloud(s->runs[run].draw)) return;
    zr_cloud_prefetch(s->runs[run].of_draw, s->parts.owners + s->runs[run].first, s->runs[run].count);
}

/* Called before the planes of a run are put: prefetches for the next one, and for the first itself. */
ZR_INLINED void zr_look_ahead(const struct zr_shader *s, uint32_t run)
{
    if (run == 0) zr_prefetch_run(s, 0);
    zr_prefetch_run(s, run + 1);
}

ZR_INLINED void zr_put_run(struct zr_shader *s, const struct zr_draw_run *run, unsigned mask)
{
    const struct zr_draw *draw = run->draw;
    const bool of_wires = zr_draw_is_of_wires(draw);
    const bool is_per_pixel =
        mask & ZR_VARY_TEXCOORDS ? !of_wires && zr_material_is_mapped(draw->material) : run->of_draw->is_per_pixel;
    if (mask & ZR_VARY_PER_PIXEL) zr_put_material(s, run, is_per_pixel);
    if (mask & ZR_VARY_TEXCOORDS && !is_per_pixel) return;
    if (of_wires) {
        for (uint32_t i = run->first; i < run->first + run->count; i++)
            zr_put_line(s, run, mask, i);
        return;
    }
    const struct zr_corner_numbers corners =
        zr_corner_numbers_of(draw, zr_rate_of(run->of_draw, mask), zr_draw_run_numbers(s, run));
    zr_put_triangles(s, run, mask, &corners, is_per_pixel);
}

/* ---- samples ---- */

/* ZR_LANES samples and the parts that cover them. */
struct zr_samples_v {
    uint32_t first, count; /* parts; 0: only the position in the rows is set */
    zr_vi owner;
    zr_vm seen; /* lanes with an owner */
    zr_vf x, y;
    zr_vf (*planes)[3];
    /* Index of the first sample in rows. is_patch: the lanes form a patch; else they lie side by side. */
    ptrdiff_t at, stride;
    bool is_patch;
};

/* Returns value k of the samples: plane k times w. */
ZR_INLINED zr_vf zr_varying(const struct zr_samples_v *in, int k, zr_vf w)
{
    return zr_shaded_value(in->planes, k, in->x, in->y) * w;
}

/* Returns values k, k + 1 and k + 2. */
ZR_INLINED struct zr_vec3_v zr_varying3(const struct zr_samples_v *in, int k, zr_vf w)
{
    return (struct zr_vec3_v){zr_varying(in, k, w), zr_varying(in, k + 1, w), zr_varying(in, k + 2, w)};
}

ZR_INLINED zr_vf zr_varying_w(const struct zr_samples_v *in)
{
    return zr_vf_set(1.0f) / zr_shaded_value(in->planes, 0, in->x, in->y);
}

/* Returns the samples of part i and of later parts with its material. */
ZR_INLINED zr_vm zr_samples_of_material(const struct zr_shader *s, const struct zr_samples_v *in, uint32_t i)
{
    zr_vm out = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
    for (uint32_t other = i; other < in->first + in->count; other++)
        if (s->materials[other] == s->materials[i])
            out = zr_vm_or(out, zr_vi_eq(in->owner, zr_vi_set((int32_t)s->parts.owners[other])));
    return out;
}

/* Loads from an array that is laid out like the rows. */
ZR_INLINED zr_vf zr_samples_load(const struct zr_samples_v *in, const float *array)
{
    if (!in->is_patch) return zr_vf_load(array + in->at);
    return zr_vf_bits(zr_vi_load_patch((const uint32_t *)(const void *)(array + in->at), (size_t)in->stride));
}

/* Output rows, one array per value of a maker. The tile's first sample is at the first of each. */
enum { ZR_ROWS_MOST = 28 };
struct zr_varying_rows {
    float *of[ZR_ROWS_MOST];
    ptrdiff_t stride;
};

/* Computes the results of ZR_LANES samples. Samples without an owner get the results of uncovered ones. */
typedef void zr_varyings_fn(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                            const void *context, zr_vf values[ZR_ROWS_MOST]);

/* ---- the walk ---- */

/* Stores a block without owners. */
ZR_INLINED void zr_fill_empty_block(const struct zr_shader *s, int number, unsigned mask, zr_varyings_fn *make,
                                    const void *context, int count, const struct zr_varying_rows *rows)
{
    const ptrdiff_t first = zr_block_low(number) * rows->stride + zr_block_left(number);
    const struct zr_samples_v none = {.at = first, .stride = rows->stride};
    zr_vf values[ZR_ROWS_MOST];
    make(s, &none, mask, context, values);
    for (int v = 0; v < count; v++)
        for (int32_t row = 0; row < ZR_BLOCK_HEIGHT; row++)
            for (int32_t column = 0; column < ZR_BLOCK_WIDTH; column += ZR_LANES)
                zr_vf_store(rows->of[v] + first + row * rows->stride + column, values[v]);
}

/* Stores a block that one part covers. */
ZR_INLINED void zr_fill_whole_block(const struct zr_shader *s, const struct zr_tile *tile, int number, unsigned mask,
                                    zr_varyings_fn *make, const void *context, int count,
                                    const struct zr_varying_rows *rows)
{
    const uint32_t part = s->parts.blocks[number].first;
    const int32_t left = zr_block_left(number), low = zr_block_low(number);
    zr_vf planes[ZR_PLANES_MOST][3], values[ZR_ROWS_MOST];
    struct zr_samples_v in = {
        .first = part, .count = 1, .seen = ZR_ALL_LANES, .planes = planes, .stride = rows->stride};
    in.owner = zr_vi_set((int32_t)s->parts.owners[part]);
    zr_select_planes(s, part, 1, in.owner, zr_plane_count(mask), planes);
    for (int32_t row = low; row < low + ZR_BLOCK_HEIGHT; row++)
        for (int32_t column = left; column < left + ZR_BLOCK_WIDTH; column += ZR_LANES) {
            in.x = zr_vf_of(zr_vi_set(tile->x + column) + zr_vi_ramp());
            in.y = zr_vf_set((float)(tile->y + row));
            in.at = row * rows->stride + column;
            make(s, &in, mask, context, values);
            for (int v = 0; v < count; v++)
                zr_vf_store(rows->of[v] + in.at, values[v]);
        }
}

/* Stores patches side by side, as many as make whole rows of ZR_LANES. */
ZR_INLINED void zr_fill_patches(const struct zr_shader *s, const struct zr_tile *tile, int number, unsigned mask,
                                zr_varyings_fn *make, const void *context, int count,
                                const struct zr_varying_rows *rows)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct zr_patch_place place = zr_patch_place_of(tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p += ZR_PATCH_ROWS) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const ptrdiff_t at = (place.low - tile->y + y) * rows->stride + place.left - tile->x + x;
        zr_vi out[ZR_ROWS_MOST][ZR_PATCH_ROWS];
        for (int k = 0; k < ZR_PATCH_ROWS; k++) {
            zr_vf planes[ZR_PLANES_MOST][3], values[ZR_ROWS_MOST];
            struct zr_samples_v in = {.first = part,
                                      .count = block->patches[p + k],
                                      .at = at + k * ZR_PATCH_COLUMNS,
                                      .stride = rows->stride,
                                      .is_patch = true};
            if (in.count > 0) {
                in.owner = zr_vi_load_patch(tile->owner + zr_patch_first(number, p + k), ZR_TILE_STRIDE);
                in.seen = zr_vi_lt(zr_vi_set(0), in.owner);
                in.x = zr_vf_of(place.column + zr_vi_set(place.left + x + k * ZR_PATCH_COLUMNS));
                in.y = zr_vf_of(place.row + zr_vi_set(place.low + y));
                in.planes = planes;
                zr_select_planes(s, part, in.count, in.owner, zr_plane_count(mask), planes);
                make(s, &in, mask, context, values);
            } else {
                in.count = 0; /* a constant for the inlined maker */
                make(s, &in, mask, context, values);
            }
            for (int v = 0; v < count; v++)
                out[v][k] = zr_vi_bits_of(values[v]);
            part += block->patches[p + k];
        }
        for (int v = 0; v < count; v++) {
            zr_vi_rows_of_patches(out[v]);
            for (int k = 0; k < ZR_PATCH_ROWS; k++)
                zr_vi_store(rows->of[v] + at + k * rows->stride, out[v][k]);
        }
    }
}

/* Returns true if a part of the block has textures. */
static inline bool zr_block_is_textured(const struct zr_shader *s, int number)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    if (block->is_whole) return s->materials[block->first];
    uint32_t end = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++)
        end += block->patches[p];
    for (uint32_t i = block->first; i < end; i++)
        if (s->materials[i]) return true;
    return false;
}

/* Computes `count` values per sample for blocks begin .. end - 1, whose parts have been found, and stores them in
 * `rows`. With ZR_VARY_TEXCOORDS, blocks without textures stay as they are. */
ZR_INLINED void zr_varyings_fill(struct zr_shader *s, const struct zr_tile *tile, int begin, int end, unsigned mask,
                                 zr_varyings_fn *make, const void *context, int count,
                                 const struct zr_varying_rows *rows)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    s->any_per_pixel = false;
    s->materials[0] = NULL;
    for (uint32_t i = 0; i < s->run_count; i++) {
        zr_look_ahead(s, i);
        zr_put_run(s, &s->runs[i], mask);
    }
    if (mask & ZR_VARY_TEXCOORDS && !s->any_per_pixel) return;
    for (int b = begin; b < end; b++) {
        if (b % ZR_BLOCK_COLUMNS >= across || (mask & ZR_VARY_TEXCOORDS && !zr_block_is_textured(s, b))) continue;
        if (!s->parts.blocks[b].is_whole)
            zr_fill_patches(s, tile, b, mask, make, context, count, rows);
        else if (s->parts.blocks[b].first > 0)
            zr_fill_whole_block(s, tile, b, mask, make, context, count, rows);
        else
            zr_fill_empty_block(s, b, mask, make, context, count, rows);
    }
}

#endif
