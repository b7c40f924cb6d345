/* textures_simd.h - shade: what textures make of the samples of a tile, for a G-buffer (gbuffer.h) whose other values
 * are there, for the kernel that shades.
 *
 * Parts have planes of 1/w, of both texture coordinates and of the tangent. Levels are told by the derivatives of the
 * coordinates along the window's axes, which follow from the planes; so each sample has its own, at every edge.
 * Source: glTF 2.0, 3.9.3; Heckbert, "Survey of Texture Mapping", 1986.
 */
#ifndef ZR_TEXTURES_SIMD_H
#define ZR_TEXTURES_SIMD_H

#include "shade/channels/gbuffer_simd.h"
#include "shade/texture_simd.h"

/* Of 1/w; u and v of texcoord 0, and of 1; the tangent; and the sign of the bitangent. */
enum { ZR_TEXTURE_PLANES = 9, ZR_FIRST_TANGENT = 5, ZR_BITANGENT = 8 };

/* ---- tangents ---- */

/* Texture coordinates and tangents at the corners of triangles. */
struct zr_fours_v {
    zr_vf x, y, z, w;
};

static inline void zr_fours_load(const zr_vec4 *values, const int32_t (*numbers)[ZR_LANES], struct zr_fours_v c[3])
{
#define ZR_FOURS_0(i) (&values[numbers[0][i]].x)
#define ZR_FOURS_1(i) (&values[numbers[1][i]].x)
#define ZR_FOURS_2(i) (&values[numbers[2][i]].x)
    ZR_LOAD4(c[0].x, c[0].y, c[0].z, c[0].w, ZR_FOURS_0);
    ZR_LOAD4(c[1].x, c[1].y, c[1].z, c[1].w, ZR_FOURS_1);
    ZR_LOAD4(c[2].x, c[2].y, c[2].z, c[2].w, ZR_FOURS_2);
#undef ZR_FOURS_0
#undef ZR_FOURS_1
#undef ZR_FOURS_2
}

/* In the image of a texture. */
static inline void zr_texture_transform_v(const struct zr_texture *texture, const struct zr_fours_v *given,
                                          zr_vf out[2])
{
    const zr_vf u = texture->texcoord == 0 ? given->x : given->z, v = texture->texcoord == 0 ? given->y : given->w;
    for (int k = 0; k < 2; k++)
        out[k] =
            (zr_vf_set(texture->rows[k][0]) * u + zr_vf_set(texture->rows[k][1]) * v) + zr_vf_set(texture->rows[k][2]);
}

struct zr_tangent_v {
    struct zr_vec3_v along; /* u; of any length, 0 where there is none */
    zr_vf sign;             /* of the bitangent, which goes against v */
};

/* Of whole triangles, from their corners: P_u = (e1 v2 - e2 v1) / (u1 v2 - u2 v1). */
static inline struct zr_tangent_v zr_tangent_of(const struct zr_vec3_v points[3], zr_vf (*places)[2], bool is_mirror)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), turn = zr_vf_set(is_mirror ? -1.0f : 1.0f);
    const struct zr_vec3_v e1 = zr_minus_v(points[1], points[0]), e2 = zr_minus_v(points[2], points[0]);
    const zr_vf u1 = places[1][0] - places[0][0], v1 = places[1][1] - places[0][1];
    const zr_vf u2 = places[2][0] - places[0][0], v2 = places[2][1] - places[0][1];
    const zr_vf area = u1 * v2 - u2 * v1, minus = zr_vf_set(-1.0f);
    const zr_vf sign = zr_vf_select(zr_vf_lt(area, zero), minus, zr_vf_select(zr_vf_eq(area, zero), zero, one));
    const struct zr_vec3_v along = zr_minus_v(zr_scale_v(e1, v2), zr_scale_v(e2, v1));
    return (struct zr_tangent_v){zr_scale_v(along, sign), (zero - sign) * turn};
}

/* ---- making ---- */

