/* stamp_simd.h - raster: coverage of 4x4 samples by one triangle per lane, for kernels.
 *
 * Space:  a stamp is 4x4 samples: the coverage of a triangle of a fine mesh mostly fits in one. Its samples are bits,
 *         ZR_STAMP * row + column.
 * Exact:  the reference's rule 7. */
#ifndef ZR_STAMP_SIMD_H
#define ZR_STAMP_SIMD_H

#include "raster/triangle_simd.h"

enum { ZR_STAMP = 4, ZR_STAMP_SAMPLES = ZR_STAMP * ZR_STAMP };
enum { ZR_HAS_STAMPS = (int)ZR_LANES >= (int)ZR_STAMP }; /* no gain with one sample at a time */
_Static_assert((int)ZR_STAMP_SAMPLES <= 31, "one bit per sample");

/* Returns the covered samples, one bit each. Edges are those at the stamp's first sample. */
static inline zr_vi zr_stamp_covered(const struct zr_edge_v edges[3])
{
    zr_vi row[3], outside = zr_vi_set(0);
    for (int k = 0; k < 3; k++)
        row[k] = edges[k].at + (edges[k].right + edges[k].up) * zr_vi_set(ZR_STAMP - 1);
    for (int y = 0; y < ZR_STAMP; y++) { /* from the last sample to the first */
        zr_vi at[3] = {row[0], row[1], row[2]};
        for (int x = 0; x < ZR_STAMP; x++) {
            outside = outside + outside - ((at[0] | at[1] | at[2]) >> 31);
            for (int k = 0; k < 3; k++)
                at[k] -= edges[k].right;
        }
        for (int k = 0; k < 3; k++)
            row[k] -= edges[k].up;
    }
    return ~outside & zr_vi_set((1 << ZR_STAMP_SAMPLES) - 1);
}

/* Lists the covered samples of ZR_LANES triangles as triangle * ZR_STAMP_SAMPLES + sample, and returns their number.
 * Pads the list to a whole vector with its last entry. */
enum { ZR_STAMP_LIST = ZR_STAMP_SAMPLES * ZR_LANES + ZR_LANES };
static inline uint32_t zr_stamp_list(const uint32_t covered[ZR_LANES], uint32_t samples[ZR_STAMP_LIST])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < ZR_LANES; i++)
        for (uint32_t s = 0; s < ZR_STAMP_SAMPLES; s += ZR_LANES)
            count +=
                zr_vi_list_bits(samples + count, covered[i] >> s & ZR_ALL_BITS, (int32_t)(i * ZR_STAMP_SAMPLES + s));
    if (count > 0) zr_vi_store(samples + count, zr_vi_set((int32_t)samples[count - 1]));
    return count;
}

#endif
