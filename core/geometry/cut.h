/* cut.h - geometry: what clipping made of a primitive, so that whatever varies over it can be cut alike.
 *
 * Clipping knows no attribute. It writes vertices as {from, to, t}; values of any kind are extended by the same
 * arithmetic, rule 3, whoever makes them and whenever.
 */
#ifndef ZR_CUT_H
#define ZR_CUT_H

#include "geometry/clip.h"

struct zr_cut {
    uint32_t first_vertex;    /* of those that are left, which follow one another */
    uint32_t corners[3];      /* of what was cut: positions of the mesh; of a line two */
    uint32_t slots[3];        /* and their slots of mesh->indices; of a line of the mesh 0 */
    uint8_t count;            /* vertices that are left: */
    uint8_t ids[ZR_CLIP_MAX]; /* numbers of values, as in zr_clip_replay */
    uint8_t corner_count;     /* 3, of a line 2 */
    uint8_t made_count;
    const struct zr_clip_made *made;
};

/* The values of the vertices that are left, to out[], from those of the corners: `values`, of which corner k has that
 * with the number numbers[k]. */
static inline void zr_cut_values(const struct zr_cut *cut, const zr_vec4 *values, const uint32_t numbers[3],
                                 zr_vec4 *out)
{
    zr_vec4 all[ZR_CLIP_VALUES];
    for (int k = 0; k < cut->corner_count; k++)
        all[k] = values[numbers[k]];
    zr_clip_replay(cut->made, cut->made_count, cut->corner_count, all);
    for (int i = 0; i < cut->count; i++)
        out[i] = all[cut->ids[i]];
}

#endif
