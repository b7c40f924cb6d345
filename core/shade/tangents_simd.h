/* tangents_simd.h - shade: texture coordinates and tangents at the corners of ZR_LANES triangles, for kernels.
 *
 * Source: glTF 2.0, 3.9.3.
 */
#ifndef ZR_TANGENTS_SIMD_H
#define ZR_TANGENTS_SIMD_H

#include "shade/shader_simd.h"

/* Transforms texture coordinates to a texture's image, as zr_texture_transform does. given: u and v of both sets. */
static inline void zr_texture_transform_v(const struct zr_texture *texture, const zr_vf given[4], zr_vf out[2])
{
    const zr_vf *uv = &given[texture->texcoord == 0 ? 0 : 2];
    for (int k = 0; k < 2; k++)
        out[k] = (zr_vf_set(texture->rows[k][0]) * uv[0] + zr_vf_set(texture->rows[k][1]) * uv[1]) +
                 zr_vf_set(texture->rows[k][2]);
}

/* Loads both coordinate sets at the corners of a run's triangles; 0 if the mesh has none. */
static inline void zr_texcoords_load(const struct zr_draw_run *run, const int32_t (*vertices)[ZR_LANES],
                                     zr_vf (*out)[4])
{
    const zr_vec4 *values = run->of_draw->attributes[ZR_ATTRIBUTE_TEXCOORD].values;
    const struct zr_vec3_v none = zr_spread_v((zr_vec3){0.0f, 0.0f, 0.0f});
    struct zr_vec3_v c[3] = {none, none, none};
    zr_vf last[3] = {none.x, none.x, none.x};
    if (values) zr_values_load(values - run->draw->first_vertex, vertices, c, last);
    for (int k = 0; k < 3; k++) {
        out[k][0] = c[k].x;
        out[k][1] = c[k].y;
        out[k][2] = c[k].z;
        out[k][3] = last[k];
    }
}

/* Tangents of the visible sides. */
struct zr_tangents_v {
    struct zr_vec3_v along[3]; /* along u, per corner; any length; 0: none */
    zr_vf sign;                /* sign of the bitangent, which points against v */
};

/* Computes one tangent per triangle from its corners: P_u = (e1 v2 - e2 v1) / (u1 v2 - u2 v1). */
static inline struct zr_tangents_v zr_tangents_of(const struct zr_vec3_v points[3], zr_vf (*places)[2], bool is_mirror)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), turn = zr_vf_set(is_mirror ? -1.0f : 1.0f);
    const struct zr_vec3_v e1 = zr_minus_v(points[1], points[0]), e2 = zr_minus_v(points[2], points[0]);
    const zr_vf u1 = places[1][0] - places[0][0], v1 = places[1][1] - places[0][1];
    const zr_vf u2 = places[2][0] - places[0][0], v2 = places[2][1] - places[0][1];
    const zr_vf area = u1 * v2 - u2 * v1, minus = zr_vf_set(-1.0f);
    const zr_vf sign = zr_vf_select(zr_vf_lt(area, zero), minus, zr_vf_select(zr_vf_eq(area, zero), zero, one));
    const struct zr_vec3_v along = zr_scale_v(zr_minus_v(zr_scale_v(e1, v2), zr_scale_v(e2, v1)), sign);
    return (struct zr_tangents_v){{along, along, along}, (zero - sign) * turn};
}

/* Returns the texture whose coordinates tangents follow; NULL: those of set 0. */
static inline const struct zr_texture *zr_tangent_texture(const struct zr_texture_maps *maps,
                                                          const struct zr_material *material)
{
    static const enum zr_texture_slot slots[] = {ZR_TEXTURE_NORMAL, ZR_TEXTURE_COAT_NORMAL, ZR_TEXTURE_ANISOTROPY};
    for (size_t i = 0; i < sizeof slots / sizeof *slots; i++) {
        const struct zr_texture_map *map = zr_texture_map_of(maps, material, slots[i]);
        if (map) return map->texture;
    }
    return NULL;
}

/* Returns the mesh's own tangents, or those of its normal map's coordinates. */
static inline struct zr_tangents_v zr_tangents_find(const struct zr_shader *s, const struct zr_draw_run *run,
                                                    zr_vm turned, const int32_t (*vertices)[ZR_LANES],
                                                    zr_vf (*texcoords)[4])
{
    const struct zr_attribute *attributes = run->of_draw->attributes;
    const zr_vec4 *given = attributes[ZR_ATTRIBUTE_TANGENT].values;
    const struct zr_texture *texture = zr_tangent_texture(&s->attributes->textures, run->draw->material);
    const zr_vm backs = zr_shown_backs(run->draw, zr_draw_run_numbers(s, run), turned);
    const zr_vf side = zr_vf_select(backs, zr_vf_set(-1.0f), zr_vf_set(1.0f));
    struct zr_tangents_v out;
    zr_vf last[3];
    if (given) {
        zr_values_load(given - run->draw->first_vertex, vertices, out.along, last);
        out.sign = last[0];
    } else {
        struct zr_vec3_v at[3];
        zr_vf places[3][2];
        zr_points_load(run->of_draw, vertices, false, at, last);
        for (int k = 0; k < 3; k++) {
            places[k][0] = texcoords[k][0];
            places[k][1] = texcoords[k][1];
            if (texture) zr_texture_transform_v(texture, texcoords[k], places[k]);
        }
        out = zr_tangents_of(at, places, zr_mat4_is_mirror(&s->geometry->instances[run->draw->instance].to_eye));
    }
    for (int k = 0; k < 3; k++)
        out.along[k] = zr_scale_v(out.along[k], side);
    out.sign = out.sign * side;
    return out;
}

#endif
