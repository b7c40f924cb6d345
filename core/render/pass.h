/* pass.h - render: the scene drawn once, in a window of some size: all that tiles are made from.
 *
 * A picture takes some of them: of pixels' centres, of samples, of maps from below or along a lamp's light.
 */
#ifndef ZR_PASS_H
#define ZR_PASS_H

#include "render/layers.h"
#include "render/tiles.h"

struct zr_pass {
    struct zr_geometry geometry;
    struct zr_scene_attributes surfaces;
    const struct zr_visibility *visibility;
    struct zr_layers_pool layers;
    struct zr_tile_source tiles;
};

/* Describes a pass: a scene, the camera with its window, and the attributes of surfaces that it needs. */
struct zr_pass_desc {
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct zr_window window;
    struct zr_attribute_wants wants; /* but its textures, which zr_pass_make makes */
    bool untextured;                 /* else colours and G-buffers have their textures, and masks theirs */
    const struct zr_base *base;      /* NULL: none */
};

/* The window of a picture of that size at side x side samples a pixel. Lines are as wide as the scene's are in pixels
 * of the picture, and points as large. */
struct zr_window zr_window_of(const struct zr_scene *scene, uint32_t width, uint32_t height, uint32_t side);

/* Decides what tiles hold. The pass points into the arena, to the scene and the camera, and into itself. ZR_OK,
 * ZR_CANCELLED, ZR_NO_MEMORY, or ZR_INTERNAL where an algorithm finds itself wrong. */
enum zr_status zr_pass_make(struct zr_arena *arena, struct zr_team *team, const struct zr_pass_desc *desc,
                            const struct zr_cancel *cancel, struct zr_pass *pass);

/* What was clipped, turned away and so on. */
struct zr_counts zr_pass_counts(const struct zr_pass *pass);

#endif
