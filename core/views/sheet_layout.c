#include "views/sheet_layout.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "overlay/type.h"

/* A gutter is four pixels per 480 of the sheet's shorter side. */
enum { GUTTER = 4, SIDE_PER_GUTTER = 480, SIDE_LEAST = 16, WIDTH_PER_LETTERS = 25 };

/* Height of a caption and of what is above its capitals, per height of letters. */
#define CAPTION 2.0
#define ABOVE   0.43

/* Returns the height of letters in captions of views of that width. */
static int32_t letters_of(int32_t view_width, uint32_t width, uint32_t height)
{
    const int32_t most = (int32_t)zr_type_height((int32_t)width, (int32_t)height);
    return zr_greater((int32_t)ZR_TYPE_LEAST, zr_lesser(most, view_width / WIDTH_PER_LETTERS));
}

bool zr_sheet_lay_out(const struct zr_sheet *sheet, uint32_t count, uint32_t width, uint32_t height,
                      struct zr_sheet_layout *layout)
{
    const uint32_t shorter = width < height ? width : height;
    uint32_t columns = sheet->columns ? sheet->columns : (uint32_t)ceil(sqrt((double)count));
    if (columns > count) columns = count;
    *layout = (struct zr_sheet_layout){.columns = columns, .rows = (count + columns - 1) / columns};
    layout->gutter = GUTTER * zr_greater(1, (int32_t)((shorter + SIDE_PER_GUTTER / 2) / SIDE_PER_GUTTER));
    const int64_t across = (int64_t)width - (int64_t)layout->gutter * (columns + 1);
    layout->letters = letters_of((int32_t)(across / columns), width, height);
    layout->caption = sheet->has_captions ? (int32_t)(CAPTION * layout->letters) : 0;
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
    const double letters = layout->letters, pen = zr_type_pen(letters), room = view.width - pen;
    const struct zr_box below = {view.x, view.y + view.height, view.width, layout->caption};
    char text[160];
    int k = 0;
    while (k < count - 1 && zr_type_width(texts[k], letters) > room)
        k++;
    const size_t length = strnlen(texts[k], sizeof text - 1);
    memcpy(text, texts[k], length);
    text[length] = '\0';
    for (size_t end = length; end > 0 && zr_type_width(text, letters) > room;) /* whole characters of UTF-8 are cut */
        do
            text[--end] = '\0';
        while (end > 0 && ((unsigned char)texts[k][end] & 0xc0) == 0x80);
    const uint32_t ink = zr_canvas_ink(zr_canvas_median(sheet, below));
    const double left = floor((view.width - zr_type_width(text, letters)) / 2);
    const double base = floor((1 + ABOVE) * letters);
    zr_type_draw(sheet, text, (struct zr_type_place){view.x + left + 0.5, below.y + base + 0.5, letters, 1, 0}, pen,
                 ink);
}
