/* ids_simd.h - shade: the channels faceId and instanceId: a word for each part. */
#ifndef ZR_IDS_SIMD_H
#define ZR_IDS_SIMD_H

#include "shade/blocks_simd.h"
#include "shade/words_simd.h"

static inline void zr_make_instances(struct zr_shader *s, const struct zr_run *run)
{
    zr_put_words(s, run, zr_vi_set((int32_t)(run->batch ? run->batch->instance + 1 : 0)));
}

static inline void zr_make_faces(struct zr_shader *s, const struct zr_run *run)
{
    const struct zr_batch *batch = run->batch;
    if (!batch)
        zr_put_words(s, run, zr_vi_set((int32_t)s->nothing));
    else if (!batch->written)
        zr_put_words(s, run, zr_flat_face(batch, zr_run_numbers(s, run)));
    for (uint32_t i = run->first; batch && batch->written && i < run->first + run->count; i++) {
        s->words[i] = zr_face_id(s->geometry, batch, s->parts.owners[i] - 1);
        s->has_planes[i] = false;
    }
}

/* Ids, of which there are some for each run. */
static inline void zr_shade_ids(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                void (*make)(struct zr_shader *s, const struct zr_run *run),
                                const struct zr_pixel_rows *out)
{
    s->nothing = 0;
    s->any_planes = false;
    for (uint32_t i = 0; i < s->run_count; i++)
        make(s, &s->runs[i]);
    zr_finish_blocks(s, tile, begin, end, false, 1 + ZR_VALUES_FEW, NULL, out);
}

#endif
