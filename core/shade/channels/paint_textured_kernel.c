#include "shade/channels/color_simd.h"
#include "shade/lights/gbuffer.h"
#include "shade/texture_simd.h"
#include "shade/varyings_simd.h"

/* Texture values of a tile's samples, for a G-buffer (gbuffer.h) whose other values are written.
 *
 * Levels follow from the derivatives of the coordinates along the window's axes. Planes give these per sample, even at
 * edges.
 * Source: glTF 2.0, 3.9.3; Heckbert, "Survey of Texture Mapping", 1986.
 */

/* ---- samples ---- */

/* Both coordinate sets of samples, and their derivatives along x and y. */
struct zr_texcoords_v {
    zr_vf at[4], along_x[4], along_y[4];
};

/* Computes them from planes `first` to first + 3. */
static inline struct zr_texcoords_v zr_texcoords_of(const struct zr_samples_v *in, int first, zr_vf w)
{
    zr_vf(*planes)[3] = in->planes;
    struct zr_texcoords_v out;
    for (int k = 0; k < 4; k++) {
        out.at[k] = zr_varying(in, first + k, w);
        out.along_x[k] = (planes[first + k][1] - out.at[k] * planes[0][1]) * w;
        out.along_y[k] = (planes[first + k][2] - out.at[k] * planes[0][2]) * w;
    }
    return out;
}

/* Transforms a step to a texture's image. */
static inline void zr_texture_step_v(const struct zr_texture *texture, const zr_vf step[4], zr_vf out[2])
{
    const zr_vf *uv = &step[texture->texcoord == 0 ? 0 : 2];
    for (int k = 0; k < 2; k++)
        out[k] = zr_vf_set(texture->rows[k][0]) * uv[0] + zr_vf_set(texture->rows[k][1]) * uv[1];
}

static inline struct zr_vec3_v zr_texture_at_v(const struct zr_texture_map *map, const struct zr_texcoords_v *texcoords)
{
    zr_vf place[2], along_x[2], along_y[2], rho = zr_vf_set(0.0f);
    zr_texture_transform_v(map->texture, texcoords->at, place);
    if (zr_texture_needs_rho(map)) {
        zr_texture_step_v(map->texture, texcoords->along_x, along_x);
        zr_texture_step_v(map->texture, texcoords->along_y, along_y);
        rho = zr_rho_squared_v(map, along_x[0], along_x[1], along_y[0], along_y[1]);
    }
    return zr_texture_color_v(map, place[0], place[1], rho, false);
}

/* Surface normal, tangent and bitangent's sign of samples, for normal maps. */
struct zr_frame_v {
    struct zr_vec3_v normal, along;
    zr_vf sign;
};

/* Returns the unit normal that a normal map's texel stands for, or the surface's own if there is no tangent. */
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

/* Positions in the G-buffer's order of values. */
enum {
    ZR_ROUGHNESS_VALUE = 3,
    ZR_METALLIC_VALUE,
    ZR_OCCLUSION_VALUE,
    ZR_EMISSIVE_VALUE,
    ZR_NORMAL_VALUE = 9,
    ZR_COAT_VALUE = 12
};

static inline void zr_take_three(zr_vf *out, zr_vm where, struct zr_vec3_v color)
{
    out[0] = zr_vf_select(where, color.x, out[0]);
    out[1] = zr_vf_select(where, color.y, out[1]);
    out[2] = zr_vf_select(where, color.z, out[2]);
}

