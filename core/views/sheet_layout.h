/* sheet_layout.h - views: places of views and captions on a sheet.
 *
 * Space:  pixels of the sheet, (0, 0) at the top left corner. A view is drawn into its box pixel by pixel.
 * Sizes:  gutters and captions grow with the sheet, as the colour bar does. Captions are lower if views are narrow, so
 *         that some 32 letters have room. */
#ifndef ZR_SHEET_LAYOUT_H
#define ZR_SHEET_LAYOUT_H

#include "overlay/canvas.h"
#include "scene/sheet.h"

struct zr_sheet_layout {
    uint32_t columns, rows;
    int32_t width, height; /* of a view */
    int32_t gutter;        /* around each view */
    int32_t letters;       /* height of capitals */
    int32_t caption;       /* height of a caption; 0: none */
};

/* Places `count` views on a sheet of width x height pixels. False if views have fewer than 16 pixels on a side. */
bool zr_sheet_lay_out(const struct zr_sheet *sheet, uint32_t count, uint32_t width, uint32_t height,
                      struct zr_sheet_layout *layout);

/* Returns the box of a view. */
struct zr_box zr_sheet_box(const struct zr_sheet_layout *layout, uint32_t number);

/* Copies a view's pixels into its box. */
void zr_sheet_put(const struct zr_sheet_layout *layout, uint32_t number, const uint8_t *pixels,
                  const struct zr_canvas *sheet);

/* Writes a caption in the middle below a view: the first of the texts that has room, or the beginning of the last. */
void zr_sheet_write(const struct zr_sheet_layout *layout, uint32_t number, const char *const *texts, int count,
                    const struct zr_canvas *sheet);

#endif
