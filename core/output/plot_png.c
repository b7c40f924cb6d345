#include "output/plot_png.h"

#include "base/cancel.h"
#include "base/rgba.h"
#include "output/images/png.h"
#include "overlay/marks.h"

enum { ROWS_PER_CANCEL_CHECK = 1 << 5 };

static const double inch = 25.4;

struct drawing {
    const struct zr_run *run;
    const struct zr_plot *plot;
    double scale; /* pixels per millimetre */
    uint32_t black;
    struct zr_point *points; /* room for those of the largest item, and one more */
};

static struct zr_marks mark_of(const struct drawing *d, const struct zr_plot_item *item)
{
    struct zr_marks marks = {.arena = d->run->scratch};
    const struct zr_ink ink = {.color = d->black, .width = d->scale * zr_plot_width(item)};
    uint32_t count = item->count;
    double dashes[ZR_PLOT_DASH_LENGTHS];
    const uint32_t lengths = item->dash > 0.0 ? zr_plot_dash_count(item->pen) : 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_point *p = &d->plot->points[item->first + i];
        d->points[i] = (struct zr_point){d->scale * p->x, d->scale * p->y};
    }
    if (item->kind == ZR_PLOT_RING) d->points[count++] = d->points[0];
    for (uint32_t i = 0; i < lengths; i++)
        dashes[i] = d->scale * item->dash * zr_plot_pens[item->pen].dashes[i];
    if (item->kind == ZR_PLOT_WORDS)
        zr_marks_add_text(&marks, item->text,
                          (struct zr_type_place){d->points[0].x, d->points[0].y, d->scale * item->height,
                                                 item->is_upright ? 0.0 : 1.0, item->is_upright ? -1.0 : 0.0},
                          ink);
    else if (item->kind == ZR_PLOT_AREA)
        zr_marks_add_area(&marks, d->points, count, ink);
    else if (lengths > 0)
        zr_marks_add_dashes(&marks, d->points, count, dashes, lengths, ink);
    else
        zr_marks_add_line(&marks, d->points, count, ink);
    return marks;
}

static enum zr_status draw_items(const struct drawing *d, const struct zr_canvas *canvas)
{
    for (uint32_t i = 0; i < d->plot->item_count; i++) {
        const struct zr_marks marks = mark_of(d, &d->plot->items[i]);
        const enum zr_status status = marks.has_failed ? ZR_NO_MEMORY : zr_marks_draw(&marks, d->run->cancel, canvas);
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}

static bool open_drawing(struct drawing *d)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < d->plot->item_count; i++)
        if (d->plot->items[i].count > most) most = d->plot->items[i].count;
    d->points = zr_arena_alloc(d->run->scratch, (size_t)most + 1, sizeof *d->points);
    return d->points != NULL;
}

enum zr_status zr_plot_png_write(const struct zr_run *run, const struct zr_plot *plot, double dpi,
                                 struct zr_buffer *out)
{
    struct drawing d = {
        .run = run, .plot = plot, .scale = dpi / inch, .black = zr_rgba_opaque((zr_vec4){0.0f, 0.0f, 0.0f, 1.0f})};
    const uint32_t width = (uint32_t)(plot->width * d.scale + 0.5), height = (uint32_t)(plot->height * d.scale + 0.5);
    uint32_t *pixels = zr_arena_alloc(run->scratch, (size_t)width * height, sizeof *pixels);
    if (!pixels || !open_drawing(&d)) return ZR_NO_MEMORY;
    const uint32_t white = zr_rgba_opaque((zr_vec4){1.0f, 1.0f, 1.0f, 1.0f});
    for (uint32_t y = 0; y < height; y++) {
        if (y % ROWS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        for (uint32_t x = 0; x < width; x++)
            pixels[(size_t)y * width + x] = white;
    }
    const struct zr_canvas canvas = {pixels, (int32_t)width, (int32_t)height};
    const enum zr_status status = draw_items(&d, &canvas);
    if (status != ZR_OK) return status;
    const struct zr_png image = {.kind = ZR_PNG_RGB,
                                 .width = width,
                                 .height = height,
                                 .pixels = pixels,
                                 .compress = ZR_COMPRESS_FAST,
                                 .is_srgb = true,
                                 .dpi = (float)dpi};
    return zr_png_write(&image, run->team, run->cancel, out);
}
