/* channels_simd.h - shade: the channels that are made of parts, a row each; for the kernel that shades.
 *
 * Most are a word for each part, given by a function that gets a run of parts, all of one draw: ZR_LANES words. Others
 * do all of it themselves. What is where nobody is seen, and all names, are in scene/channels.h.
 */
#ifndef ZR_CHANNELS_SIMD_H
#define ZR_CHANNELS_SIMD_H

#include "shade/channels/front_facing_simd.h"
#include "shade/channels/ids_simd.h"
#include "shade/channels/normals_simd.h"

struct zr_channel_maker {
    enum zr_channel channel;
    zr_vi (*words)(const struct zr_shader *s, const struct zr_run *run);
    /* Or, where that is NULL: blocks begin .. end - 1 of the tile, whose parts have been found. */
    void (*shade)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end, const struct zr_shaded *to);
};

static const struct zr_channel_maker zr_channel_makers[] = {
    {ZR_CHANNEL_FACE_ID, zr_face_id_words, NULL},
    {ZR_CHANNEL_INSTANCE_ID, zr_instance_id_words, NULL},
    {ZR_CHANNEL_FRONT_FACING, zr_front_facing_words, NULL},
    {ZR_CHANNEL_NORMALS, NULL, zr_shade_normals},
};

enum { ZR_CHANNEL_MAKERS = sizeof zr_channel_makers / sizeof zr_channel_makers[0] };

static inline void zr_shade_channel(struct zr_shader *s, const struct zr_channel_maker *maker,
                                    const struct zr_tile *tile, int begin, int end, const struct zr_shaded *to)
{
    const struct zr_pixel_rows *out = &to->channels[maker->channel];
    if (!out->first) return;
    if (maker->shade) {
        maker->shade(s, tile, begin, end, to);
        return;
    }
    s->nothing = zr_channel_rows[maker->channel].nothing;
    s->any_planes = false;
    for (uint32_t i = 0; i < s->run_count; i++) {
        const struct zr_run *run = &s->runs[i];
        zr_put_words(s, run, run->draw ? maker->words(s, run) : zr_vi_set((int32_t)s->nothing));
    }
    zr_finish_blocks(s, tile, begin, end, false, 1 + ZR_VALUES_FEW, NULL, out);
}

#endif
