/* plot_png.h - output: a technical drawing as PNG, by the pens of overlay/.
 *
 * Size:   that of the paper, rounded to whole pixels; the file has the resolution. */
#ifndef ZR_PLOT_PNG_H
#define ZR_PLOT_PNG_H

#include "base/run.h"
#include "base/status.h"
#include "drawing/plot.h"
#include "output/bytes/buffer.h"

#define ZR_PLOT_DPI_LEAST 30.0
#define ZR_PLOT_DPI_MOST  600.0

/* Appends the file. `dpi`: pixels per inch. Pixels are in run->scratch. Returns ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED or
 * ZR_INTERNAL. */
enum zr_status zr_plot_png_write(const struct zr_run *run, const struct zr_plot *plot, double dpi,
                                 struct zr_buffer *out);

#endif
