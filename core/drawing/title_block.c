#include "drawing/title_block.h"

#include <string.h>

#include "overlay/type.h"

#define ROW_HEIGHT (ZR_PAGE_TITLE_HEIGHT / 3.0)
#define COLUMN     (ZR_PAGE_TITLE_WIDTH / 3.0)
#define PADDING    2.0
#define NAME       1.8 /* height of the names of fields */
#define VALUE      3.5
#define TITLE      4.5
#define LEAST      2.0

static void add_line(struct zr_plot *plot, enum zr_plot_pen pen, double x0, double y0, double x1, double y1)
{
    zr_plot_add_line(plot, pen, (const struct zr_point[2]){{x0, y0}, {x1, y1}}, 2);
}

static void add_box(struct zr_plot *plot, enum zr_plot_pen pen, struct zr_page_box box)
{
    const struct zr_point points[] = {{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
    zr_plot_add_ring(plot, pen, points, 4);
}

static void add_frame(struct zr_plot *plot, const struct zr_page *page)
{
    const struct zr_page_box frame = page->frame;
    const double into = 5.0, x = 0.5 * page->width, y = 0.5 * page->height;
    zr_plot_begin(plot, "frame");
    add_box(plot, ZR_PLOT_FRAME, frame);
    add_line(plot, ZR_PLOT_FRAME, x, 5.0, x, frame.y0 + into);
    if (page->title.x0 > x + into) add_line(plot, ZR_PLOT_FRAME, x, page->height - 5.0, x, frame.y1 - into);
    if (!(page->title.x0 > x + into)) add_line(plot, ZR_PLOT_FRAME, x, page->height - 5.0, x, frame.y1);
    add_line(plot, ZR_PLOT_FRAME, 10.0, y, frame.x0 + into, y);
    add_line(plot, ZR_PLOT_FRAME, page->width - 5.0, y, frame.x1 - into, y);
}

/* ---- fields ---- */

/* Returns the bytes of the longest beginning of a text that is not wider, without parts of characters. */
static size_t fitting(const char *text, double height, double width)
{
    char begin[256];
    const char *at = text;
    size_t fits = 0;
    while (*at) {
        zr_type_character(&at);
        const size_t size = (size_t)(at - text);
        if (size >= sizeof begin) break;
        memcpy(begin, text, size);
        begin[size] = '\0';
        if (zr_type_width(begin, height) > width) break;
        fits = size;
    }
    return fits;
}

/* Writes a text that is not wider than `width`. */
static void add_fitting(struct zr_plot *plot, const char *text, double x, double y, double height, double width)
{
    const double wide = zr_type_width(text, height);
    if (wide > width) height *= width / wide;
    if (height >= LEAST) {
        zr_plot_add_text(plot, text, (struct zr_point){x, y}, height, false);
        return;
    }
    const size_t size = fitting(text, LEAST, width - zr_type_width("...", LEAST) - LEAST);
    char *cut = zr_arena_zero(plot->arena, size + sizeof "...", 1);
    if (cut) {
        memcpy(cut, text, size);
        memcpy(cut + size, "...", sizeof "...");
        zr_plot_add_text(plot, cut, (struct zr_point){x, y}, LEAST, false);
    } else {
        plot->has_failed = true;
    }
}

static void add_field(struct zr_plot *plot, const char *name, const char *value, double x, double y, double width,
                      double height)
{
    zr_plot_add_text(plot, name, (struct zr_point){x + PADDING, y + PADDING + NAME}, NAME, false);
    if (*value) add_fitting(plot, value, x + PADDING, y + ROW_HEIGHT - 2.2, height, width - 2.0 * PADDING);
}

/* Adds the symbol around the middle of a field: the cone's small end points to the left; first angle has the circles to
 * the right of it, third angle to the left. */
static void add_symbol(struct zr_plot *plot, double x, double y, bool is_first_angle)
{
    const double large = 3.6, small = 1.8, length = 7.2, apart = 9.5;
    const double side = is_first_angle ? 1.0 : -1.0;
    const double cone = x - side * 0.5 * apart, circles = x + side * 0.5 * apart;
    const struct zr_point points[] = {{cone - 0.5 * length, y - small},
                                      {cone + 0.5 * length, y - large},
                                      {cone + 0.5 * length, y + large},
                                      {cone - 0.5 * length, y + small}};
    const double over = 1.4;
    zr_plot_add_ring(plot, ZR_PLOT_SYMBOL, points, 4);
    zr_plot_add_circle(plot, ZR_PLOT_SYMBOL, (struct zr_point){circles, y}, large);
    zr_plot_add_circle(plot, ZR_PLOT_SYMBOL, (struct zr_point){circles, y}, small);
    zr_plot_add_straight(plot, ZR_PLOT_CENTER, (struct zr_point){cone - 0.5 * length - over, y},
                         (struct zr_point){cone + 0.5 * length + over, y}, true);
    zr_plot_add_straight(plot, ZR_PLOT_CENTER, (struct zr_point){circles - large - over, y},
                         (struct zr_point){circles + large + over, y}, true);
    zr_plot_add_straight(plot, ZR_PLOT_CENTER, (struct zr_point){circles, y - large - over},
                         (struct zr_point){circles, y + large + over}, true);
}

static void add_table(struct zr_plot *plot, struct zr_page_box title)
{
    add_box(plot, ZR_PLOT_FRAME, title);
    for (int row = 1; row < 3; row++)
        add_line(plot, ZR_PLOT_TABLE, title.x0, title.y0 + row * ROW_HEIGHT, title.x1, title.y0 + row * ROW_HEIGHT);
    for (int column = 1; column < 3; column++)
        add_line(plot, ZR_PLOT_TABLE, title.x0 + column * COLUMN, title.y0 + ROW_HEIGHT, title.x0 + column * COLUMN,
                 title.y1);
}

void zr_title_block_add(struct zr_plot *plot, const struct zr_page *page, const struct zr_title_texts *texts)
{
    const struct zr_page_box title = page->title;
    const double x[3] = {title.x0, title.x0 + COLUMN, title.x0 + 2.0 * COLUMN};
    const double y[3] = {title.y0, title.y0 + ROW_HEIGHT, title.y0 + 2.0 * ROW_HEIGHT};
    add_frame(plot, page);
    zr_plot_begin(plot, "title");
    add_table(plot, title);
    add_field(plot, "TITLE", texts->title, x[0], y[0], ZR_PAGE_TITLE_WIDTH, TITLE);
    add_field(plot, "SCALE", texts->scale, x[0], y[1], COLUMN, VALUE);
    add_field(plot, "UNIT", texts->unit, x[1], y[1], COLUMN, VALUE);
    add_field(plot, "SIZE", texts->size, x[2], y[1], COLUMN, VALUE);
    add_field(plot, "DATE", texts->date, x[0], y[2], COLUMN, VALUE);
    add_field(plot, "SHEET", page->size == ZR_PAGE_A4 ? "A4 1/1" : "A3 1/1", x[1], y[2], COLUMN, VALUE);
    add_field(plot, "PROJECTION", "", x[2], y[2], COLUMN, VALUE);
    add_symbol(plot, x[2] + 0.5 * COLUMN + 8.0, y[2] + 0.5 * ROW_HEIGHT, page->is_first_angle);
}
