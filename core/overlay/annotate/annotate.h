/* annotate.h - overlay: dimensions, labels, title, triad and scale bar of a finished frame.
 *
 * Input:  the camera, the bounds and the faces per pixel of a frame; words, title and dimensions of its view. Numbers
 *         and axes are those of the file, not of the world that a bare mesh is turned to.
 * Output: marks (overlay/marks.h) for the picture and for SVG, and what found no room. Data channels have no marks.
 * Sizes:  by the shorter side of the window; scene/camera/margins.h leaves room for them in fitted views.
 * Order:  title, triad, scale bar, dimensions of the box, given dimensions, notes of holes, labels. Each takes only
 *         places that are free, in a fixed order: the same marks on every machine. */
#ifndef ZR_ANNOTATE_H
#define ZR_ANNOTATE_H

#include "base/run.h"
#include "overlay/annotate/layout.h"

struct zr_annotations {
    struct zr_marks marks;
    uint32_t left_out_count, numbered_count;
    const struct zr_left_out *left_out;
    const struct zr_numbered_part *numbered;
    uint32_t causes[ZR_LEFT_OUT_CAUSES]; /* how many marks are left out by each */
};

/* Makes the marks of a frame, in `arena`. *out is NULL if the view asks for none. The view has the
 * output color. A view with a lens has a title and a
 * triad only. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_annotations_make(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                                   const struct zr_annotations **out);

/* Draws the marks over frame->color, if there is one. Returns ZR_OK or ZR_CANCELLED. */
enum zr_status zr_annotations_draw(const struct zr_run *run, const struct zr_annotations *annotations,
                                   struct zr_frame *frame);

#endif
