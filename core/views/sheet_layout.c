#include "views/sheet_layout.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "overlay/glyphs.h"

/* Rows of the sheet per dot of glyphs; sizes in dots. */
enum { HEIGHT_PER_DOT = 480, GUTTER = 4, ABOVE = 3, BELOW = 2, SIDE_LEAST = 16 };

bool zr_sheet_lay_out(const struct zr_sheet *sheet, uint32_t count, uint32_t width, uint32_t height,
                      struct zr_sheet_layout *layout)
{
    const uint32_t shorter = width < height ? width : height;
    uint32_t columns = sheet->columns ? sheet->columns : (uint32_t)ceil(sqrt((double)count));
    if (columns > count) columns = count;
    *layout = (struct zr_sheet_layout){.columns = columns, .rows = (count + columns - 1) / columns};
    layout->dot = zr_greater(1, (int32_t)((shorter + HEIGHT_PER_DOT / 2) / HEIGHT_PER_DOT));
    layout->gutter = GUTTER * layout->dot;
    layout->caption = sheet->has_captions ? (ABOVE + ZR_GLYPH_ROWS + BELOW) * layout->dot : 0;
    const int64_t across = (int64_t)width - (int64_t)layout->gutter * (columns + 1);
    const int64_t down =
        (int64_t)height - (int64_t)layout->gutter * (layout->rows + 1) - (int64_t)layout->caption * layout->rows;
    if (across < (int64_t)SIDE_LEAST * columns || down < (int64_t)SIDE_LEAST * layout->rows) return false;
    layout->width = (int32_t)(across / columns);
    layout->height = (int32_t)(down / layout->rows);
    return true;
}

struct zr_box zr_sheet_box(const struct zr_sheet_layout *layout, uint32_t number)
{
    const int32_t column = (int32_t)(number % layout->columns), row = (int32_t)(number / layout->columns);
    return (struct zr_box){layout->gutter + column * (layout->width + layout->gutter),
                           layout->gutter + row * (layout->height + layout->caption + layout->gutter), layout->width,
                           layout->height};
}

void zr_sheet_put(const struct zr_sheet_layout *layout, uint32_t number, const uint8_t *pixels,
                  const struct zr_canvas *sheet)
{
    const struct zr_box box = zr_sheet_box(layout, number);
    const size_t row = (size_t)box.width * sizeof *sheet->pixels;
    for (int32_t y = 0; y < box.height; y++)
        memcpy(sheet->pixels + (size_t)(box.y + y) * (size_t)sheet->width + (size_t)box.x, pixels + (size_t)y * row,
               row);
}

void zr_sheet_write(const struct zr_sheet_layout *layout, uint32_t number, const char *const *texts, int count,
                    const struct zr_canvas *sheet)
{
    const struct zr_box view = zr_sheet_box(layout, number);
    const int32_t dot = layout->dot, room = view.width / dot;
    const struct zr_box below = {view.x, view.y + view.height, view.width, layout->caption};
    char text[160];
    int k = 0;
    while (k < count - 1 && zr_glyphs_width(texts[k]) > room)
        k++;
    const size_t length = strnlen(texts[k], sizeof text - 1);
    memcpy(text, texts[k], length);
    text[length] = '\0';
    for (size_t end = length; end > 0 && zr_glyphs_width(text) > room;) /* whole characters of UTF-8 are cut */
        do
            text[--end] = '\0';
        while (end > 0 && ((unsigned char)texts[k][end] & 0xc0) == 0x80);
    const uint32_t ink = zr_canvas_ink(zr_canvas_median(sheet, below));
    const int32_t x = view.x + (view.width - zr_glyphs_width(text) * dot) / 2;
    zr_glyphs_draw(sheet, text, x, view.y + view.height + ABOVE * dot, dot, 0, ink);
}
