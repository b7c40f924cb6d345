/* channels_simd.h - shade: table of the functions that make channels from owners. For the shading kernel.
 *
 * Most channels have a word per pixel, from a function of up to ZR_LANES primitives of one draw. Others are made from
 * parts (shader_simd.h). Clear values and names are in scene/channels.h.
 */
#ifndef ZR_CHANNELS_SIMD_H
#define ZR_CHANNELS_SIMD_H

#include "base/inlined.h"
#include "shade/blocks_simd.h"
#include "shade/channels/front_facing_simd.h"
#include "shade/channels/ids_simd.h"
#include "shade/channels/normals_simd.h"

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
