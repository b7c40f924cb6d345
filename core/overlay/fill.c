#include "overlay/fill.h"

#include <math.h>
#include <stddef.h>

/* Returns the integral from minus infinity of min(max(u, 0), 1). */
static double clamped_integral(double u)
{
    return u <= 0 ? 0 : u >= 1 ? u - 0.5 : u * u / 2;
}

/* Returns the mean of min(max(u, 0), 1) between two values of u. */
static double clamped_mean(double from, double to)
{
    const double least = 1e-6, middle = (from + to) / 2; /* below, differences of integrals lose digits */
    if (fabs(to - from) < least) return middle <= 0 ? 0 : middle >= 1 ? 1 : middle;
    return (clamped_integral(to) - clamped_integral(from)) / (to - from);
}

/* Returns the area of the pixel at (x, y) to the right of an edge, positive if the edge runs down. */
static double area_right_of(const struct zr_point *a, const struct zr_point *b, double x, double y)
{
    const double top = a->y < b->y ? a->y : b->y, bottom = a->y < b->y ? b->y : a->y;
    const double from = top > y ? top : y, to = bottom < y + 1 ? bottom : y + 1;
    if (to <= from) return 0;
    const double slope = (b->x - a->x) / (b->y - a->y);
    const double x0 = a->x + (from - a->y) * slope, x1 = a->x + (to - a->y) * slope;
    const double area = (to - from) * clamped_mean(x + 1 - x0, x + 1 - x1);
    return a->y < b->y ? area : -area;
}

static double coverage(const struct zr_point *points, uint32_t count, double x, double y)
{
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += area_right_of(&points[i], &points[i + 1 < count ? i + 1 : 0], x, y);
    sum = fabs(sum);
    return sum < 1 ? sum : 1;
}

void zr_fill_draw(const struct zr_canvas *canvas, const struct zr_point *points, uint32_t count, uint32_t color)
{
    const struct zr_box all = zr_canvas_bounds(canvas, points, count, 0);
    for (int32_t y = all.y; y < all.y + all.height; y++) {
        uint32_t *row = canvas->pixels + (size_t)y * (size_t)canvas->width;
        for (int32_t x = all.x; x < all.x + all.width; x++)
            row[x] = zr_canvas_blend(row[x], color, coverage(points, count, x, y));
    }
}
