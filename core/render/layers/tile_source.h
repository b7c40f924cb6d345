/* tile_source.h - render: the input of a window's tiles: scene, geometry, attributes and visibility. */
#ifndef ZR_TILE_SOURCE_H
#define ZR_TILE_SOURCE_H

#include "raster/visibility.h"
#include "shade/draw_attributes.h"

struct zr_layers_pool; /* layers.h */
struct zr_solid_boxes; /* solid_boxes.h */

struct zr_tile_source {
    const struct zr_scene *scene;
    const struct zr_geometry *geometry;
    const struct zr_scene_attributes *attributes;
    const struct zr_visibility *visibility;
    enum zr_isa isa;

    /* Masked and blended surfaces. */
    struct zr_layers_pool *layers;       /* NULL: none */
    bool any_masked, any_blended;        /* any_blended: only if colours are drawn */
    const struct zr_solid_boxes *solids; /* boxes of operands (scene/csg.h); NULL: none are drawn */
};

#endif
