#include "overlay/color_bar.h"

#include <math.h>

#include "base/rgba.h"
#include "overlay/glyphs.h"

static void draw_tick(const struct zr_color_bar_layout *l, const struct zr_canvas *canvas, int i, int32_t grow,
                      uint32_t color)
{
    const double share = zr_tick_share(&l->ticks, i, l->scale->low, l->scale->high);
    const int32_t row = l->bar.height - 1 - (int32_t)floor(share * (double)(l->bar.height - 1) + 0.5);
    const int32_t y = l->bar.y + row - (l->line - 1) / 2;
    char text[ZR_DECIMAL_SIZE];
    zr_canvas_fill(canvas, zr_box_grow((struct zr_box){l->tick_x, y, l->tick_width, l->line}, grow), color);
    zr_decimal_write(l->ticks.at[i], l->ticks.is_scientific, text);
    zr_glyphs_draw(canvas, text, l->label_x, y + (l->line - ZR_GLYPH_CAPITAL_ROWS * l->dot) / 2, l->dot, grow, color);
}

/* Draws everything but the colours of the map. */
static void draw_ink(const struct zr_color_bar_layout *l, const struct zr_canvas *canvas, int32_t grow, uint32_t color)
{
    zr_canvas_fill(canvas, zr_box_grow(l->bar, l->line + grow), color);
    for (int i = 0; i < l->ticks.count; i++)
        draw_tick(l, canvas, i, grow, color);
    if (l->title) zr_glyphs_draw(canvas, l->title, l->title_x, l->title_y, l->title_dot, grow, color);
}

static void draw_colors(const struct zr_color_bar_layout *l, const struct zr_canvas *canvas)
{
    const bool has_length = l->scale->low < l->scale->high;
    for (int32_t r = 0; r < l->bar.height; r++) {
        const float share = has_length ? (float)r / (float)(l->bar.height - 1) : 0.5f;
        const struct zr_box row = {l->bar.x, l->bar.y + l->bar.height - 1 - r, l->bar.width, 1};
        zr_canvas_fill(canvas, row, zr_rgba_opaque(zr_colormap_color(l->scale->map, share)));
    }
}

void zr_color_bar_paint(const struct zr_color_bar_layout *layout, const struct zr_canvas *canvas)
{
    const uint32_t paper = zr_canvas_median(canvas, layout->block);
    draw_ink(layout, canvas, layout->dot, paper);
    draw_ink(layout, canvas, 0, zr_canvas_ink(paper));
    draw_colors(layout, canvas);
}

void zr_color_bar_draw(const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_color_scale *scale = scene->color_bar.is_on ? zr_color_bar_scale(scene) : NULL;
    struct zr_color_bar_layout layout;
    if (!frame->color || !scale ||
        !zr_color_bar_lay_out(&scene->color_bar, scale, frame->width, frame->height, &layout))
        return;
    const struct zr_canvas canvas = {(uint32_t *)(void *)frame->color, (int32_t)frame->width, (int32_t)frame->height};
    zr_color_bar_paint(&layout, &canvas);
    const struct zr_box all = zr_canvas_clip(&canvas, layout.all);
    for (int32_t y = all.y; frame->spans && y < all.y + all.height; y++)
        frame->spans[y] = zr_column_span_join(frame->spans[y],
                                              (struct zr_column_span){(uint32_t)all.x, (uint32_t)(all.x + all.width)});
}
