/* tile_source.h - render: what the tiles of a window are made from. */
#ifndef ZR_TILE_SOURCE_H
#define ZR_TILE_SOURCE_H

#include "raster/visibility.h"
#include "shade/draw_attributes.h"

struct zr_layers_pool; /* layers.h */

/* What tiles are made from. */
struct zr_tile_source {
    const struct zr_scene *scene;
    const struct zr_geometry *geometry;
    const struct zr_scene_attributes *surfaces;
    const struct zr_visibility *visibility;
    enum zr_isa isa;

    /* Of what is see-through. */
    struct zr_layers_pool *layers; /* NULL: nothing is */
    bool any_masked, any_blended;  /* blended: and colours are wanted */
};

#endif
