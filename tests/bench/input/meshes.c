#include "bench/input/meshes.h"

#include <math.h>
#include <stdlib.h>

#include "reference/models.h"
#include "support/random.h"

static const double PI = 3.14159265358979323846;

enum { FILL_LAYERS = 16, SEED = 7 };

static const double FOCAL = 2.0, NEAR = 1.0, FAR = 100.0;

/* A camera in the origin that looks along -z. */
static void look(struct drawing *drawing, uint32_t width, uint32_t height)
{
    drawing_start(drawing, width, height);
    zr_mat4 m = {{0}};
    m.m[0] = (float)(FOCAL * height / width);
    m.m[5] = (float)FOCAL;
    m.m[10] = (float)(-(FAR + NEAR) / (FAR - NEAR));
    m.m[11] = -1.0f;
    m.m[14] = (float)(-2 * FAR * NEAR / (FAR - NEAR));
    drawing->projection = m;
}

void meshes_look(struct drawing *drawing, bool from_corner, float zoom, uint32_t width, uint32_t height)
{
    models_look(drawing, from_corner ? 1 : 0, width, height);
    drawing->projection.m[0] *= zoom;
    drawing->projection.m[5] *= zoom;
}

/* The point that is seen at x, y (-1 to 1 over the window), `distance` in front of the camera. */
static zr_vec4 seen_at(const struct drawing *drawing, double x, double y, double distance)
{
    return (zr_vec4){(float)(x * distance / (double)drawing->projection.m[0]),
                     (float)(y * distance / (double)drawing->projection.m[5]), (float)-distance, 1.0f};
}

static zr_vec4 some_color(struct random *random)
{
    return (zr_vec4){(float)random_range(random, 0.0, 1.0), (float)random_range(random, 0.0, 1.0),
                     (float)random_range(random, 0.0, 1.0), 1.0f};
}

void meshes_fill(struct drawing *drawing, uint32_t width, uint32_t height, bool front_first)
{
    static const double corners[3][2] = {{-1.0, -1.0}, {1.5, -1.0}, {-1.0, 1.5}};
    struct random random = random_seeded(SEED);
    look(drawing, width, height);
    for (uint32_t i = 0; i < FILL_LAYERS; i++) {
        uint32_t layer = front_first ? i : FILL_LAYERS - 1 - i, first = drawing->position_count;
        double distance = 5.0 * (1.0 + 0.2 * layer);
        for (int c = 0; c < 3; c++)
            drawing_position(drawing, seen_at(drawing, corners[c][0], corners[c][1], distance * (1.0 + 0.5 * c)),
                             some_color(&random));
        drawing_triangle(drawing, first, first + 1, first + 2);
    }
}

static const float HALF_OF_THE_WINDOW = 1.3f;

void meshes_cube(struct drawing *drawing, uint32_t width, uint32_t height)
{
    static const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    drawing_start(drawing, width, height);
    for (int i = 0; i < 8; i++) {
        zr_vec4 c = {i & 1 ? 1.0f : 0.0f, i & 2 ? 1.0f : 0.0f, i & 4 ? 1.0f : 0.0f, 1.0f};
        drawing_position(drawing, (zr_vec4){2 * c.x - 1, 2 * c.y - 1, 2 * c.z - 1, 1.0f}, c);
    }
    for (int f = 0; f < 6; f++) {
        drawing_triangle(drawing, faces[f][0], faces[f][1], faces[f][2]);
        drawing_triangle(drawing, faces[f][0], faces[f][2], faces[f][3]);
    }
    meshes_look(drawing, true, HALF_OF_THE_WINDOW, width, height);
}

/* ---- a ball with bumps ---- */

static void ball_point(struct drawing *drawing, double latitude, double longitude)
{
    double x = cos(latitude) * cos(longitude), y = sin(latitude), z = cos(latitude) * sin(longitude);
    double radius = 1.0 + 0.08 * sin(6 * x + 2 * y) * cos(5 * z) + 0.02 * sin(31 * x) * sin(29 * y) * sin(37 * z);
    drawing_position(drawing, (zr_vec4){(float)(radius * x), (float)(radius * y), (float)(radius * z), 1.0f},
                     (zr_vec4){(float)(0.5 + 0.5 * x), (float)(0.5 + 0.5 * y), (float)(0.5 + 0.5 * z), 1.0f});
}

void meshes_ball(struct drawing *drawing, uint32_t rings)
{
    uint32_t around = 2 * rings;
    drawing_start(drawing, 1, 1);
    ball_point(drawing, PI / 2, 0.0);
    for (uint32_t r = 1; r < rings; r++)
        for (uint32_t i = 0; i < around; i++)
            ball_point(drawing, PI / 2 - PI * r / rings, 2 * PI * i / around);
    ball_point(drawing, -PI / 2, 0.0);
    uint32_t last = drawing->position_count - 1;
    for (uint32_t r = 0; r < rings; r++)
        for (uint32_t i = 0; i < around; i++) {
            uint32_t next = (i + 1) % around, upper = 1 + (r - 1) * around, lower = 1 + r * around;
            if (r == 0)
                drawing_triangle(drawing, 0, lower + next, lower + i);
            else if (r == rings - 1)
                drawing_triangle(drawing, last, upper + i, upper + next);
            else {
                drawing_triangle(drawing, upper + i, upper + next, lower + i);
                drawing_triangle(drawing, upper + next, lower + next, lower + i);
            }
        }
}

