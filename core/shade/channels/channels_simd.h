/* channels_simd.h - shade: table of the functions that make channels from owners. For the shading kernel.
 *
 * Most channels have a word per pixel, from a function of up to ZR_LANES primitives of one draw. Others are made from
 * parts (shader_simd.h). Clear values and names are in scene/channels.h.
 */
#ifndef ZR_CHANNELS_SIMD_H
#define ZR_CHANNELS_SIMD_H

#include "base/inlined.h"
#include "scene/channels.h"
#include "shade/blocks_simd.h"
#include "shade/varyings_simd.h"
#include "shade/words_simd.h"

/* The channel normals: three floats per pixel, unit length, of the visible side. context: float[3][3], from eye space
 * to the channel's. */
ZR_INLINED void zr_make_normals(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                const void *context, zr_vf values[ZR_ROWS_MOST])
{
    const float(*m)[3] = (const float(*)[3])context;
    (void)s;
    for (int k = 0; k < 3; k++)
        values[k] = zr_vf_set(0.0f);
    if (in->count == 0) return;
    const struct zr_vec3_v n = zr_normalize_v(zr_varying3(in, zr_first_plane(mask, ZR_VARY_NORMAL), zr_varying_w(in)));
    const struct zr_vec3_v out =
        zr_normalize_v((struct zr_vec3_v){zr_dot_v(zr_spread_v((zr_vec3){m[0][0], m[0][1], m[0][2]}), n),
                                          zr_dot_v(zr_spread_v((zr_vec3){m[1][0], m[1][1], m[1][2]}), n),
                                          zr_dot_v(zr_spread_v((zr_vec3){m[2][0], m[2][1], m[2][2]}), n)});
    values[0] = zr_vf_select(in->seen, out.x, values[0]);
    values[1] = zr_vf_select(in->seen, out.y, values[1]);
    values[2] = zr_vf_select(in->seen, out.z, values[2]);
}

static inline __attribute__((flatten)) void zr_shade_normals(struct zr_shader *s, const struct zr_tile *tile, int begin,
                                                             int end, const struct zr_tile_targets *to)
{
    float normals[3][ZR_TILE_STRIDE * ZR_TILE_SIZE];
    const struct zr_pixel_rows *out = &to->channels[ZR_CHANNEL_NORMALS];
    const struct zr_varying_rows rows = {{normals[0], normals[1], normals[2]}, ZR_TILE_STRIDE};
    const int32_t first = zr_block_low(begin), last = zr_block_low(end);
    zr_varyings_fill(s, tile, begin, end, ZR_VARY_NORMAL, zr_make_normals, to->normals_to_space, 3, &rows);
    for (int32_t y = first; y < last && y < tile->height; y++) {
        float *to_row = (float *)out->first + y * out->stride;
        for (int32_t x = 0; x < tile->width; x++)
            for (int k = 0; k < 3; k++)
                to_row[3 * x + k] = normals[k][y * ZR_TILE_STRIDE + x];
    }
}

/* The channels faceId and instanceId: a word per pixel. */
static inline zr_vi zr_face_id_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                     zr_vi numbers)
{
    (void)geometry;
    return zr_flat_number_v(of_draw->draw, ZR_RATE_FACE, numbers) + zr_vi_set((int32_t)of_draw->draw->first_id);
}

static inline zr_vi zr_instance_id_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                         zr_vi numbers)
{
    const int32_t instance = (int32_t)of_draw->draw->instance;
    (void)geometry;
    (void)numbers;
    return zr_vi_set(ZR_MUTANT(instances_from_0, instance + 1, instance));
}

/* The channel frontFacing: a word per pixel. Returns 1 for fronts, 2 for backs and 0 for lines. Edges of faces get 0,
 * too, though their colour depends on the visible side of their face. */
static inline zr_vi zr_front_facing_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                          zr_vi numbers)
{
    if (zr_draw_is_of_wires(of_draw->draw)) return zr_vi_set(0);
    const zr_vm backs = zr_flat_backs(geometry, of_draw, numbers);
    return zr_vi_select(backs, zr_vi_set(2), zr_vi_set(1));
}

/* WORDS(channel, function)
 * PARTS(channel, function): for blocks begin .. end - 1 of the tile, whose parts have been found */
