/* view_lines.h - drawing: the lines of one view of a technical drawing, visible and hidden.
 *
 * Space:  lengths of the scene along the right and the up axis of the view, which are exact axes of the world but for the
 *         isometric one. Coordinates are those of the scene, not pixels: they are brought back in doubles by the floats
 *         of the camera.
 * How:    lines/drawing.h with an orthographic camera; straight lines keep no points between their ends, and all other
 *         points are kept. */
#ifndef ZR_VIEW_LINES_H
#define ZR_VIEW_LINES_H

#include "base/dvec3.h"
#include "base/run.h"
#include "drawing/page.h"
#include "lines/polylines.h"
#include "scene/camera/camera.h"

struct zr_view_axes {
    zr_dvec3 right, up, back; /* unit vectors; back: towards the eye */
};

struct zr_view_lines {
    struct zr_view_axes axes;
    double low[2], high[2]; /* extent along right and up */
    struct zr_polylines lines;
};

/* Returns the axes of a view. `z_is_up`: of the world; else y. */
struct zr_view_axes zr_view_axes_of(enum zr_page_view view, bool z_is_up);

/* Makes the lines, in the arena. `scene` draws both sides of its faces, `bounds` are valid and not a point. Returns ZR_OK,
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_view_lines_make(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_bounds *bounds, struct zr_view_axes axes, bool has_hidden,
                                  struct zr_view_lines *out);

#endif