/* ---- polygons ---- */

/* Corners on an ellipse, one in each of `corners` equal parts of the turn, so that it stays convex on the grid of
 * 1/256 pixel; in one plane, since 1/distance is linear over the window. Of three corners the last has the colour of
 * the first: flat, it then does not matter which of them a renderer takes. */
static void one_polygon(struct drawing *drawing, struct random *random)
{
    enum { CORNERS_MAX = 12 };
    uint32_t corners = 3 + (uint32_t)random_below(random, CORNERS_MAX - 2), indices[CORNERS_MAX];
    double size = random_range(random, 0.0, 1.0), radius = 4.0 + 26.0 * size * size * size; /* pixels */
    double flat = random_range(random, 0.6, 1.0), start = random_range(random, 0.0, 2 * PI);
    double half_x = drawing->width / 2.0, half_y = drawing->height / 2.0;
    double x = random_range(random, radius - half_x + 1, half_x - radius - 1);
    double y = random_range(random, radius - half_y + 1, half_y - radius - 1);
    double distance = random_range(random, 2.0, 40.0), tilt_x = random_range(random, -0.3, 0.3),
           tilt_y = random_range(random, -0.3, 0.3), turn = random_below(random, 2) ? 1.0 : -1.0;
    zr_vec4 first_color = {0};
    for (uint32_t i = 0; i < corners; i++) {
        double angle = start + turn * 2 * PI * (i + random_range(random, -0.2, 0.2)) / corners;
        double dx = cos(angle), dy = flat * sin(angle);
        zr_vec4 color = some_color(random);
        if (i == 0) first_color = color;
        indices[i] = drawing_position(drawing,
                                      seen_at(drawing, (x + radius * dx) / half_x, (y + radius * dy) / half_y,
                                              distance / (1.0 + tilt_x * dx + tilt_y * dy)),
                                      corners == 3 && i == 2 ? first_color : color);
    }
    drawing_face(drawing, indices, corners);
}

void meshes_polygons(struct drawing *drawing, uint32_t width, uint32_t height, uint32_t count)
{
    struct random random = random_seeded(SEED);
    look(drawing, width, height);
    for (uint32_t i = 0; i < count; i++)
        one_polygon(drawing, &random);
}

/* ---- subdivision ---- */

/* Edges and the corners in their middles. Open addressing; its size is a power of two. */
struct middles {
    uint64_t *edges; /* the two corners, the lower first; UINT64_MAX: none */
    uint32_t *corners;
    uint64_t mask;
};

static bool middles_make(struct middles *middles, uint32_t triangles)
{
    uint64_t size = 64;
    while (size < (uint64_t)triangles * 4)
        size *= 2;
    *middles =
        (struct middles){malloc(size * sizeof *middles->edges), malloc(size * sizeof *middles->corners), size - 1};
    if (!middles->edges || !middles->corners) return false;
    for (uint64_t i = 0; i < size; i++)
        middles->edges[i] = UINT64_MAX;
    return true;
}

static float mean(float a, float b)
{
    return (a + b) * 0.5f;
}

static zr_vec4 between(zr_vec4 a, zr_vec4 b)
{
    return (zr_vec4){mean(a.x, b.x), mean(a.y, b.y), mean(a.z, b.z), mean(a.w, b.w)};
}

static uint32_t middle_of(struct middles *middles, struct drawing *fine, uint32_t a, uint32_t b)
{
    uint64_t edge = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a, at = edge;
    at = random_split(&at) & middles->mask;
    while (middles->edges[at] != UINT64_MAX && middles->edges[at] != edge)
        at = (at + 1) & middles->mask;
    if (middles->edges[at] == UINT64_MAX) {
        middles->edges[at] = edge;
        middles->corners[at] = drawing_position(fine, between(fine->positions[a], fine->positions[b]),
                                                between(fine->colors[a], fine->colors[b]));
    }
    return middles->corners[at];
}

void meshes_subdivide(const struct drawing *coarse, struct drawing *fine)
{
    struct middles middles;
    drawing_start(fine, coarse->width, coarse->height);
    fine->modelview = coarse->modelview;
    fine->projection = coarse->projection;
    if (!middles_make(&middles, coarse->face_count)) fine->failed = true;
    for (uint32_t i = 0; i < coarse->position_count && !fine->failed; i++)
        drawing_position(fine, coarse->positions[i], coarse->colors[i]);
    for (uint32_t f = 0; f < coarse->face_count && !fine->failed; f++) {
        const uint32_t *v = coarse->indices + coarse->face_offsets[f];
        uint32_t ab = middle_of(&middles, fine, v[0], v[1]), bc = middle_of(&middles, fine, v[1], v[2]);
        uint32_t ca = middle_of(&middles, fine, v[2], v[0]);
        drawing_triangle(fine, v[0], ab, ca);
        drawing_triangle(fine, ab, v[1], bc);
        drawing_triangle(fine, ca, bc, v[2]);
        drawing_triangle(fine, ab, bc, ca);
    }
    free(middles.edges);
    free(middles.corners);
}
