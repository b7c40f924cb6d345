/* line_sheet.h - lines: the polylines of a drawing by part, without the meshes.
 *
 * Space:  window, pixels, y up.
 * Parts:  those of scene/parts/part_list.h. Beyond ZR_SHEET_PARTS_MOST, the lines of all other parts are in one more,
 *         without a name. A line between two parts belongs to the part of its first triangle.
 * Length: of a pixel in world units, if all points have the same scale: rays are parallel, and pixels square. */
#ifndef ZR_LINE_SHEET_H
#define ZR_LINE_SHEET_H

#include "base/run.h"
#include "lines/drawing.h"

enum { ZR_SHEET_PARTS_MOST = 1000 };

struct zr_line_sheet {
    struct zr_polylines lines;
    const uint32_t *parts; /* by polyline */
    uint32_t part_count;
    const char *const *part_names; /* by part: UTF-8, "": none */
    double pixel;                  /* world units; 0: of no scale */
};

/* Copies a drawing of the scene to `arena`; the copy does not point to the scene. Returns ZR_OK, ZR_NO_MEMORY or
 * ZR_CANCELLED. */
enum zr_status zr_line_sheet_make(const struct zr_run *run, const struct zr_drawing_desc *desc,
                                  const struct zr_drawing *drawing, struct zr_line_sheet *out);

#endif
