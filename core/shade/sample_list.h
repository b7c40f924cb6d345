/* sample_list.h - shade: values of the visible surfaces at some places of a tile, in any order. A kernel.
 *
 * How:    planes of a primitive are set up once for all its places in a list.
 * Exact:  at samples, the same bytes as those of zr_paint.samples. */
#ifndef ZR_SAMPLE_LIST_H
#define ZR_SAMPLE_LIST_H

#include "base/isa.h"
#include "raster/tile.h"
#include "shade/draw_attributes.h"
#include "shade/lights/gbuffer.h"

enum { ZR_SAMPLES_LISTED = 1024, ZR_SAMPLES_ROOM = ZR_SAMPLES_LISTED + 16 /* vectors fit at the end */ };

struct zr_sample_list {
    uint32_t count;
    _Alignas(64) float x[ZR_SAMPLES_ROOM]; /* in samples of the window; also between them */
    float y[ZR_SAMPLES_ROOM];
    uint32_t owner[ZR_SAMPLES_ROOM]; /* of covered samples only */
};

/* Memory of the kernel, of any content. On a stack of its own, a call would touch each of its pages. */
struct zr_sample_room {
    _Alignas(64) unsigned char bytes[384 << 10];
};

/* Writes the values to a G-buffer of one row, without owners. Base colours, materials and opacities are optional.
 * Up to 15 values behind the last may be written. */
typedef void zr_samples_at_fn(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                              const struct zr_sample_list *list, struct zr_sample_room *room,
                              const struct zr_gbuffer *to);

ZR_KERNEL_TABLE(zr_samples_at_fn, zr_samples_at)

#endif
