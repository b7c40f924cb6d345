#include "effects/remap.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/run.h"

enum { ROWS_PER_RANGE = 4, HALF = ZR_REMAP_ONE / 2 };

/* ---- places ---- */

struct making {
    const struct zr_lens_plan *plan;
    const struct zr_cancel *cancel;
    struct zr_remap_place *places;
    atomic_uint_fast64_t nowhere;
};

/* Rounding may move a place beyond the outermost centres by little. */
static struct zr_remap_place place_of(const struct zr_lens_plan *plan, double x, double y)
{
    const struct zr_lens_ray ray = zr_lens_look_up(plan, x, y);
    const double u = ray.x - 0.5, v = ray.y - 0.5, right = (double)plan->width - 1.0,
                 bottom = (double)plan->height - 1.0;
    if (ray.end != ZR_LENS_RAY || !(u >= -0.5 && u <= right + 0.5 && v >= -0.5 && v <= bottom + 0.5))
        return (struct zr_remap_place){ZR_REMAP_NOWHERE, 0};
    return (struct zr_remap_place){(int32_t)floor(fmin(fmax(u, 0.0), right) * ZR_REMAP_ONE + 0.5),
                                   (int32_t)floor(fmin(fmax(v, 0.0), bottom) * ZR_REMAP_ONE + 0.5)};
}

static void find_rows(void *context, size_t begin, size_t end)
{
    struct making *making = context;
    const struct zr_lens_plan *plan = making->plan;
    uint64_t nowhere = 0;
    for (size_t y = begin; y < end && !zr_is_cancelled(making->cancel); y++) {
        struct zr_remap_place *row = making->places + y * plan->view_width;
        for (uint32_t x = 0; x < plan->view_width; x++) {
            row[x] = place_of(plan, (double)x + 0.5, (double)y + 0.5);
            nowhere += row[x].x == ZR_REMAP_NOWHERE;
        }
    }
    atomic_fetch_add_explicit(&making->nowhere, nowhere, memory_order_relaxed);
}

enum zr_status zr_remap_make(const struct zr_run *run, const struct zr_lens_plan *plan, struct zr_remap *remap)
{
    struct zr_remap_place *places =
        zr_arena_alloc(run->arena, (size_t)plan->view_width * plan->view_height, sizeof *places);
    struct making making = {.plan = plan, .cancel = run->cancel, .places = places};
    if (!places) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, plan->view_height, ROWS_PER_RANGE, find_rows, &making);
    *remap = (struct zr_remap){.width = plan->view_width,
                               .height = plan->view_height,
                               .source_width = plan->width,
                               .source_height = plan->height,
                               .places = places,
                               .nowhere = making.nowhere};
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}

/* ---- data ---- */

struct channel {
    const struct zr_remap *remap;
    const struct zr_cancel *cancel;
    uint32_t words, clear;
    const uint32_t *source;
    uint32_t *out;
};

static void copy_rows(void *context, size_t begin, size_t end)
{
    const struct channel *channel = context;
    const struct zr_remap *remap = channel->remap;
    const uint32_t words = channel->words;
    for (size_t y = begin; y < end && !zr_is_cancelled(channel->cancel); y++) {
        uint32_t *out = channel->out + y * remap->width * words;
        for (uint32_t x = 0; x < remap->width; x++, out += words) {
            struct zr_remap_pixel pixel = {0, 0};
            const bool has_ray = zr_remap_nearest_pixel(remap, x, (uint32_t)y, &pixel);
            const uint32_t *from = channel->source + ((size_t)pixel.y * remap->source_width + pixel.x) * words;
            for (uint32_t k = 0; k < words; k++)
                out[k] = has_ray ? from[k] : channel->clear;
        }
    }
}

enum zr_status zr_remap_nearest(const struct zr_run *run, const struct zr_remap *remap, uint32_t words, uint32_t clear,
                                const uint32_t *source, uint32_t *out)
{
    struct channel channel = {remap, run->cancel, words, clear, source, out};
    zr_team_ranges(run->team, remap->height, ROWS_PER_RANGE, copy_rows, &channel);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}

