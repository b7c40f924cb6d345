#include "input/mesh/shapes.h"

#include "base/trig.h"

/* A mesh while it is made. */
struct making {
    const struct zr_shape_desc *shape;
    zr_vec4 *positions;
    uint32_t *offsets, *indices;
    uint32_t position_count, face_count, corner_count;
};

static void add_position(struct making *m, double x, double y, double z)
{
    const double *move = m->shape->move;
    m->positions[m->position_count++] =
        (zr_vec4){(float)(x - move[0]), (float)(y - move[1]), (float)(z - move[2]), 1.0f};
}

/* Ends a face whose corners have been added. */
static void end_face(struct making *m)
{
    m->offsets[++m->face_count] = m->corner_count;
}

static void add_corner(struct making *m, uint32_t position)
{
    m->indices[m->corner_count++] = position;
}

static void add_quad(struct making *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_corner(m, a);
    add_corner(m, b);
    add_corner(m, c);
    add_corner(m, d);
    end_face(m);
}

static void add_triangle(struct making *m, uint32_t a, uint32_t b, uint32_t c)
{
    add_corner(m, a);
    add_corner(m, b);
    add_corner(m, c);
    end_face(m);
}

/* Adds a ring of positions around the z axis. */
static void add_ring(struct making *m, double radius, double z)
{
    const uint32_t count = m->shape->segments;
    for (uint32_t i = 0; i < count; i++) {
        double sine, cosine;
        zr_sine_cosine(360.0 * (double)i / (double)count, &sine, &cosine);
        add_position(m, radius * cosine, radius * sine, z);
    }
}

/* Adds quads between two rings of `count` positions; the second is above the first. */
static void add_sides(struct making *m, uint32_t below, uint32_t above, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t next = (i + 1) % count;
        add_quad(m, below + i, below + next, above + next, above + i);
    }
}

/* Adds a polygon of a ring: seen from above, or from below. */
static void add_cap(struct making *m, uint32_t ring, uint32_t count, bool is_top)
{
    for (uint32_t i = 0; i < count; i++)
        add_corner(m, is_top ? ring + i : ring + count - 1 - i);
    end_face(m);
}

/* Adds triangles between a ring and a point on the axis. */
static void add_fan(struct making *m, uint32_t ring, uint32_t count, uint32_t point, bool is_top)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t next = (i + 1) % count;
        add_triangle(m, ring + (is_top ? i : next), ring + (is_top ? next : i), point);
    }
}

/* ---- bodies ---- */

static void make_box(struct making *m)
{
    static const uint8_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const double *size = m->shape->size;
    for (int i = 0; i < 8; i++)
        add_position(m, (i & 1 ? 0.5 : -0.5) * size[0], (i & 2 ? 0.5 : -0.5) * size[1], (i & 4 ? 0.5 : -0.5) * size[2]);
    for (int f = 0; f < 6; f++)
        add_quad(m, faces[f][0], faces[f][1], faces[f][2], faces[f][3]);
}

/* Cylinders and cones. */
static void make_frustum(struct making *m, double bottom, double top)
{
    const uint32_t n = m->shape->segments;
    const double half = 0.5 * m->shape->height;
    add_ring(m, bottom, -half);
    if (top > 0.0) {
        add_ring(m, top, half);
        add_sides(m, 0, n, n);
        add_cap(m, n, n, true);
    } else {
        add_position(m, 0.0, 0.0, half);
        add_fan(m, 0, n, n, true);
    }
    add_cap(m, 0, n, false);
}

static uint32_t rings_of(const struct zr_shape_desc *shape)
{
    return shape->segments / 2 > 2 ? shape->segments / 2 - 1 : 1;
}

static void make_sphere(struct making *m)
{
    const uint32_t n = m->shape->segments, rings = rings_of(m->shape);
    const double radius = m->shape->radius;
    for (uint32_t i = 1; i <= rings; i++) {
        double sine, cosine;
        zr_sine_cosine(180.0 * (double)i / (double)(rings + 1), &sine, &cosine);
        add_ring(m, radius * sine, -radius * cosine);
    }
    add_position(m, 0.0, 0.0, -radius);
    add_position(m, 0.0, 0.0, radius);
    add_fan(m, 0, n, rings * n, false);
    for (uint32_t i = 0; i + 1 < rings; i++)
        add_sides(m, i * n, (i + 1) * n, n);
    add_fan(m, (rings - 1) * n, n, rings * n + 1, true);
}

