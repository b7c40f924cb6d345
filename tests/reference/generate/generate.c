#include "reference/generate/generate.h"

#include <math.h>

/* One picture in so many has colours per vertex, one in so many those of first corners. */
enum { SMOOTH_SHARE = 3, FIRST_CORNER_SHARE = 6, SAMPLES_SHARE = 8, WIDE_SHARE = 4 };

double random_power(struct random *r, int low, int high)
{
    double mantissa = random_range(r, 1.0, 2.0);
    return ldexp(mantissa, low + (int)random_below(r, (uint32_t)(high - low + 1)));
}

double random_signed_power(struct random *r, int low, int high)
{
    bool negative = random_below(r, 2);
    double power = random_power(r, low, high);
    return negative ? -power : power;
}

/* Now and then exactly 0 or 1, where rounding to 8 bits ends. */
static float random_channel(struct random *r)
{
    uint32_t pick = random_below(r, 16);
    return pick < 2 ? (float)pick : (float)random_range(r, 0.0, 1.0);
}

static uint32_t vertex(struct drawing *drawing, struct random *r, double x, double y, double z, double w)
{
    float red = random_channel(r), green = random_channel(r), blue = random_channel(r);
    return drawing_position(drawing, (zr_vec4){(float)x, (float)y, (float)z, (float)w},
                            (zr_vec4){red, green, blue, 1.0f});
}

uint32_t random_vertex(struct drawing *drawing, struct random *r, double x, double y, double z, double w)
{
    return vertex(drawing, r, x * w, y * w, z * w, w);
}

uint32_t random_vertex_in(struct drawing *drawing, struct random *r, const double low[3], const double high[3],
                          double w)
{
    double at[3];
    for (int k = 0; k < 3; k++)
        at[k] = random_range(r, low[k], high[k]);
    return random_vertex(drawing, r, at[0], at[1], at[2], w);
}

/* Depths stay off the near and far planes, so that only kinds that mean to clip do. */
static const double depth_limit = 0.999;

static double random_depth(struct random *r)
{
    return random_range(r, -depth_limit, depth_limit);
}

static void fill_large(struct drawing *drawing, struct random *r)
{
    const double low[3] = {-1, -1, -depth_limit}, high[3] = {1, 1, depth_limit};
    uint32_t count = 4 + random_below(r, 9);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = random_vertex_in(drawing, r, low, high, 1);
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

/* A triangle whose corners are at most `radius` pixels from a random centre. */
static void local_triangle(struct drawing *drawing, struct random *r, double radius, double w_low, double w_high)
{
    double rx = fmin(radius * 2.0 / drawing->width, 1.0), ry = fmin(radius * 2.0 / drawing->height, 1.0);
    double x = random_range(r, rx - 1, 1 - rx), y = random_range(r, ry - 1, 1 - ry);
    const double low[3] = {x - rx, y - ry, -depth_limit}, high[3] = {x + rx, y + ry, depth_limit};
    uint32_t v[3];
    for (int k = 0; k < 3; k++) {
        double w = random_range(r, w_low, w_high);
        v[k] = random_vertex_in(drawing, r, low, high, w);
    }
    drawing_triangle(drawing, v[0], v[1], v[2]);
}

static void fill_small(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 400; i++)
        local_triangle(drawing, r, random_power(r, -1, 3), 1, 1);
}

/* The third corner lies near the line through the others, or exactly on it, or
 * on one of them. */
static void fill_slivers(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 100; i++) {
        double x0 = random_range(r, -1, 1), y0 = random_range(r, -1, 1), z0 = random_depth(r);
        double x1 = random_range(r, -1, 1), y1 = random_range(r, -1, 1), z1 = random_depth(r);
        double t = random_below(r, 8) ? random_range(r, 0.0, 1.0) : random_below(r, 5) * 0.25;
        double off = random_below(r, 8) ? random_signed_power(r, -16, -5) : 0.0;
        double z2 = random_below(r, 2) ? z0 + t * (z1 - z0) : random_depth(r);
        double w = random_below(r, 2) ? 1.0 : random_power(r, -4, 4);
        uint32_t a = random_vertex(drawing, r, x0, y0, z0, w), b = random_vertex(drawing, r, x1, y1, z1, w);
        uint32_t c = random_vertex(drawing, r, x0 + t * (x1 - x0) - off * (y1 - y0),
                                   y0 + t * (y1 - y0) + off * (x1 - x0), z2, w);
        drawing_triangle(drawing, a, b, c);
    }
}

/* A jittered grid of triangles that share all their edges; half of the pictures
 * with a w of its own at each vertex. */
