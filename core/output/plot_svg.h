/* plot_svg.h - output: a technical drawing as SVG.
 *
 * Space:  millimetres; the size of the file is that of the paper.
 * Form:   a group per view or table, with its name as id; in it, a group per run of items with one pen, with the pen's
 *         name as class. Lines and letters are paths. A text is a group with role="img" and the text as aria-label.
 *         The root has the scale as data-scale.
 * Exact:  coordinates have up to 6 decimals. The same bytes for every machine, LC_NUMERIC being "C". */
#ifndef ZR_PLOT_SVG_H
#define ZR_PLOT_SVG_H

#include "base/cancel.h"
#include "base/status.h"
#include "drawing/plot.h"
#include "output/bytes/buffer.h"

/* Appends the file. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_plot_svg_write(const struct zr_plot *plot, const struct zr_cancel *cancel, struct zr_buffer *out);

#endif
