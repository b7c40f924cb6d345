#include "base/prefetch.h"
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

/* Prefetches texels of the samples one block to the right: those of every fourth lane, at the level of the first. A
 * tenth of the time of the helmet of `make bench-looks`. */
static inline void zr_prefetch_texels(const struct zr_alike_maps *maps, const zr_vf place[2], const zr_vf along_x[2],
                                      zr_vf rho_squared)
{
    const struct zr_texture_map *map = maps->of[0];
    const zr_vf ahead = zr_vf_set(ZR_BLOCK_WIDTH);
    int32_t numbers[ZR_LANES], exponents[ZR_LANES];
    zr_vi_store(exponents, zr_vi_bits_of(rho_squared) >> 23);
    int32_t number = (exponents[0] - 127) / 2;
    number = number < 0 ? 0 : number < (int32_t)map->level_count ? number : (int32_t)map->level_count - 1;
    const struct zr_texture_level *level = &map->levels[number];
    const zr_vi x = zr_nearest_texel_v(map->texture->wrap_s, level->width, place[0] + along_x[0] * ahead);
    const zr_vi y = zr_nearest_texel_v(map->texture->wrap_t, level->height, place[1] + along_x[1] * ahead);
    zr_vi_store(numbers, y * zr_vi_set((int32_t)level->width) + x);
    for (int i = 0; i < maps->count; i++)
        for (int k = 0; k < ZR_LANES; k += 4)
            zr_prefetch(maps->of[i]->levels[number].texels, (size_t)numbers[k] * (maps->of[i]->bits / 2), 1);
}

static inline void zr_textures_at_v(const struct zr_alike_maps *maps, const struct zr_texcoords_v *texcoords,
                                    struct zr_vec3_v *out)
{
    const struct zr_texture_map *map = maps->of[0];
    zr_vf place[2], along_x[2], along_y[2], rho = zr_vf_set(0.0f);
    zr_texture_transform_v(map->texture, texcoords->at, place);
    if (zr_texture_needs_rho(map)) {
        zr_texture_step_v(map->texture, texcoords->along_x, along_x);
        zr_texture_step_v(map->texture, texcoords->along_y, along_y);
        rho = zr_rho_squared_v(map, along_x[0], along_x[1], along_y[0], along_y[1]);
        zr_prefetch_texels(maps, place, along_x, rho);
    }
    zr_texture_colors_v(maps, place[0], place[1], rho, false, out);
}

/* Texels of a material, by slot. Slots without a texture are not written. */
struct zr_texels_v {
    struct zr_vec3_v of[ZR_TEXTURE_SLOTS];
    unsigned slots; /* that have a texture: bits */
};

/* Samples textures of one place: those of the first slot of `slots` and of slots that share its place. Returns these
 * slots. A map of several slots, as occlusion with roughness, is sampled once. */
static inline unsigned zr_sample_alike(const struct zr_texture_map *const *maps, unsigned slots,
                                       const struct zr_texcoords_v *texcoords, struct zr_texels_v *out)
{
    const uint32_t place = maps[zr_lowest_bit(slots)]->place;
    struct zr_alike_maps alike = {.count = 0};
    struct zr_vec3_v colors[ZR_TEXTURE_SLOTS];
    int numbers[ZR_TEXTURE_SLOTS];
    unsigned taken = 0;
    for (unsigned left = slots; left; left &= left - 1) {
        const int slot = zr_lowest_bit(left);
        int i = 0;
        if (maps[slot]->place != place) continue;
        while (i < alike.count && alike.of[i] != maps[slot])
            i++;
        alike.of[i] = maps[slot];
        alike.count = i < alike.count ? alike.count : i + 1;
        colors[i] = zr_spread_v((zr_vec3){0, 0, 0});
        numbers[slot] = i;
        taken |= 1u << slot;
    }
    zr_textures_at_v(&alike, texcoords, colors);
    for (unsigned left = taken; left; left &= left - 1)
        out->of[zr_lowest_bit(left)] = colors[numbers[zr_lowest_bit(left)]];
    return taken;
}

/* Samples the textures of a material. Those of one place share the search for their texels: a tenth of the time of the
 * helmet of `make bench-looks`. */
