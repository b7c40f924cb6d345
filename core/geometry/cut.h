/* cut.h - geometry: record of one clipped primitive, by which its attributes are clipped later.
 *
 * Clipping handles positions only. It records each new vertex as {from, to, t}; values of any kind are extended by the
 * same arithmetic (rule 3) when they are needed. */
#ifndef ZR_CUT_H
#define ZR_CUT_H

#include "geometry/clip.h"

struct zr_cut {
    uint32_t first_vertex;    /* first of the remaining vertices, which are consecutive */
    uint32_t corners[3];      /* of the clipped primitive: positions of the mesh; a line has two */
    uint32_t slots[3];        /* of the corners, into mesh->indices; 0 for a line of the mesh */
    uint8_t count;            /* number of remaining vertices */
    uint8_t ids[ZR_CLIP_MAX]; /* their value numbers, as in zr_clip_replay */
    uint8_t corner_count;     /* 3, or 2 for a line */
    uint8_t made_count;
    const struct zr_clip_made *made;
};

/* Writes the values of the remaining vertices to out[]. Corner k has the value values[numbers[k]]. */
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
