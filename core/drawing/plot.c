#include "drawing/plot.h"

#include <math.h>
#include <string.h>

#include "base/trig.h"
#include "overlay/type.h"

static const double arrow_length = 3.0, arrow_half_width = 0.5;

#define PEN_ROW(ID, name, width, ...) {name, width, __VA_ARGS__},
const struct zr_plot_pen_row zr_plot_pens[ZR_PLOT_PENS] = {ZR_PLOT_PEN_ROWS(PEN_ROW)};

void zr_plot_begin(struct zr_plot *plot, const char *name)
{
    if (plot->group_count == ZR_PLOT_GROUPS) return;
    plot->groups[plot->group_count++] = (struct zr_plot_group){name, plot->item_count};
}

uint32_t zr_plot_dash_count(enum zr_plot_pen pen)
{
    uint32_t count = 0;
    while (count < ZR_PLOT_DASH_LENGTHS && zr_plot_pens[pen].dashes[count] > 0.0)
        count++;
    return count;
}

double zr_plot_width(const struct zr_plot_item *item)
{
    if (item->kind == ZR_PLOT_AREA) return 0.0;
    return item->kind == ZR_PLOT_WORDS ? 0.1 * item->height : zr_plot_pens[item->pen].width;
}

/* Makes room for `more` objects behind the first `count`. */
static bool reserve(struct zr_plot *plot, void **array, uint32_t count, uint32_t more, uint32_t *room, size_t size)
{
    enum { FIRST_ROOM = 256 };
    if (*room - count >= more) return true;
    if (more > UINT32_MAX / 4 || count > UINT32_MAX / 4) plot->has_failed = true;
    if (plot->has_failed) return false;
    const uint32_t wanted = 2 * (count + more) + FIRST_ROOM;
    void *grown = zr_arena_grow(plot->arena, *array, count, wanted, size);
    plot->has_failed = !grown;
    if (!grown) return false;
    *array = grown;
    *room = wanted;
    return true;
}

/* Adds an item with points, which are copied. */
static void add(struct zr_plot *plot, struct zr_plot_item item, const struct zr_point *points, uint32_t count)
{
    void *items = plot->items, *all = plot->points;
    const bool has_room = reserve(plot, &items, plot->item_count, 1, &plot->item_room, sizeof *plot->items);
    plot->items = items;
    if (!has_room || !reserve(plot, &all, plot->point_count, count, &plot->point_room, sizeof *plot->points)) return;
    plot->points = all;
    item.first = plot->point_count;
    item.count = count;
    memcpy(plot->points + plot->point_count, points, count * sizeof *points);
    plot->point_count += count;
    plot->items[plot->item_count++] = item;
}

void zr_plot_add_line(struct zr_plot *plot, enum zr_plot_pen pen, const struct zr_point *points, uint32_t count)
{
    add(plot, (struct zr_plot_item){.kind = ZR_PLOT_LINE, .pen = pen, .dash = zr_plot_dash_count(pen) ? 1.0 : 0.0},
        points, count);
}

void zr_plot_add_ring(struct zr_plot *plot, enum zr_plot_pen pen, const struct zr_point *points, uint32_t count)
{
    add(plot, (struct zr_plot_item){.kind = ZR_PLOT_RING, .pen = pen, .dash = zr_plot_dash_count(pen) ? 1.0 : 0.0},
        points, count);
}

void zr_plot_add_straight(struct zr_plot *plot, enum zr_plot_pen pen, struct zr_point from, struct zr_point to,
                          bool has_middle)
{
    const double x = to.x - from.x, y = to.y - from.y, length = sqrt(x * x + y * y);
    const uint32_t lengths = zr_plot_dash_count(pen);
    const double *dashes = zr_plot_pens[pen].dashes;
    struct zr_plot_item item = {.kind = ZR_PLOT_LINE, .pen = pen};
    double period = 0.0;
    for (uint32_t i = 0; i < lengths; i++)
        period += dashes[i];
    if (lengths > 0) {
        const double step = has_middle ? 2.0 : 1.0;
        const double periods = step * floor((length - dashes[0]) / (step * period) + 0.5);
        if (periods > 0.0) item.dash = length / (periods * period + dashes[0]);
    }
    add(plot, item, (const struct zr_point[2]){from, to}, 2);
}

void zr_plot_add_circle(struct zr_plot *plot, enum zr_plot_pen pen, struct zr_point center, double radius)
{
    enum { STEPS = 120 };
    struct zr_point points[STEPS];
    for (int i = 0; i < STEPS; i++) {
        double sine, cosine;
        zr_sine_cosine(360.0 * i / STEPS, &sine, &cosine);
        points[i] = (struct zr_point){center.x + radius * cosine, center.y + radius * sine};
    }
    zr_plot_add_ring(plot, pen, points, STEPS);
}

void zr_plot_add_arrow(struct zr_plot *plot, struct zr_point tip, double dx, double dy)
{
    const double x = tip.x - arrow_length * dx, y = tip.y - arrow_length * dy, half = arrow_half_width;
    const struct zr_point points[] = {tip, {x - half * dy, y + half * dx}, {x + half * dy, y - half * dx}};
    add(plot, (struct zr_plot_item){.kind = ZR_PLOT_AREA, .pen = ZR_PLOT_DIMENSION}, points, 3);
}

void zr_plot_add_text(struct zr_plot *plot, const char *text, struct zr_point at, double height, bool is_upright)
{
    struct zr_plot_item item = {.kind = ZR_PLOT_WORDS, .pen = ZR_PLOT_TEXT, .height = height, .is_upright = is_upright};
    item.text = zr_arena_copy(plot->arena, text, strlen(text) + 1);
    plot->boxed += item.text && !zr_type_has_all(text);
    if (item.text)
        add(plot, item, &at, 1);
    else
        plot->has_failed = true;
}
