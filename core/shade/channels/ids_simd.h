/* ids_simd.h - shade: the channels faceId and instanceId: a word per pixel. */
#ifndef ZR_IDS_SIMD_H
#define ZR_IDS_SIMD_H

#include "shade/words_simd.h"

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

#endif