/* Samples the textures of one material for the samples `where`. May be repeated for one material. */
static inline void zr_take_textures(zr_vf out[ZR_ROWS_MOST], const struct zr_texture_maps *maps,
                                    const struct zr_material *material, const struct zr_texcoords_v *texcoords,
                                    const struct zr_frame_v *frame, zr_vm where)
{
    const struct zr_texture_map *map;
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_BASE_COLOR)))
        zr_take_three(out, where, zr_texture_at_v(map, texcoords));
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_METALLIC_ROUGHNESS))) {
        const struct zr_vec3_v texel = zr_texture_at_v(map, texcoords);
        out[ZR_ROUGHNESS_VALUE] = zr_vf_select(where, texel.y, out[ZR_ROUGHNESS_VALUE]);
        out[ZR_METALLIC_VALUE] = zr_vf_select(where, texel.z, out[ZR_METALLIC_VALUE]);
    }
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_OCCLUSION)))
        out[ZR_OCCLUSION_VALUE] = zr_vf_select(where, zr_texture_at_v(map, texcoords).x, out[ZR_OCCLUSION_VALUE]);
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_EMISSIVE)))
        zr_take_three(out + ZR_EMISSIVE_VALUE, where, zr_texture_at_v(map, texcoords));
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_NORMAL)))
        zr_take_three(out + ZR_NORMAL_VALUE, where,
                      zr_mapped_normal_v(zr_texture_at_v(map, texcoords), material->normal_scale, frame));
    if (!maps->of_finishes) return;
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_COAT)))
        out[ZR_COAT_VALUE] = zr_vf_select(where, zr_texture_at_v(map, texcoords).x, out[ZR_COAT_VALUE]);
    if ((map = zr_texture_map_of(maps, material, ZR_TEXTURE_COAT_ROUGHNESS)))
        out[ZR_COAT_VALUE + 1] = zr_vf_select(where, zr_texture_at_v(map, texcoords).y, out[ZR_COAT_VALUE + 1]);
}

/* Makes the texture values. context: the G-buffer. Without a texture of a kind: 1, and the surface's own normal. */
ZR_INLINED void zr_make_textures(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                 const void *context, zr_vf values[ZR_ROWS_MOST])
{
    const struct zr_gbuffer *to = context;
    const int tangent = zr_first_plane(mask, ZR_VARY_TANGENT);
    const struct zr_vec3_v normal = {zr_samples_load(in, to->normal[0]), zr_samples_load(in, to->normal[1]),
                                     zr_samples_load(in, to->normal[2])};
    for (int k = 0; k < ZR_NORMAL_VALUE; k++)
        values[k] = zr_vf_set(1.0f);
    values[ZR_NORMAL_VALUE] = normal.x;
    values[ZR_NORMAL_VALUE + 1] = normal.y;
    values[ZR_NORMAL_VALUE + 2] = normal.z;
    values[ZR_COAT_VALUE] = values[ZR_COAT_VALUE + 1] = zr_vf_set(1.0f);
    if (in->count == 0) return;
    const zr_vf w = zr_varying_w(in);
    const struct zr_texcoords_v texcoords = zr_texcoords_of(in, zr_first_plane(mask, ZR_VARY_TEXCOORDS), w);
    const struct zr_frame_v frame = {normal, zr_varying3(in, tangent, w), in->planes[tangent + 3][0]};
    const struct zr_material *done = NULL; /* usually there is one */
    for (uint32_t i = in->first; i < in->first + in->count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        zr_take_textures(values, &s->attributes->textures, material, &texcoords, &frame,
                         zr_samples_of_material(s, in, i));
        done = material;
    }
}

static inline struct zr_varying_rows zr_texture_rows_of(const struct zr_gbuffer *to)
{
    const struct zr_gbuffer_textures *t = to->textures;
    return (struct zr_varying_rows){{t->base[0], t->base[1], t->base[2], t->roughness, t->metallic, t->occlusion,
                                     t->emissive[0], t->emissive[1], t->emissive[2], t->normal[0], t->normal[1],
                                     t->normal[2], t->coat, t->coat_roughness},
                                    to->stride};
}

void ZR_KERNEL(zr_paint_textured)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                  const struct zr_tile_targets *to)
{
    zr_shade_colors_by(s, tile, begin, end, to, ZR_COLOR_TEXTURED_VARYINGS);
}

void ZR_KERNEL(zr_sample_textures)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_gbuffer *to)
{
    enum { GROUPS = ZR_VARY_TEXCOORDS | ZR_VARY_TANGENT | ZR_VARY_PER_PIXEL };
    const struct zr_varying_rows rows = zr_texture_rows_of(to);
    if (s->attributes->textures.of_finishes)
        zr_varyings_fill(s, tile, begin, end, GROUPS, zr_make_textures, to, ZR_TEXTURE_VALUES_FINISHED, &rows);
    else
        zr_varyings_fill(s, tile, begin, end, GROUPS, zr_make_textures, to, ZR_TEXTURE_VALUES, &rows);
}
