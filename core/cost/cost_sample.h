/* cost_sample.h - cost: window area that faces, lines and points cover, estimated from a sample of them (cost.h).
 *
 * Exact:  the sample is pseudo-random, and the same on every machine.
 */
#ifndef ZR_COST_SAMPLE_H
#define ZR_COST_SAMPLE_H

#include "scene/camera/resolved_view.h"

/* Sums over a sample of the faces, lines and points of a scene, in pixels of the window. */
struct zr_cost_sample {
    const struct zr_scene *scene;
    double width, height; /* of the window, pixels */
    double scale;         /* faces, lines and points of the scene per one of the sample; 0 without any */
    double faces, fragments, line_fragments, layered;
    double runs;                         /* faces with another material than the face before */
    double outlines;                     /* edges drawn as lines */
    double shape_corners, shape_samples; /* faces that are not convex: squared corners; pixels times corners */
    double kept; /* lower bound of the translucent fragments of the scene, not of the sample, for memory */
    double lit, lamps, placed_lamps, shadows; /* lit fragments; the others times lights of their material */
    double textures;                          /* fragments times textures */
    double vertex_lamps, vertex_placed_lamps; /* lit vertices and faces, times lights */
    double boxes_width, boxes_height;         /* sums over the boxes of faces, pixels */
    double cap_corners;                       /* faces that planes of sections cross; once per plane */
    double crossing; /* lower bound of the share of pairs of drawn faces that cut one another */
};

struct zr_cost_sample zr_cost_sample_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved);

#endif
