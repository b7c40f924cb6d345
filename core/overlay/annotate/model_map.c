#include "overlay/annotate/model_map.h"

#include <math.h>

#include "base/cancel.h"

enum { OUTSIDE = 0, MODEL = 1 };

struct flood {
    uint8_t *map;
    uint32_t *stack; /* pixels whose neighbours are not looked at yet */
    size_t count;
    uint32_t width, height;
};

static void visit(struct flood *f, const uint32_t *ids, uint32_t x, uint32_t y)
{
    const size_t at = (size_t)y * f->width + x;
    if (ids[at] != 0 || f->map[at] == OUTSIDE) return;
    f->map[at] = OUTSIDE;
    f->stack[f->count++] = (uint32_t)at;
}

/* Marks all background that leads to the border. */
static bool flood(const struct zr_layout *l, struct flood *f)
{
    for (uint32_t x = 0; x < f->width; x++) {
        visit(f, l->ids, x, 0);
        visit(f, l->ids, x, f->height - 1);
    }
    for (uint32_t y = 0; y < f->height; y++) {
        visit(f, l->ids, 0, y);
        visit(f, l->ids, f->width - 1, y);
    }
    for (uint32_t done = 0; f->count > 0; done++) {
        const uint32_t at = f->stack[--f->count], x = at % f->width, y = at / f->width;
        if (done % 65536 == 0 && zr_is_cancelled(l->cancel)) return false;
        if (x > 0) visit(f, l->ids, x - 1, y);
        if (x + 1 < f->width) visit(f, l->ids, x + 1, y);
        if (y > 0) visit(f, l->ids, x, y - 1);
        if (y + 1 < f->height) visit(f, l->ids, x, y + 1);
    }
    return true;
}

bool zr_model_map_make(const struct zr_layout *l, struct zr_model_map *out)
{
    const uint32_t width = l->frame->width, height = l->frame->height;
    const size_t pixels = (size_t)width * height, across = (size_t)width + 1;
    if (!l->ids) return false;
    struct flood f = {.width = width, .height = height};
    uint32_t *sums = zr_arena_alloc(l->arena, across * ((size_t)height + 1), sizeof *sums);
    f.map = zr_arena_alloc(l->arena, pixels, 1);
    f.stack = zr_arena_alloc(l->arena, pixels, sizeof *f.stack);
    if (!sums || !f.map || !f.stack) return false;
    for (size_t i = 0; i < pixels; i++)
        f.map[i] = MODEL;
    if (!flood(l, &f)) return false;
    for (size_t x = 0; x < across; x++)
        sums[x] = 0;
    for (uint32_t y = 0; y < height; y++) {
        uint32_t row = 0;
        if (zr_is_cancelled(l->cancel)) return false;
        sums[(y + 1) * across] = 0;
        for (uint32_t x = 0; x < width; x++) {
            row += f.map[(size_t)y * width + x];
            sums[(y + 1) * across + x + 1] = sums[y * across + x + 1] + row;
        }
    }
    *out = (struct zr_model_map){width, height, f.map, sums};
    return true;
}

static size_t within(double value, uint32_t most)
{
    return value <= 0.0 ? 0 : value >= (double)most ? most : (size_t)value;
}

bool zr_model_map_is_free(const struct zr_model_map *map, struct zr_rect rect)
{
    const size_t across = (size_t)map->width + 1;
    const size_t x0 = within(floor(rect.x0), map->width), x1 = within(ceil(rect.x1), map->width);
    const size_t y0 = within(floor(rect.y0), map->height), y1 = within(ceil(rect.y1), map->height);
    if (x0 >= x1 || y0 >= y1) return true;
    return map->sums[y1 * across + x1] + map->sums[y0 * across + x0] ==
           map->sums[y1 * across + x0] + map->sums[y0 * across + x1];
}
