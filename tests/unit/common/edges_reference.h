/* edges_reference.h - tests: pictures of samples. */
#ifndef ZR_TESTS_EDGES_REFERENCE_H
#define ZR_TESTS_EDGES_REFERENCE_H

#include <math.h>
#include <string.h>

#include "effects/edges.h"
#include "support/random.h"

static struct random dice = {{RANDOM_STATE_1}};

static float between(double low, double high)
{
    return (float)random_range(&dice, low, high);
}

/* ---- pictures: planes, spheres' normals, lines and holes, one over the other ---- */

enum { MOST = 512 }; /* samples a row */

struct sample {
    uint32_t owner;
    zr_vec3 normal, point;
};

struct picture {
    uint32_t width, height, side;
    int columns, rows;
    struct zr_edges edges;
    struct zr_pixel_scale scale;
    struct sample samples[MOST * MOST]; /* [row * MOST + column] */
};

static struct picture picture;

static void begin_picture(uint32_t width, uint32_t height, uint32_t side, bool is_parallel)
{
    picture.width = width, picture.height = height, picture.side = side;
    picture.columns = (int)(width * side), picture.rows = (int)(height * side);
    picture.edges = (struct zr_edges){.is_on = true,
                                      .width = 1.5f,
                                      .keeps_width = true,
                                      .crease_degrees = 30.0f,
                                      .silhouette_opacity = 1.0f,
                                      .crease_opacity = 0.85f};
    /* 20 pixels a unit; of a perspective, at a depth of 1 */
    picture.scale = (struct zr_pixel_scale){20.0f, {0.0f, 0.0f, is_parallel ? 0.0f : -1.0f}, is_parallel ? 1.0f : 0.0f};
    const struct sample nobody = {0, {0, 0, 0}, {1e18f, 1e18f, 1e18f}};
    for (int i = 0; i < MOST * MOST; i++)
        picture.samples[i] = nobody;
}

static zr_vec3 any_normal(void)
{
    const float x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(0.5, 1.0);
    return zr_vec3_normalize((zr_vec3){x, y, z});
}

/* Where the ray of a sample meets the plane through the middle of its own depth. */
static zr_vec3 point_on(int x, int y, zr_vec3 normal, float depth)
{
    const float step = 1.0f / (20.0f * (float)picture.side);
    const float u = ((float)(x - picture.columns / 2) + 0.5f) * step;
    const float v = ((float)(y - picture.rows / 2) + 0.5f) * step;
    if (picture.scale.offset > 0.0f) return (zr_vec3){u, v, -depth - (normal.x * u + normal.y * v) / normal.z};
    const float t = depth * normal.z / (normal.z - normal.x * u - normal.y * v);
    return (zr_vec3){u * t, v * t, -t};
}

enum kind { PLANE, BALL, LINE, HOLE, KINDS };

struct patch {
    enum kind kind;
    uint32_t owner;
    int left, bottom, right, top;
    zr_vec3 normal;
    float depth;
};

static void draw_sample(const struct patch *patch, int x, int y)
{
    const float u = 1.6f * (float)(x - patch->left) / (float)(patch->right - patch->left) - 0.8f;
    const float v = 1.6f * (float)(y - patch->bottom) / (float)(patch->top - patch->bottom) - 0.8f;
    struct sample *sample = &picture.samples[y * MOST + x];
    *sample = (struct sample){patch->owner, patch->normal, point_on(x, y, patch->normal, patch->depth)};
    if (patch->kind == BALL) sample->normal = zr_vec3_normalize((zr_vec3){u, v, 0.5f});
    if (patch->kind == LINE) sample->normal = (zr_vec3){0, 0, 0};
    if (patch->kind == HOLE) *sample = (struct sample){0, {0, 0, 0}, {1e18f, 1e18f, 1e18f}};
}

static void draw_patch(const struct patch *patch)
{
    for (int y = patch->bottom; y < patch->top && y < picture.rows; y++)
        for (int x = patch->left; x < patch->right && x < picture.columns; x++)
            draw_sample(patch, x, y);
}

static void draw_patches(int count)
{
    for (int i = 0; i < count; i++) {
        struct patch patch = {.kind = (enum kind)random_below(&dice, KINDS), .owner = (uint32_t)i + 1};
        const uint32_t most = random_below(&dice, 3) ? 100 : 5;
        patch.left = (int)random_below(&dice, (uint32_t)picture.columns);
        patch.bottom = (int)random_below(&dice, (uint32_t)picture.rows);
        patch.right = patch.left + 1 + (int)random_below(&dice, most);
        patch.top = patch.bottom + 1 + (int)random_below(&dice, most);
        patch.normal = any_normal();
        patch.depth = between(4.0, 4.5);
        draw_patch(&patch);
    }
}

#endif
