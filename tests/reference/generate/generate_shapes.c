/* Generators of polygons of any shape, of outlines, of lines and of points. */
#include <math.h>

#include "reference/generate/generate.h"

enum { CORNERS_MAX = 40, RINGS_MAX = 4 };

/* A plane in normalized device coordinates, and the box in which its polygons have their corners. */
struct place {
    double x, y, reach, z, slope_x, slope_y, uneven;
    double w_low, w_high;
    double step; /* of the grid that corners are on, or 0 */
};

static struct place random_place(struct random *r, double reach, double room)
{
    struct place p = {.reach = reach};
    p.x = random_range(r, -room, room);
    p.y = random_range(r, -room, room);
    p.z = random_range(r, -0.4, 0.4);
    p.slope_x = random_range(r, -0.2, 0.2);
    p.slope_y = random_range(r, -0.2, 0.2);
    p.uneven = random_below(r, 3) ? 0.0 : 0.02;
    bool perspective = random_below(r, 2);
    p.w_low = perspective ? 0.25 : 1.0;
    p.w_high = perspective ? 4.0 : 1.0;
    p.step = random_below(r, 3) ? 0.0 : 1.0 / 32;
    return p;
}

static uint32_t corner_at(struct drawing *drawing, struct random *r, const struct place *p, double dx, double dy)
{
    double x = p->x + p->reach * dx, y = p->y + p->reach * dy, off = random_range(r, -p->uneven, p->uneven);
    double w = random_range(r, p->w_low, p->w_high);
    if (p->step > 0.0) {
        x = floor(x / p->step) * p->step;
        y = floor(y / p->step) * p->step;
    }
    return random_vertex(drawing, r, x, y, p->z + p->slope_x * dx + p->slope_y * dy + off, w);
}

/* Corners anywhere: edges cross, and the ring goes round in any way it likes. */
static uint32_t scattered_ring(struct drawing *drawing, struct random *r, const struct place *p, uint32_t *out)
{
    uint32_t count = 3 + random_below(r, 9);
    for (uint32_t i = 0; i < count; i++) {
        double dx = random_range(r, -1, 1), dy = random_range(r, -1, 1);
        out[i] = i > 2 && random_below(r, 12) == 0 ? out[i - 2] : corner_at(drawing, r, p, dx, dy);
    }
    return count;
}

/* A star around a point: simple, with dents. The rational parametrization of the circle, so that no
 * function of libm is needed. */
static uint32_t star_ring(struct drawing *drawing, struct random *r, const struct place *p, double size, uint32_t *out)
{
    uint32_t count = 4 + random_below(r, CORNERS_MAX - 4);
    double cx = random_range(r, -0.5, 0.5) * (1 - size), cy = random_range(r, -0.5, 0.5) * (1 - size);
    bool turned = random_below(r, 2);
    for (uint32_t i = 0; i < count; i++) {
        double t = -4.0 + 8.0 * (turned ? count - 1 - i : i) / count, radius = size * random_range(r, 0.25, 1.0);
        out[i] = corner_at(drawing, r, p, cx + radius * (1 - t * t) / (1 + t * t), cy + radius * 2 * t / (1 + t * t));
    }
    return count;
}

static void add_shape(struct drawing *drawing, struct random *r, const struct place *place)
{
    uint32_t ring[CORNERS_MAX], rings = random_below(r, 3) ? 1 : 1 + random_below(r, RINGS_MAX);
    for (uint32_t i = 0; i < rings; i++) {
        uint32_t count = random_below(r, 2) ? scattered_ring(drawing, r, place, ring)
                                            : star_ring(drawing, r, place, i ? 0.4 : 1.0, ring);
        if (i == 0)
            drawing_face(drawing, ring, count);
        else
            drawing_hole(drawing, ring, count);
    }
}

void fill_shapes(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 12; i++) {
        double reach = random_power(r, -4, -2);
        struct place place = random_place(r, reach, 0.9 - reach);
        add_shape(drawing, r, &place);
    }
}

/* Across the borders, the near and the far plane; some corners behind the eye. */
void fill_shapes_clipped(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 8; i++) {
        struct place place = random_place(r, random_power(r, -2, 0), 1.2);
        place.z = random_range(r, -1.2, 1.2);
        place.slope_x = random_range(r, -1, 1);
        place.slope_y = random_range(r, -1, 1);
        if (random_below(r, 4) == 0) place.w_low = -0.5;
        add_shape(drawing, r, &place);
    }
}

static zr_mat4 slanted(struct random *r)
{
    zr_mat4 m = zr_mat4_identity();
    m.m[3] = (float)random_range(r, -0.3, 0.3);
    m.m[7] = (float)random_range(r, -0.3, 0.3);
    return m;
}