#define ZR_CHANNEL_MAKERS(WORDS, PARTS)                                                                                \
    WORDS(FACE_ID, zr_face_id_words)                                                                                   \
    WORDS(INSTANCE_ID, zr_instance_id_words)                                                                           \
    WORDS(FRONT_FACING, zr_front_facing_words)                                                                         \
    PARTS(NORMALS, zr_shade_normals)

/* Returns the words of primitives `numbers` of a draw. */
typedef zr_vi zr_words_fn(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, zr_vi numbers);

/* Returns the words of pixels with these owners, draw by draw. s->draw is the last draw found. The lanes left are kept
 * as a mask, not as its bits: gcc 12 stored 16 of these bits by kmovw and loaded 32, and the loop never ended. */
ZR_INLINED zr_vi zr_words_of(struct zr_shader *s, zr_words_fn *words, zr_vi owners, zr_vi clear_value)
{
    zr_vm left = zr_vi_lt(zr_vi_set(0), owners);
    uint32_t each[ZR_LANES];
    zr_vi out = clear_value;
    while (zr_vm_any(left)) {
        const struct zr_draw *draw = s->draw;
        const zr_vi t = owners - zr_vi_set((int32_t)draw->first + 1), none = zr_vi_set(-1);
        const zr_vm of_draw = zr_vi_lt_where(zr_vi_lt(none, t), t, zr_vi_set((int32_t)draw->count));
        const zr_vi numbers = zr_vi_select(of_draw, t, zr_vi_set(0));
        left = zr_vm_andnot(left, of_draw);
        out = zr_vi_select(of_draw, words(s->geometry, zr_attributes_of_draw(s, draw), numbers), out);
        if (zr_vm_any(left)) {
            zr_vi_store(each, owners);
            s->draw = zr_draw_next(s->geometry, draw, each[zr_lowest_bit(zr_vm_bits(left))] - 1);
        }
    }
    return out;
}

ZR_INLINED void zr_shade_words(struct zr_shader *s, const struct zr_tile *tile, zr_words_fn *words,
                               uint32_t clear_value, const struct zr_pixel_rows *out)
{
    const struct zr_store to = {tile, false, NULL, out};
    const zr_vi none = zr_vi_set((int32_t)clear_value);
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        const bool is_whole = tile->has_block_owners && tile->block_owner[block] != ZR_BLOCK_SHARED;
        const uint32_t *owners = &tile->owner[zr_block_first(block)];
        if (is_whole) {
            const zr_vi owner = zr_vi_set((int32_t)tile->block_owner[block]);
            zr_store_alike(&to, block, zr_words_of(s, words, owner, none));
            continue;
        }
        for (int32_t y = 0; y < ZR_BLOCK_HEIGHT; y++, owners += ZR_TILE_STRIDE)
            for (int32_t x = 0; x < ZR_BLOCK_WIDTH; x += ZR_LANES)
                zr_store_pixels(&to, zr_block_left(block) + x, zr_block_low(block) + y,
                                zr_words_of(s, words, zr_vi_load(owners + x), none));
    }
}

#define ZR_SKIP(...)

/* Returns true if channels other than color need parts. */
static inline bool zr_wants_parts(const struct zr_tile_targets *to)
{
#define ZR_WANTS(channel, ...)                                                                                         \
    if (to->channels[ZR_CHANNEL_##channel].first) return true;
    ZR_CHANNEL_MAKERS(ZR_SKIP, ZR_WANTS)
#undef ZR_WANTS
    return false;
}

static inline void zr_shade_channels_of_parts(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                              const struct zr_tile_targets *to)
{
#define ZR_BY_PARTS(channel, shade)                                                                                    \
    if (to->channels[ZR_CHANNEL_##channel].first) shade(s, tile, begin, end, to);
    ZR_CHANNEL_MAKERS(ZR_SKIP, ZR_BY_PARTS)
#undef ZR_BY_PARTS
}

static inline void zr_shade_channels_of_words(struct zr_shader *s, const struct zr_tile *tile,
                                              const struct zr_tile_targets *to)
{
#define ZR_BY_WORDS(channel, words)                                                                                    \
    if (to->channels[ZR_CHANNEL_##channel].first)                                                                      \
        zr_shade_words(s, tile, words, zr_channel_rows[ZR_CHANNEL_##channel].clear_value,                              \
                       &to->channels[ZR_CHANNEL_##channel]);
    ZR_CHANNEL_MAKERS(ZR_BY_WORDS, ZR_SKIP)
#undef ZR_BY_WORDS
}
#undef ZR_SKIP

#endif
