/* Generators of triangles of all sizes: the renderer has a way of its own for the tiny, the small, the wide and the
 * large, and what they share is that none may be seen for another. */
#include <math.h>

#include "reference/generate/generate.h"

/* As large as a pixel or two, and more of them than one thread takes at a time. */
void fill_tiny(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 6000; i++) {
        double reach = random_power(r, -2, 0), across = reach * 2.0 / drawing->width,
               up = reach * 2.0 / drawing->height;
        double x = random_range(r, across - 1, 1 - across), y = random_range(r, up - 1, 1 - up);
        const double low[3] = {x - across, y - up, -0.9}, high[3] = {x + across, y + up, 0.9};
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = random_vertex_in(drawing, r, low, high, 1);
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

/* A place on a grid of `step` pixels, as a normalized device coordinate. */
static double on_grid(double pixels, double step, uint32_t size)
{
    return fmax(0.0, fmin(floor(pixels / step) * step, size)) * 2.0 / size - 1.0;
}

/* Corners on multiples of `step` pixels, at most `reach` pixels apart along x and y; of some, an edge is level. */
static void triangle_on_grid(struct drawing *drawing, struct random *r, double step, double reach, const double z[3])
{
    double x0 = random_range(r, -reach / 2, drawing->width), y0 = random_range(r, -reach / 2, drawing->height), y = 0;
    bool level = random_below(r, 4) == 0;
    uint32_t v[3];
    for (int k = 0; k < 3; k++) {
        double x = x0 + random_range(r, 0, reach), other_y = y0 + random_range(r, 0, reach);
        if (k != 1 || !level) y = other_y;
        v[k] = random_vertex(drawing, r, on_grid(x, step, drawing->width), on_grid(y, step, drawing->height), z[k], 1);
    }
    drawing_triangle(drawing, v[0], v[1], v[2]);
}

/* At three depths, which do not vary: the earliest of all that lie there is seen, whatever its size. And at depth 1,
 * where nothing is seen. */
void fill_layers(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 400; i++) {
        uint32_t size = random_below(r, 64);
        double reach = size == 0 ? 500 : size < 4 ? 150 : size < 16 ? 40 : size < 32 ? 10 : 3;
        uint32_t layer = random_below(r, 7);
        double z = layer == 6 ? 1 : 0.25 * (layer % 3) - 0.25, step = random_below(r, 2) ? 0.5 : 1.0;
        triangle_on_grid(drawing, r, step, reach, (const double[3]){z, z, z});
    }
}

/* Most reach over many tiles, and more of them than are sorted by their depth at a time. */
void fill_crowd(struct drawing *drawing, struct random *r)
{
    bool perspective = random_below(r, 2);
    for (int i = 0; i < 600; i++) {
        double z = random_range(r, -0.8, 0.8), lean = random_below(r, 4) ? 0.02 : 0.19;
        const double low[3] = {-1, -1, z - lean}, high[3] = {1, 1, z + lean};
        uint32_t v[3];
        for (int k = 0; k < 3; k++) {
            double w = perspective ? random_power(r, -8, 6) : 1;
            v[k] = random_vertex_in(drawing, r, low, high, w);
        }
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

/* On the grid of subpixels and between its places, and wider than a tile. */
void fill_aligned_wide(struct drawing *drawing, struct random *r)
{
    static const double steps[] = {1.0 / 512, 1.0 / 256, 1.0 / 16, 0.5, 1};
    for (int i = 0; i < 12; i++) {
        double step = steps[random_below(r, sizeof steps / sizeof *steps)], z[3];
        for (int k = 0; k < 3; k++)
            z[k] = random_range(r, -0.9, 0.9);
        triangle_on_grid(drawing, r, step, random_range(r, 65, 250), z);
    }
}

/* A sheet of triangles that share their corners, about as large as pixels: nearly each pixel shows another one. */
static void add_sheet(struct drawing *drawing, struct random *r)
{
    enum { ACROSS = 40 };
    uint32_t v[ACROSS][ACROSS];
    const double step = random_range(r, 0.5, 3), size = step * ACROSS;
    const double left = random_range(r, 1, drawing->width - size - 1),
                 low = random_range(r, 1, drawing->height - size - 1);
    for (int row = 0; row < ACROSS; row++)
        for (int column = 0; column < ACROSS; column++) {
            double x = left + step * (column + random_range(r, 0, 0.7)),
                   y = low + step * (row + random_range(r, 0, 0.7));
            double z = random_range(r, -0.9, 0.9), w = random_power(r, -1, 1);
            v[row][column] = random_vertex(drawing, r, x * 2 / drawing->width - 1, y * 2 / drawing->height - 1, z, w);
        }
    for (int row = 0; row + 1 < ACROSS; row++)
        for (int column = 0; column + 1 < ACROSS; column++) {
            drawing_triangle(drawing, v[row][column], v[row][column + 1], v[row + 1][column]);
            drawing_triangle(drawing, v[row + 1][column], v[row][column + 1], v[row + 1][column + 1]);
        }
}

void fill_dense(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 3; i++)
        add_sheet(drawing, r);
}

/* As large as a stamp, which is four samples across and up, or a little larger, on the grid of pixels and off it, and
 * at the ends of tiles. */
void fill_stamps(struct drawing *drawing, struct random *r)
{
    static const double steps[] = {1.0 / 512, 1.0 / 16, 0.5, 1};
    const double reach = random_range(r, 2, 4.5), step = steps[random_below(r, sizeof steps / sizeof *steps)];
    for (int i = 0; i < 3000; i++) {
        double near = random_range(r, -0.9, 0.9), lean = random_below(r, 8) ? 0.05 : 0, z[3];
        for (int k = 0; k < 3; k++)
            z[k] = near + lean * random_range(r, -1, 1);
        triangle_on_grid(drawing, r, step, reach, z);
    }
}