void fill_outlines(struct drawing *drawing, struct random *r)
{
    drawing->outline = random_below(r, 2) ? ZR_OUTLINE_OWN : ZR_OUTLINE_COLORED;
    drawing->unfilled = true;
    fill_shapes(drawing, r);
    fill_polygons(drawing, r);
}

void fill_outlines_clipped(struct drawing *drawing, struct random *r)
{
    drawing->outline = random_below(r, 2) ? ZR_OUTLINE_OWN : ZR_OUTLINE_COLORED;
    drawing->unfilled = true;
    fill_shapes_clipped(drawing, r);
    fill_polygons_clipped(drawing, r);
}

/* Faces and their outlines, which the faces make room for; and lines through all of it. */
void fill_hidden_lines(struct drawing *drawing, struct random *r)
{
    drawing->outline = ZR_OUTLINE_COLORED;
    fill_polygons(drawing, r);
    fill_shapes(drawing, r);
    fill_lines(drawing, r);
    drawing->projection = slanted(r);
}

/* Level, upright, slanted by one half, or any way; some of no length. */
static void add_line(struct drawing *drawing, struct random *r, double room, double reach, double w_low, double z_room)
{
    double x = random_range(r, -room, room), y = random_range(r, -room, room);
    double dx = random_range(r, -reach, reach), dy = random_range(r, -reach, reach);
    double z0 = random_range(r, -z_room, z_room), z1 = random_range(r, -z_room, z_room);
    double w0 = random_range(r, w_low, 2), w1 = random_range(r, w_low, 2);
    uint32_t kind = random_below(r, 8);
    if (kind == 0) dx = 0;
    if (kind == 1) dy = 0;
    if (kind == 2) dy = dx * drawing->width / drawing->height;
    if (kind == 3) { /* pixel centres and corners */
        x = floor(x * drawing->width) / drawing->width;
        y = floor(y * drawing->height) / drawing->height;
        dx = floor(dx * drawing->width) / drawing->width;
        dy = floor(dy * drawing->height) / drawing->height;
        w0 = w1 = 1;
    }
    double x1 = fmax(-room, fmin(room, x + dx)), y1 = fmax(-room, fmin(room, y + dy));
    uint32_t a = random_vertex(drawing, r, x, y, z0, w0), b = random_vertex(drawing, r, x1, y1, z1, w1);
    drawing_line(drawing, a, b);
}

void fill_lines(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 200; i++) {
        double reach = random_power(r, -7, -1);
        add_line(drawing, r, 0.98, reach, 0.25, 0.99);
    }
}

void fill_lines_clipped(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 200; i++) {
        double reach = random_power(r, -2, 1);
        add_line(drawing, r, 2.5, reach, random_below(r, 4) ? 0.25 : -0.5, 1.5);
    }
}

/* Sizes whole, by halves, near halves, or any. */
static float point_size(struct random *r)
{
    enum { LARGEST = 48 };
    const double whole = 1 + random_below(r, LARGEST);
    switch (random_below(r, 5)) {
    case 0:
        return 1.0f;
    case 1:
        return (float)(whole + 0.5);
    case 2:
        return (float)(whole + 0.5 + random_range(r, -1, 1) / 128);
    case 3:
        return (float)random_range(r, 1, 6);
    default:
        return (float)whole;
    }
}

/* Anywhere, on the borders of the view, or on corners and centres of pixels or a hair beside them. */
static void add_point(struct drawing *drawing, struct random *r, double room, double w_low, double z_room)
{
    double x = random_range(r, -room, room), y = random_range(r, -room, room), z = random_range(r, -z_room, z_room);
    double w = random_range(r, w_low, 2);
    const uint32_t kind = random_below(r, 8);
    if (kind < 2) {
        const double steps = random_below(r, 2) ? 1 : 256;
        x = floor(x * drawing->width * steps) / (drawing->width * steps);
        y = floor(y * drawing->height * steps) / (drawing->height * steps);
        w = 1;
    }
    if (kind == 2 && room > 1) x = x < 0 ? -1 : 1;
    if (kind == 3 && room > 1) y = y < 0 ? -1 : 1;
    if (kind == 4 && room > 1) z = z < 0 ? -1 : 1;
    drawing_point(drawing, random_vertex(drawing, r, x, y, z, w));
}

void fill_points(struct drawing *drawing, struct random *r)
{
    drawing->point_size = point_size(r);
    for (int i = 0; i < 200; i++)
        add_point(drawing, r, 0.98, 0.25, 0.99);
}

/* Beside the window, at its border, before the near plane, behind the far one and behind the eye; and faces among them.
 */
void fill_points_clipped(struct drawing *drawing, struct random *r)
{
    const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    uint32_t v[3];
    drawing->point_size = point_size(r);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++)
            v[k] = random_vertex_in(drawing, r, low, high, 1);
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
    for (int i = 0; i < 200; i++)
        add_point(drawing, r, 1.3, random_below(r, 4) ? 0.25 : -0.5, 1.3);
}