/* ---- colour ---- */

enum { GRID_MAX = 8, WEIGHT_BITS = 8 };

/* Weighted sums of bytes: two in each word, red and blue, green and alpha. Each has up to 8 + 16 + 6 bits. */
struct sums {
    uint64_t red_blue, green_alpha;
    uint32_t weight;
    uint32_t common; /* bits that all pixels have */
    uint64_t lit[3]; /* of colours times alpha */
};

static inline void add(struct sums *sums, uint32_t rgba, uint32_t weight, bool is_lit)
{
    const uint64_t red = rgba & 255u, green = rgba >> 8 & 255u, blue = rgba >> 16 & 255u, alpha = rgba >> 24;
    sums->red_blue += (red | blue << 32) * weight;
    sums->green_alpha += (green | alpha << 32) * weight;
    sums->weight += weight;
    sums->common &= rgba;
    if (!is_lit) return;
    sums->lit[0] += weight * alpha * red;
    sums->lit[1] += weight * alpha * green;
    sums->lit[2] += weight * alpha * blue;
}

static inline uint32_t share(uint64_t sum, uint64_t of)
{
    return (uint32_t)((sum + of / 2) / of);
}

/* Returns the mean of colours, each in proportion to its weight alone. */
static inline uint32_t plain_mean(const struct sums *sums)
{
    const uint32_t red = (uint32_t)sums->red_blue, blue = (uint32_t)(sums->red_blue >> 32);
    const uint32_t green = (uint32_t)sums->green_alpha, alpha = (uint32_t)(sums->green_alpha >> 32);
    const uint32_t weight = sums->weight, half = weight / 2;
    return (red + half) / weight | (green + half) / weight << 8 | (blue + half) / weight << 16 |
           (alpha + half) / weight << 24;
}

/* Returns the mean of colours in proportion to their alpha, too. */
static uint32_t lit_mean(const struct sums *sums)
{
    const uint64_t alpha = sums->green_alpha >> 32;
    if (alpha == 0) return plain_mean(sums);
    return share(sums->lit[0], alpha) | share(sums->lit[1], alpha) << 8 | share(sums->lit[2], alpha) << 16 |
           share(alpha, sums->weight) << 24;
}

static inline int32_t clamp(int64_t v, uint32_t count)
{
    const int64_t most = (int64_t)(count - 1) * ZR_REMAP_ONE;
    return (int32_t)(v < 0 ? 0 : v > most ? most : v);
}

/* Adds the four nearest pixels. */
static inline void add_place(const struct channel *channel, int64_t at_x, int64_t at_y, bool is_lit, struct sums *sums)
{
    enum { DROPPED = ZR_REMAP_BITS - WEIGHT_BITS, ONE = 1 << WEIGHT_BITS };
    const uint32_t width = channel->remap->source_width, height = channel->remap->source_height;
    const uint32_t x = (uint32_t)(clamp(at_x, width) + (1 << (DROPPED - 1))) >> DROPPED,
                   y = (uint32_t)(clamp(at_y, height) + (1 << (DROPPED - 1))) >> DROPPED;
    const uint32_t column = x >> WEIGHT_BITS, row = y >> WEIGHT_BITS, right = x % ONE, below = y % ONE;
    const uint32_t *pixel = channel->source + (size_t)row * width + column;
    add(sums, pixel[0], (ONE - right) * (ONE - below), is_lit);
    if (right > 0) add(sums, pixel[1], right * (ONE - below), is_lit);
    if (below > 0) add(sums, pixel[width], (ONE - right) * below, is_lit);
    if (right > 0 && below > 0) add(sums, pixel[width + 1], right * below, is_lit);
}

/* Change of places from one pixel of the view to the next. */
struct step {
    int64_t x, y;
};

