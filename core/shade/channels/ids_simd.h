/* ids_simd.h - shade: the channels faceId and instanceId: a word for each part. */
#ifndef ZR_IDS_SIMD_H
#define ZR_IDS_SIMD_H

#include "shade/blocks_simd.h"
#include "shade/words_simd.h"

static inline zr_vi zr_face_id_words(const struct zr_shader *s, const struct zr_run *run)
{
    return zr_flat_face(run->draw, zr_run_numbers(s, run));
}

static inline zr_vi zr_instance_id_words(const struct zr_shader *s, const struct zr_run *run)
{
    (void)s;
    return zr_vi_set(ZR_MUTANT(instances_from_0, (int32_t)run->draw->instance + 1, (int32_t)run->draw->instance));
}

#endif
