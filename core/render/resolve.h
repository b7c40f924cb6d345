/* resolve.h - render: writes the pixels of a tile in every channel.
 *
 * Colour and depth are planes over the window (raster/plane.h), recomputed for the visible primitives.
 * Exact:  colour follows the reference's rule 9 (tests/reference/RULES.md).
 */
#ifndef ZR_RESOLVE_H
#define ZR_RESOLVE_H

#include "base/isa.h"
#include "raster/tile.h"
#include "scene/channels.h"
#include "shade/draw_attributes.h"
#include "shade/frame.h"
#include "shade/paint.h"

/* A tile's share of the frame's totals. */
struct zr_resolved {
    uint32_t covered; /* pixels that a primitive covers */
    float deepest;    /* greatest finite value of the channel depth; 0: none */
};

/* Writes the tile's part of each channel of `frame`, with the kernels of `isa`. Overwrites the tile's depths. Different
 * tiles may be resolved by different threads at once. */
struct zr_resolved zr_resolve_tile(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                                   enum zr_isa isa, const struct zr_scene *scene, struct zr_tile *tile,
                                   const struct zr_frame *frame);

/* Returns the tile's rows in a channel; `first` is NULL if the frame lacks the channel. */
struct zr_pixel_rows zr_resolve_rows(const struct zr_frame *frame, const struct zr_tile *tile, enum zr_channel channel);

#endif