/* Returns half of the change between the neighbours along an axis, or the whole of that beside one of them. */
static inline struct step step_at(const struct zr_remap_place *place, ptrdiff_t next, uint32_t at, uint32_t count)
{
    const struct zr_remap_place *before = at > 0 ? place - next : place, *after = at + 1 < count ? place + next : place;
    if (before->x == ZR_REMAP_NOWHERE) before = place;
    if (after->x == ZR_REMAP_NOWHERE) after = place;
    const int64_t pixels = (before != place) + (after != place);
    if (pixels == 0) return (struct step){0, 0};
    return (struct step){pixels == 2 ? ((int64_t)after->x - before->x) / 2 : (int64_t)after->x - before->x,
                         pixels == 2 ? ((int64_t)after->y - before->y) / 2 : (int64_t)after->y - before->y};
}

/* Returns the number of places along a step. */
static inline int64_t grid_of(struct step step)
{
    const int64_t x = step.x < 0 ? -step.x : step.x, y = step.y < 0 ? -step.y : step.y, most = x > y ? x : y;
    const int64_t count = (most + HALF - 1) / ZR_REMAP_ONE;
    return count < 1 ? 1 : count > GRID_MAX ? GRID_MAX : count;
}

/* Places within a pixel: columns x rows of them. */
struct grid {
    struct step across, down;
    int64_t columns, rows;
};

static inline void add_grid(const struct channel *channel, const struct zr_remap_place *place, const struct grid *grid,
                            bool is_lit, struct sums *sums)
{
    *sums = (struct sums){.common = UINT32_MAX};
    if (grid->columns * grid->rows == 1) { /* the same, without divisions */
        add_place(channel, place->x, place->y, is_lit, sums);
        return;
    }
    for (int64_t row = 0; row < grid->rows; row++)
        for (int64_t column = 0; column < grid->columns; column++) {
            /* Twice the offset of the place from the middle of the pixel, in its columns and rows. */
            const int64_t a = 2 * column + 1 - grid->columns, b = 2 * row + 1 - grid->rows;
            const int64_t x = a * grid->across.x / (2 * grid->columns) + b * grid->down.x / (2 * grid->rows),
                          y = a * grid->across.y / (2 * grid->columns) + b * grid->down.y / (2 * grid->rows);
            add_place(channel, place->x + x, place->y + y, is_lit, sums);
        }
}

static inline uint32_t mix_grid(const struct channel *channel, const struct zr_remap_place *place,
                                const struct grid *grid)
{
    struct sums sums;
    add_grid(channel, place, grid, false, &sums);
    if (sums.common >> 24 == 255) return plain_mean(&sums);
    add_grid(channel, place, grid, true, &sums);
    return lit_mean(&sums);
}

static inline uint32_t color_at(const struct channel *channel, uint32_t x, uint32_t y)
{
    const struct zr_remap *remap = channel->remap;
    const struct zr_remap_place *place = remap->places + (size_t)y * remap->width + x;
    if (place->x == ZR_REMAP_NOWHERE) return channel->clear;
    struct grid grid = {.across = step_at(place, 1, x, remap->width),
                        .down = step_at(place, (ptrdiff_t)remap->width, y, remap->height)};
    grid.columns = grid_of(grid.across);
    grid.rows = grid_of(grid.down);
    return mix_grid(channel, place, &grid);
}

static void mix_rows(void *context, size_t begin, size_t end)
{
    const struct channel *channel = context;
    const uint32_t width = channel->remap->width;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < width; x++) {
            if (x % 1024 == 0 && zr_is_cancelled(channel->cancel)) return;
            channel->out[y * width + x] = color_at(channel, x, (uint32_t)y);
        }
}

enum zr_status zr_remap_color(const struct zr_run *run, const struct zr_remap *remap, uint32_t clear,
                              const uint32_t *source, uint32_t *out)
{
    struct channel channel = {remap, run->cancel, 1, clear, source, out};
    zr_team_ranges(run->team, remap->height, ROWS_PER_RANGE, mix_rows, &channel);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
