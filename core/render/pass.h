/* pass.h - render: one pass: the scene's geometry, attributes and visibility for one window, from which tiles are
 * drawn.
 *
 * Pixel centres, samples, and the depth maps from below and along lights each have a pass of their own.
 */
#ifndef ZR_PASS_H
#define ZR_PASS_H

#include "base/run.h"
#include "render/layers/layers.h"
#include "render/tiles.h"

struct zr_pass {
    struct zr_geometry geometry;
    struct zr_scene_attributes attributes;
    const struct zr_visibility *visibility;
    struct zr_layers_pool layers;
    struct zr_tile_source tiles;
};

/* Input of a pass: a scene, the camera and window, and the attributes to make. */
struct zr_pass_desc {
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct zr_window window;
    struct zr_attribute_wants wants; /* without textures, which zr_pass_make adds */
    bool untextured;                 /* makes no textures: colours, G-buffers and masks go without */
    const struct zr_base *base;      /* NULL: none */
};

/* Returns the window of a picture of that size with side x side samples per pixel. Line widths and point sizes, in
 * pixels of the picture, are scaled by side. */
struct zr_window zr_window_of(const struct zr_scene *scene, uint32_t width, uint32_t height, uint32_t side);

/* Makes the pass, which points into the arena, to the scene and camera, and into itself. Returns ZR_OK, ZR_CANCELLED,
 * ZR_NO_MEMORY, or ZR_INTERNAL if an algorithm fails its own checks. */
enum zr_status zr_pass_make(const struct zr_run *run, const struct zr_pass_desc *desc, struct zr_pass *pass);

/* Returns the counts of geometry, visibility and masked tiles. */
struct zr_counts zr_pass_counts(const struct zr_pass *pass);

#endif
