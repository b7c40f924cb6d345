#include "output/images/gif_colors.h"

#include <string.h>

#include "output/images/palette.h"

/* Colours that agree in 7 bits per channel count as one, with their mean. */
enum { BITS = 7, CELLS = 1 << (3 * BITS), COLORS = 256, OPAQUE_FROM = 128 };

/* Less is rounding: two pixels in neighbouring cells have 0.5. */
#define LEAST_SCATTER 0.25

struct cell {
    uint32_t count, place; /* pixels; number in the table */
    uint64_t sums[3];
};

/* Cells begin .. end - 1 of the list. */
struct box {
    uint32_t begin, end;
    uint64_t count, sums[3];
    int axis;       /* the channel that is most scattered */
    double scatter; /* sum of squared distances from the mean along it; 0: none */
};

struct cells {
    const struct zr_gif *gif;
    const struct zr_cancel *cancel;
    uint32_t *numbers; /* by place: 1 + number in the list; 0: no pixel. Later: colour */
    struct cell *list;
    uint32_t count;
    bool has_transparent;
};

static inline bool is_transparent(const struct zr_gif *gif, const uint8_t *pixel)
{
    return gif->has_alpha && pixel[3] < OPAQUE_FROM;
}

static inline uint32_t place_of(const uint8_t *pixel)
{
    enum { SHIFT = 8 - BITS };
    return ((uint32_t)pixel[0] >> SHIFT) << (2 * BITS) | ((uint32_t)pixel[1] >> SHIFT) << BITS |
           (uint32_t)pixel[2] >> SHIFT;
}

/* ---- at most 256 colours ---- */

/* Takes the colours of a palette; those of transparent pixels become one. */
static void take_palette(const struct zr_gif *gif, const struct zr_palette *palette, struct zr_gif_colors *colors)
{
    uint8_t numbers[COLORS];
    for (uint32_t i = 0; i < palette->count; i++) {
        const bool is_out = is_transparent(gif, palette->colors[i]);
        const bool is_new = !is_out || colors->transparent < 0;
        numbers[i] = (uint8_t)(is_new ? colors->count : (uint32_t)colors->transparent);
        if (!is_new) continue;
        if (is_out) colors->transparent = (int)colors->count;
        memcpy(colors->colors[colors->count++], palette->colors[i], 3);
    }
    const size_t pixels = (size_t)gif->width * gif->height;
    for (size_t i = 0; i < pixels; i++)
        palette->indices[i] = numbers[palette->indices[i]];
    colors->indices = palette->indices;
}

/* ---- more colours ---- */

static void count_pixel(struct cells *cells, const uint8_t *pixel)
{
    const uint32_t place = place_of(pixel);
    if (cells->numbers[place] == 0) {
        cells->list[cells->count++] = (struct cell){.place = place};
        cells->numbers[place] = cells->count;
    }
    struct cell *cell = &cells->list[cells->numbers[place] - 1];
    cell->count++;
    for (int c = 0; c < 3; c++)
        cell->sums[c] += pixel[c];
}

static enum zr_status count_cells(struct cells *cells)
{
    const struct zr_gif *gif = cells->gif;
    const uint8_t *pixel = gif->rgba;
    for (uint32_t y = 0; y < gif->height; y++) {
        if (zr_is_cancelled(cells->cancel)) return ZR_CANCELLED;
        for (uint32_t x = 0; x < gif->width; x++, pixel += 4)
            if (is_transparent(gif, pixel))
                cells->has_transparent = true;
            else
                count_pixel(cells, pixel);
    }
    return ZR_OK;
}

static inline uint32_t level(const struct cell *cell, int channel)
{
    return cell->place >> (BITS * (2 - channel)) & ((1u << BITS) - 1);
}

static struct box make_box(const struct cells *cells, uint32_t begin, uint32_t end)
{
    struct box box = {.begin = begin, .end = end};
    uint64_t levels[3] = {0}, squares[3] = {0};
    for (uint32_t i = begin; i < end; i++) {
        const struct cell *cell = &cells->list[i];
        box.count += cell->count;
        for (int c = 0; c < 3; c++) {
            const uint64_t l = level(cell, c);
            box.sums[c] += cell->sums[c];
            levels[c] += l * cell->count;
            squares[c] += l * l * cell->count;
        }
    }
    for (int c = 0; c < 3; c++) {
        const double mean = (double)levels[c] / (double)box.count;
        const double scatter = (double)squares[c] - mean * (double)levels[c];
        if (scatter < LEAST_SCATTER || scatter <= box.scatter) continue;
        box.scatter = scatter;
        box.axis = c;
    }
    return box;
}

