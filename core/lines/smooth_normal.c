#include "lines/smooth_normal.h"

static const float cosine_least = 0.6f;

/* A triangle and its small neighbours. */
struct ring {
    uint32_t count;
    uint32_t triangles[4]; /* the first one is the triangle itself */
    float signs[4];        /* -1: wound against it */
};

static float dot(const float a[3], const float b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static void add_neighbour(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of, uint32_t side,
                          struct ring *ring)
{
    const struct zr_edge_mesh *table = of->table;
    const uint32_t edge = table->side_edges[side], first = table->edges[edge].first_side;
    if (zr_edge_side_count(table, edge) != 2) return;
    const uint32_t other = table->sides[first] == side ? table->sides[first + 1] : table->sides[first];
    const uint32_t next = of->first_triangle + other / 3;
    if (next == ring->triangles[0] || !(mesh->traits[next] & ZR_TRIANGLE_SMALL)) return;
    ring->triangles[ring->count] = next;
    ring->signs[ring->count++] = zr_side_is_upward(table, side) == zr_side_is_upward(table, other) ? -1.0f : 1.0f;
}

/* Returns the triangle alone if it is not small. */
static struct ring ring_of(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of, uint32_t triangle)
{
    struct ring ring = {.count = 1, .triangles = {triangle}, .signs = {1.0f}};
    for (uint32_t k = 0; mesh->traits[triangle] & ZR_TRIANGLE_SMALL && k < 3; k++)
        add_neighbour(mesh, of, 3 * (triangle - of->first_triangle) + k, &ring);
    return ring;
}

/* Averages the normals of a ring. */
static void average(const struct zr_window_mesh *mesh, const struct ring *ring, const float (*normals)[3], float out[3])
{
    const float area = mesh->areas[ring->triangles[0]];
    float sum[3] = {area * normals[0][0], area * normals[0][1], area * normals[0][2]};
    memcpy(out, normals[0], sizeof sum);
    for (uint32_t i = 1; i < ring->count; i++) {
        const float cosine = ring->signs[i] * dot(normals[0], normals[i]);
        if (!(cosine > cosine_least)) continue;
        const float share = (cosine - cosine_least) / (1.0f - cosine_least);
        const float weight = ring->signs[i] * mesh->areas[ring->triangles[i]] * share;
        for (int k = 0; k < 3; k++)
            sum[k] += weight * normals[i][k];
    }
    const float length = sqrtf(dot(sum, sum));
    for (int k = 0; length > 0.0f && k < 3; k++)
        out[k] = sum[k] / length;
}

/* The first round. */
static void average_given(const struct zr_window_mesh *mesh, const struct ring *ring, float out[3])
{
    float normals[4][3];
    for (uint32_t i = 0; i < ring->count; i++)
        memcpy(normals[i], mesh->normals[ring->triangles[i]], sizeof normals[i]);
    average(mesh, ring, (const float(*)[3])normals, out);
}

void zr_smooth_normal_of(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of, uint32_t triangle,
                         float out[3])
{
    const struct ring ring = ring_of(mesh, of, triangle);
    float normals[4][3];
    average_given(mesh, &ring, normals[0]);
    for (uint32_t i = 1; i < ring.count; i++) {
        const struct ring around = ring_of(mesh, of, ring.triangles[i]);
        average_given(mesh, &around, normals[i]);
    }
    average(mesh, &ring, (const float(*)[3])normals, out);
}
