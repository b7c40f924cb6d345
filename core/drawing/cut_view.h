/* cut_view.h - drawing: the section A-A.
 *
 * Which:  the view that looks across the plane becomes the section: the right view for x, the front view for z, the top
 *         view for y (of a world where y is up). It keeps its place and frame beside the other views.
 * Form:   ISO 128-40 and -50: the cutting line is a chain line with wide ends, arrows in the direction of sight, and
 *         letters, in the view beside; A-A above the section; hatches at 45 degrees, at 135 for every other part. Hidden
 *         lines are left out. */
#ifndef ZR_CUT_VIEW_H
#define ZR_CUT_VIEW_H

#include "base/run.h"
#include "drawing/placed_views.h"
#include "sections/sections.h"

/* Lines of the letters and arrows reach so far from the view: millimetres. */
#define ZR_CUT_REACH 12.0

/* Sets is_cut and so on. `axis`: 0 to 2 of the world; `share`: of its extent. */
void zr_cut_view_choose(struct zr_placed_views *placed, const struct zr_bounds *bounds, int axis, double share);

/* Cuts the scene, in run->arena. Fails as zr_sections_make. */
enum zr_status zr_cut_view_scene(const struct zr_run *run, const struct zr_scene *scene, const struct zr_bounds *bounds,
                                 const struct zr_placed_views *placed, const struct zr_sections_cut **out);

/* Adds the hatches of the section to the plot's group. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_cut_view_hatch(const struct zr_run *run, struct zr_plot *plot, const struct zr_placed_views *placed,
                                 const struct zr_scene *cut);

/* Adds cutting line, arrows, letters and label, in a group "section". Sets the boxes of both ends and of the label. */
enum { ZR_CUT_BOXES = 3 };
void zr_cut_view_mark(struct zr_plot *plot, const struct zr_placed_views *placed,
                      struct zr_page_box boxes[ZR_CUT_BOXES]);

#endif