static void fill_mesh(struct drawing *drawing, struct random *r)
{
    uint32_t columns = 2 + random_below(r, 12), rows = 2 + random_below(r, 10);
    double jitter = random_below(r, 4) ? random_range(r, 0.0, 0.7) : 0.0;
    bool perspective = random_below(r, 2);
    uint32_t first = drawing->position_count;
    for (uint32_t j = 0; j <= rows; j++)
        for (uint32_t i = 0; i <= columns; i++) {
            double x = (i + random_range(r, -0.5, 0.5) * jitter) * 1.96 / columns - 0.98;
            double y = (j + random_range(r, -0.5, 0.5) * jitter) * 1.96 / rows - 0.98;
            double z = random_depth(r), w = perspective ? random_range(r, 0.2, 3) : 1;
            random_vertex(drawing, r, x, y, z, w);
        }
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns; i++) {
            uint32_t a = first + j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
            bool other = random_below(r, 2);
            drawing_triangle(drawing, a, b, other ? d : c);
            if (other)
                drawing_triangle(drawing, b, c, d);
            else
                drawing_triangle(drawing, a, c, d);
        }
}

/* Corners on multiples of `step` pixels, at most `reach` steps apart. */
static void grid_triangle(struct drawing *drawing, struct random *r, double step, uint32_t reach)
{
    uint32_t columns = (uint32_t)(drawing->width / step), rows = (uint32_t)(drawing->height / step);
    uint32_t x0 = random_below(r, columns), y0 = random_below(r, rows), v[3];
    for (int k = 0; k < 3; k++) {
        double x = fmin(x0 + random_below(r, reach + 1), columns) * step;
        double y = fmin(y0 + random_below(r, reach + 1), rows) * step;
        v[k] = random_vertex(drawing, r, x * 2.0 / drawing->width - 1.0, y * 2.0 / drawing->height - 1.0,
                             random_depth(r), 1);
    }
    drawing_triangle(drawing, v[0], v[1], v[2]);
}

/* Multiples of 1/512 lie halfway between two snapped places: round to even. */
static void fill_subpixel(struct drawing *drawing, struct random *r)
{
    static const double steps[] = {1.0 / 512, 1.0 / 256, 1.0 / 128, 1.0 / 16, 0.5};
    for (int i = 0; i < 150; i++) {
        double step = steps[random_below(r, sizeof steps / sizeof *steps)];
        grid_triangle(drawing, r, step, (uint32_t)(random_power(r, 1, 3) / step));
    }
}

static void fill_pixel_aligned(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 100; i++) {
        double step = random_below(r, 2) ? 1.0 : 0.5;
        grid_triangle(drawing, r, step, 4 + random_below(r, 40));
    }
}

static void fill_perspective(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 60; i++) {
        double radius = random_power(r, 3, 6), w_low = random_power(r, -5, -1);
        local_triangle(drawing, r, radius, w_low, 4);
    }
}

