/* resolve.h - render: the visibility of a tile -> its pixels in every channel.
 *
 * Colour and depth are planes over the window (raster/plane.h), made again for the
 * primitives that are seen. Exact: colour follows the reference's rule 9.
 */
#ifndef ZR_RESOLVE_H
#define ZR_RESOLVE_H

#include "base/isa.h"
#include "raster/tile.h"
#include "shade/draw_attributes.h"
#include "shade/frame.h"
#include "shade/paint.h"

/* What a tile adds to what is known of all of the frame. */
struct zr_resolved {
    uint32_t covered; /* pixels that belong to a primitive */
    float deepest;    /* of the depth channel, infinity left out; 0 where there is none */
};

/* With the kernels of `isa`, writes the tile's part of each channel that `frame` has. The tile is used up. One writer a
 * pixel: different tiles may be resolved at once. */
struct zr_resolved zr_resolve_tile(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                                   enum zr_isa isa, const struct zr_scene *scene, struct zr_tile *tile,
                                   const struct zr_frame *frame);

/* Where the tile lies in a channel; `first` is NULL where the frame has it not. */
struct zr_pixel_rows zr_resolve_rows(const struct zr_frame *frame, const struct zr_tile *tile, enum zr_channel channel);

#endif
