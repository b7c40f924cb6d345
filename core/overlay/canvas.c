#include "overlay/canvas.h"

#include <math.h>
#include <string.h>

static struct zr_box between(int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    return (struct zr_box){x0, y0, zr_greater(x1 - x0, 0), zr_greater(y1 - y0, 0)};
}

struct zr_box zr_box_join(struct zr_box a, struct zr_box b)
{
    return between(zr_lesser(a.x, b.x), zr_lesser(a.y, b.y), zr_greater(a.x + a.width, b.x + b.width),
                   zr_greater(a.y + a.height, b.y + b.height));
}

struct zr_box zr_canvas_clip(const struct zr_canvas *canvas, struct zr_box box)
{
    return between(zr_greater(box.x, 0), zr_greater(box.y, 0), zr_lesser(box.x + box.width, canvas->width),
                   zr_lesser(box.y + box.height, canvas->height));
}

/* Returns a position as a whole number from 0 to `most`. */
static int32_t clamped(double at, int32_t most)
{
    return at <= 0 ? 0 : at >= most ? most : (int32_t)at;
}

struct zr_box zr_canvas_bounds(const struct zr_canvas *canvas, const struct zr_point *points, uint32_t count,
                               double reach)
{
    if (count == 0) return between(0, 0, 0, 0);
    struct zr_point low = points[0], high = low;
    for (uint32_t i = 1; i < count; i++) {
        const struct zr_point p = points[i];
        low = (struct zr_point){p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y};
        high = (struct zr_point){p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y};
    }
    return between(clamped(low.x - reach, canvas->width), clamped(low.y - reach, canvas->height),
                   clamped(ceil(high.x + reach), canvas->width), clamped(ceil(high.y + reach), canvas->height));
}

void zr_canvas_fill(const struct zr_canvas *canvas, struct zr_box box, uint32_t color)
{
    const struct zr_box in = zr_canvas_clip(canvas, box);
    for (int32_t y = in.y; y < in.y + in.height; y++) {
        uint32_t *row = canvas->pixels + (size_t)y * (size_t)canvas->width;
        for (int32_t x = in.x; x < in.x + in.width; x++)
            row[x] = color;
    }
}

uint32_t zr_canvas_blend(uint32_t below, uint32_t color, double covered)
{
    uint8_t under[4], over[4];
    memcpy(under, &below, sizeof under);
    memcpy(over, &color, sizeof over);
    const uint32_t alpha = (uint32_t)(covered * over[3] + 0.5), rest = (255 - alpha) * under[3];
    const uint32_t all = 255 * alpha + rest; /* 255 times the new alpha */
    if (alpha == 0 || alpha == 255) return alpha == 0 ? below : color;
    for (int c = 0; c < 3; c++)
        under[c] = (uint8_t)((255 * alpha * over[c] + rest * under[c] + all / 2) / all);
    under[3] = (uint8_t)((all + 127) / 255);
    memcpy(&below, under, sizeof below);
    return below;
}

static uint32_t opaque_of(const uint8_t rgb[3])
{
    const uint8_t bytes[4] = {rgb[0], rgb[1], rgb[2], 255};
    uint32_t color;
    memcpy(&color, bytes, sizeof color);
    return color;
}

/* Returns the least value such that at least half of all are no greater. */
static uint8_t median_of(const uint32_t counts[256], uint64_t all)
{
    uint64_t seen = 0;
    int value = 0;
    for (; value < 255; value++) {
        seen += counts[value];
        if (2 * seen >= all) break;
    }
    return (uint8_t)value;
}

uint32_t zr_canvas_median(const struct zr_canvas *canvas, struct zr_box box)
{
    const struct zr_box in = zr_canvas_clip(canvas, box);
    const uint64_t all = (uint64_t)in.width * (uint64_t)in.height;
    uint32_t counts[3][256] = {{0}};
    uint8_t median[3] = {255, 255, 255};
    for (int32_t y = in.y; y < in.y + in.height; y++) {
        const uint32_t *row = canvas->pixels + (size_t)y * (size_t)canvas->width;
        for (int32_t x = in.x; x < in.x + in.width; x++) {
            uint8_t bytes[4];
            memcpy(bytes, &row[x], sizeof bytes);
            for (int c = 0; c < 3; c++)
                counts[c][(bytes[c] * bytes[3] + 255 * (255 - bytes[3]) + 127) / 255]++;
        }
    }
    for (int c = 0; c < 3 && all > 0; c++)
        median[c] = median_of(counts[c], all);
    return opaque_of(median);
}

uint32_t zr_canvas_ink(uint32_t paper)
{
    /* A grey of 118 has equal contrast to black and white by WCAG 2, (L1 + 0.05) / (L2 + 0.05). For other colours, luma
     * as in ITU-R BT.601 is accurate enough. */
    enum { GREY = 118 };
    static const uint8_t black[3] = {0, 0, 0}, white[3] = {255, 255, 255};
    uint8_t rgb[4];
    memcpy(rgb, &paper, sizeof rgb);
    return opaque_of(299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] >= 1000 * GREY ? black : white);
}