static inline void zr_texels_at(const struct zr_texture_maps *maps, const struct zr_material *material,
                                const struct zr_texcoords_v *texcoords, bool finished, struct zr_texels_v *out)
{
    const struct zr_texture_map *own[ZR_TEXTURE_SLOTS];
    const int slots = finished ? ZR_TEXTURE_SLOTS : ZR_TEXTURE_COAT;
    out->slots = 0;
    for (int slot = 0; slot < slots; slot++) {
        own[slot] = zr_texture_map_of(maps, material, (enum zr_texture_slot)slot);
        if (own[slot]) out->slots |= 1u << slot;
    }
    for (unsigned left = out->slots; left;)
        left &= ~zr_sample_alike(own, left, texcoords, out);
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

/* Returns the unit vector along the surface that a direction between tangent and bitangent has, or 0 without a
 * tangent. x, y: of the direction; it is turned by the material's angle. */
static inline struct zr_vec3_v zr_direction_along_v(zr_vf x, zr_vf y, const float turn[2],
                                                    const struct zr_frame_v *frame)
{
    const struct zr_vec3_v normal = frame->normal, along = frame->along;
    const zr_vf cosine = zr_vf_set(turn[0]), sine = zr_vf_set(turn[1]);
    const struct zr_vec3_v tangent = zr_normalize_v(zr_minus_v(along, zr_scale_v(normal, zr_dot_v(normal, along))));
    const struct zr_vec3_v bitangent = zr_scale_v(zr_cross_v(normal, tangent), frame->sign);
    return zr_normalize_v(
        zr_add_v(zr_scale_v(tangent, x * cosine - y * sine), zr_scale_v(bitangent, x * sine + y * cosine)));
}

/* Positions in the G-buffer's order of values. */
enum {
    ZR_ROUGHNESS_VALUE = 3,
    ZR_METALLIC_VALUE,
    ZR_OCCLUSION_VALUE,
    ZR_EMISSIVE_VALUE,
    ZR_NORMAL_VALUE = 9,
    ZR_COAT_VALUE = 12,
    ZR_COAT_ROUGHNESS_VALUE,
    ZR_COAT_NORMAL_VALUE,
    ZR_SHEEN_VALUE = 17,
    ZR_FILM_VALUE = 20,
    ZR_FILM_THICKNESS_VALUE,
    ZR_TRANSMISSION_VALUE,
    ZR_THICKNESS_VALUE,
    ZR_ALONG_VALUE,
    ZR_ANISOTROPY_VALUE = 27
};

static inline void zr_take_three(zr_vf *out, zr_vm where, struct zr_vec3_v color)
{
    out[0] = zr_vf_select(where, color.x, out[0]);
    out[1] = zr_vf_select(where, color.y, out[1]);
    out[2] = zr_vf_select(where, color.z, out[2]);
}

#define HAS(slot)      (texels->slots >> ZR_TEXTURE_##slot & 1u)
#define TAKE(value, v) (out[value] = zr_vf_select(where, v, out[value]))

/* Sets the direction of anisotropy, and the factor of its strength. */
static inline void zr_take_anisotropy(zr_vf out[ZR_ROWS_MOST], const struct zr_material *material,
                                      const struct zr_texels_v *texels, const struct zr_frame_v *frame, zr_vm where)
{
    const zr_vf one = zr_vf_set(1.0f), two = zr_vf_set(2.0f);
    zr_vf x = one, y = zr_vf_set(0.0f);
    if (!(material->finish.anisotropy > 0.0f)) return;
    if (HAS(ANISOTROPY)) {
        const struct zr_vec3_v texel = texels->of[ZR_TEXTURE_ANISOTROPY];
        x = texel.x * two - one;
        y = texel.y * two - one;
        TAKE(ZR_ANISOTROPY_VALUE, texel.z);
    }
    zr_take_three(out + ZR_ALONG_VALUE, where, zr_direction_along_v(x, y, material->finish.along, frame));
}

/* Sets the values of surfaces without textures of finishes. */
static inline void zr_begin_finishes(struct zr_vec3_v normal, zr_vf out[ZR_ROWS_MOST])
{
    for (int k = ZR_COAT_VALUE; k < ZR_TEXTURE_VALUES_FINISHED; k++)
        out[k] = zr_vf_set(1.0f);
    for (int k = 0; k < 3; k++)
        out[ZR_ALONG_VALUE + k] = zr_vf_set(0.0f);
    out[ZR_COAT_NORMAL_VALUE] = normal.x;
    out[ZR_COAT_NORMAL_VALUE + 1] = normal.y;
    out[ZR_COAT_NORMAL_VALUE + 2] = normal.z;
}

static inline void zr_take_finishes(zr_vf out[ZR_ROWS_MOST], const struct zr_material *material,
                                    const struct zr_texels_v *texels, const struct zr_frame_v *frame, zr_vm where)
{
    const struct zr_vec3_v *of = texels->of;
    if (HAS(COAT)) TAKE(ZR_COAT_VALUE, of[ZR_TEXTURE_COAT].x);
    if (HAS(COAT_ROUGHNESS)) TAKE(ZR_COAT_ROUGHNESS_VALUE, of[ZR_TEXTURE_COAT_ROUGHNESS].y);
    if (HAS(COAT_NORMAL))
        zr_take_three(out + ZR_COAT_NORMAL_VALUE, where,
                      zr_mapped_normal_v(of[ZR_TEXTURE_COAT_NORMAL], material->coat_normal_scale, frame));
    if (HAS(SHEEN)) zr_take_three(out + ZR_SHEEN_VALUE, where, of[ZR_TEXTURE_SHEEN]);
    if (HAS(FILM)) TAKE(ZR_FILM_VALUE, of[ZR_TEXTURE_FILM].x);
    if (HAS(FILM_THICKNESS)) TAKE(ZR_FILM_THICKNESS_VALUE, of[ZR_TEXTURE_FILM_THICKNESS].y);
    if (HAS(TRANSMISSION)) TAKE(ZR_TRANSMISSION_VALUE, of[ZR_TEXTURE_TRANSMISSION].x);
    if (HAS(THICKNESS)) TAKE(ZR_THICKNESS_VALUE, of[ZR_TEXTURE_THICKNESS].y);
    zr_take_anisotropy(out, material, texels, frame, where);
}

/* Samples the textures of one material for the samples `where`. May be repeated for one material. */
static inline void zr_take_textures(zr_vf out[ZR_ROWS_MOST], const struct zr_texture_maps *maps,
                                    const struct zr_material *material, const struct zr_texcoords_v *texcoords,
                                    const struct zr_frame_v *frame, zr_vm where, bool finished)
{
    struct zr_texels_v own, *texels = &own;
    const struct zr_vec3_v *of = own.of;
    zr_texels_at(maps, material, texcoords, finished, texels);
    if (HAS(BASE_COLOR)) zr_take_three(out, where, of[ZR_TEXTURE_BASE_COLOR]);
    if (HAS(METALLIC_ROUGHNESS)) {
        TAKE(ZR_ROUGHNESS_VALUE, of[ZR_TEXTURE_METALLIC_ROUGHNESS].y);
        TAKE(ZR_METALLIC_VALUE, of[ZR_TEXTURE_METALLIC_ROUGHNESS].z);
    }
    if (HAS(OCCLUSION)) TAKE(ZR_OCCLUSION_VALUE, of[ZR_TEXTURE_OCCLUSION].x);
    if (HAS(EMISSIVE)) zr_take_three(out + ZR_EMISSIVE_VALUE, where, of[ZR_TEXTURE_EMISSIVE]);
    if (HAS(NORMAL))
        zr_take_three(out + ZR_NORMAL_VALUE, where,
                      zr_mapped_normal_v(of[ZR_TEXTURE_NORMAL], material->normal_scale, frame));
    if (finished) zr_take_finishes(out, material, texels, frame, where);
}
#undef HAS
#undef TAKE

/* Makes the texture values. Without a texture of a kind: 1, and the surface's own normal. */
ZR_INLINED void zr_make_values(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                               const struct zr_gbuffer *to, bool finished, zr_vf values[ZR_ROWS_MOST])
{
    const int tangent = zr_first_plane(mask, ZR_VARY_TANGENT);
    const struct zr_vec3_v normal = {zr_samples_load(in, to->normal[0]), zr_samples_load(in, to->normal[1]),
                                     zr_samples_load(in, to->normal[2])};
    for (int k = 0; k < ZR_NORMAL_VALUE; k++)
        values[k] = zr_vf_set(1.0f);
    values[ZR_NORMAL_VALUE] = normal.x;
    values[ZR_NORMAL_VALUE + 1] = normal.y;
    values[ZR_NORMAL_VALUE + 2] = normal.z;
    if (finished) zr_begin_finishes(normal, values);
    if (in->count == 0) return;
    const zr_vf w = zr_varying_w(in);
    const struct zr_texcoords_v texcoords = zr_texcoords_of(in, zr_first_plane(mask, ZR_VARY_TEXCOORDS), w);
    const struct zr_frame_v frame = {normal, zr_varying3(in, tangent, w), in->planes[tangent + 3][0]};
    const struct zr_material *done = NULL; /* usually there is one */
    for (uint32_t i = in->first; i < in->first + in->count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        zr_take_textures(values, &s->attributes->textures, material, &texcoords, &frame,
                         zr_samples_of_material(s, in, i), finished);
        done = material;
    }
}

/* Without and with values of finishes. context: the G-buffer. */
ZR_INLINED void zr_make_textures(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                 const void *context, zr_vf values[ZR_ROWS_MOST])
{
    zr_make_values(s, in, mask, context, false, values);
}

ZR_INLINED void zr_make_finished(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                 const void *context, zr_vf values[ZR_ROWS_MOST])
{
    zr_make_values(s, in, mask, context, true, values);
}

static inline struct zr_varying_rows zr_texture_rows_of(const struct zr_gbuffer *to)
{
    const struct zr_gbuffer_textures *t = to->textures;
    return (struct zr_varying_rows){
        {t->base[0],     t->base[1],        t->base[2],        t->roughness,      t->metallic,       t->occlusion,
         t->emissive[0], t->emissive[1],    t->emissive[2],    t->normal[0],      t->normal[1],      t->normal[2],
         t->coat,        t->coat_roughness, t->coat_normal[0], t->coat_normal[1], t->coat_normal[2], t->sheen[0],
         t->sheen[1],    t->sheen[2],       t->film,           t->film_thickness, t->transmission,   t->thickness,
         t->along[0],    t->along[1],       t->along[2],       t->anisotropy},
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
        zr_varyings_fill(s, tile, begin, end, GROUPS, zr_make_finished, to, ZR_TEXTURE_VALUES_FINISHED, &rows);
    else
        zr_varyings_fill(s, tile, begin, end, GROUPS, zr_make_textures, to, ZR_TEXTURE_VALUES, &rows);
}
