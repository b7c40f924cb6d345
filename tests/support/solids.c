#include "support/solids.h"

#include <math.h>

const char *const solid_names[SOLIDS] = {"cube",        "sphere",      "torus", "ring",
                                         "hollow cube", "overlapping", "plate", "inside out"};

/* A mesh that grows in arrays of fixed size. */
struct growing {
    struct zr_mesh mesh;
    zr_vec4 *positions;
    uint32_t *offsets, *indices, *rings, *ring_offsets;
};

enum { POSITIONS = 1 << 13, CORNERS = 1 << 14 };

static struct growing begin(struct zr_arena *arena)
{
    struct growing g = {.positions = zr_arena_zero(arena, POSITIONS, sizeof *g.positions),
                        .offsets = zr_arena_zero(arena, CORNERS, sizeof *g.offsets),
                        .indices = zr_arena_zero(arena, CORNERS, sizeof *g.indices),
                        .rings = zr_arena_zero(arena, CORNERS, sizeof *g.rings),
                        .ring_offsets = zr_arena_zero(arena, CORNERS, sizeof *g.ring_offsets)};
    g.mesh =
        (struct zr_mesh){.name = "solid", .positions = g.positions, .face_offsets = g.offsets, .indices = g.indices};
    return g;
}

static uint32_t add_position(struct growing *g, double x, double y, double z)
{
    g->positions[g->mesh.position_count] = (zr_vec4){(float)x, (float)y, (float)z, 1.0f};
    return g->mesh.position_count++;
}

static void add_face(struct growing *g, const uint32_t *corners, uint32_t count)
{
    uint32_t at = g->offsets[g->mesh.face_count];
    for (uint32_t i = 0; i < count; i++)
        g->indices[at++] = corners[i];
    g->offsets[++g->mesh.face_count] = at;
}

/* `turn`: the faces point inwards. */
static void add_box(struct growing *g, const double low[3], const double high[3], bool turn)
{
    static const uint8_t faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};
    const uint32_t first = g->mesh.position_count;
    for (int i = 0; i < 8; i++)
        add_position(g, i % 4 == 1 || i % 4 == 2 ? high[0] : low[0], i % 4 >= 2 ? high[1] : low[1],
                     i >= 4 ? high[2] : low[2]);
    for (int f = 0; f < 6; f++) {
        uint32_t corners[4];
        for (int k = 0; k < 4; k++)
            corners[k] = first + faces[f][turn ? 3 - k : k];
        add_face(g, corners, 4);
    }
}

static const double pi = 3.14159265358979323846;

/* A torus around z of `n` by `m` quads, or of twice as many triangles. */
static void add_torus(struct growing *g, uint32_t n, uint32_t m, double radius, double tube, bool triangles)
{
    const uint32_t first = g->mesh.position_count;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            const double u = 2 * pi * i / n, v = 2 * pi * k / m, r = radius + tube * cos(v);
            add_position(g, r * cos(u), r * sin(u), tube * sin(v));
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            const uint32_t a = first + i * m + k, b = first + (i + 1) % n * m + k,
                           c = first + (i + 1) % n * m + (k + 1) % m, d = first + i * m + (k + 1) % m;
            if (!triangles) {
                add_face(g, (const uint32_t[4]){a, b, c, d}, 4);
                continue;
            }
            add_face(g, (const uint32_t[3]){a, b, c}, 3);
            add_face(g, (const uint32_t[3]){a, c, d}, 3);
        }
}

static zr_vec4 on_sphere(uint32_t i, uint32_t k, uint32_t n, uint32_t m)
{
    const double u = 2 * pi * (i % n) / n, v = pi * k / m, r = k == 0 || k == m ? 0.0 : sin(v);
    return (zr_vec4){(float)(r * cos(u)), (float)(r * sin(u)), (float)cos(v), 1.0f};
}

/* Each triangle has positions of its own. */
static void add_sphere(struct growing *g, uint32_t n, uint32_t m, bool turn)
{
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++) {
            const zr_vec4 q[4] = {on_sphere(i, k, n, m), on_sphere(i, k + 1, n, m), on_sphere(i + 1, k + 1, n, m),
                                  on_sphere(i + 1, k, n, m)};
            for (int half = 0; half < 2; half++) {
                if (half == 0 ? k + 1 == m : k == 0) continue;
                uint32_t corners[3];
                for (int c = 0; c < 3; c++) {
                    const zr_vec4 p = q[half == 0 ? c : (c + 2) % 4];
                    corners[turn ? 2 - c : c] = g->mesh.position_count;
                    g->positions[g->mesh.position_count++] = p;
                }
                add_face(g, corners, 3);
            }
        }
}