/* Moves the cells below the mean of the box to its front. Returns where the others begin: both have some. */
static uint32_t split(struct cells *cells, const struct box *box)
{
    uint64_t levels = 0;
    for (uint32_t i = box->begin; i < box->end; i++)
        levels += (uint64_t)level(&cells->list[i], box->axis) * cells->list[i].count;
    const uint64_t least = levels / box->count;
    uint32_t at = box->begin;
    for (uint32_t i = box->begin; i < box->end; i++) {
        if (level(&cells->list[i], box->axis) > least) continue;
        const struct cell moved = cells->list[i];
        cells->list[i] = cells->list[at];
        cells->list[at++] = moved;
    }
    return at;
}

static struct box *most_scattered(struct box *boxes, uint32_t count)
{
    struct box *most = &boxes[0];
    for (uint32_t i = 1; i < count; i++)
        if (boxes[i].scatter > most->scatter) most = &boxes[i];
    return most;
}

/* Splits the cells into boxes. Returns their number. */
static uint32_t make_boxes(struct cells *cells, struct box boxes[COLORS])
{
    const uint32_t most = cells->has_transparent ? COLORS - 1 : COLORS;
    uint32_t count = cells->count > 0;
    if (count) boxes[0] = make_box(cells, 0, cells->count);
    while (count && count < most && !zr_is_cancelled(cells->cancel)) {
        struct box *box = most_scattered(boxes, count);
        if (box->scatter <= 0.0) break;
        const uint32_t at = split(cells, box);
        boxes[count++] = make_box(cells, at, box->end);
        *box = make_box(cells, box->begin, at);
    }
    return count;
}

static void take_boxes(struct cells *cells, const struct box *boxes, struct zr_gif_colors *colors)
{
    for (uint32_t b = 0; b < colors->count; b++) {
        for (int c = 0; c < 3; c++)
            colors->colors[b][c] = (uint8_t)((boxes[b].sums[c] + boxes[b].count / 2) / boxes[b].count);
        for (uint32_t i = boxes[b].begin; i < boxes[b].end; i++)
            cells->numbers[cells->list[i].place] = b;
    }
    if (cells->has_transparent) colors->transparent = (int)colors->count++;
}

static enum zr_status map_pixels(const struct cells *cells, struct zr_gif_colors *colors)
{
    const struct zr_gif *gif = cells->gif;
    const uint8_t *pixel = gif->rgba;
    uint8_t *index = colors->indices;
    for (uint32_t y = 0; y < gif->height; y++) {
        if (zr_is_cancelled(cells->cancel)) return ZR_CANCELLED;
        for (uint32_t x = 0; x < gif->width; x++, pixel += 4)
            *index++ =
                (uint8_t)(is_transparent(gif, pixel) ? (uint32_t)colors->transparent : cells->numbers[place_of(pixel)]);
    }
    return ZR_OK;
}

static enum zr_status sort_colors(struct cells *cells, struct zr_arena *arena, struct zr_gif_colors *colors)
{
    const size_t pixels = (size_t)cells->gif->width * cells->gif->height;
    struct box boxes[COLORS];
    cells->numbers = zr_arena_zero(arena, CELLS, sizeof *cells->numbers);
    cells->list = zr_arena_alloc(arena, pixels < CELLS ? pixels : CELLS, sizeof *cells->list);
    colors->indices = zr_arena_alloc(arena, pixels, 1);
    if (!cells->numbers || !cells->list || !colors->indices) return ZR_NO_MEMORY;
    const enum zr_status status = count_cells(cells);
    if (status != ZR_OK) return status;
    colors->count = make_boxes(cells, boxes);
    take_boxes(cells, boxes, colors);
    return map_pixels(cells, colors);
}

enum zr_status zr_gif_colors_make(const struct zr_gif *gif, struct zr_arena *arena, const struct zr_cancel *cancel,
                                  struct zr_gif_colors *colors)
{
    struct zr_palette palette;
    *colors = (struct zr_gif_colors){.transparent = -1};
    if (zr_palette_make(&palette, arena, gif->rgba, gif->width, gif->height, NULL, !gif->has_alpha)) {
        take_palette(gif, &palette, colors);
        return ZR_OK;
    }
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    struct cells cells = {.gif = gif, .cancel = cancel};
    return sort_colors(&cells, arena, colors);
}