static inline void zr_put_tangents(struct zr_shader *s, const struct zr_run *run, const struct zr_triangle_setup_v *way,
                                   const struct zr_corner_numbers *corners, const struct zr_fours_v texcoords[3])
{
    const struct zr_draw_attributes *surface = run->surface;
    const zr_vec4 *given = surface->attributes[ZR_ATTRIBUTE_TANGENT].values;
    const struct zr_texture *texture =
        zr_texture_map_of(&s->surfaces->textures, run->draw->material, ZR_TEXTURE_NORMAL)->texture;
    const zr_vf one = zr_vf_set(1.0f);
    const zr_vf side =
        zr_vf_select(zr_shown_backs(run->draw, zr_run_numbers(s, run), way->turned), zr_vf_set(-1.0f), one);
    struct zr_vec3_v along[3];
    zr_vf sign;
    if (given) {
        struct zr_fours_v tangents[3];
        zr_fours_load(given - run->draw->first_vertex, corners->vertex, tangents);
        for (int k = 0; k < 3; k++)
            along[k] = (struct zr_vec3_v){tangents[k].x, tangents[k].y, tangents[k].z};
        sign = tangents[0].w;
    } else {
        const zr_vec4 *points = surface->attributes[ZR_ATTRIBUTE_POINT].values - run->draw->first_vertex;
        struct zr_vec3_v at[3];
        zr_vf places[3][2];
        zr_values_load(points, corners->vertex, at);
        for (int k = 0; k < 3; k++)
            zr_texture_transform_v(texture, &texcoords[k], places[k]);
        const struct zr_tangent_v tangent =
            zr_tangent_of(at, places, zr_mat4_is_mirror(&s->geometry->instances[run->draw->instance].to_eye));
        for (int k = 0; k < 3; k++)
            along[k] = tangent.along;
        sign = tangent.sign;
    }
    for (int k = 0; k < 3; k++)
        along[k] = zr_scale_v(along[k], side);
    const struct zr_planes3_v planes = zr_planes3_make(way, along);
    const struct zr_plane_v constant = {sign * side, zr_vf_set(0.0f), zr_vf_set(0.0f)};
    zr_put_three(s, run->first, ZR_FIRST_TANGENT, ZR_TEXTURE_PLANES, &planes);
    zr_put_plane(s, run->first, ZR_BITANGENT, ZR_TEXTURE_PLANES, &constant);
}

/* True where the run has textures. */
static inline bool zr_make_textures(struct zr_shader *s, const struct zr_run *run)
{
    const struct zr_material *material = run->draw->material;
    const zr_vec4 *values = run->surface->attributes[ZR_ATTRIBUTE_TEXCOORD].values;
    const bool textured = !zr_draw_is_of_lines(run->draw) && zr_material_has_textures(material);
    for (uint32_t i = run->first; i < run->first + ZR_LANES; i++)
        s->materials[i] = textured ? material : NULL;
    if (!textured) return false;
    const zr_vf zero = zr_vf_set(0.0f);
    const struct zr_plane_v none = {zero, zero, zero};
    const struct zr_corner_numbers corners = zr_corner_numbers_of(run->draw, ZR_RATE_DRAW, zr_run_numbers(s, run));
    const struct zr_triangle_setup_v way = zr_way_of(s->geometry->vertices, corners.vertex);
    struct zr_fours_v c[3] = {{zero, zero, zero, zero}, {zero, zero, zero, zero}, {zero, zero, zero, zero}};
    if (values) zr_fours_load(values - run->draw->first_vertex, corners.vertex, c);
    const struct zr_plane_v planes[5] = {
        way.oow_plane, zr_plane1_make(&way, c[0].x, c[1].x, c[2].x), zr_plane1_make(&way, c[0].y, c[1].y, c[2].y),
        zr_plane1_make(&way, c[0].z, c[1].z, c[2].z), zr_plane1_make(&way, c[0].w, c[1].w, c[2].w)};
    for (int k = 0; k < 5; k++)
        zr_put_plane(s, run->first, k, ZR_TEXTURE_PLANES, &planes[k]);
    if (material->textures[ZR_TEXTURE_NORMAL]) {
        zr_put_tangents(s, run, &way, &corners, c);
    } else {
        for (int k = ZR_FIRST_TANGENT; k < ZR_TEXTURE_PLANES; k++)
            zr_put_plane(s, run->first, k, ZR_TEXTURE_PLANES, &none);
    }
    return true;
}