/* Corners anywhere in the box given, in units of their own w. */
static void fill_box(struct drawing *drawing, struct random *r, const double low[3], const double high[3])
{
    for (int i = 0; i < 40; i++) {
        uint32_t v[3];
        double shared = random_power(r, -3, 3);
        for (int k = 0; k < 3; k++) {
            double w = random_below(r, 2) ? shared : random_power(r, -3, 3);
            v[k] = random_vertex_in(drawing, r, low, high, w);
        }
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

static void fill_near(struct drawing *drawing, struct random *r)
{
    fill_box(drawing, r, (double[]){-1, -1, -3}, (double[]){1, 1, 1});
}

static void fill_far(struct drawing *drawing, struct random *r)
{
    fill_box(drawing, r, (double[]){-1, -1, -1}, (double[]){1, 1, 3});
}

static void fill_side(struct drawing *drawing, struct random *r)
{
    if (random_below(r, 2))
        fill_box(drawing, r, (double[]){-3, -1, -1}, (double[]){3, 1, 1});
    else
        fill_box(drawing, r, (double[]){-1, -3, -1}, (double[]){1, 3, 1});
}

/* w of either sign: corners in front of the eye and behind it. */
static void fill_planes(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 30; i++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++) {
            double x = random_range(r, -2, 2), y = random_range(r, -2, 2), z = random_range(r, -2, 2);
            v[k] = vertex(drawing, r, x, y, z, random_range(r, -0.5, 2));
        }
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

/* Coordinates that differ by many powers of two. */
static void fill_huge(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 30; i++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++) {
            double w = random_power(r, -6, 6), x = random_signed_power(r, -8, 12), y = random_signed_power(r, -8, 12);
            bool behind = random_below(r, 4) == 0;
            v[k] = random_vertex(drawing, r, x, y, random_signed_power(r, -8, 4), behind ? -w : w);
        }
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

const struct generator generators[] = {
    {"large", false, false, WINDOWS_ANY, fill_large},
    {"small", false, false, WINDOWS_ANY, fill_small},
    {"slivers", false, false, WINDOWS_ANY, fill_slivers},
    {"mesh", false, false, WINDOWS_ANY, fill_mesh},
    {"subpixel", false, false, WINDOWS_BINARY, fill_subpixel},
    {"pixel-aligned", false, false, WINDOWS_BINARY, fill_pixel_aligned},
    {"pixel-aligned-odd", false, false, WINDOWS_ANY, fill_pixel_aligned},
    {"perspective", false, false, WINDOWS_ANY, fill_perspective},
    {"near-clipped", true, false, WINDOWS_ANY, fill_near},
    {"far-clipped", true, false, WINDOWS_ANY, fill_far},
    {"side-clipped", true, false, WINDOWS_ANY, fill_side},
    {"planes-clipped", true, false, WINDOWS_ANY, fill_planes},
    {"huge", true, false, WINDOWS_ANY, fill_huge},
    {"coplanar", false, false, WINDOWS_ANY, fill_coplanar},
    {"polygons", false, false, WINDOWS_ANY, fill_polygons},
    {"polygons-clipped", true, false, WINDOWS_ANY, fill_polygons_clipped},
    {"matrix-orthographic", true, false, WINDOWS_ANY, fill_matrix_orthographic},
    {"matrix-perspective", true, false, WINDOWS_ANY, fill_matrix_perspective},
    {"matrix-any", true, false, WINDOWS_ANY, fill_matrix_any},
    {"shapes", false, false, WINDOWS_ANY, fill_shapes},
    {"shapes-clipped", true, false, WINDOWS_ANY, fill_shapes_clipped},
    {"outlines", false, true, WINDOWS_ANY, fill_outlines},
    {"outlines-clipped", true, true, WINDOWS_ANY, fill_outlines_clipped},
    {"hidden-lines", true, true, WINDOWS_ANY, fill_hidden_lines},
    {"lines", false, true, WINDOWS_ANY, fill_lines},
    {"lines-clipped", true, true, WINDOWS_ANY, fill_lines_clipped},
    {"points", false, true, WINDOWS_ANY, fill_points},
    {"points-clipped", true, true, WINDOWS_ANY, fill_points_clipped},
    {"tiny", false, false, WINDOWS_LARGE, fill_tiny},
    {"layers", false, false, WINDOWS_LARGE, fill_layers},
    {"crowd", false, false, WINDOWS_LARGE, fill_crowd},
    {"aligned-wide", false, false, WINDOWS_BINARY, fill_aligned_wide},
    {"dense", false, false, WINDOWS_LARGE, fill_dense},
    {"stamps", false, false, WINDOWS_ANY, fill_stamps},
    {"lit", true, false, WINDOWS_ANY, fill_lit},
    {"lamps", true, false, WINDOWS_ANY, fill_lamps},
    {"spots", true, false, WINDOWS_ANY, fill_spots},
    {"blended", true, true, WINDOWS_ANY, fill_blended},
    {"masked", true, true, WINDOWS_ANY, fill_masked},
};
const size_t generator_count = sizeof generators / sizeof *generators;

static const uint32_t *pick_window(enum windows windows, struct random *r)
{
    static const uint32_t binary[][2] = {{128, 64}, {256, 256}, {64, 64}, {512, 128}, {16, 32}};
    static const uint32_t any[][2] = {{97, 61},   {300, 200}, {255, 129}, {128, 64},  {101, 200},
                                      {256, 256}, {33, 47},   {200, 199}, {130, 100}, {1, 7}};
    static const uint32_t large[][2] = {{320, 256}, {437, 199}, {385, 319}};
    switch (windows) {
    case WINDOWS_BINARY:
        return binary[random_below(r, sizeof binary / sizeof *binary)];
    case WINDOWS_LARGE:
        return large[random_below(r, sizeof large / sizeof *large)];
    case WINDOWS_ANY:
        break;
    }
    return any[random_below(r, sizeof any / sizeof *any)];
}

/* Some pictures have several samples per pixel, and some wide lines; by numbers of their own, so that nothing else of
 * the picture depends on it. Large windows have fewer samples, for they take as much longer. */
static void choose_samples(const struct generator *generator, uint64_t seed, uint64_t frame, struct drawing *drawing)
{
    enum { MANY_SAMPLES_MAX = 20000 };
    struct random r = random_seeded(~seed ^ (frame << 8));
    if (frame % SAMPLES_SHARE == SAMPLES_SHARE - 3)
        drawing->side = drawing->width * drawing->height <= MANY_SAMPLES_MAX ? 4 : 2;
    if (generator->wires && frame % WIDE_SHARE == 1) drawing->line_width = (float)random_range(&r, 0.3, 9.0);
}

void generate(const struct generator *generator, uint64_t seed, uint64_t frame, struct drawing *drawing)
{
    uint64_t kind = (uint64_t)(generator - generators);
    struct random r = random_seeded(seed ^ (kind << 56) ^ (frame << 8));
    const uint32_t *size = pick_window(generator->windows, &r);
    drawing_start(drawing, size[0], size[1]);
    generator->fill(drawing, &r);
    choose_samples(generator, seed, frame, drawing);
    drawing->smooth = frame % SMOOTH_SHARE == SMOOTH_SHARE - 1;
    drawing->first_corner = frame % FIRST_CORNER_SHARE == FIRST_CORNER_SHARE / 2;
}