static void make_torus(struct making *m)
{
    const uint32_t n = m->shape->segments;
    for (uint32_t i = 0; i < n; i++) {
        double sine, cosine;
        zr_sine_cosine(360.0 * (double)i / (double)n, &sine, &cosine);
        add_ring(m, m->shape->radius + m->shape->tube * cosine, m->shape->tube * sine);
    }
    for (uint32_t i = 0; i < n; i++)
        add_sides(m, i * n, (i + 1) % n * n, n);
}

static void make_extrusion(struct making *m)
{
    const struct zr_shape_desc *shape = m->shape;
    const bool is_reversed = zr_shape_area(shape) < 0.0;
    for (int side = -1; side <= 1; side += 2)
        for (uint32_t i = 0; i < shape->count; i++) {
            const double *p = shape->points[is_reversed ? shape->count - 1 - i : i];
            add_position(m, p[0], p[1], (double)side * 0.5 * shape->height);
        }
    add_sides(m, 0, shape->count, shape->count);
    add_cap(m, shape->count, shape->count, true);
    add_cap(m, 0, shape->count, false);
}

/* ---- all ---- */

/* Upper bounds of a body's parts. */
struct room {
    size_t positions, faces, corners;
};

static struct room room_of(const struct zr_shape_desc *shape)
{
    const size_t n = shape->segments, rings = rings_of(shape), points = shape->count;
    switch (shape->type) {
    case ZR_SHAPE_BOX:
        return (struct room){8, 6, 24};
    case ZR_SHAPE_SPHERE:
        return (struct room){rings * n + 2, (rings + 1) * n, 4 * (rings + 1) * n};
    case ZR_SHAPE_TORUS:
        return (struct room){n * n, n * n, 4 * n * n};
    case ZR_SHAPE_EXTRUSION:
        return (struct room){2 * points, points + 2, 6 * points};
    default:
        return (struct room){2 * n, n + 2, 6 * n};
    }
}

bool zr_shape_make(struct zr_arena *arena, const struct zr_shape_desc *shape, struct zr_mesh *mesh)
{
    const struct room room = room_of(shape);
    struct making m = {.shape = shape,
                       .positions = zr_arena_alloc(arena, room.positions, sizeof *m.positions),
                       .offsets = zr_arena_alloc(arena, room.faces + 1, sizeof *m.offsets),
                       .indices = zr_arena_alloc(arena, room.corners, sizeof *m.indices)};
    if (!zr_arena_ok(arena)) return false;
    m.offsets[0] = 0;
    switch (shape->type) {
    case ZR_SHAPE_BOX:
        make_box(&m);
        break;
    case ZR_SHAPE_SPHERE:
        make_sphere(&m);
        break;
    case ZR_SHAPE_CYLINDER:
        make_frustum(&m, shape->radius, shape->radius);
        break;
    case ZR_SHAPE_CONE:
        make_frustum(&m, shape->radius, shape->top);
        break;
    case ZR_SHAPE_TORUS:
        make_torus(&m);
        break;
    default:
        make_extrusion(&m);
    }
    mesh->position_count = m.position_count;
    mesh->positions = m.positions;
    mesh->face_count = m.face_count;
    mesh->face_offsets = m.offsets;
    mesh->indices = m.indices;
    return true;
}

double zr_shape_area(const struct zr_shape_desc *shape)
{
    const double *first = shape->points[0];
    double area = 0.0;
    for (uint32_t i = 1; i + 1 < shape->count; i++) {
        const double *a = shape->points[i], *b = shape->points[i + 1];
        area += (a[0] - first[0]) * (b[1] - first[1]) - (b[0] - first[0]) * (a[1] - first[1]);
    }
    return area;
}