/* ---- samples ---- */

/* Of samples: both coordinates, and how they change along x and along y. */
struct zr_texcoords_v {
    struct zr_fours_v at, along_x, along_y;
};

static inline struct zr_texcoords_v zr_texcoords_of(zr_vf (*planes)[3], zr_vf x, zr_vf y)
{
    const zr_vf w = zr_vf_set(1.0f) / zr_shaded_value(planes, 0, x, y);
    zr_vf at[4], steps[2][4];
    for (int k = 0; k < 4; k++) {
        at[k] = zr_shaded_value(planes, 1 + k, x, y) * w;
        for (int j = 0; j < 2; j++)
            steps[j][k] = (planes[1 + k][1 + j] - at[k] * planes[0][1 + j]) * w;
    }
    return (struct zr_texcoords_v){{at[0], at[1], at[2], at[3]},
                                   {steps[0][0], steps[0][1], steps[0][2], steps[0][3]},
                                   {steps[1][0], steps[1][1], steps[1][2], steps[1][3]}};
}

/* A step in the image of a texture. */
static inline void zr_texture_step_v(const struct zr_texture *texture, const struct zr_fours_v *step, zr_vf out[2])
{
    const zr_vf u = texture->texcoord == 0 ? step->x : step->z, v = texture->texcoord == 0 ? step->y : step->w;
    for (int k = 0; k < 2; k++)
        out[k] = zr_vf_set(texture->rows[k][0]) * u + zr_vf_set(texture->rows[k][1]) * v;
}

static inline struct zr_vec3_v zr_texture_at_v(const struct zr_texture_map *map, const struct zr_texcoords_v *texcoords)
{
    zr_vf place[2], along_x[2], along_y[2], rho = zr_vf_set(0.0f);
    zr_texture_transform_v(map->texture, &texcoords->at, place);
    if (zr_texture_needs_rho(map)) {
        zr_texture_step_v(map->texture, &texcoords->along_x, along_x);
        zr_texture_step_v(map->texture, &texcoords->along_y, along_y);
        rho = zr_rho_squared_v(map, along_x[0], along_x[1], along_y[0], along_y[1]);
    }
    return zr_texture_color_v(map, place[0], place[1], rho, false);
}

/* What samples have beside their coordinates, for normal maps. */
struct zr_frame_v {
    struct zr_vec3_v normal, along;
    zr_vf sign;
};

/* The normal that a normal map has, from that of the surface, unit; where there is no tangent, that one. */
static inline struct zr_vec3_v zr_mapped_normal_v(struct zr_vec3_v texel, float scale, const struct zr_frame_v *frame)
{
    const struct zr_vec3_v normal = frame->normal, along = frame->along;
    const zr_vf one = zr_vf_set(1.0f), two = zr_vf_set(2.0f), factor = zr_vf_set(scale);
    const struct zr_vec3_v flat = zr_minus_v(along, zr_scale_v(normal, zr_dot_v(normal, along)));
    const struct zr_vec3_v tangent = zr_normalize_v(flat),
                           bitangent = zr_scale_v(zr_cross_v(normal, tangent), frame->sign);
    const struct zr_vec3_v sum = zr_add_v(zr_add_v(zr_scale_v(tangent, (texel.x * two - one) * factor),
                                                   zr_scale_v(bitangent, (texel.y * two - one) * factor)),
                                          zr_scale_v(normal, texel.z * two - one));
    const zr_vm has_one = zr_vm_and(zr_vf_lt(zr_vf_set(0.5f), zr_dot_v(tangent, tangent)),
                                    zr_vf_lt(zr_vf_set(1e-12f), zr_dot_v(sum, sum)));
    return zr_choose_v(has_one, zr_normalize_v(sum), normal);
}

