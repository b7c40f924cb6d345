#include "overlay/pen.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Pixels are drawn in tiles of this side, so that distances fit on the stack. Blocks far from all strokes are passed
 * over. */
enum { TILE = 16, BLOCK = 128 };
#define PIXEL_DIAGONAL_HALF 0.70711

struct segment {
    struct zr_point from;
    double x, y;    /* to its end */
    double inverse; /* of the squared length; 0: a point */
};

static struct segment segment_of(const struct zr_path *path, uint32_t begin, uint32_t i)
{
    const struct zr_point *a = &path->points[i > begin ? i - 1 : i], *b = &path->points[i];
    struct segment s = {*a, b->x - a->x, b->y - a->y, 0};
    const double squared = s.x * s.x + s.y * s.y;
    if (squared > 0) s.inverse = 1 / squared;
    return s;
}

/* From the nearest point of a polyline to the middle of a pixel. */
struct offset {
    double squared; /* length */
    double nx, ny;  /* across the stroke, of any length; 0, 0: at the middle of a dot */
};

static struct offset offset_from(const struct segment *s, double x, double y)
{
    const double px = x - s->from.x, py = y - s->from.y, along = (px * s->x + py * s->y) * s->inverse;
    const double inside = along < 0 ? 0 : along > 1 ? 1 : along, dx = px - inside * s->x, dy = py - inside * s->y;
    const struct offset offset = {dx * dx + dy * dy, dx, dy};
    return along > 0 && along < 1 ? (struct offset){offset.squared, -s->y, s->x} : offset;
}

struct tile {
    struct zr_box box;
    bool is_touched;
    struct offset offsets[TILE * TILE]; /* by pixel: the least, or an infinite one */
};

/* Returns a position between pixels of the tile as a pixel's number, 0 to `most`. */
static int32_t clamped(double at, int32_t most)
{
    return at <= 0 ? 0 : at >= most ? most : (int32_t)at;
}

/* Measures the pixels within `reach` of the bounds of a segment. */
static void touch(struct tile *tile, const struct segment *s, double reach)
{
    const struct zr_box box = tile->box;
    const double left = (s->x < 0 ? s->x : 0) + s->from.x - reach - box.x, right = left + fabs(s->x) + 2 * reach;
    const double top = (s->y < 0 ? s->y : 0) + s->from.y - reach - box.y, bottom = top + fabs(s->y) + 2 * reach;
    const int32_t x_begin = clamped(left, box.width), x_end = clamped(ceil(right), box.width);
    const int32_t y_begin = clamped(top, box.height), y_end = clamped(ceil(bottom), box.height);
    for (int i = 0; i < TILE * TILE && !tile->is_touched; i++)
        tile->offsets[i].squared = HUGE_VAL;
    tile->is_touched = true;
    for (int32_t y = y_begin; y < y_end; y++)
        for (int32_t x = x_begin; x < x_end; x++) {
            const struct offset offset = offset_from(s, box.x + x + 0.5, box.y + y + 0.5);
            struct offset *least = &tile->offsets[y * TILE + x];
            if (offset.squared < least->squared) *least = offset;
        }
}

/* Returns the larger half diagonal of boxes of that side. */
static double half_diagonal(int32_t side)
{
    return 0.75 * side;
}

/* Returns whether a path may come within `reach` of a box of that side. If there is a tile, computes its offsets. */
static bool comes_near(const struct zr_path *path, double reach, struct zr_box box, int32_t side, struct tile *tile)
{
    const double x = box.x + side / 2, y = box.y + side / 2, far = reach + half_diagonal(side);
    uint32_t begin = 0;
    for (uint32_t k = 0; k < path->count; begin = path->ends[k++])
        for (uint32_t i = path->ends[k] - begin > 1 ? begin + 1 : begin; i < path->ends[k]; i++) {
            const struct segment segment = segment_of(path, begin, i);
            if (offset_from(&segment, x, y).squared >= far * far) continue;
            if (!tile) return true;
            touch(tile, &segment, reach);
        }
    return tile && tile->is_touched;
}

/* Returns the area of a pixel on one side of a line: the part whose points p have p . (a, b) < t, from its middle.
 * (a, b): unit vector with a >= b >= 0. */
static double side_area(double a, double b, double t)
{
    const double far = (a + b) / 2, near = (a - b) / 2, beyond = t < 0 ? far + t : far - t;
    const double corner = beyond > 0 ? beyond * beyond / (2 * a * b) : 0;
    if (t >= -near && t <= near) return 0.5 + t / a;
    return t < 0 ? corner : 1 - corner;
}

/* Returns the area of a pixel in an endless stroke. */
static double coverage(struct offset offset, double width)
{
    const double distance = sqrt(offset.squared), length = sqrt(offset.nx * offset.nx + offset.ny * offset.ny);
    const double x = length > 0 ? fabs(offset.nx) / length : 1, y = length > 0 ? fabs(offset.ny) / length : 0;
    const double a = x > y ? x : y, b = x > y ? y : x;
    return side_area(a, b, distance + width / 2) - side_area(a, b, distance - width / 2);
}

static void paint(const struct tile *tile, const struct zr_canvas *canvas, double width, uint32_t color)
{
    const double reach = width / 2 + PIXEL_DIAGONAL_HALF;
    for (int32_t y = 0; y < tile->box.height; y++) {
        const struct offset *offsets = &tile->offsets[y * TILE];
        uint32_t *row = canvas->pixels + (size_t)(tile->box.y + y) * (size_t)canvas->width + tile->box.x;
        for (int32_t x = 0; x < tile->box.width; x++)
            if (offsets[x].squared < reach * reach)
                row[x] = zr_canvas_blend(row[x], color, coverage(offsets[x], width));
    }
}

/* Returns the part of `all` in the square of that side at (x, y). */
static struct zr_box square_of(struct zr_box all, int32_t x, int32_t y, int32_t side)
{
    return (struct zr_box){x, y, zr_lesser(side, all.x + all.width - x), zr_lesser(side, all.y + all.height - y)};
}

static void draw_block(const struct zr_canvas *canvas, const struct zr_path *path, double width, uint32_t color,
                       struct zr_box block)
{
    const double reach = width / 2 + PIXEL_DIAGONAL_HALF;
    struct tile tile;
    for (int32_t y = block.y; y < block.y + block.height; y += TILE)
        for (int32_t x = block.x; x < block.x + block.width; x += TILE) {
            tile.box = square_of(block, x, y, TILE);
            tile.is_touched = false;
            if (comes_near(path, reach, tile.box, TILE, &tile)) paint(&tile, canvas, width, color);
        }
}

void zr_pen_draw(const struct zr_canvas *canvas, const struct zr_path *path, double width, uint32_t color)
{
    const double reach = width / 2 + PIXEL_DIAGONAL_HALF;
    const uint32_t count = path->count > 0 ? path->ends[path->count - 1] : 0;
    const struct zr_box all = zr_canvas_bounds(canvas, path->points, count, reach);
    for (int32_t y = all.y; y < all.y + all.height; y += BLOCK)
        for (int32_t x = all.x; x < all.x + all.width; x += BLOCK) {
            const struct zr_box block = square_of(all, x, y, BLOCK);
            if (comes_near(path, reach, block, BLOCK, NULL)) draw_block(canvas, path, width, color, block);
        }
}
