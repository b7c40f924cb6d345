/* drawing.h - lines, entry point of the room: scene and camera -> polylines and ink of a line drawing.
 *
 *     mesh/edge_mesh.h    welded edges of each mesh
 *     window_mesh.h       triangles in the window
 *     smooth_normal.h     normals for creases
 *     features.h          borders, contours, creases
 *     chains.h            hysteresis of creases
 *     lines.h             segments in the window
 *     cells.h             lists of triangles per 16 x 16 pixels
 *     intersections.h     lines between pieces
 *     hidden_parts.h      exact visibility
 *     line_pieces.h       visible and hidden pieces, seams
 *     contour_steps.h     contours that nothing lies behind
 *     coincident.h        hidden pieces that coincide
 *     polylines.h         joined lines, from here on in the window of the description
 *     strokes.h           ink
 */
#ifndef ZR_DRAWING_H
#define ZR_DRAWING_H

#include "base/run.h"
#include "lines/features.h"
#include "lines/strokes.h"

struct zr_drawing_desc {
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    const struct zr_bounds *bounds; /* of the geometry */
    uint32_t width, height;         /* pixels */
    struct zr_feature_rule rule;
    bool has_hidden; /* hidden lines are drawn as well */
    double straight; /* points closer to a straight line go: fine pixels; 0: ZR_POLYLINE_STRAIGHT */
};

/* A drawing before strokes. */
struct zr_drawing {
    struct zr_window_mesh mesh; /* in the fine window (window_view.h) */
    struct zr_lines lines;      /* likewise */
    struct zr_polylines polylines;
};

/* Makes the polylines, in the arena. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_drawing_make(const struct zr_run *run, const struct zr_drawing_desc *desc, struct zr_drawing *out);

#endif