/* All values of ZR_LANES samples, in the order of the G-buffer's. */
struct zr_textures_v {
    zr_vf value[ZR_TEXTURE_VALUES];
};
enum { ZR_ROUGHNESS_VALUE = 3, ZR_METALLIC_VALUE, ZR_OCCLUSION_VALUE, ZR_EMISSIVE_VALUE, ZR_NORMAL_VALUE = 9 };

static inline void zr_take_three(struct zr_textures_v *out, int first, zr_vm where, struct zr_vec3_v color)
{
    out->value[first] = zr_vf_select(where, color.x, out->value[first]);
    out->value[first + 1] = zr_vf_select(where, color.y, out->value[first + 1]);
    out->value[first + 2] = zr_vf_select(where, color.z, out->value[first + 2]);
}

/* Samples of one material, which are `where`. Once more it changes nothing. */
static inline void zr_take_textures(struct zr_textures_v *out, const struct zr_texture_maps *maps,
                                    const struct zr_material *material, const struct zr_texcoords_v *texcoords,
                                    const struct zr_frame_v *frame, zr_vm where)
{
    const struct zr_texture_map *map;
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_BASE_COLOR)))
        zr_take_three(out, 0, where, zr_texture_at_v(map, texcoords));
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_METALLIC_ROUGHNESS))) {
        const struct zr_vec3_v texel = zr_texture_at_v(map, texcoords);
        out->value[ZR_ROUGHNESS_VALUE] = zr_vf_select(where, texel.y, out->value[ZR_ROUGHNESS_VALUE]);
        out->value[ZR_METALLIC_VALUE] = zr_vf_select(where, texel.z, out->value[ZR_METALLIC_VALUE]);
    }
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_OCCLUSION)))
        out->value[ZR_OCCLUSION_VALUE] =
            zr_vf_select(where, zr_texture_at_v(map, texcoords).x, out->value[ZR_OCCLUSION_VALUE]);
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_EMISSIVE)))
        zr_take_three(out, ZR_EMISSIVE_VALUE, where, zr_texture_at_v(map, texcoords));
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_NORMAL)))
        zr_take_three(out, ZR_NORMAL_VALUE, where,
                      zr_mapped_normal_v(zr_texture_at_v(map, texcoords), material->normal_scale, frame));
}

static inline zr_vf zr_patch_load(const float *from, ptrdiff_t stride)
{
    return zr_vf_bits(zr_vi_load_patch((const uint32_t *)(const void *)from, (size_t)stride));
}

/* What `count` parts from `first` on show in a patch. */
static inline struct zr_textures_v zr_textures_at(const struct zr_shader *s, uint32_t first, uint32_t count,
                                                  zr_vi owner, zr_vf x, zr_vf y, struct zr_vec3_v normal)
{
    const zr_vf one = zr_vf_set(1.0f);
    struct zr_textures_v out = {{one, one, one, one, one, one, one, one, one, normal.x, normal.y, normal.z}};
    const struct zr_material *done = NULL; /* most often there is one */
    zr_vf planes[ZR_TEXTURE_PLANES][3];
    if (count == 0) return out;
    zr_select_planes(s, first, count, owner, ZR_TEXTURE_PLANES, planes);
    const struct zr_texcoords_v texcoords = zr_texcoords_of(planes, x, y);
    const zr_vf w = one / zr_shaded_value(planes, 0, x, y);
    const struct zr_frame_v frame = {normal, zr_shaded_three(planes, ZR_FIRST_TANGENT, w, x, y),
                                     planes[ZR_BITANGENT][0]};
    for (uint32_t i = first; i < first + count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        zr_vm of_it = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
        for (uint32_t other = i; other < first + count; other++)
            if (s->materials[other] == material)
                of_it = zr_vm_or(of_it, zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[other])));
        zr_take_textures(&out, &s->surfaces->textures, material, &texcoords, &frame, of_it);
        done = material;
    }
    return out;
}