/* A plate from -1 to 1 with two square holes through it along z. */
static void make_plate(struct growing *g)
{
    static const double squares[3][4] = {{-1, -1, 1, 1}, {-0.7, -0.7, -0.1, 0.5}, {0.2, -0.3, 0.8, 0.9}};
    uint32_t corners[2][3][4], rings = 0, at = 0;
    for (int top = 0; top < 2; top++)
        for (int s = 0; s < 3; s++)
            for (int k = 0; k < 4; k++)
                corners[top][s][k] = add_position(g, squares[s][k == 1 || k == 2 ? 2 : 0], squares[s][k >= 2 ? 3 : 1],
                                                  top ? 0.25 : -0.25);
    for (int top = 0; top < 2; top++) {
        for (int s = 0; s < 3; s++) {
            const bool forward = (s == 0) == (top == 1);
            for (int k = 0; k < 4; k++)
                g->indices[at++] = corners[top][s][forward ? k : 3 - k];
            g->ring_offsets[++rings] = at;
        }
        g->offsets[++g->mesh.face_count] = at;
        g->rings[g->mesh.face_count] = rings;
    }
    for (int s = 0; s < 3; s++)
        for (int k = 0; k < 4; k++) {
            const uint32_t a = corners[0][s][k], b = corners[0][s][(k + 1) % 4], c = corners[1][s][(k + 1) % 4],
                           d = corners[1][s][k];
            add_face(g, s == 0 ? (const uint32_t[4]){a, b, c, d} : (const uint32_t[4]){d, c, b, a}, 4);
            g->ring_offsets[++rings] = g->offsets[g->mesh.face_count];
            g->rings[g->mesh.face_count] = rings;
        }
    g->mesh.face_rings = g->rings;
    g->mesh.ring_offsets = g->ring_offsets;
}

struct zr_mesh solid_make(struct zr_arena *arena, enum solid solid)
{
    static const double ones[2][3] = {{-1, -1, -1}, {1, 1, 1}}, inner[2][3] = {{-0.5, -0.4, -0.3}, {0.6, 0.5, 0.4}},
                        other[2][3] = {{0.25, 0.25, 0.25}, {1.5, 1.25, 1.75}};
    struct growing g = begin(arena);
    switch (solid) {
    case SOLID_CUBE:
        add_box(&g, ones[0], ones[1], false);
        break;
    case SOLID_SPHERE:
        add_sphere(&g, 24, 12, false);
        break;
    case SOLID_TORUS:
        add_torus(&g, 24, 12, 1.0, 0.4, true);
        break;
    case SOLID_RING:
        add_torus(&g, 20, 10, 1.0, 0.5, false);
        break;
    case SOLID_HOLLOW:
        add_box(&g, ones[0], ones[1], false);
        add_box(&g, inner[0], inner[1], true);
        break;
    case SOLID_OVERLAPPING:
        add_box(&g, ones[0], ones[1], false);
        add_box(&g, inner[0], inner[1], false);
        add_box(&g, other[0], other[1], false);
        break;
    case SOLID_PLATE:
        make_plate(&g);
        break;
    default:
        add_sphere(&g, 16, 8, true);
        break;
    }
    return g.mesh;
}

double solid_volume(const struct zr_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const struct zr_rings rings = zr_mesh_rings(mesh, face);
        for (uint32_t r = 0; r < rings.count; r++)
            for (uint32_t i = rings.offsets[r] + 2; i < rings.offsets[r + 1]; i++) {
                const zr_vec4 a = mesh->positions[mesh->indices[rings.offsets[r]]],
                              b = mesh->positions[mesh->indices[i - 1]], c = mesh->positions[mesh->indices[i]];
                const double p[3][3] = {{(double)a.x, (double)a.y, (double)a.z},
                                        {(double)b.x, (double)b.y, (double)b.z},
                                        {(double)c.x, (double)c.y, (double)c.z}};
                sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                       p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                       p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
            }
    }
    return sum / 6.0;
}
