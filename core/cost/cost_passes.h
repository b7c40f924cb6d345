/* cost_passes.h - cost: passes that a scene is drawn in, and traits of a scene that decide about work and memory.
 *
 * Space:  views[0] of the scene.
 */
#ifndef ZR_COST_PASSES_H
#define ZR_COST_PASSES_H

#include "lines/cells.h"
#include "scene/camera/resolved_view.h"
#include "scene/picture.h"

/* Number of passes by kind. */
struct zr_cost_passes {
    double centres; /* at pixel centres: for channels and, in linear light, for occlusion */
    double samples; /* at side x side samples per pixel: 0 or 1 */
    double side;
    double maps, map_texels; /* shadow maps, that of the ground included, and their texels */
    uint32_t lamp_maps;      /* shadow maps of lights */
    bool makes_normals;      /* averages normals over faces */
    bool has_colors, has_masks, has_flow, has_walls, has_info;
    double channel_words; /* per pixel, of all channels */
};
struct zr_cost_passes zr_cost_passes_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved);

/* Returns words per pixel of the channels of a view. */
double zr_cost_channel_words(const struct zr_view *view);

/* True if surfaces are lit once in a pixel (effects/surfaces.h, render/layers/layer_surfaces.h). */
bool zr_cost_lights_surfaces(const struct zr_scene *scene);

/* True if edges are lines of the mesh. */
bool zr_cost_draws_lines(const struct zr_picture *picture);

/* Returns how often lines of the mesh are found: for a picture, and for a file. */
double zr_cost_line_times(const struct zr_scene *scene, const struct zr_cost_passes *passes);

/* Returns pixels of the window in which lines are found (lines/window_view.h) per pixel of a window that the scene
 * fills. */
double zr_cost_fine_pixels(double width, double height);

/* True if glass shows a picture of the other surfaces, which is drawn first. */
bool zr_cost_refracts(const struct zr_scene *scene);

/* Pixels of a cell in which lines are found (lines/cells.h). */
#define ZR_COST_CELL_PIXELS ((double)ZR_CELL_PIXELS * ZR_CELL_PIXELS)

#endif