/* ---- blocks ---- */

/* The rows of a G-buffer: surfaces' own normals, and what is made, in its order. */
struct zr_texture_rows {
    const float *normal[3];
    float *of[ZR_TEXTURE_VALUES];
    ptrdiff_t stride;
};

static inline struct zr_texture_rows zr_texture_rows_of(const struct zr_gbuffer *to)
{
    const struct zr_gbuffer_textures *t = to->textures;
    return (struct zr_texture_rows){{to->normal[0], to->normal[1], to->normal[2]},
                                    {t->base[0], t->base[1], t->base[2], t->roughness, t->metallic, t->occlusion,
                                     t->emissive[0], t->emissive[1], t->emissive[2], t->normal[0], t->normal[1],
                                     t->normal[2]},
                                    to->stride};
}

static inline bool zr_block_has_textures(const struct zr_shader *s, int number)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    if (block->is_whole) return block->first > 0 && s->materials[block->first];
    uint32_t count = 0;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++)
        count += block->patches[p];
    for (uint32_t i = block->first; i < block->first + count; i++)
        if (s->materials[i]) return true;
    return false;
}

/* Patches side by side, as many as make whole rows of ZR_LANES. */
static void zr_texture_block(const struct zr_shader *s, const struct zr_tile *tile, int number,
                             const struct zr_texture_rows *to)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct zr_patch_place place = zr_patch_place_of(tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p += ZR_PATCH_ROWS) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const ptrdiff_t at = (place.low - tile->y + y) * to->stride + place.left - tile->x + x;
        const zr_vf fy = zr_vf_of(place.row + zr_vi_set(place.low + y));
        zr_vi rows[ZR_TEXTURE_VALUES][ZR_PATCH_ROWS];
        for (int k = 0; k < ZR_PATCH_ROWS; k++) {
            const uint32_t count = block->is_whole ? 1 : block->patches[p + k];
            const zr_vi owner = block->is_whole
                                    ? zr_vi_set((int32_t)s->parts.owners[part])
                                    : zr_vi_load_patch(tile->owner + zr_patch_first(number, p + k), ZR_TILE_STRIDE);
            const zr_vf fx = zr_vf_of(place.column + zr_vi_set(place.left + x + k * ZR_PATCH_COLUMNS));
            const ptrdiff_t patch = at + k * ZR_PATCH_COLUMNS;
            const struct zr_vec3_v normal = {zr_patch_load(to->normal[0] + patch, to->stride),
                                             zr_patch_load(to->normal[1] + patch, to->stride),
                                             zr_patch_load(to->normal[2] + patch, to->stride)};
            const struct zr_textures_v textures = zr_textures_at(s, part, count, owner, fx, fy, normal);
            for (int v = 0; v < ZR_TEXTURE_VALUES; v++)
                rows[v][k] = zr_vi_bits_of(textures.value[v]);
            if (!block->is_whole) part += count;
        }
        for (int v = 0; v < ZR_TEXTURE_VALUES; v++) {
            zr_vi_rows_of_patches(rows[v]);
            for (int k = 0; k < ZR_PATCH_ROWS; k++)
                zr_vi_store(to->of[v] + at + k * to->stride, rows[v][k]);
        }
    }
}

/* Blocks begin .. end - 1, whose parts have been found. */
static inline void zr_texture_blocks(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                     const struct zr_gbuffer *to)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    const struct zr_texture_rows rows = zr_texture_rows_of(to);
    bool any = false;
    s->materials[0] = NULL;
    for (uint32_t i = 0; i < s->run_count; i++)
        any |= zr_make_textures(s, &s->runs[i]);
    for (int b = begin; any && b < end; b++)
        if (b % ZR_BLOCK_COLUMNS < across && zr_block_has_textures(s, b)) zr_texture_block(s, tile, b, &rows);
}

#endif
